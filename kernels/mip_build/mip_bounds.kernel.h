// A coarser level of a pyramid of bounds: each texel holds the minimum, the maximum or both of those it covers.
// Source: Akenine-Moeller et al., Real-Time Rendering 4e, 2018, 11.6.5; McGuire et al. 2017, 4.2 (one step of 16).

FN RANGE fine(CTX, int x, int y) {
#if ONE
    float v = load_pixel(src, params.src_x, x, y);
    return vec2(v, v);
#else
    return load_pixel(src, params.src_x, x, y);
#endif
}

#if CHANNELS == 1 && ONE == 0
FN float wider(float a, float b) { return UPPER != 0 ? upper_of(a, b) : lower_of(a, b); }
#else
FN vec2 wider(vec2 a, vec2 b) { return vec2(lower_of(a.x, b.x), upper_of(a.y, b.y)); }
#endif

// The last of n texels that texel i of m covers.
FN int last_covered(CTX, int i, int m, int n) {
    return params.cover_rest != 0 && i == m - 1 ? n - 1 : min(i * RATIO + RATIO, n) - 1;
}

KERNEL(mip_bounds) {
    const int x = invocation_x();
    const int y = invocation_y();
    if (x >= params.dst_x || y >= params.dst_y) return;
    const int last_x = last_covered(ctx, x, params.dst_x, params.src_x);
    const int last_y = last_covered(ctx, y, params.dst_y, params.src_y);
    RANGE v = fine(ctx, x * RATIO, y * RATIO);
    if (RATIO == 2) {
        UNROLL for (int j = 0; j < TAPS_Y; ++j)
            UNROLL for (int k = 0; k < TAPS_X; ++k)
                if (j + k > 0) v = wider(v, fine(ctx, min(x * 2 + k, last_x), min(y * 2 + j, last_y)));
    } else {
        for (int j = y * RATIO; j <= last_y; ++j)
            for (int k = x * RATIO; k <= last_x; ++k) v = wider(v, fine(ctx, k, j));
    }
#if OUTWARD
    v = in_double(params.src_x) ? v : outward_f16(v);
#endif
    store_pixel(dst, params.dst_x, x, y, v);
}
