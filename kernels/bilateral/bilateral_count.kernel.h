// Counts pixels that a filter leaves out. Beside the filter, so that it costs nothing where nobody asks.

KERNEL(bilateral_count) {
    const int x = invocation_x();
    const int y = invocation_y();
    if (x >= params.width || y >= params.height) return;
#if SRC_CHANNELS == 1
    const float v = load_pixel(src, params.src_stride, x, y);
    const float zero = v - v;
    const float depth = v;
    const vec3 n = vec3(v, v, v);
#elif SRC_CHANNELS == 2
    const vec2 v = load_pixel(src, params.src_stride, x, y);
    const float zero = (v.x - v.x) + (v.y - v.y);
    const float depth = v.x;
    const vec3 n = vec3(v.x, v.y, v.y);
#else
    const vec4 v = load_pixel(src, params.src_stride, x, y);
    const float zero = (v.x - v.x) + (v.y - v.y) + (v.z - v.z) + (v.w - v.w);
    const float depth = v.x;
    const vec3 n = vec3(params.scale * v.x + params.offset, params.scale * v.y + params.offset, params.scale * v.z + params.offset);
#endif
    bool counts = !(zero == 0.0f);
    if (RULE == 1) counts = !(depth > 0.0f && depth < 1.0e10f);
    if (RULE == 2) counts = !(n.x * n.x + n.y * n.y + n.z * n.z > 1.0e-12f) || counts;
    if (counts) atomic_add(counters, params.counter, 1u);
}
