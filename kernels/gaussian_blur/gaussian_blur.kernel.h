// One pass of a separable Gaussian blur (Akenine-Moeller et al., Real-Time Rendering 4e, 12.1, eq. 12.1):
//   dst(p) = w(0) src(p) + sum over t = 1..RADIUS of w(t) (src(p - t) + src(p + t))
// along one axis, with weights that the host normalised. `inside` says that no tap leaves the image.

// 1 where the pixel at distance t along the axis is in the image, for each pixel of the wide at (x, y); else 0.
FN wide within(CTX, int x, int y, int t) {
    wide w = wide_splat(0.0f);
    UNROLL for (int k = 0; k < PIXELS; ++k) {
        int at = AXIS == 0 ? min(x + k, params.width - 1) + t : y + t;
        if (at >= 0 && at < (AXIS == 0 ? params.width : params.height)) set_pixel(w, k, get_pixel(wide_splat(1.0f), k));
    }
    return w;
}

// The pixels at distance t along the axis from those of the wide at (x, y).
FN wide tap(CTX, int x, int y, int t, bool inside) {
    if (inside) return AXIS == 0 ? load_wide(src, params.src_stride, x + t, y) : load_wide(src, params.src_stride, x, y + t);
    int sy = AXIS == 0 ? y : border_index(BORDER, y + t, params.height);
    wide w;
    UNROLL for (int k = 0; k < PIXELS; ++k) {
        int sx = min(x + k, params.width - 1);
        if (AXIS == 0) sx = border_index(BORDER, sx + t, params.width);
        set_pixel(w, k, load_pixel(src, params.src_stride, sx, sy));
    }
    return w;
}

// w(t) times what the taps at -t and t hold, in difference form beyond what the centre holds.
FN wide pair(CTX, wide centre, int x, int y, int t, bool inside) {
    wide low = tap(ctx, x, y, -t, inside);
    wide high = tap(ctx, x, y, t, inside);
    if (DIFFERENCE != 0) {
        low = low - centre;
        high = high - centre;
    }
    if (BORDER == BORDER_ZERO && !inside) {
        low = choose(within(ctx, x, y, -t), low);
        high = choose(within(ctx, x, y, t), high);
    }
    return table(weights, t) * (low + high);
}

// The sum of the weights of the taps that are in the image.
FN wide weight_within(CTX, int x, int y) {
    wide sum = wide_splat(table(weights, 0));
    for (int t = 1; t <= RADIUS; ++t) sum = sum + table(weights, t) * (within(ctx, x, y, -t) + within(ctx, x, y, t));
    return sum;
}

FN wide blur(CTX, int x, int y, bool inside) {
    wide centre = tap(ctx, x, y, 0, inside);
    wide sum = DIFFERENCE != 0 ? wide_splat(0.0f) : table(weights, 0) * centre;
    if (UNROLLED != 0) {
        UNROLL for (int t = 1; t <= RADIUS; ++t) sum = sum + pair(ctx, centre, x, y, t, inside);
    } else {
        for (int t = 1; t <= RADIUS; ++t) sum = sum + pair(ctx, centre, x, y, t, inside);
    }
    if (BORDER == BORDER_ZERO && !inside) sum = sum / weight_within(ctx, x, y);
    if (DIFFERENCE != 0) sum = centre + sum;
    return KEEP_ALPHA != 0 ? with_alpha_of(sum, centre) : sum;
}

KERNEL(gaussian_blur) {
    const bool sideways = AXIS == 0 && PIXELS == 1;  // an invocation's results follow each other along the row
    const int across = sideways ? BLOCK : PIXELS;
    const int down = sideways ? 1 : BLOCK;
    const int x = invocation_x() * across;
    const int y = invocation_y() * down;
    if (x >= params.width || y >= params.height) return;
    const int reach_x = AXIS == 0 ? RADIUS : 0;
    const int reach_y = AXIS == 1 ? RADIUS : 0;
    const bool inside = x >= reach_x && x + across + reach_x <= params.width &&
                        y >= reach_y && y + down + reach_y <= params.height;
    wide result[BLOCK];
    if (SPLIT != 0 && inside) {
        UNROLL for (int b = 0; b < BLOCK; ++b) result[b] = blur(ctx, sideways ? x + b : x, sideways ? y : y + b, true);
        UNROLL for (int b = 0; b < BLOCK; ++b)
            store_wide(dst, params.dst_stride, sideways ? x + b : x, sideways ? y : y + b, result[b]);
        return;
    }
    UNROLL for (int b = 0; b < BLOCK; ++b)
        result[b] = blur(ctx, sideways ? min(x + b, params.width - 1) : x, sideways ? y : min(y + b, params.height - 1), false);
    UNROLL for (int b = 0; b < BLOCK; ++b)
        UNROLL for (int k = 0; k < PIXELS; ++k)
            if ((sideways ? x + b : x + k) < params.width && (sideways ? y : y + b) < params.height)
                store_pixel(dst, params.dst_stride, sideways ? x + b : x + k, sideways ? y : y + b, get_pixel(result[b], k));
}
