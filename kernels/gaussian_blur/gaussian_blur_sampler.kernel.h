// One pass of a separable Gaussian blur with two texels per tap (Akenine-Moeller et al., Real-Time Rendering 4e, 12.1,
// figure 12.3): the linear sampler, placed between texels t and t + 1 at w(t+1) / (w(t) + w(t+1)), weighs them itself.

FN pixel sampled(CTX, int x, int y, float distance) {
    vec2 at = AXIS == 0 ? vec2(float(x) + 0.5f + distance, float(y) + 0.5f) : vec2(float(x) + 0.5f, float(y) + 0.5f + distance);
    return sample2d(src, vec2(at.x * params.pixel_x, at.y * params.pixel_y));
}

FN pixel pair(CTX, int x, int y, int i) {
    float distance = table(weights, 2 * i);
    return table(weights, 2 * i - 1) * (sampled(ctx, x, y, -distance) + sampled(ctx, x, y, distance));
}

KERNEL(gaussian_blur_sampler) {
    const int x = invocation_x();
    const int y = invocation_y();
    if (x >= params.width || y >= params.height) return;
    pixel sum = table(weights, 0) * sampled(ctx, x, y, 0.0f);
    if (UNROLLED != 0) {
        UNROLL for (int i = 1; i <= PAIRS; ++i) sum = sum + pair(ctx, x, y, i);
    } else {
        for (int i = 1; i <= PAIRS; ++i) sum = sum + pair(ctx, x, y, i);
    }
    store_pixel(dst, params.dst_stride, x, y, sum);
}
