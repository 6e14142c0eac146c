// Trilinear look-ups along lines through a volume, whose addresses no value read decides: what a driver's kernels can
// sample.
#if SAMPLED
FN vec4 look_up(CTX, vec3 p) {
    const float per = 1.0f / float(params.side);
    return sample3d(volume, vec3(p.x * per, p.y * per, p.z * per), 0.0f);
}
#else
FN vec4 blend(vec4 a, vec4 b, float f) { return a + f * (b - a); }
FN float in_box(float p, int n) { return clamp(p - 0.5f, 0.0f, float(n - 1)); }
#define ROW(i) blend(load_pixel(volume, 0, i, 0), load_pixel(volume, 0, (i) + x, 0), f.x)
#define SLICE(i) blend(ROW(i), ROW((i) + y), f.y)
FN vec4 look_up(CTX, vec3 p) {
    const int n = params.side;
    const vec3 q = vec3(in_box(p.x, n), in_box(p.y, n), in_box(p.z, n));
    const ivec3 c = ivec3(int(q.x), int(q.y), int(q.z));
    const vec3 f = vec3(q.x - float(c.x), q.y - float(c.y), q.z - float(c.z));
    const int x = c.x + 1 < n ? 1 : 0;
    const int y = c.y + 1 < n ? n : 0;
    const int z = c.z + 1 < n ? n * n : 0;
    const int corner = (c.z * n + c.y) * n + c.x;
    return blend(SLICE(corner), SLICE(corner + z), f.z);
}
#endif

KERNEL(limit_sample) {
    const int column = invocation_x();
    const int row = invocation_y();
    if (column >= params.width || row >= params.height) return;
    const float n = float(params.side);
    const vec3 start = vec3(n * (float(column) + 0.5f) / float(params.width), n * (float(row) + 0.5f) / float(params.height), 1.0f);
    vec4 sum = vec4(0.0f);
    for (int k = 0; k < params.looks; ++k) {
        const float t = float(k);
        const vec3 p = vec3(start.x + t * params.step_x, start.y + t * params.step_y, start.z + t * params.step_z);
        sum = sum + look_up(ctx, vec3(p.x - n * floor(p.x / n), p.y - n * floor(p.y / n), p.z - n * floor(p.z / n)));
    }
    store(dst, row * params.width + column, sum);
}
