// The variance of luminance in a window around each pixel, as an estimate of one sample's: sum (l - mean)^2 / (n - 1), in two
// passes over the window, so that nothing cancels. Pixels that are not finite do not count.

KERNEL(variance) {
    const int x = invocation_x();
    const int y = invocation_y();
    if (x >= params.width || y >= params.height) return;
    const int left = max(x - RADIUS, 0);
    const int right = min(x + RADIUS, params.width - 1);
    const int top = max(y - RADIUS, 0);
    const int bottom = min(y + RADIUS, params.height - 1);
    // Relative to the pixel itself, so that a high level costs no digits.
    const float here = luminance_of(load_pixel(src, params.src_stride, x, y));
    const float level = here - here == 0.0f ? here : 0.0f;
    float n = 0.0f;
    float sum = 0.0f;
    for (int j = top; j <= bottom; ++j)
        for (int i = left; i <= right; ++i) {
            const float l = luminance_of(load_pixel(src, params.src_stride, i, j));
            const bool counts = l - l == 0.0f;
            n += counts ? 1.0f : 0.0f;
            sum += counts ? l - level : 0.0f;
        }
    const float mean = sum / max(n, 1.0f);
    float squares = 0.0f;
    for (int j = top; j <= bottom; ++j)
        for (int i = left; i <= right; ++i) {
            const float l = luminance_of(load_pixel(src, params.src_stride, i, j));
            const float d = l - l == 0.0f ? (l - level) - mean : 0.0f;
            squares += d * d;
        }
    store(variances, y * params.width + x, squares / max(n - 1.0f, 1.0f));
}
