// Counts what level 0 holds that the promises speak of. counters: 0 texels whose colour is dropped (opacity 0, colour
// NaN or infinite), 1 other texels with a NaN, 2 other texels with an infinity.

KERNEL(mip_count) {
    const int x = invocation_x();
    const int y = invocation_y();
    const int z = invocation_z();
    if (x >= params.src_x || y >= params.src_y || z >= params.src_z) return;
#if BY_ROWS
    const pixel v = load_pixel(src, params.src_x, x, z * params.src_y + y);
#else
    const pixel v = load_voxel(src, ivec3(params.src_x, params.src_y, params.src_z), ivec3(x, y, z));
#endif
#if CHANNELS == 1
    const bool nan = isnan(v);
    const bool infinite = isinf(v);
    const bool hidden = false;
#elif CHANNELS == 2
    const bool nan = isnan(v.x) || isnan(v.y);
    const bool infinite = isinf(v.x) || isinf(v.y);
    const bool hidden = false;
#else
    const bool nan = isnan(v.x) || isnan(v.y) || isnan(v.z) || isnan(v.w);
    const bool infinite = isinf(v.x) || isinf(v.y) || isinf(v.z) || isinf(v.w);
    const bool hidden = HIDDEN != 0 && v.w == 0.0f;
#endif
    if (nan || infinite) atomic_add(counters, hidden ? 0 : (nan ? 1 : 2), 1u);
}
