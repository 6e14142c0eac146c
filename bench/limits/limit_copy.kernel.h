// dst = src: what a driver's compute kernels can move. Raw bits, so that f32x1 also stands for unorm8x4 and f32x2 for
// f16x4.
KERNEL(limit_copy) {
    const int first = invocation_x() * PIXELS * BLOCK;
    const int y = invocation_y();
    if (first >= params.width || y >= params.height) return;
    if (first + PIXELS * BLOCK <= params.width) {
        UNROLL for (int b = 0; b < BLOCK; ++b)
            store_wide(dst, params.width, first + b * PIXELS, y, load_wide(src, params.width, first + b * PIXELS, y));
        return;
    }
    for (int i = first; i < params.width; ++i)
        store_pixel(dst, params.width, i, y, load_pixel(src, params.width, i, y));
}
