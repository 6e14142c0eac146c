// Cuts triangles into pieces: pairs of a triangle and a block of SIDE^3 voxels that it touches, exactly. From triangles
// (root), or from pieces of PARENT^3 voxels, so that no invocation has more than a few hundred blocks to look at. The
// order of the list depends on timing; nothing that is made of it does.

FN ivec3 vertex(CTX, int t, int i) {
    const int at = t * TRIANGLE_WORDS + 3 * i;
    return ivec3(load(triangles, at), load(triangles, at + 1), load(triangles, at + 2)) -
           65536 * ivec3(params.base_x, params.base_y, params.base_z);
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
    const ivec3 begin = first / SIDE;
    const ivec3 end = last / SIDE;
    if (begin.x == end.x && begin.y == end.y && begin.z == end.z && inside(low, high, from * 65536, (to + 1) * 65536)) {
        keep(ctx, t, begin, grid);
        return;
    }
    // Float first, in voxels from the first voxel; what that leaves open goes to the integers.
    const float span = float(max(last.x - first.x, max(last.y - first.y, last.z - first.z)) + 1);
    const vec3 a = voxels_of(v0 - 65536 * first);
    const vec3 b = voxels_of(v1 - 65536 * first);
    const vec3 c = voxels_of(v2 - 65536 * first);
    const vec3 ab = voxels_of(v1 - v0);
    const vec3 bc = voxels_of(v2 - v1);
    const vec3 ca = voxels_of(v0 - v2);
    ROUGH_TRIANGLE(span)
    // Look for the next block, then decide on it: neighbouring invocations do the same thing at the same time.
    ivec3 next = begin;
    for (;;) {
        ivec3 block = next;
        ivec3 centre = next;  // half voxels
        ivec3 size = next;
        int meets = ROUGH_NO;
        while (next.z <= end.z && meets == ROUGH_NO) {
            block = next;
            const ivec3 from_voxel = max(block * SIDE, first);
            const ivec3 to_voxel = min(block * SIDE + (SIDE - 1), last) + 1;
            centre = from_voxel + to_voxel;
            size = to_voxel - from_voxel;
            meets = meets_roughly(la, lb, ld, lw, plane, slack, 32768.0f * voxels_of(centre - 2 * first), 32768.0f * voxels_of(size));
            next = following(next, begin, end);
        }
        if (meets == ROUGH_NO) break;
        if (meets == ROUGH_YES || meets_exactly(v0, v1, v2, centre, size)) keep(ctx, t, block, grid);
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
