// Which tiles have a pixel that reflects. Those without get their result here, and no ray.

KERNEL(hiz_ssr_tiles) {
    const int side = TILE * params.scale;
    const int tiles_x = (params.width + side - 1) / side;
    const int x = invocation_x();
    const int y = invocation_y();
    if (x >= tiles_x || y >= (params.height + side - 1) / side) return;
    const int last_x = min((x + 1) * side, params.width);
    const int last_y = min((y + 1) * side, params.height);
    uint reflects = 0u;
    for (int j = y * side; j < last_y; ++j)
        for (int i = x * side; i < last_x; ++i) {
            const int at = j * params.width + i;
            if (load(normals, at).w < params.cutoff &&
                is_surface(reciprocal_depth(load_pixel(depth, 0, at, 0), DEPTH, params.depth_scale, params.depth_offset)))
                reflects = 1u;
        }
    store(flags, y * tiles_x + x, reflects);
    if (reflects != 0u) return;
#if SHADE
    for (int j = y * side; j < last_y; ++j)
        for (int i = x * side; i < last_x; ++i) store(radiance, j * params.width + i, vec4(0.0f));
#endif
    const int traced_x = (params.width + params.scale - 1) / params.scale;
    const int traced_y = (params.height + params.scale - 1) / params.scale;
    for (int k = 0; k < params.each; ++k)
        for (int j = y * TILE; j < min((y + 1) * TILE, traced_y); ++j)
            for (int i = x * TILE; i < min((x + 1) * TILE, traced_x); ++i) {
                const int at = (k * traced_y + j) * traced_x + i;
                store(hits, at, vec4(0.0f));
                store(paths, at, vec4(0.0f));
            }
}
