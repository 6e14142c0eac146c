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

FN pixel along_z(CTX, int x, int y, int l, bool clean) {
    pixel t[5];
    UNROLL for (int k = 0; k < mip_taps(MODE_Z); ++k)
        t[k] = fine(ctx, x, y, mip_tap(MODE_Z, l, k, params.src_z), clean);
    return mip_mean(MODE_Z, t, l, params.dst_z, params.src_z);
}

FN pixel along_y(CTX, int x, int j, int l, bool clean) {
    pixel t[5];
    UNROLL for (int k = 0; k < mip_taps(MODE_Y); ++k)
        t[k] = along_z(ctx, x, mip_tap(MODE_Y, j, k, params.src_y), l, clean);
    return mip_mean(MODE_Y, t, j, params.dst_y, params.src_y);
}

FN pixel along_x(CTX, int i, int j, int l, bool clean) {
    pixel t[5];
    UNROLL for (int k = 0; k < mip_taps(MODE_X); ++k)
        t[k] = along_y(ctx, mip_tap(MODE_X, i, k, params.src_x), j, l, clean);
    return mip_mean(MODE_X, t, i, params.dst_x, params.src_x);
}

FN void keep(CTX, int x, int y, int z, pixel v) {
    const ivec3 extent = ivec3(params.dst_x, params.dst_y, params.dst_z);
    store_voxel(dst, extent, ivec3(x, y, z), from_steps(v, params.src_x));
}

// Neighbours of a row: BLOCK, or one where an extent is odd (there are up to 125 taps then). What is not finite shows
// in their sum.
KERNEL(mip_average) {
    const int each = MODE_X <= MIP_PAIR && MODE_Y <= MIP_PAIR && MODE_Z <= MIP_PAIR ? BLOCK : 1;
    const int x = invocation_x() * each;
    const int y = invocation_y();
    const int z = invocation_z();
    if (x >= params.dst_x || y >= params.dst_y || z >= params.dst_z) return;
    const bool clean = params.clean != 0;
    pixel v[BLOCK];
    if (SPLIT != 0 && x + each <= params.dst_x) {
        UNROLL for (int b = 0; b < each; ++b) v[b] = along_x(ctx, x + b, y, z, false);
        pixel sum = v[0];
        UNROLL for (int b = 1; b < each; ++b) sum = sum + v[b];
        if (!clean || colour_is_finite(sum)) {
            UNROLL for (int b = 0; b < each; ++b) keep(ctx, x + b, y, z, v[b]);
            return;
        }
    }
    if (SPLIT != 0) {
        for (int b = 0; b < each && x + b < params.dst_x; ++b) keep(ctx, x + b, y, z, along_x(ctx, x + b, y, z, clean));
        return;
    }
    UNROLL for (int b = 0; b < each; ++b) v[b] = along_x(ctx, min(x + b, params.dst_x - 1), y, z, clean);
    UNROLL for (int b = 0; b < each; ++b)
        if (x + b < params.dst_x) keep(ctx, x + b, y, z, v[b]);
}
