// bilateral.kernel.h for colours alone and small windows, in the form of drivers that read whole texels faster than planes: the
// window is unrolled by constants, and results beside each other share what they read. The same sums in the same order.

FN float distance2_of(vec4 d, int channels) {
    float r = 0.0f;
    if (L1 != 0) {
        r = abs(d.x) + abs(d.y) + abs(d.z);
        if (channels == 4) r = r + abs(d.w);
        return r * r;
    }
    r = d.x * d.x + d.y * d.y + d.z * d.z;
    if (channels == 4) r = r + d.w * d.w;
    return r;
}

KERNEL(bilateral_packed) {
    const int x = invocation_x() * ACROSS;
    const int y = invocation_y() * DOWN;
    if (x >= params.width || y >= params.height) return;
    if (FLAT != 0) {
        if (load(flats, y / 16 * ((params.width + 15) / 16) + x / 16) != 0u) return;
    }

    ARRAY(vec4, centre, ACROSS * DOWN)
    ARRAY(vec4, guide, ACROSS * DOWN)
    ARRAY(vec4, sum, ACROSS * DOWN)
    ARRAY(float, weight, ACROSS * DOWN)
    UNROLL for (int b = 0; b < DOWN; ++b) {
        const int row = min(y + b, params.height - 1);
        UNROLL for (int a = 0; a < ACROSS; ++a) {
            centre[b * ACROSS + a] = load_pixel(colours, params.pitch, x + a + params.pad, row);
            if (RANGE == 2) guide[b * ACROSS + a] = load_pixel(guides, params.pitch, x + a + params.pad, row);
            sum[b * ACROSS + a] = vec4(0.0f, 0.0f, 0.0f, 0.0f);
            weight[b * ACROSS + a] = 1.0f;
        }
    }

    UNROLL for (int j = -RADIUS; j < RADIUS + DOWN; ++j) {
        const int row = border_index(BORDER, y + j, params.height);
        UNROLL for (int i = -RADIUS; i < RADIUS + ACROSS; ++i) {
            const vec4 tap = load_pixel(colours, params.pitch, x + i + params.pad, row);
            vec4 tap_guide = tap;
            if (RANGE == 2) tap_guide = load_pixel(guides, params.pitch, x + i + params.pad, row);
            UNROLL for (int b = 0; b < DOWN; ++b) {
                UNROLL for (int a = 0; a < ACROSS; ++a) {
                    const int s = i - a;
                    const int t = j - b;
                    if (s >= -RADIUS && s <= RADIUS && t >= -RADIUS && t <= RADIUS && s * s + t * t <= REACH &&
                        (s != 0 || t != 0)) {
                        const vec4 d = tap - centre[b * ACROSS + a];
                        const float apart = RANGE == 2 ? distance2_of(tap_guide - guide[b * ACROSS + a], 3)
                                                       : distance2_of(d, COLOURS);
                        const float w = range_weight((table(spatial, max(s, -s)) + table(spatial, max(t, -t))) -
                                                     params.range_factor * apart);
                        weight[b * ACROSS + a] += w;
                        sum[b * ACROSS + a] = sum[b * ACROSS + a] + w * d;
                    }
                }
            }
        }
    }

    UNROLL for (int b = 0; b < DOWN; ++b) {
        UNROLL for (int a = 0; a < ACROSS; ++a) {
            if (x + a < params.width && y + b < params.height) {
                const int at = b * ACROSS + a;
                vec4 after = centre[at] + sum[at] / weight[at];
                if (COLOURS == 3) after.w = centre[at].w;
                // What is not finite stays as it is.
                if (centre[at].x >= 1.0e36f) after = load_pixel(src, params.src_stride, x + a, y + b);
                store_pixel(dst, params.dst_stride, x + a, y + b, after);
            }
        }
    }
}
