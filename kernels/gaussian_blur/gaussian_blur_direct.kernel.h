// Gaussian blur in one pass of (2 RADIUS_X + 1)(2 RADIUS_Y + 1) taps, the baseline of the separable form
// (Akenine-Moeller et al., Real-Time Rendering 4e, 12.1, d^2 against 2d). `inside` says that no tap leaves the image.

// 1 where column x + tx is in the image, for each pixel of the wide; else 0.
FN wide within(CTX, int x, int tx) {
    wide w = wide_splat(0.0f);
    UNROLL for (int k = 0; k < PIXELS; ++k) {
        int at = min(x + k, params.width - 1) + tx;
        if (at >= 0 && at < params.width) set_pixel(w, k, get_pixel(wide_splat(1.0f), k));
    }
    return w;
}

FN wide tap(CTX, int x, int y, int tx, bool inside) {
    if (inside) return load_wide(src, params.src_stride, x + tx, y);
    wide w;
    UNROLL for (int k = 0; k < PIXELS; ++k)
        set_pixel(w, k, load_pixel(src, params.src_stride, border_index(BORDER, min(x + k, params.width - 1) + tx, params.width), y));
    return w;
}

FN wide pair(CTX, wide origin, int x, int y, int tx, bool inside) {
    wide low = tap(ctx, x, y, -tx, inside) - origin;
    wide high = tap(ctx, x, y, tx, inside) - origin;
    if (BORDER == BORDER_ZERO && !inside) {
        low = choose(within(ctx, x, -tx), low, wide_splat(0.0f));
        high = choose(within(ctx, x, tx), high, wide_splat(0.0f));
    }
    return table(row_weights, tx) * (low + high);
}

// The weighted sum along row y, relative to origin (zero where the plain form is asked for).
FN wide row(CTX, wide origin, int x, int y, bool inside) {
    wide sum = table(row_weights, 0) * (tap(ctx, x, y, 0, inside) - origin);
    if (UNROLLED != 0) {
        UNROLL for (int t = 1; t <= RADIUS_X; ++t) sum = sum + pair(ctx, origin, x, y, t, inside);
    } else {
        for (int t = 1; t <= RADIUS_X; ++t) sum = sum + pair(ctx, origin, x, y, t, inside);
    }
    return sum;
}

// The sum of the weights of the taps that are in the image.
FN wide weight_within(CTX, int x, int y) {
    wide along = wide_splat(table(row_weights, 0));
    for (int t = 1; t <= RADIUS_X; ++t) along = along + table(row_weights, t) * (within(ctx, x, -t) + within(ctx, x, t));
    float across = table(column_weights, 0);
    for (int t = 1; t <= RADIUS_Y; ++t)
        across = across + table(column_weights, t) * ((y - t >= 0 ? 1.0f : 0.0f) + (y + t < params.height ? 1.0f : 0.0f));
    return across * along;
}

// The row at distance t; nothing where it is outside and outside is nothing.
FN wide row_at(CTX, wide origin, int x, int y, int t, bool inside) {
    if (inside) return row(ctx, origin, x, y + t, true);
    if (BORDER == BORDER_ZERO && (y + t < 0 || y + t >= params.height)) return wide_splat(0.0f);
    return row(ctx, origin, x, border_index(BORDER, y + t, params.height), false);
}

FN wide blur(CTX, int x, int y, bool inside) {
    wide centre = tap(ctx, x, y, 0, inside);
    wide origin = DIFFERENCE != 0 ? centre : wide_splat(0.0f);
    wide sum = table(column_weights, 0) * row_at(ctx, origin, x, y, 0, inside);
    for (int t = 1; t <= RADIUS_Y; ++t)
        sum = sum + table(column_weights, t) * (row_at(ctx, origin, x, y, -t, inside) + row_at(ctx, origin, x, y, t, inside));
    if (BORDER == BORDER_ZERO && !inside) sum = sum / weight_within(ctx, x, y);
    if (DIFFERENCE != 0) sum = centre + sum;
    return KEEP_ALPHA != 0 ? with_alpha_of(sum, centre) : sum;
}

KERNEL(gaussian_blur_direct) {
    const int x = invocation_x() * PIXELS;
    const int y = invocation_y();
    if (x >= params.width || y >= params.height) return;
    const bool inside = x >= RADIUS_X && x + PIXELS + RADIUS_X <= params.width &&
                        y >= RADIUS_Y && y + 1 + RADIUS_Y <= params.height;
    if (SPLIT != 0 && inside) {
        store_wide(dst, params.dst_stride, x, y, blur(ctx, x, y, true));
        return;
    }
    wide result = blur(ctx, x, y, false);
    UNROLL for (int k = 0; k < PIXELS; ++k)
        if (x + k < params.width) store_pixel(dst, params.dst_stride, x + k, y, get_pixel(result, k));
}
