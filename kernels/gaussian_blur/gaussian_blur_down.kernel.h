// The next coarser level of the blur's pyramid: binomial weights over TAPS x TAPS pixels around each 2x2 (Burt and Adelson,
// The Laplacian Pyramid as a Compact Image Code, 1983, with even taps, so that samples lie in the centres of cells).

FN pixel at(CTX, int x, int y, bool inside) {
    const bool outside = !inside && (x < 0 || x >= params.src_width || y < 0 || y >= params.src_height);
    if (BORDER == BORDER_ZERO && outside) return get_pixel(wide_splat(0.0f), 0);
    if (ONES != 0) return get_pixel(wide_splat(1.0f), 0);
    return load_pixel(src, params.src_stride, outside ? border_index(BORDER, x, params.src_width) : x,
                      outside ? border_index(BORDER, y, params.src_height) : y);
}

// The column at x, weighted.
FN pixel column(CTX, int x, int y, bool inside) {
    if (HALVE_Y == 0) return at(ctx, x, y, inside);
    pixel sum = table(weights, 0) * at(ctx, x, y, inside);
    UNROLL for (int k = 1; k < TAPS; ++k) sum = sum + table(weights, k) * at(ctx, x, y + k, inside);
    return sum;
}

FN void reduce(CTX, int x, int y, int from_x, int from_y, bool inside) {
    const int step = HALVE_X != 0 ? 2 : 1;
    ARRAY(pixel, columns, BLOCK * 2 + TAPS - 2)
    UNROLL for (int i = 0; i < (HALVE_X != 0 ? BLOCK * 2 + TAPS - 2 : BLOCK); ++i)
        columns[i] = column(ctx, from_x + i, from_y, inside);
    UNROLL for (int b = 0; b < BLOCK; ++b) {
        pixel sum = columns[step * b];
        if (HALVE_X != 0) {
            sum = table(weights, 0) * sum;
            UNROLL for (int k = 1; k < TAPS; ++k) sum = sum + table(weights, k) * columns[step * b + k];
        }
        if (x + b < params.dst_width) store_pixel(dst, params.dst_width, x + b, y, sum);
    }
}

KERNEL(gaussian_blur_down) {
    const int x = invocation_x() * BLOCK;
    const int y = invocation_y();
    if (x >= params.dst_width || y >= params.dst_height) return;
    const int from_x = params.first_x + (HALVE_X != 0 ? 2 * x : x);
    const int from_y = params.first_y + (HALVE_Y != 0 ? 2 * y : y);
    // Each form stands alone, so that no test for the border is left in the loops.
    if (from_x >= 0 && from_x + BLOCK * 2 + TAPS - 2 <= params.src_width && from_y >= 0 && from_y + TAPS <= params.src_height)
        reduce(ctx, x, y, from_x, from_y, true);
    else
        reduce(ctx, x, y, from_x, from_y, false);
}
