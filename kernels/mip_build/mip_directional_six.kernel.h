// Level 1 of all six directional volumes from one reading of level 0: the same bits as six dispatches of
// mip_directional.

FN vec4 fine(CTX, int x, int y, int z, bool clean) {
#if BY_ROWS
    vec4 v = as_loaded(load_pixel(src, params.src_x, x, z * params.src_y + y), params.src_x);
#else
    const ivec3 extent = ivec3(params.src_x, params.src_y, params.src_z);
    vec4 v = as_loaded(load_voxel(src, extent, ivec3(x, y, z)), params.src_x);
#endif
    return clean ? drop_hidden_colour(v) : v;
}

// The pair of an axis seen from the front; along an axis of extent 1 there is no pair.
FN vec4 seen(int pair, vec4 front, vec4 back) { return to_steps(pair != 0 ? composite(front, back) : front); }

// The mean over the two axes across, u first, as it is stored.
FN vec4 mean_of(CTX, int pair_u, int pair_v, vec4 a, vec4 b, vec4 c, vec4 d) {
    vec4 low = pair_u != 0 ? mip_pair(a, b) : a;
    vec4 high = pair_u != 0 ? mip_pair(c, d) : c;
    return from_steps(pair_v != 0 ? mip_pair(low, high) : low, params.src_x);
}

// Writes the six; returns whether the two along x are finite. What is not finite shows in one of them at least.
FN bool build(CTX, ivec3 p, bool clean) {
    const ivec3 extent = ivec3((params.src_x + 1) >> 1, (params.src_y + 1) >> 1, (params.src_z + 1) >> 1);
    const int x = p.x * 2;
    const int y = p.y * 2;
    const int z = p.z * 2;
    const vec4 a = fine(ctx, x, y, z, clean);
    const vec4 b = fine(ctx, x + PAIR_X, y, z, clean);
    const vec4 c = fine(ctx, x, y + PAIR_Y, z, clean);
    const vec4 d = fine(ctx, x + PAIR_X, y + PAIR_Y, z, clean);
    const vec4 e = fine(ctx, x, y, z + PAIR_Z, clean);
    const vec4 f = fine(ctx, x + PAIR_X, y, z + PAIR_Z, clean);
    const vec4 g = fine(ctx, x, y + PAIR_Y, z + PAIR_Z, clean);
    const vec4 h = fine(ctx, x + PAIR_X, y + PAIR_Y, z + PAIR_Z, clean);
    const vec4 px = mean_of(ctx, PAIR_Y, PAIR_Z, seen(PAIR_X, a, b), seen(PAIR_X, c, d),
                            seen(PAIR_X, e, f), seen(PAIR_X, g, h));
    const vec4 nx = mean_of(ctx, PAIR_Y, PAIR_Z, seen(PAIR_X, b, a), seen(PAIR_X, d, c),
                            seen(PAIR_X, f, e), seen(PAIR_X, h, g));
    const vec4 py = mean_of(ctx, PAIR_X, PAIR_Z, seen(PAIR_Y, a, c), seen(PAIR_Y, b, d),
                            seen(PAIR_Y, e, g), seen(PAIR_Y, f, h));
    const vec4 ny = mean_of(ctx, PAIR_X, PAIR_Z, seen(PAIR_Y, c, a), seen(PAIR_Y, d, b),
                            seen(PAIR_Y, g, e), seen(PAIR_Y, h, f));
    const vec4 pz = mean_of(ctx, PAIR_X, PAIR_Y, seen(PAIR_Z, a, e), seen(PAIR_Z, b, f),
                            seen(PAIR_Z, c, g), seen(PAIR_Z, d, h));
    const vec4 nz = mean_of(ctx, PAIR_X, PAIR_Y, seen(PAIR_Z, e, a), seen(PAIR_Z, f, b),
                            seen(PAIR_Z, g, c), seen(PAIR_Z, h, d));
    store_voxel(dst_px, extent, p, px);
    store_voxel(dst_nx, extent, p, nx);
    store_voxel(dst_py, extent, p, py);
    store_voxel(dst_ny, extent, p, ny);
    store_voxel(dst_pz, extent, p, pz);
    store_voxel(dst_nz, extent, p, nz);
    return colour_is_finite(px) && colour_is_finite(nx);
}

KERNEL(mip_directional_six) {
    const ivec3 p = ivec3(invocation_x(), invocation_y(), invocation_z());
    if (2 * p.x >= params.src_x || 2 * p.y >= params.src_y || 2 * p.z >= params.src_z) return;
    const bool finite = build(ctx, p, SPLIT == 0);
    if (SPLIT != 0 && !finite) build(ctx, p, true);
}
