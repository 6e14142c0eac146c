// Nearest look-ups along lines through a level of a volume: dense, and by walks from the root of a sparse octree.

FN vec4 look_up(CTX, ivec3 p) {
    const int bits = params.depth - params.level;
#if OCTREE
    int node = 0;
    for (int k = bits - 1; k >= 0; --k) {
        const uint first = load(children, node);
        if (first == 0u) return vec4(0.0f);
        node = int(first) + ((p.x >> k) & 1) + 2 * ((p.y >> k) & 1) + 4 * ((p.z >> k) & 1);
    }
    return load(values, node);
#else
    return load(volume, (((p.z << bits) + p.y) << bits) + p.x);
#endif
}

KERNEL(voxel_look) {
    const int column = invocation_x();
    const int row = invocation_y();
    if (column >= params.width || row >= params.height) return;
    const float n = float(1 << (params.depth - params.level));
    const vec3 start = vec3(n * (float(column) + 0.5f) / float(params.width), n * (float(row) + 0.5f) / float(params.height), 0.5f);
    vec4 sum = vec4(0.0f);
    for (int k = 0; k < params.looks; ++k) {
        const float t = float(k);
        const vec3 p = vec3(start.x + t * params.step_x, start.y + t * params.step_y, start.z + t * params.step_z);
        sum = sum + look_up(ctx, ivec3(int(p.x - n * floor(p.x / n)), int(p.y - n * floor(p.y / n)), int(p.z - n * floor(p.z / n))));
    }
    store(dst, row * params.width + column, sum);
}
