// a = b + s c (McCalpin, STREAM).
KERNEL(limit_triad) {
    const int x = invocation_x() * PIXELS;
    const int y = invocation_y();
    if (x + PIXELS > params.width || y >= params.height) return;
    store_wide(a, params.width, x, y, load_wide(b, params.width, x, y) + 3.0f * load_wide(c, params.width, x, y));
}
