// Triangle records from vertices in float: g = (position - origin) scale, rounded to 2^-16 voxel. Five operations in float
// are off by 2^-24 of |g| each at most, and the positions themselves have lost something. What cannot be taken becomes a
// point outside; it is counted where it may touch the grid.

#define LEAST (-4096.0f * 65536.0f)  // coordinates that the exact tests hold (triangle_box.h), whatever the grid
#define MOST (6144.0f * 65536.0f)

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

#if TEXTURED
FN float finite_or_0(float v) { return v - v == 0.0f ? v : 0.0f; }
FN void put_uv(CTX, int at, int vertex) {
    for (int k = 0; k < 2; ++k)
        store(record_uvs, at + k, vertex < 0 ? 0.0f : finite_or_0(load(vertex_uvs, 2 * vertex + k)));
}
#endif

FN void round_triangle(CTX, int t) {
    ivec3 v[3];
    int vertex[3];
    UNROLL for (int i = 0; i < 3; ++i) {
        v[i] = ivec3(-65536 * 4, -65536 * 4, -65536 * 4);
        vertex[i] = -1;
    }
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
        } else if (!within(p, LEAST, MOST) || !within(q, LEAST, MOST) || !within(r, LEAST, MOST)) {
            const vec3 extent = 65536.0f * vec3(float(params.width), float(params.height), float(params.depth));
            const vec3 low = min(p, min(q, r));
            const vec3 high = max(p, max(q, r));
            if (low.x <= extent.x && low.y <= extent.y && low.z <= extent.z && high.x >= 0.0f && high.y >= 0.0f &&
                high.z >= 0.0f)
                atomic_add(counters, COUNT_FAR, 1u);
        } else {
            vertex[0] = int(a);
            vertex[1] = int(b);
            vertex[2] = int(c);
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
            const int other_vertex = vertex[k];
            vertex[k] = vertex[k + 1];
            vertex[k + 1] = other_vertex;
            turned = 1 - turned;
        }
    }
    UNROLL for (int i = 0; i < 3; ++i) put(ctx, t * TRIANGLE_WORDS + 3 * i, v[i]);
#if TEXTURED
    UNROLL for (int i = 0; i < 3; ++i) put_uv(ctx, 6 * t + 2 * i, vertex[i]);
#endif
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
