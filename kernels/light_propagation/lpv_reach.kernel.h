// Where injected light is: a flag for each run of cells, and the largest c0.
KERNEL(lpv_reach) {
    const int x = invocation_x() * params.run;
    const int y = invocation_y();
    const int z = invocation_z();
    if (x >= params.width || y >= params.height || z >= params.depth) return;
    const ivec3 extent = ivec3(params.width, params.height, params.depth);
    uint some = 0u;  // bits of any coefficient but its sign
    uint most = 0u;
    for (int k = x; k < min(x + params.run, params.width); ++k)
        for (int volume = 0; volume < params.volumes; ++volume) {
            const vec4 c = load_voxel(injected, extent, ivec3(k, y, volume * params.depth + z));
            const uint c0 = floatBitsToUint(abs(c.x));
            some = some | c0 | floatBitsToUint(abs(c.y)) | floatBitsToUint(abs(c.z)) | floatBitsToUint(abs(c.w));
            if (volume % params.quads == 0) most = max(most, c0);
        }
    const int flag = (z * params.height + y) * ((params.width + params.run - 1) / params.run) + invocation_x();
    store(reached, flag, some != 0u ? 1u : 0u);
    store(reaches, flag, 0u);
    if (most != 0u) atomic_max(state, 1, most);
}
