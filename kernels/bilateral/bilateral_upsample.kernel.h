// An image of 1/RATIO the size at full size (joint bilateral upsampling, Kopf et al. 2007): the four low pixels around a pixel,
// by their bilinear weights and by how their depth, and normal, fit the pixel's plane; where none fits, the one whose depth
// is nearest (Jansen and Bavoil 2011).

FN float inverse_of(float z) { return z > 0.0f && z < 1.0e10f ? 1.0f / z : 0.0f; }
FN float inverse_at(CTX, int x, int y) {
    return inverse_of(load(depth, clamp(y, 0, params.height - 1) * params.width + clamp(x, 0, params.width - 1)));
}

// Of differences to both sides the smaller; 0 where a side is sky.
FN float slope(float a, float b, float c) {
    const float low = a > 0.0f ? b - a : 1.0e30f;
    const float high = c > 0.0f ? c - b : 1.0e30f;
    const float least = abs(low) <= abs(high) ? low : high;
    return abs(least) < 1.0e29f ? least : 0.0f;
}

KERNEL(bilateral_upsample) {
    const int x = invocation_x();
    const int y = invocation_y();
    if (x >= params.width || y >= params.height) return;
    const float here = inverse_at(ctx, x, y);
    const float gx = slope(x > 0 ? inverse_at(ctx, x - 1, y) : 0.0f, here, x + 1 < params.width ? inverse_at(ctx, x + 1, y) : 0.0f);
    const float gy = slope(y > 0 ? inverse_at(ctx, x, y - 1) : 0.0f, here, y + 1 < params.height ? inverse_at(ctx, x, y + 1) : 0.0f);
    const float ratio = float(RATIO);
    const float u = (float(x) + 0.5f) / ratio - 0.5f;
    const float v = (float(y) + 0.5f) / ratio - 0.5f;
    const int left = u >= 0.0f ? int(u) : -1;
    const int top = v >= 0.0f ? int(v) : -1;
#if CHANNELS == 1
    float sum = 0.0f;
    float nearest = 0.0f;
#else
    vec4 sum = vec4(0.0f);
    vec4 nearest = vec4(0.0f);
#endif
    float weight = 0.0f;
    float best = 3.0e38f;
    for (int k = 0; k < 4; ++k) {
        const int i = left + (k & 1);
        const int j = top + (k >> 1);
        const int lx = clamp(i, 0, params.low_width - 1);
        const int ly = clamp(j, 0, params.low_height - 1);
        const float wx = (k & 1) == 0 ? 1.0f - (u - float(left)) : u - float(left);
        const float wy = (k >> 1) == 0 ? 1.0f - (v - float(top)) : v - float(top);
        const float there = inverse_of(load(depth_low, ly * params.low_width + lx));
        // From this pixel to the middle of the low one.
        const float dx = (float(lx) + 0.5f) * ratio - 0.5f - float(x);
        const float dy = (float(ly) + 0.5f) * ratio - 0.5f - float(y);
        const float apart = abs(there - here - (gx * dx + gy * dy));
        const float plain = abs(there - here);
        float e = -1.0e30f;
        if (here > 0.0f && there > 0.0f)
            e = -1.44269504f * (apart / here) / (params.depth_scale * sqrt(dx * dx + dy * dy) + 4.76837158e-7f);
        if (here == 0.0f && there == 0.0f) e = 0.0f;
#if NORMALS == 1
        if (here > 0.0f) {
            const vec4 n = load_pixel(normals, params.width, x, y);
            const vec4 m = load_pixel(normals_low, params.low_width, lx, ly);
            e = e + params.normal_power * log2_cosine(n.x * m.x + n.y * m.y + n.z * m.z);
        }
#endif
        const float w = wx * wy * range_weight(e > 0.0f ? 0.0f : e);
        const pixel value = load_pixel(src, params.low_width, lx, ly);
#if CHANNELS == 1
        const bool finite = value - value == 0.0f;
#else
        const vec4 zero = value - value;
        const bool finite = (zero.x + zero.y) + (zero.z + zero.w) == 0.0f;
#endif
        if (finite) {
            sum = sum + w * value;
            weight += w;
            if (plain < best) {
                best = plain;
                nearest = value;
            }
        }
    }
    store_pixel(dst, params.width, x, y, NEAREST == 0 && weight >= params.least ? sum / weight : nearest);
}
