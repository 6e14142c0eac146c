// From a plane for each coefficient (CELLS: from pixels in another order, lpv_propagate_cells.kernel.h) back to pixels of four. Light that came through faces has nothing in c4, c5, c7: there
// the result holds what was injected.
FN float summed(CTX, bool inside, int to, int i, float across) {
    if (i > 8) return 0.0f;
    if (i == 4 || i == 5 || i == 7) return params.keep != 0 ? across : 0.0f;
    if (!inside) return 0.0f;
    const int slot = i == 6 ? 4 : i == 8 ? 5 : i;
    const int cells = params.width * params.height * params.depth;
    const int at = CELLS != 0 ? to + slot / 4 * 4 * cells + slot % 4 : to + i * params.plane;
    if (ACTIVE != 0 && load(state, 0) % 2u == 1u) return load(odd, at);
    return load(sum, at);
}

KERNEL(lpv_finish) {
    const int x = invocation_x();
    const int y = invocation_y();
    const int z = invocation_z();
    if (x >= params.width || y >= params.height || z >= params.channels * QUADS * params.depth) return;
    const int channel = z / (QUADS * params.depth);
    const int i = 4 * (z / params.depth % QUADS);
    const int plane_to = 3 * params.pitch + channel * (QUADS == 1 ? 4 : 9) * params.plane + z % params.depth * params.slice +
                         y * params.pitch + x;
    const int volume = channel * QUADS * params.depth + z % params.depth;
    const int to = CELLS != 0 ? 4 + 4 * ((volume * params.height + y) * params.width + x) : plane_to;
    const ivec3 extent = ivec3(params.width, params.height, params.depth);
    bool inside = true;  // lpv_start's box holds all light
    if (ACTIVE != 0) {
        const int cell = z % params.depth;
        inside = x >= int(load(boxes, 3)) && x < int(load(boxes, 6)) && y >= int(load(boxes, 4)) && y < int(load(boxes, 7)) &&
                 cell >= int(load(boxes, 5)) && cell < int(load(boxes, 8));
    }
    vec4 across = vec4(0.0f, 0.0f, 0.0f, 0.0f);
    if (i == 4 && params.keep != 0) across = load_voxel(injected, extent, ivec3(x, y, z));
    store_voxel(result, extent, ivec3(x, y, z),
                vec4(summed(ctx, inside, to, i, across.x), summed(ctx, inside, to, i + 1, across.y), summed(ctx, inside, to, i + 2, across.z),
                     summed(ctx, inside, to, i + 3, across.w)));
}
