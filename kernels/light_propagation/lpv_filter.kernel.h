// A light volume blurred by (w, 1 - 2 w, w) along each axis; beyond the grid is its outermost cell, which keeps the sum.

FN vec4 row(CTX, int at, int left, int right) {
    const vec4 centre = load_pixel(src, 0, at, 0);
    return centre + params.weight * ((load_pixel(src, 0, at - left, 0) - centre) + (load_pixel(src, 0, at + right, 0) - centre));
}
FN vec4 slice(CTX, int at, ivec2 x, ivec2 y) {
    const vec4 centre = row(ctx, at, x.x, x.y);
    return centre + params.weight * ((row(ctx, at - y.x, x.x, x.y) - centre) + (row(ctx, at + y.y, x.x, x.y) - centre));
}
FN ivec2 neighbours(int at, int n, int step) { return ivec2(at > 0 ? step : 0, at + 1 < n ? step : 0); }

KERNEL(lpv_filter) {
    for (int i = invocation_x(); i < params.pixels; i += params.stride) {
        const int plane = params.width * params.height;
        const ivec2 x = neighbours(i % params.width, params.width, 1);
        const ivec2 y = neighbours(i / params.width % params.height, params.height, params.width);
        const ivec2 z = neighbours(i / plane % params.depth, params.depth, plane);
        const vec4 centre = slice(ctx, i, x, y);
        store_pixel(dst, 0, i, 0,
                    centre + params.weight * ((slice(ctx, i - z.x, x, y) - centre) + (slice(ctx, i + z.y, x, y) - centre)));
    }
}
