// The least and the greatest value, in each column of 16 rows, of what weighs in a bilateral filter. NaN where one of them is
// no number.

FN float value_at(CTX, int p, int x, int y) {
    return load(planes, ((params.plane + p) * params.height + y) * params.pitch + params.pad + x);
}

FN float quantity_at(CTX, int q, int x, int y) {
    if (KIND == 1) {
        const int dx = q == 1 && params.width > 1 ? 1 : 0;
        const int dy = q == 2 && params.height > 1 ? 1 : 0;
        const int left = min(x, params.width - 1 - dx);
        const int above = min(y, params.height - 1 - dy);
        const float v = value_at(ctx, 0, left, above);
        return q == 0 ? v : value_at(ctx, 0, left + dx, above + dy) - v;
    }
    if (KIND == 2 && q == 3) {
        const float nx = value_at(ctx, 0, x, y);
        const float ny = value_at(ctx, 1, x, y);
        const float nz = value_at(ctx, 2, x, y);
        return nx * nx + ny * ny + nz * nz;
    }
    return value_at(ctx, q, x, y);
}

KERNEL(bilateral_range) {
    const int x = invocation_x();
    const int tile = invocation_y();
    const int q = invocation_z();
    if (x >= params.width || 16 * tile >= params.height) return;
    float least = 3.0e38f;
    float greatest = -3.0e38f;
    bool numbers = true;
    for (int y = 16 * tile; y < min(16 * tile + 16, params.height); ++y) {
        const float v = quantity_at(ctx, q, x, y);
        least = min(least, v);
        greatest = max(greatest, v);
        numbers = numbers && v == v;
    }
    const int rows = (params.height + 15) / 16;
    const int at = ((params.first + q) * rows + tile) * 2 * params.width + x;
    store(ranges, at, numbers ? least : uintBitsToFloat(0x7fc00000u));
    store(ranges, at + params.width, numbers ? greatest : uintBitsToFloat(0x7fc00000u));
}
