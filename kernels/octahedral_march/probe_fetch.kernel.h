// Radiance of the texels that probe_trace's rays met.
#define HIT 1
#define MISS 2
#define ASSUMED 6

KERNEL(probe_fetch) {
    for (int i = invocation_x(); i < params.rays; i += params.stride) {
        const int outcome = int(load(hits, i).y);
        const uint texel = load(texels, i);
        vec4 v = vec4(0.0f, 0.0f, 0.0f, 0.0f);
        if ((outcome == HIT || outcome == ASSUMED) && texel < uint(params.texel_count)) {
#if PACKED
            const vec3 c = r11g11b10_value(load(radiance, int(texel)));
            v = vec4(c.x, c.y, c.z, 1.0f);
#else
            v = load_pixel(radiance, 0, int(texel), 0);
            v.w = 1.0f;
#endif
        } else if (outcome == MISS) {
            v = vec4(params.environment_r, params.environment_g, params.environment_b, 0.0f);
        }
        store(seen, i, v);
    }
}
