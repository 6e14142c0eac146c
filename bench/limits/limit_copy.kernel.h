// dst = src: what a driver's compute kernels can move. Raw bits, so that f32x1 also stands for unorm8x4 and f32x2 for f16x4.
KERNEL(limit_copy) {
    const int x = invocation_x() * PIXELS;
    const int y = invocation_y();
    if (x >= params.width || y >= params.height) return;
    if (x + PIXELS <= params.width) {
        store_wide(dst, params.width, x, y, load_wide(src, params.width, x, y));
        return;
    }
    for (int i = x; i < params.width; ++i) store_pixel(dst, params.width, i, y, load_pixel(src, params.width, i, y));
}
