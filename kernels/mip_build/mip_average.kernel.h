// A coarser level by a mean that is separable: box (isotropic; area weights at odd extents), 1-2-1 or 1-3-3-1 (gaussian3).
// Source: Crassin et al. 2011 (mip-mapping of voxel bricks); Akenine-Moeller et al., Real-Time Rendering 4e, 2018, 11.5.7.

FN pixel fine(CTX, int x, int y, int z) {
#if BY_ROWS
    pixel v = load_pixel(src, params.src_x, x, z * params.src_y + y);
#else
    pixel v = load_voxel(src, ivec3(params.src_x, params.src_y, params.src_z), ivec3(x, y, z));
#endif
    v = as_loaded(v, params.src_x);
#if CHANNELS == 4
    if (params.clean != 0) v = drop_hidden_colour(v);
#endif
    return to_steps(v);
}

FN pixel along_x(CTX, int i, int y, int z) {
    pixel t[5];
    UNROLL for (int k = 0; k < mip_taps(MODE_X); ++k) t[k] = fine(ctx, mip_tap(MODE_X, i, k, params.src_x), y, z);
    return mip_mean(MODE_X, t, i, params.dst_x, params.src_x);
}

FN pixel along_y(CTX, int i, int j, int z) {
    pixel t[5];
    UNROLL for (int k = 0; k < mip_taps(MODE_Y); ++k) t[k] = along_x(ctx, i, mip_tap(MODE_Y, j, k, params.src_y), z);
    return mip_mean(MODE_Y, t, j, params.dst_y, params.src_y);
}

KERNEL(mip_average) {
    const int x = invocation_x();
    const int y = invocation_y();
    const int z = invocation_z();
    if (x >= params.dst_x || y >= params.dst_y || z >= params.dst_z) return;
    pixel t[5];
    UNROLL for (int k = 0; k < mip_taps(MODE_Z); ++k) t[k] = along_y(ctx, x, y, mip_tap(MODE_Z, z, k, params.src_z));
    const pixel v = mip_mean(MODE_Z, t, z, params.dst_z, params.src_z);
    store_voxel(dst, ivec3(params.dst_x, params.dst_y, params.dst_z), ivec3(x, y, z), from_steps(v, params.src_x));
}
