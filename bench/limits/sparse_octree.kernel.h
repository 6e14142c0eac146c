// A sparse octree of voxels, level by level from a list of those that are occupied (Crassin and Green, Octree-Based Sparse
// Voxelization, in: OpenGL Insights, 2012): mark the nodes that hold voxels, allocate their children, fill the leaves,
// average upwards. children: 0 none, MARKED, else the first of eight. ends: next free node; then the end of each level.
#define MARKED 0xffffffffu

#if STEP == 0 || STEP == 2
FN int octant(uint voxel, int bit) {
    return int((voxel >> bit) & 1u) + 2 * int((voxel >> (bit + 10)) & 1u) + 4 * int((voxel >> (bit + 20)) & 1u);
}
FN int node_of(CTX, uint voxel, int levels) {
    int node = 0;
    for (int k = 1; k <= levels; ++k) node = int(load(children, node)) + octant(voxel, params.depth - k);
    return node;
}
#elif STEP != 4
FN int begin_of(CTX) { return params.level == 0 ? 0 : int(load(ends, params.level)); }
#endif

KERNEL(sparse_octree) {
#if STEP == 0
    if (invocation_x() == 0) store(ends, 1 + params.level, load(ends, 0));
    for (int i = invocation_x(); i < params.voxels; i += params.stride)
        atomic_max(children, node_of(ctx, load(list, i), params.level), MARKED);
#elif STEP == 1
    const int end = int(load(ends, 1 + params.level));
    for (int i = begin_of(ctx) + invocation_x(); i < end; i += params.stride) {
        if (load(children, i) != MARKED) continue;
        const uint first = atomic_add(ends, 0, 8u);
        store(children, i, first);
        for (int k = 0; k < 8; ++k) {
            store(children, int(first) + k, 0u);
            store(values, int(first) + k, vec4(0.0f));
        }
    }
#elif STEP == 2
    for (int i = invocation_x(); i < params.voxels; i += params.stride) {
        const uint voxel = load(list, i);
        const int x = int(voxel & 1023u);
        const int y = int((voxel >> 10) & 1023u);
        const int z = int(voxel >> 20);
        store(values, node_of(ctx, voxel, params.depth), load(volume, (((z << params.depth) + y) << params.depth) + x));
    }
#elif STEP == 3
    const int end = int(load(ends, 1 + params.level));
    for (int i = begin_of(ctx) + invocation_x(); i < end; i += params.stride) {
        const int first = int(load(children, i));
        if (first == 0) continue;
        vec4 sum = load(values, first);
        for (int k = 1; k < 8; ++k) sum = sum + load(values, first + k);
        store(values, i, 0.125f * sum);
    }
#else
    if (invocation_x() > 0) return;
    store(children, 0, 0u);
    store(ends, 0, 1u);
#endif
}
