// One pass of a separable Gaussian blur (Akenine-Moeller et al., Real-Time Rendering 4e, 12.1, eq. 12.1):
//   dst(p) = w(0) src(p) + sum over t = 1..radius of w(t) (src(p - t) + src(p + t))
// along one axis, with weights that the host normalised. An invocation computes BLOCK results, each one step further along
// the axis from (x, y). `inside` says that no tap of theirs leaves the image.

// Taps on each side. A constant only where they are unrolled, so that elsewhere one compilation serves every radius.
FN int taps(CTX) { return UNROLLED != 0 ? RADIUS : params.radius; }

// The pixels at distance d along the axis from those of the wide at (x, y).
FN wide tap(CTX, int x, int y, int d, bool inside) {
    if (inside) return AXIS == 0 ? load_wide(src, params.src_stride, x + d, y) : load_wide(src, params.src_stride, x, y + d);
    int sy = AXIS == 0 ? y : border_index(BORDER, y + d, params.height);
    wide w;
    UNROLL for (int k = 0; k < PIXELS; ++k) {
        int sx = AXIS == 0 ? border_index(BORDER, x + k + d, params.width) : min(x + k, params.width - 1);
        set_pixel(w, k, load_pixel(src, params.src_stride, sx, sy));
    }
    return w;
}

// 1 where the pixel at distance d is in the image, for each pixel of the wide; else 0.
FN wide within(CTX, int x, int y, int d) {
    wide w = wide_splat(0.0f);
    UNROLL for (int k = 0; k < PIXELS; ++k) {
        int at = AXIS == 0 ? x + k + d : y + d;
        if (at >= 0 && at < (AXIS == 0 ? params.width : params.height)) set_pixel(w, k, get_pixel(wide_splat(1.0f), k));
    }
    return w;
}

// The weighted centre, and the weighted taps at -t and t; in difference form what they hold beyond the centre.
FN wide first(CTX, wide centre) { return DIFFERENCE != 0 ? wide_splat(0.0f) : table(weights, 0) * centre; }
FN wide pair(CTX, wide centre, wide low, wide high, int t) {
    return table(weights, t) * (DIFFERENCE != 0 ? (low - centre) + (high - centre) : low + high);
}
FN wide result(CTX, wide centre, wide sum) {
    if (DIFFERENCE != 0) sum = centre + sum;
    return KEEP_ALPHA != 0 ? with_alpha_of(sum, centre) : sum;
}

// The result at distance d, tap by tap. Where outside is nothing, the weights inside are renormalised.
FN wide blur(CTX, int x, int y, int d, bool inside) {
    const bool renormalise = BORDER == BORDER_ZERO && !inside;
    wide centre = tap(ctx, x, y, d, inside);
    wide sum = first(ctx, centre);
    wide weight = wide_splat(table(weights, 0));
    for (int t = 1; t <= taps(ctx); ++t) {
        wide low = tap(ctx, x, y, d - t, inside);
        wide high = tap(ctx, x, y, d + t, inside);
        if (renormalise) {
            wide counts_low = within(ctx, x, y, d - t);
            wide counts_high = within(ctx, x, y, d + t);
            weight = weight + table(weights, t) * (counts_low + counts_high);
            wide outside = DIFFERENCE != 0 ? centre : wide_splat(0.0f);
            low = choose(counts_low, low, outside);
            high = choose(counts_high, high, outside);
        }
        sum = sum + pair(ctx, centre, low, high, t);
    }
    return result(ctx, centre, renormalise ? sum / weight : sum);
}

FN void put(CTX, int x, int y, int d, wide w, bool inside) {
    int dx = AXIS == 0 ? x + d : x;
    int dy = AXIS == 0 ? y : y + d;
    if (inside) {
        store_wide(dst, params.dst_stride, dx, dy, w);
    } else {
        UNROLL for (int k = 0; k < PIXELS; ++k)
            if (dx + k < params.width && dy < params.height) store_pixel(dst, params.dst_stride, dx + k, dy, get_pixel(w, k));
    }
}

// All results, from taps that are loaded once: for radii that are unrolled.
FN void blur_block(CTX, int x, int y, bool inside) {
    ARRAY(wide, line, UNROLLED != 0 ? BLOCK + 2 * RADIUS : 1)
    UNROLL for (int i = 0; i < BLOCK + 2 * RADIUS; ++i) line[i] = tap(ctx, x, y, i - RADIUS, inside);
    UNROLL for (int b = 0; b < BLOCK; ++b) {
        wide centre = line[b + RADIUS];
        wide sum = first(ctx, centre);
        UNROLL for (int t = 1; t <= RADIUS; ++t)
            sum = sum + pair(ctx, centre, line[b + RADIUS - t], line[b + RADIUS + t], t);
        put(ctx, x, y, b, result(ctx, centre, sum), inside);
    }
}

KERNEL(gaussian_blur) {
    const int across = AXIS == 0 ? PIXELS * BLOCK : PIXELS;
    const int down = AXIS == 0 ? 1 : BLOCK;
    const int x = invocation_x() * across;
    const int y = invocation_y() * down;
    if (x >= params.width || y >= params.height) return;
    const int reach_x = AXIS == 0 ? taps(ctx) : 0;
    const int reach_y = AXIS == 0 ? 0 : taps(ctx);
    const bool inside = x >= reach_x && x + across + reach_x <= params.width &&
                        y >= reach_y && y + down + reach_y <= params.height;
    // Each form stands alone, so that no test for the border is left in the loop over taps.
    if (SPLIT != 0 && inside) {
        if (UNROLLED != 0) blur_block(ctx, x, y, true);
        else for (int b = 0; b < BLOCK; ++b) put(ctx, x, y, b, blur(ctx, x, y, b, true), true);
    } else {
        if (UNROLLED != 0 && SPLIT == 0 && BORDER != BORDER_ZERO) blur_block(ctx, x, y, false);
        else for (int b = 0; b < BLOCK; ++b) put(ctx, x, y, b, blur(ctx, x, y, b, false), false);
    }
}
