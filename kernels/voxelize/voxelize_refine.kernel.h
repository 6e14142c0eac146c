// Cuts triangles into pieces: pairs of a triangle and a block of SIDE^3 voxels that it touches, exactly. From triangles
// (root), or from pieces of PARENT^3 voxels, so that no invocation has more than a few hundred blocks to look at. The
// order of the list depends on timing; nothing that is made of it does.

FN ivec3 vertex(CTX, int t, int i) {
    const int at = t * TRIANGLE_WORDS + 3 * i;
    return ivec3(load(triangles, at), load(triangles, at + 1), load(triangles, at + 2));
}

FN void keep(CTX, int t, ivec3 block, ivec3 grid) {
    const int b = linear_of(block, grid);
#if MARK
    atomic_max(slots, b, 1u);
#endif
    const uint at = atomic_add(counters, params.counter, 1u);
    if (at < uint(params.capacity)) {
        store(pieces, 2 * int(at), uint(t));
        store(pieces, 2 * int(at) + 1, uint(b));
    }
}

FN void refine(CTX, int t, ivec3 from, ivec3 to) {
    const ivec3 extent = ivec3(params.width, params.height, params.depth);
    const ivec3 grid = blocks_of(extent, SIDE);
    const ivec3 v0 = vertex(ctx, t, 0);
    const ivec3 v1 = vertex(ctx, t, 1);
    const ivec3 v2 = vertex(ctx, t, 2);
    const ivec3 first = max(from, first_voxel(min(v0, min(v1, v2))));
    const ivec3 last = min(to, last_voxel(max(v0, max(v1, v2)), extent));
    if (first.x > last.x || first.y > last.y || first.z > last.z) return;
    const ivec3 a = first / SIDE;
    const ivec3 b = last / SIDE;
#if ROOT
    if (a.x == b.x && a.y == b.y && a.z == b.z) {
        keep(ctx, t, a, grid);
        return;
    }
#endif
    ivec4 lines[9];
    uvec2 n[3];
    UNROLL for (int axis = 0; axis < 3; ++axis) {
        const ivec2 p = projected(v0, axis);
        const ivec2 q = projected(v1, axis);
        const ivec2 r = projected(v2, axis);
        n[axis] = double_area(p, q, r);
        UNROLL for (int i = 0; i < 3; ++i) lines[3 * axis + i] = edge_of(p, q, r, n[axis], i);
    }
    const vec3 rough = vec3(float_of_signed_64(n[0]), float_of_signed_64(n[1]), float_of_signed_64(n[2]));
    for (int z = a.z; z <= b.z; ++z)
        for (int y = a.y; y <= b.y; ++y)
            for (int x = a.x; x <= b.x; ++x) {
                const ivec3 block = ivec3(x, y, z);
                const ivec3 low = max(block * SIDE, first);
                const ivec3 high = min(block * SIDE + (SIDE - 1), last) + 1;
                const ivec3 c = low + high;
                const ivec3 h = high - low;
                if (plane_meets(rough, n[0], n[1], n[2], c * 32768 - v0, h) && edges_meet(lines, c, h))
                    keep(ctx, t, block, grid);
            }
}

KERNEL(voxelize_refine) {
    const ivec3 extent = ivec3(params.width, params.height, params.depth);
#if ROOT
    for (int i = invocation_x(); i < params.parents; i += params.stride)
        refine(ctx, i, ivec3(0, 0, 0), extent - 1);
#else
    const int count = int(min(load(counters, COUNT_BLOCKS), uint(params.parents)));
    for (int i = invocation_x(); i < count; i += params.stride) {
        const ivec3 from = PARENT * position_of(int(load(parent_list, 2 * i + 1)), blocks_of(extent, PARENT));
        refine(ctx, int(load(parent_list, 2 * i)), from, from + (PARENT - 1));
    }
#endif
}
