// 1/z, which is linear on a plane in screen space, or z, with its derivatives along both axes: of the two differences to
// neighbours the smaller, which does not cross an edge. Depths that are no surface (sky, zero, negative, NaN) become NaN,
// and weigh nothing.

FN float value_at(CTX, int x, int y) {
    float d = load_pixel(z, params.width, x, y);
    float none = uintBitsToFloat(0x7fc00000u);
    if (!(d > 0.0f && d < 1.0e10f)) return none;
    return INVERSE != 0 ? 1.0f / d : d;
}

// Of differences to both sides, NaN where there is no surface.
FN float slope(float low, float high) {
    if (!(low == low)) return high == high ? high : 0.0f;
    if (!(high == high)) return low;
    return abs(low) <= abs(high) ? low : high;
}

KERNEL(bilateral_depth) {
    const int px = invocation_x();
    const int y = invocation_y();
    if (px >= params.pitch || y >= params.height) return;
    const int x = border_index(BORDER, px - params.pad, params.width);
    const float v = value_at(ctx, x, y);
    const float none = uintBitsToFloat(0x7fc00000u);
    const float left = x > 0 ? v - value_at(ctx, x - 1, y) : none;
    const float right = x + 1 < params.width ? value_at(ctx, x + 1, y) - v : none;
    const float above = y > 0 ? v - value_at(ctx, x, y - 1) : none;
    const float below = y + 1 < params.height ? value_at(ctx, x, y + 1) - v : none;
    store_pixel(planes, params.pitch, px, params.first * params.height + y, v);
    store_pixel(planes, params.pitch, px, (params.first + 1) * params.height + y, slope(left, right));
    store_pixel(planes, params.pitch, px, (params.first + 2) * params.height + y, slope(above, below));
}
