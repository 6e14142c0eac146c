// Tiles without edges. From the ranges of what weighs, over all that a tile's taps may reach, follows the greatest exponent that
// any two of its pixels can be apart by; where there is one that is no number, the tile is not flat.
// Depth: from p to q the values of 1/z change by sums of differences between neighbours, and the slopes at p are two of those:
// off the plane by at most |dx| range_x + |dy| range_y <= |q - p| sqrt(range_x^2 + range_y^2).
// Normals: n(p).n(q) = (|n(p)|^2 + |n(q)|^2 - |n(p) - n(q)|^2) / 2.

// Least and greatest of a quantity.
FN vec2 range_of(CTX, int q, int x0, int x1, int tile0, int tile1) {
    const int rows = (params.height + 15) / 16;
    float least = 3.0e38f;
    float greatest = -3.0e38f;
    bool numbers = true;
    for (int tile = tile0; tile <= tile1; ++tile) {
        const int at = (q * rows + tile) * 2 * params.width;
        for (int x = x0; x <= x1; ++x) {
            const float low = load(ranges, at + x);
            const float high = load(ranges, at + params.width + x);
            least = min(least, low);
            greatest = max(greatest, high);
            numbers = numbers && low == low;
        }
    }
    return numbers ? vec2(least, greatest) : vec2(uintBitsToFloat(0x7fc00000u), uintBitsToFloat(0x7fc00000u));
}
FN float width_of(vec2 range) { return range.y - range.x; }

KERNEL(bilateral_flat) {
    const int columns = (params.width + 15) / 16;
    const int rows = (params.height + 15) / 16;
    const int tx = invocation_x();
    const int ty = invocation_y();
    if (tx >= columns || ty >= rows) return;
    const int left = 16 * tx - params.reach;
    const int right = min(16 * tx + 15, params.width - 1) + params.reach;
    const int above = 16 * ty - params.reach;
    const int below = min(16 * ty + 15, params.height - 1) + params.reach;
    const int x0 = max(left, 0);
    const int x1 = min(right, params.width - 1);
    const int t0 = max(above, 0) / 16;
    const int t1 = min(below, params.height - 1) / 16;

    float e = 0.0f;
    if (COLOURS != 0) {
        float apart = 0.0f;
        for (int c = 0; c < COLOURS; ++c) {
            const float d = width_of(range_of(ctx, params.colour + c, x0, x1, t0, t1));
            apart = apart + (L1 != 0 ? d : d * d);
        }
        e = e + params.range_factor * (L1 != 0 ? apart * apart : apart);
    }
    if (BIAS != 0) e = e - range_of(ctx, params.bias, x0, x1, t0, t1).x;
    if (DEPTH != 0) {
        const float least = range_of(ctx, params.depth, x0, x1, t0, t1).x;
        const float sx = width_of(range_of(ctx, params.depth + 1, x0, x1, t0, t1));
        const float sy = width_of(range_of(ctx, params.depth + 2, x0, x1, t0, t1));
        e = e + 1.44269504f * sqrt(sx * sx + sy * sy) / (params.depth_scale * least);
    }
    if (NORMAL != 0) {
        float apart = 0.0f;
        for (int c = 0; c < 3; ++c) {
            const float d = width_of(range_of(ctx, params.normal + c, x0, x1, t0, t1));
            apart = apart + d * d;
        }
        const vec2 squares = range_of(ctx, params.normal + 3, x0, x1, t0, t1);
        const float most = squares.y > 1.0f ? log2_cosine(squares.y) : 0.0f;
        e = e + params.normal_power * (most - log2_cosine(squares.x - 0.5f * apart));
    }
    if (LUMINANCE != 0) {
        const float factor = range_of(ctx, params.luminance + 1, x0, x1, t0, t1).y;
        e = e + factor * width_of(range_of(ctx, params.luminance, x0, x1, t0, t1));
    }
    const bool reaches = INSIDE == 0 || (left >= 0 && above >= 0 && right < params.width && below < params.height);
    store(flats, ty * columns + tx, reaches && e <= params.limit ? 1u : 0u);
}
