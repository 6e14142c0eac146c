// 1 4 6 4 1 along an axis of the grid, a deviation of one cell; nothing outside.

FN vec4 cell_at(CTX, int x, int y, int z) {
    const bool inside = x >= 0 && y >= 0 && z >= 0 && x < params.columns && y < params.rows && z < params.bins;
    return inside ? load(from, (z * params.rows + y) * params.columns + x) : vec4(0.0f);
}

FN vec4 along(CTX, int x, int y, int z, int t) {
    return cell_at(ctx, AXIS == 0 ? x + t : x, AXIS == 1 ? y + t : y, AXIS == 2 ? z + t : z);
}

KERNEL(bilateral_grid_blur) {
    const int x = invocation_x();
    const int y = invocation_y();
    const int z = invocation_z();
    if (x >= params.columns || y >= params.rows || z >= params.bins) return;
    const vec4 ends = along(ctx, x, y, z, -2) + along(ctx, x, y, z, 2);
    const vec4 sides = along(ctx, x, y, z, -1) + along(ctx, x, y, z, 1);
    store(to, (z * params.rows + y) * params.columns + x, 0.0625f * ends + 0.25f * sides + 0.375f * along(ctx, x, y, z, 0));
}
