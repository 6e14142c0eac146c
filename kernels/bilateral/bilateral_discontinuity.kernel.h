// A Gaussian blur along one axis that goes on to both sides until an edge of the mask stops it (Segovia et al. 2006).

FN bool is_finite(pixel v) {
#if CHANNELS == 1
    return v - v == 0.0f;
#elif CHANNELS == 2
    const pixel zero = v - v;
    return zero.x + zero.y == 0.0f;
#else
    const pixel zero = v - v;
    return (zero.x + zero.y) + (zero.z + zero.w) == 0.0f;
#endif
}

FN uint mask_at(CTX, int x, int y, int t) {
    return load(mask, AXIS == 0 ? y * params.width + x + t : (y + t) * params.width + x);
}

KERNEL(bilateral_discontinuity) {
    const int x = invocation_x();
    const int y = invocation_y();
    if (x >= params.width || y >= params.height) return;
    const pixel centre = load_pixel(src, params.src_stride, x, y);
#if CHANNELS == 1
    pixel sum = 0.0f;
#elif CHANNELS == 2
    pixel sum = vec2(0.0f);
#else
    pixel sum = vec4(0.0f);
#endif
    float weight = 1.0f;
    const bool finite = is_finite(centre);
    for (int side = 0; side < 2; ++side) {
        const int sign = side == 0 ? 1 : -1;
        const uint edge = AXIS == 0 ? (side == 0 ? 1u : 4u) : (side == 0 ? 2u : 8u);
        for (int t = 1; t <= RADIUS; ++t) {
            if ((mask_at(ctx, x, y, sign * (t - 1)) & edge) != 0u) break;
            const pixel v = load_pixel(src, params.src_stride, AXIS == 0 ? x + sign * t : x, AXIS == 0 ? y : y + sign * t);
            if (!is_finite(v)) continue;
            const float w = table(weights, t);
            weight += w;
            sum = sum + w * (v - centre);
        }
    }
    pixel result = finite ? centre + sum / weight : centre;
#if CHANNELS == 4
    if (ALPHA == 0) result.w = centre.w;
#endif
    store_pixel(dst, params.dst_stride, x, y, result);
}
