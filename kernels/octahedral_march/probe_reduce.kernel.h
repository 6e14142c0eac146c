// Octahedral maps of probes at a lower resolution, texels weighted by their solid angles: of radiance the mean, of distance the
// mean and the standard deviation of the mixture. What is no number is left out (radiance) or hides (distance: 0).

#if DISTANCE
FN float value_of(CTX, int texel) {
#if PACKED
    const float d = f16_value((load(src, texel >> 1) >> uint(16 * (texel & 1))) & 0xffffu);
#else
    const float d = load_pixel(src, 0, texel, 0) / params.unit_length;
#endif
    return d >= 0.0f ? min(d, params.farthest) : 0.0f;
}
#else
FN vec4 value_of(CTX, int texel) {
#if PACKED
    const vec3 v = r11g11b10_value(load(src, texel));
    return vec4(v.x, v.y, v.z, 0.0f);
#else
    return load_pixel(src, 0, texel, 0);
#endif
}
#endif

KERNEL(probe_reduce) {
    const int i = invocation_x();
    const int made = invocation_y();
    if (i >= params.reduced * params.reduced || made >= params.probes) return;
#if LIST
    const int probe = int(load(list, made));
#else
    const int probe = made;
#endif
    const int factor = params.size / params.reduced;
    const int x0 = i % params.reduced * factor;
    const int y0 = i / params.reduced * factor;
    const int to = made * params.reduced * params.reduced + i;
    float all = 0.0f;
#if DISTANCE
    float mean = 0.0f;
    for (int y = y0; y < y0 + factor; ++y)
        for (int x = x0; x < x0 + factor; ++x) {
            const float w = octahedral_solid_angle(x, y, params.size);
            all += w;
            mean += w * value_of(ctx, (probe * params.size + y) * params.size + x);
        }
    mean = mean / all;
    float squares = 0.0f;
    if (factor > 1)
        for (int y = y0; y < y0 + factor; ++y)
            for (int x = x0; x < x0 + factor; ++x) {
                const float d = value_of(ctx, (probe * params.size + y) * params.size + x) - mean;
                squares += octahedral_solid_angle(x, y, params.size) * (d * d);
            }
    store(moments, 2 * to, factor > 1 ? mean : value_of(ctx, (probe * params.size + y0) * params.size + x0));
    store(moments, 2 * to + 1, sqrt(squares / all));
#else
    vec4 sum = vec4(0.0f);  // the fourth: of the texels that are numbers
    for (int y = y0; y < y0 + factor; ++y)
        for (int x = x0; x < x0 + factor; ++x) {
            const float w = octahedral_solid_angle(x, y, params.size);
            const vec4 v = value_of(ctx, (probe * params.size + y) * params.size + x);
            all += w;
            if (finite(vec4(v.x, v.y, v.z, 0.0f))) sum = sum + w * vec4(v.x, v.y, v.z, 1.0f);
        }
    store(means, to, sum / all);
#endif
}
