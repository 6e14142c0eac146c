// The grid's value at a pixel's place and luminance, trilinear, by the number of pixels that it holds there.

FN vec4 row_at(CTX, int x, int y, int z, float fx) {
    const int at = (min(z, params.bins - 1) * params.rows + min(y, params.rows - 1)) * params.columns;
    const vec4 a = load(grid, at + min(x, params.columns - 1));
    const vec4 b = load(grid, at + min(x + 1, params.columns - 1));
    return a + fx * (b - a);
}

KERNEL(bilateral_grid_slice) {
    const int px = invocation_x();
    const int py = invocation_y();
    if (px >= params.width || py >= params.height) return;
    const pixel v = load_pixel(src, params.src_stride, px, py);
    const float side = float(params.cell);
    const int x = px / params.cell;
    const int y = py / params.cell;
    const float fx = float(px - x * params.cell) / side;
    const float fy = float(py - y * params.cell) / side;
    const float most = float(params.bins - 1);
    const float depth = (luminance_of(v) - params.low) * params.per_step;
    const float b = depth > 0.0f ? (depth < most ? depth : most) : 0.0f;
    const int z = int(b);
    const float fz = b - float(z);
    const vec4 near_low = row_at(ctx, x, y, z, fx);
    const vec4 near_row = near_low + fy * (row_at(ctx, x, y + 1, z, fx) - near_low);
    const vec4 far_low = row_at(ctx, x, y, z + 1, fx);
    const vec4 far_row = far_low + fy * (row_at(ctx, x, y + 1, z + 1, fx) - far_low);
    const vec4 sum = near_row + fz * (far_row - near_row);
    // A cell's pixels are several cells wide after the blur, so that there is always weight where a pixel is; a pixel that is
    // not finite stays as it is.
#if CHANNELS == 1
    const bool kept = !(v - v == 0.0f) || !(sum.w > 1.0e-6f);
    store_pixel(dst, params.dst_stride, px, py, kept ? v : sum.x / sum.w);
#elif CHANNELS == 2
    const vec2 zero = v - v;
    const bool kept = !(zero.x + zero.y == 0.0f) || !(sum.w > 1.0e-6f);
    store_pixel(dst, params.dst_stride, px, py, kept ? v : vec2(sum.x / sum.w, sum.y / sum.w));
#else
    const vec4 zero = v - v;
    const bool kept = !((zero.x + zero.y) + (zero.z + zero.w) == 0.0f) || !(sum.w > 1.0e-6f);
    store_pixel(dst, params.dst_stride, px, py, kept ? v : vec4(sum.x / sum.w, sum.y / sum.w, sum.z / sum.w, v.w));
#endif
}
