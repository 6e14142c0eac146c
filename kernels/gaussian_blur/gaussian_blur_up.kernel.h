// The next finer level of the blur's pyramid: every coarse pixel gives two fine ones an axis, each a weighted sum of TAPS
// coarse pixels (linear interpolation or a cubic B-spline, at a quarter of a coarse pixel from its centre).

FN pixel at(CTX, int x, int y) {
    return load_pixel(src, params.src_stride, min(x, params.src_width - 1), min(y, params.src_height - 1));
}

FN void put(CTX, int x, int y, pixel p) {
    if (x < 0 || x >= params.dst_width || y < 0 || y >= params.dst_height) return;
    if (COVERED != 0) p = p / (load(coverage_x, x) * load(coverage_y, y));
    store_pixel(dst, params.dst_stride, x, y, p);
}

// The weight of tap k in the first or second half of a coarse pixel.
FN float weight(CTX, int k, int second) { return table(weights, second != 0 ? TAPS - 1 - k : k); }

// The column at x, weighted for one of the two rows.
FN pixel column(CTX, int x, int y, int second) {
    if (DOUBLE_Y == 0) return at(ctx, x, y);
    pixel sum = weight(ctx, 0, second) * at(ctx, x, y);
    UNROLL for (int k = 1; k < TAPS; ++k) sum = sum + weight(ctx, k, second) * at(ctx, x, y + k);
    return sum;
}

KERNEL(gaussian_blur_up) {
    const int i = invocation_x() * BLOCK;
    const int j = invocation_y();
    const int x = (DOUBLE_X != 0 ? 2 * i : i) - params.odd_x;
    const int y = (DOUBLE_Y != 0 ? 2 * j : j) - params.odd_y;
    if (x >= params.dst_width || y >= params.dst_height) return;
    UNROLL for (int v = 0; v < 2; ++v) {
        if (DOUBLE_Y != 0 || v == 0) {
            ARRAY(pixel, columns, BLOCK + TAPS - 1)
            UNROLL for (int c = 0; c < (DOUBLE_X != 0 ? BLOCK + TAPS - 1 : BLOCK); ++c)
                columns[c] = column(ctx, params.first_x + i + c, params.first_y + j, v);
            UNROLL for (int b = 0; b < BLOCK; ++b) {
                if (DOUBLE_X != 0) {
                    UNROLL for (int h = 0; h < 2; ++h) {
                        pixel sum = weight(ctx, 0, h) * columns[b];
                        UNROLL for (int k = 1; k < TAPS; ++k) sum = sum + weight(ctx, k, h) * columns[b + k];
                        put(ctx, x + 2 * b + h, y + v, sum);
                    }
                } else {
                    put(ctx, x + b, y + v, columns[b]);
                }
            }
        }
    }
}
