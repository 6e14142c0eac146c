// A coarser level of one directional volume: the voxels along the direction composited front to back, then the mean of
// the four (nine at odd extents) results. Source: Crassin et al. 2011, anisotropic voxels.

// Where a voxel of the finer level is: an element of a buffer, or coordinates in an image.
#if LINEAR
#define PLACE int
FN PLACE step_along(CTX, int axis) { return axis == 0 ? 1 : (axis == 1 ? params.src_x : params.src_x * params.src_y); }
#else
#define PLACE ivec3
FN PLACE step_along(CTX, int axis) { return ivec3(axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0); }
#endif

FN pixel fine(CTX, PLACE p, bool clean) {
#if LINEAR
    pixel v = as_loaded(load_pixel(src, 0, p, 0), params.src_x);
#elif BY_ROWS
    pixel v = as_loaded(load_pixel(src, params.src_x, p.x, p.z * params.src_y + p.y), params.src_x);
#else
    pixel v = as_loaded(load_voxel(src, ivec3(params.src_x, params.src_y, params.src_z), p), params.src_x);
#endif
    return clean ? drop_hidden_colour(v) : v;
}

// Along the axis, and the other two in the order x, y, z.
FN ivec3 turned(CTX, int x, int y, int z) {
    return params.axis == 0 ? ivec3(x, y, z) : (params.axis == 1 ? ivec3(y, x, z) : ivec3(z, x, y));
}

// Fine voxel k of the coarse voxel i of m along the axis, whose first is at p. At odd extents the first and third
// belong to it in part.
FN pixel layer(CTX, PLACE p, int k, int i, int m, bool clean) {
    pixel c = fine(ctx, p + k * step_along(ctx, params.axis), clean);
    if (MODE_ALONG == MIP_TRIPLE && k != 1) c = layer_part(c.w, float(k == 0 ? m - i : i + 1) / float(m)) * c;
    return c;
}

FN pixel composite_along(CTX, PLACE p, int i, int m, bool clean) {
    const int last = mip_taps(MODE_ALONG) - 1;
    pixel c = layer(ctx, p, params.backward == 0 ? 0 : last, i, m, clean);
    UNROLL for (int k = 1; k <= last; ++k)
        c = composite(c, layer(ctx, p, params.backward == 0 ? k : last - k, i, m, clean));
    return to_steps(c);
}

FN pixel along_u(CTX, PLACE p, ivec3 i, ivec3 m, ivec3 n, bool clean) {
    pixel t[5];
    const PLACE next = step_along(ctx, params.axis == 0 ? 1 : 0);
    UNROLL for (int k = 0; k < mip_taps(MODE_U); ++k) t[k] = composite_along(ctx, p + k * next, i.x, m.x, clean);
    return mip_mean(MODE_U, t, i.y, m.y, n.y);
}

FN pixel along_v(CTX, PLACE p, ivec3 i, ivec3 m, ivec3 n, bool clean) {
    pixel t[5];
    const PLACE next = step_along(ctx, params.axis == 2 ? 1 : 2);
    UNROLL for (int k = 0; k < mip_taps(MODE_V); ++k) t[k] = along_u(ctx, p + k * next, i, m, n, clean);
    return mip_mean(MODE_V, t, i.z, m.z, n.z);
}

KERNEL(mip_directional) {
    const int x = invocation_x();
    const int y = invocation_y();
    const int z = invocation_z();
    if (x >= params.dst_x || y >= params.dst_y || z >= params.dst_z) return;
    const ivec3 i = turned(ctx, x, y, z);
    const ivec3 m = turned(ctx, params.dst_x, params.dst_y, params.dst_z);
    const ivec3 n = turned(ctx, params.src_x, params.src_y, params.src_z);
    const PLACE p = mip_tap(MODE_ALONG, i.x, 0, n.x) * step_along(ctx, params.axis) +
                    mip_tap(MODE_U, i.y, 0, n.y) * step_along(ctx, params.axis == 0 ? 1 : 0) +
                    mip_tap(MODE_V, i.z, 0, n.z) * step_along(ctx, params.axis == 2 ? 1 : 2);
    pixel v = along_v(ctx, p, i, m, n, params.clean != 0 && SPLIT == 0);
    if (SPLIT != 0 && params.clean != 0 && !colour_is_finite(v)) v = along_v(ctx, p, i, m, n, true);
    store_voxel(dst, ivec3(params.dst_x, params.dst_y, params.dst_z), ivec3(x, y, z), from_steps(v, params.src_x));
}
