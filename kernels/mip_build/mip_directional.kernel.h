// A coarser level of one directional volume: the voxels along the direction composited front to back, then the mean of
// the four (nine at odd extents) results. Source: Crassin et al. 2011, anisotropic voxels.

// (along the axis, the other two in the order x, y, z) from (x, y, z), and back.
FN ivec3 turned(CTX, ivec3 p) {
    return params.axis == 0 ? p : (params.axis == 1 ? ivec3(p.y, p.x, p.z) : ivec3(p.z, p.x, p.y));
}
FN ivec3 straight(CTX, ivec3 p) {
    return params.axis == 0 ? p : (params.axis == 1 ? ivec3(p.y, p.x, p.z) : ivec3(p.y, p.z, p.x));
}

FN ivec3 src_extent(CTX) { return ivec3(params.src_x, params.src_y, params.src_z); }
FN ivec3 dst_extent(CTX) { return ivec3(params.dst_x, params.dst_y, params.dst_z); }

FN pixel fine(CTX, ivec3 p, bool clean) {
#if BY_ROWS
    pixel v = as_loaded(load_pixel(src, params.src_x, p.x, p.z * params.src_y + p.y), params.src_x);
#else
    pixel v = as_loaded(load_voxel(src, src_extent(ctx), p), params.src_x);
#endif
    return clean ? drop_hidden_colour(v) : v;
}

// Fine voxel k of coarse voxel i along the axis. At odd extents the first and third belong to it in part.
FN pixel layer(CTX, int i, int k, int u, int v, bool clean) {
    pixel c = fine(ctx, straight(ctx, ivec3(mip_tap(MODE_ALONG, i, k, 0), u, v)), clean);
    if (MODE_ALONG == MIP_TRIPLE && k != 1) {
        int m = turned(ctx, dst_extent(ctx)).x;
        c = layer_part(c.w, float(k == 0 ? m - i : i + 1) / float(m)) * c;
    }
    return c;
}

FN pixel composite_along(CTX, int i, int u, int v, bool clean) {
    const int last = mip_taps(MODE_ALONG) - 1;
    pixel c = layer(ctx, i, params.backward == 0 ? 0 : last, u, v, clean);
    UNROLL for (int k = 1; k <= last; ++k)
        c = composite(c, layer(ctx, i, params.backward == 0 ? k : last - k, u, v, clean));
    return to_steps(c);
}

FN pixel along_u(CTX, ivec3 i, int v, bool clean) {
    pixel t[5];
    UNROLL for (int k = 0; k < mip_taps(MODE_U); ++k)
        t[k] = composite_along(ctx, i.x, mip_tap(MODE_U, i.y, k, 0), v, clean);
    return mip_sum(MODE_U, t, i.y, turned(ctx, dst_extent(ctx)).y, turned(ctx, src_extent(ctx)).y);
}

FN pixel along_v(CTX, ivec3 i, bool clean) {
    pixel t[5];
    UNROLL for (int k = 0; k < mip_taps(MODE_V); ++k) t[k] = along_u(ctx, i, mip_tap(MODE_V, i.z, k, 0), clean);
    return mip_share(MODE_U) * mip_share(MODE_V) *
           mip_sum(MODE_V, t, i.z, turned(ctx, dst_extent(ctx)).z, turned(ctx, src_extent(ctx)).z);
}

KERNEL(mip_directional) {
    const ivec3 p = ivec3(invocation_x(), invocation_y(), invocation_z());
    if (p.x >= params.dst_x || p.y >= params.dst_y || p.z >= params.dst_z) return;
    const ivec3 i = turned(ctx, p);
    pixel v = along_v(ctx, i, params.clean != 0 && SPLIT == 0);
    if (SPLIT != 0 && params.clean != 0 && !colour_is_finite(v)) v = along_v(ctx, i, true);
    store_voxel(dst, dst_extent(ctx), p, from_steps(v, params.src_x));
}
