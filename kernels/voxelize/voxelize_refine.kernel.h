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

FN bool inside(ivec3 low, ivec3 high, ivec3 from, ivec3 to) {
    return low.x >= from.x && low.y >= from.y && low.z >= from.z && high.x <= to.x && high.y <= to.y && high.z <= to.z;
}

FN void refine(CTX, int t, ivec3 from, ivec3 to) {
    const ivec3 grid = blocks_of(ivec3(params.width, params.height, params.depth), SIDE);
    const ivec3 v0 = vertex(ctx, t, 0);
    const ivec3 v1 = vertex(ctx, t, 1);
    const ivec3 v2 = vertex(ctx, t, 2);
    const ivec3 low = min(v0, min(v1, v2));
    const ivec3 high = max(v0, max(v1, v2));
    const ivec3 first = first_voxel(low, from);
    const ivec3 last = last_voxel(high, to);
    if (first.x > last.x || first.y > last.y || first.z > last.z) return;
    const ivec3 a = first / SIDE;
    const ivec3 b = last / SIDE;
    if (a.x == b.x && a.y == b.y && a.z == b.z && inside(low, high, from * 65536, (to + 1) * 65536)) {
        keep(ctx, t, a, grid);
        return;
    }
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
                const ivec3 begin = max(block * SIDE, first);
                const ivec3 end = min(block * SIDE + (SIDE - 1), last) + 1;
                const ivec3 c = begin + end;
                const ivec3 h = end - begin;
                if (plane_meets(rough, n[0], n[1], n[2], c * 32768 - v0, h) && edges_meet(lines, c, h))
                    keep(ctx, t, block, grid);
            }
}

KERNEL(voxelize_refine) {
    const ivec3 first = ivec3(params.first_x, params.first_y, params.first_z);
    const ivec3 last = ivec3(params.last_x, params.last_y, params.last_z);
#if ROOT
    for (int i = invocation_x(); i < params.parents; i += params.stride) refine(ctx, i, first, last);
#else
    const ivec3 grid = blocks_of(ivec3(params.width, params.height, params.depth), PARENT);
    const int count = int(min(load(counters, COUNT_BLOCKS), uint(params.parents)));
    for (int i = invocation_x(); i < count; i += params.stride) {
        const ivec3 from = PARENT * position_of(int(load(parent_list, 2 * i + 1)), grid);
        refine(ctx, int(load(parent_list, 2 * i)), max(from, first), min(from + (PARENT - 1), last));
    }
#endif
}
