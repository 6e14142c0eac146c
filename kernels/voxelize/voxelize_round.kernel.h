// Triangle records from vertices in float: g = (position - origin) scale, rounded to 2^-16 voxel. In float this is off by
// 2^-24 of |g|, and by what the positions themselves lost. What cannot be taken becomes a point outside, and is counted.

FN float in_units(float v, float origin, float rest, float scale) { return floor((v - origin - rest) * scale + 0.5f); }

FN vec3 corner(CTX, int i) {
    return vec3(in_units(load(positions, 3 * i), params.origin_x, params.rest_x, params.scale),
                in_units(load(positions, 3 * i + 1), params.origin_y, params.rest_y, params.scale),
                in_units(load(positions, 3 * i + 2), params.origin_z, params.rest_z, params.scale));
}

FN bool finite(vec3 v) { return v.x - v.x + (v.y - v.y) + (v.z - v.z) == 0.0f; }
FN bool within(vec3 v, float low, float high) {
    return v.x >= low && v.x <= high && v.y >= low && v.y <= high && v.z >= low && v.z <= high;
}
FN bool before(ivec3 a, ivec3 b) {
    return a.x < b.x || (a.x == b.x && (a.y < b.y || (a.y == b.y && a.z < b.z)));
}

FN void put(CTX, int at, ivec3 v) {
    store(records, at, v.x);
    store(records, at + 1, v.y);
    store(records, at + 2, v.z);
}

FN void round_triangle(CTX, int t) {
    ivec3 v[3];
    UNROLL for (int i = 0; i < 3; ++i) v[i] = ivec3(-65536 * 4, -65536 * 4, -65536 * 4);
    const uint a = load(indices, 3 * t);
    const uint b = load(indices, 3 * t + 1);
    const uint c = load(indices, 3 * t + 2);
    const uint count = uint(params.vertices);
    if (a >= count || b >= count || c >= count) {
        atomic_add(counters, COUNT_BAD_INDEX, 1u);
    } else {
        const vec3 p = corner(ctx, int(a));
        const vec3 q = corner(ctx, int(b));
        const vec3 r = corner(ctx, int(c));
        if (!finite(p) || !finite(q) || !finite(r)) {
            atomic_add(counters, COUNT_NOT_FINITE, 1u);
        } else if (!within(p, params.low, params.high) || !within(q, params.low, params.high) ||
                   !within(r, params.low, params.high)) {
            atomic_add(counters, COUNT_FAR, 1u);
        } else {
            v[0] = ivec3(int(p.x), int(p.y), int(p.z));
            v[1] = ivec3(int(q.x), int(q.y), int(q.z));
            v[2] = ivec3(int(r.x), int(r.y), int(r.z));
        }
    }
    int turned = 0;
    UNROLL for (int i = 0; i < 3; ++i) {
        const int k = i & 1;  // pairs 0 1, 1 2, 0 1
        if (before(v[k + 1], v[k])) {
            const ivec3 other = v[k];
            v[k] = v[k + 1];
            v[k + 1] = other;
            turned = 1 - turned;
        }
    }
    UNROLL for (int i = 0; i < 3; ++i) put(ctx, t * TRIANGLE_WORDS + 3 * i, v[i]);
#if MATERIALS
    const int material = int(load(material_list, t));
#else
    const int material = 0;
#endif
    put(ctx, t * TRIANGLE_WORDS + 9, ivec3(material, t, turned));
}

KERNEL(voxelize_round) {
    for (int t = invocation_x(); t < params.triangles; t += params.stride) round_triangle(ctx, t);
}
