// A coarser level by a mean that is separable: box (isotropic; area weights at odd extents), 1-2-1 or 1-3-3-1
// (gaussian3). Source: Crassin et al. 2011, mip-mapping of voxel bricks; Akenine-Moeller et al., Real-Time Rendering
// 4e, 2018, 11.5.7.

FN pixel fine(CTX, int x, int y, int z, bool clean) {
#if BY_ROWS
    pixel v = as_loaded(load_pixel(src, params.src_x, x, z * params.src_y + y), params.src_x);
#else
    const ivec3 extent = ivec3(params.src_x, params.src_y, params.src_z);
    pixel v = as_loaded(load_voxel(src, extent, ivec3(x, y, z)), params.src_x);
#endif
    if (clean) v = drop_hidden_colour(v);
    return to_steps(v);
}

FN pixel along_x(CTX, int i, int y, int z, bool clean) {
    pixel t[5];
    UNROLL for (int k = 0; k < mip_taps(MODE_X); ++k)
        t[k] = fine(ctx, mip_tap(MODE_X, i, k, params.src_x), y, z, clean);
    return mip_mean(MODE_X, t, i, params.dst_x, params.src_x);
}

FN pixel along_y(CTX, int i, int j, int z, bool clean) {
    pixel t[5];
    UNROLL for (int k = 0; k < mip_taps(MODE_Y); ++k)
        t[k] = along_x(ctx, i, mip_tap(MODE_Y, j, k, params.src_y), z, clean);
    return mip_mean(MODE_Y, t, j, params.dst_y, params.src_y);
}

FN pixel along_z(CTX, int i, int j, int l, bool clean) {
    pixel t[5];
    UNROLL for (int k = 0; k < mip_taps(MODE_Z); ++k)
        t[k] = along_y(ctx, i, j, mip_tap(MODE_Z, l, k, params.src_z), clean);
    return mip_mean(MODE_Z, t, l, params.dst_z, params.src_z);
}

KERNEL(mip_average) {
    const int x = invocation_x();
    const int y = invocation_y();
    const int z = invocation_z();
    if (x >= params.dst_x || y >= params.dst_y || z >= params.dst_z) return;
    pixel v = along_z(ctx, x, y, z, params.clean != 0 && SPLIT == 0);
#if CHANNELS == 4
    if (SPLIT != 0 && params.clean != 0 && !colour_is_finite(v)) v = along_z(ctx, x, y, z, true);
#endif
    store_voxel(dst, ivec3(params.dst_x, params.dst_y, params.dst_z), ivec3(x, y, z), from_steps(v, params.src_x));
}
