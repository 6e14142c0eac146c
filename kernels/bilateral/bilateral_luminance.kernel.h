// Luminance (Rec. 709) and log2(e) / (sigma_l sqrt(gauss3x3(variance)) + epsilon), by which its differences count
// (Schied et al. 2017, eq. 5). NaN, so that nothing weighs, where that variance is below the target.

FN float colour_at(CTX, int p, int x, int y) { return load_pixel(colours, params.pitch, x, p * params.height + y); }

FN float variance_row(CTX, int x, int y) {
    const int row = params.variance * params.height + clamp(y, 0, params.height - 1);
    const float low = load_pixel(variances, params.pitch, params.pad + max(x - 1, 0), row);
    const float centre = load_pixel(variances, params.pitch, params.pad + x, row);
    const float high = load_pixel(variances, params.pitch, params.pad + min(x + 1, params.width - 1), row);
    return 0.25f * (low + high) + 0.5f * centre;
}

KERNEL(bilateral_luminance) {
    const int px = invocation_x();
    const int y = invocation_y();
    if (px >= params.pitch || y >= params.height) return;
    const int x = border_index(BORDER, px - params.pad, params.width);
    const int at = params.pad + x;
    float l = colour_at(ctx, 0, at, y);
    if (COLOURS == 2) l = 0.5f * (l + colour_at(ctx, 1, at, y));
    if (COLOURS > 2) l = 0.2126f * l + 0.7152f * colour_at(ctx, 1, at, y) + 0.0722f * colour_at(ctx, 2, at, y);
    const float v = 0.25f * (variance_row(ctx, x, y - 1) + variance_row(ctx, x, y + 1)) + 0.5f * variance_row(ctx, x, y);
    store_pixel(planes, params.pitch, px, params.first * params.height + y, l);
    const float factor = 1.44269504f / (params.sigma * sqrt(v > 0.0f ? v : 0.0f) + params.epsilon);
    store_pixel(planes, params.pitch, px, (params.first + 1) * params.height + y,
                v < params.target ? uintBitsToFloat(0x7fc00000u) : factor);
}
