// Every function of math/sh.h.
FN vec3 read3(CTX, int i) { return vec3(load(directions, i), load(directions, i + 1), load(directions, i + 2)); }

KERNEL(sh_probe) {
    const int at = invocation_x();
    if (at < params.count) {
        const vec3 d = read3(ctx, 3 * at);
        for (int i = 0; i < 25; ++i) {
            store(values, 83 * at + i, sh_basis(i, d));
            store(values, 83 * at + 25 + i, sh_cosine(i, d));
            store(values, 83 * at + 50 + i, sh_zonal(i, 1.0f, d));
        }
        const vec4 basis = sh2_basis(d);
        const vec4 cosine = sh2_cosine(d);
        store(values, 83 * at + 75, basis.x);
        store(values, 83 * at + 76, basis.y);
        store(values, 83 * at + 77, basis.z);
        store(values, 83 * at + 78, basis.w);
        store(values, 83 * at + 79, cosine.x);
        store(values, 83 * at + 80, cosine.y);
        store(values, 83 * at + 81, cosine.z);
        store(values, 83 * at + 82, cosine.w);
    }
    if (at < 5) {
        const vec3 rx = read3(ctx, 3 * params.count);
        const vec3 ry = read3(ctx, 3 * params.count + 3);
        const vec3 rz = read3(ctx, 3 * params.count + 6);
        for (int m = -4; m <= 4; ++m)
            for (int n = -4; n <= 4; ++n) {
                const bool inside = abs(m) <= at && abs(n) <= at;
                store(rotations, 81 * at + 9 * (m + 4) + n + 4, inside ? sh_rotation(at, m, n, rx, ry, rz) : 0.0f);
            }
    }
}
