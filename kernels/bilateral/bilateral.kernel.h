// dst(p) = sum w(p,q) src(q) / sum w(p,q), w(p,p) = 1, over a window of taps; w a product of terms, here a sum of exponents
// of 2 (Tomasi and Manduchi 1998; joint: Petschnigg et al. 2004; depth `svgf`, normal, luminance: Schied et al. 2017, 4.4).
// Summed as differences from the centre, so that constants stay to the bit. Planes reach `pad` pixels beyond both ends of
// a row, filled as BORDER asks: no tap along a row tests for the border.

FN wide plane(CTX, int p, int x, int y) { return load_wide(planes, params.pitch, x + params.pad, p * params.height + y); }
FN wide guided(CTX, int p, int x, int y) { return load_wide(guides, params.pitch, x + params.pad, p * params.height + y); }

// Beyond ADAPTIVE a tap is a pair of pixels, averaged: the inner half of a window one by one, the outer half in steps of
// two (Bavoil and Andersson 2012).
FN bool is_pair(int i) { return ADAPTIVE != 0 && max(i, -i) > ADAPTIVE; }
FN int first_of(int i) { return !is_pair(i) ? i * STEP : i > 0 ? 2 * i - ADAPTIVE - 1 : 2 * i + ADAPTIVE; }
FN wide plane_tap(CTX, int p, int x, int y, int x2, int y2, bool pair) {
    wide w = plane(ctx, p, x, y);
    if (pair) w = 0.5f * (w + plane(ctx, p, x2, y2));
    return w;
}
FN wide guided_tap(CTX, int p, int x, int y, int x2, int y2, bool pair) {
    wide w = guided(ctx, p, x, y);
    if (pair) w = 0.5f * (w + guided(ctx, p, x2, y2));
    return w;
}

// Whether a row of a tile is left to another pass.
FN bool is_left(CTX, int x, int y) {
    const int columns = (params.width + 15) / 16;
    const int first = FLAT == 2 ? max(y - params.reach, 0) / 16 : y / 16;
    const int last = FLAT == 2 ? min(y + params.reach, params.height - 1) / 16 : y / 16;
    bool found = false;
    for (int tile = first; tile <= last; ++tile) found = found || load(flats, tile * columns + x / 16) != 0u;
    return found == (FLAT == 1);
}

// dst at a pixel: the filtered colours; what is not finite stays as it is, alpha too where it is not filtered.
#define FILTERED(c) get_pixel(sum[b * COLOURS + min(c, COLOURS - 1)], k)
#if DST_CHANNELS == 1
#define DST_PIXEL float
#define DST_VALUE FILTERED(0)
FN bool is_finite(float v) { return v - v == 0.0f; }
#elif DST_CHANNELS == 2
#define DST_PIXEL vec2
#define DST_VALUE vec2(FILTERED(0), FILTERED(1))
FN bool is_finite(vec2 v) { vec2 zero = v - v; return zero.x + zero.y == 0.0f; }
#elif DST_CHANNELS == 4
#define DST_PIXEL vec4
#define DST_VALUE vec4(FILTERED(0), FILTERED(1), FILTERED(2), COLOURS == 3 ? before.w : FILTERED(3))
FN bool is_finite(vec4 v) { vec4 zero = v - v; return (zero.x + zero.y) + (zero.z + zero.w) == 0.0f; }
#endif

KERNEL(bilateral) {
    const int x = invocation_x() * PIXELS;
    const int y = (invocation_y() / STEP) * STEP * BLOCK + invocation_y() % STEP;
    if (x >= params.width || y >= params.height) return;
    if (FLAT != 0) {
        if (is_left(ctx, x, y)) return;
    }

    ARRAY(wide, centre, BLOCK * COLOURS)
    ARRAY(wide, sum, BLOCK * COLOURS)
    ARRAY(wide, weight, BLOCK)
    ARRAY(wide, variance, BLOCK)
    ARRAY(wide, colour, BLOCK * (GUIDES + 1))
    ARRAY(wide, depth, BLOCK * 4)
    ARRAY(wide, normal, BLOCK * 3)
    ARRAY(wide, luminance, BLOCK * 2)
    UNROLL for (int b = 0; b < BLOCK; ++b) {
        const int row = min(y + b * STEP, params.height - 1);
        UNROLL for (int c = 0; c < COLOURS; ++c) {
            centre[b * COLOURS + c] = plane(ctx, c, x, row);
            sum[b * COLOURS + c] = wide_splat(0.0f);
        }
        weight[b] = wide_splat(1.0f);
        if (CARRY != 0) variance[b] = guided(ctx, params.variance, x, row);
        if (RANGE == 2) {
            UNROLL for (int c = 0; c < GUIDES; ++c) colour[b * (GUIDES + 1) + c] = guided(ctx, params.guide + c, x, row);
        }
        if (DEPTH != 0) {
            UNROLL for (int c = 0; c < 3; ++c) depth[b * 4 + c] = guided(ctx, params.depth + c, x, row);
            depth[b * 4 + 3] = DEPTH == 1 ? wide_splat(1.0f) / depth[b * 4] : 4.76837158e-7f * depth[b * 4];
        }
        if (NORMAL != 0) {
            UNROLL for (int c = 0; c < 3; ++c) normal[b * 3 + c] = guided(ctx, params.normal + c, x, row);
        }
        if (LUMINANCE != 0) {
            UNROLL for (int c = 0; c < 2; ++c) luminance[b * 2 + c] = guided(ctx, params.luminance + c, x, row);
        }
    }

    // Where nothing can weigh beside the centre (sky, noise below its target), no tap is read.
    bool idle = DEPTH != 0 || LUMINANCE != 0;
    if (DEPTH != 0 || LUMINANCE != 0) {
        UNROLL for (int b = 0; b < BLOCK; ++b)
            UNROLL for (int k = 0; k < PIXELS; ++k) {
                const float z = DEPTH != 0 ? get_pixel(depth[b * 4], k) : 0.0f;
                const float f = LUMINANCE != 0 ? get_pixel(luminance[b * 2 + 1], k) : 0.0f;
                idle = idle && !(z == z && f == f);
            }
    }
    const int end = idle ? -ROWS : ROWS + BLOCK;
    for (int j = -ROWS; j < end; ++j) {
        const int down = first_of(j);
        if (BORDER == BORDER_ZERO && (y + down < 0 || y + down >= params.height)) continue;
        const int row = border_index(BORDER, y + down, params.height);
        const int row2 = border_index(BORDER, y + down + 1, params.height);
        // Of a circle, the taps of this row: no test stands among the taps.
        int side = COLUMNS;
        if (BLOCK == 1 && COLUMNS * COLUMNS + ROWS * ROWS > REACH)
            while (side * side + j * j > REACH) --side;
        for (int i = -side; i <= side; ++i) {
            const int across = first_of(i);
            const bool pair = is_pair(i) || is_pair(j);
            const int tx = x + across;
            const int tx2 = is_pair(i) ? tx + 1 : tx;
            const int ty2 = is_pair(i) ? row : row2;
            ARRAY(wide, tap, COLOURS)
            ARRAY(wide, tap_colour, GUIDES + 1)
            ARRAY(wide, tap_normal, 3)
            wide tap_depth, tap_luminance, tap_variance, tap_bias;
            UNROLL for (int c = 0; c < COLOURS; ++c) tap[c] = plane_tap(ctx, c, tx, row, tx2, ty2, pair);
            if (RANGE == 2) {
                UNROLL for (int c = 0; c < GUIDES; ++c)
                    tap_colour[c] = guided_tap(ctx, params.guide + c, tx, row, tx2, ty2, pair);
            }
            if (BIAS != 0) tap_bias = guided_tap(ctx, params.bias, tx, row, tx2, ty2, pair);
            if (DEPTH != 0) tap_depth = guided_tap(ctx, params.depth, tx, row, tx2, ty2, pair);
            if (LUMINANCE != 0) tap_luminance = guided_tap(ctx, params.luminance, tx, row, tx2, ty2, pair);
            if (CARRY != 0) tap_variance = guided_tap(ctx, params.variance, tx, row, tx2, ty2, pair);
            if (NORMAL != 0) {
                UNROLL for (int c = 0; c < 3; ++c)
                    tap_normal[c] = guided_tap(ctx, params.normal + c, tx, row, tx2, ty2, pair);
            }
            UNROLL for (int b = 0; b < BLOCK; ++b) {
                const int t = j - b;
                if (BLOCK > 1 && (t < -ROWS || t > ROWS || i * i + t * t > REACH)) continue;
                if (i == 0 && t == 0) continue;
                const float space = table(spatial, max(i, -i)) + table(spatial, max(t, -t));
                wide e = wide_splat(space);
                if (BIAS != 0) e = e + tap_bias;
                if (RANGE != 0) {
                    wide distance2;
                    UNROLL for (int c = 0; c < (RANGE == 2 ? GUIDES : COLOURS); ++c) {
                        wide d = RANGE == 2 ? tap_colour[c] - colour[b * (GUIDES + 1) + c]
                                            : tap[c] - centre[b * COLOURS + c];
                        const wide part = L1 != 0 ? wide_abs(d) : d * d;
                        distance2 = c == 0 ? part : distance2 + part;
                    }
                    if (L1 != 0) distance2 = distance2 * distance2;
                    e = e - params.range_factor * distance2;
                }
                if (DEPTH != 0) {
                    const float dx = is_pair(i) ? float(across) + 0.5f : float(across);
                    const float dy = is_pair(j) ? float(down) + 0.5f : float(down - b * STEP);
                    wide slope = dx * depth[b * 4 + 1] + dy * depth[b * 4 + 2];
                    wide apart = wide_abs((tap_depth - depth[b * 4]) - (DEPTH == 1 ? slope : wide_splat(0.0f)));
                    if (DEPTH == 1)
                        e = e - (1.44269504f / (params.depth_scale * sqrt(dx * dx + dy * dy) + 4.76837158e-7f)) *
                                    (apart * depth[b * 4 + 3]);
                    else
                        e = e - 1.44269504f * apart / (params.depth_scale * wide_abs(slope) + depth[b * 4 + 3]);
                }
                if (NORMAL != 0) {
                    wide cosine = tap_normal[0] * normal[b * 3] + tap_normal[1] * normal[b * 3 + 1] +
                                  tap_normal[2] * normal[b * 3 + 2];
                    e = e + params.normal_power * wide_log2_cosine(cosine);
                }
                if (LUMINANCE != 0) e = e - luminance[b * 2 + 1] * wide_abs(tap_luminance - luminance[b * 2]);
                const bool alone = RANGE == 0 && BIAS == 0 && DEPTH == 0 && NORMAL == 0 && LUMINANCE == 0;
                wide w = alone ? wide_splat(range_weight(space)) : wide_weight(e);
                if (ADAPTIVE != 0 && pair) w = w + w;
                weight[b] = weight[b] + w;
                UNROLL for (int c = 0; c < COLOURS; ++c)
                    sum[b * COLOURS + c] = sum[b * COLOURS + c] + w * (tap[c] - centre[b * COLOURS + c]);
                if (CARRY != 0) variance[b] = variance[b] + (w * w) * tap_variance;
            }
        }
    }

    UNROLL for (int b = 0; b < BLOCK; ++b) {
        const int row = y + b * STEP;
        if (row >= params.height) continue;
        UNROLL for (int c = 0; c < COLOURS; ++c) {
            sum[b * COLOURS + c] = centre[b * COLOURS + c] + sum[b * COLOURS + c] / weight[b];
#if DST_CHANNELS == 0
            store_wide(dst, params.pitch, x + params.pad, c * params.height + row, sum[b * COLOURS + c]);
#endif
        }
        if (CARRY != 0) {
            const wide v = variance[b] / (weight[b] * weight[b]);
            UNROLL for (int k = 0; k < PIXELS; ++k)
                if (x + k < params.width)
                    store_pixel(variances, params.carried_stride, params.carried_at + x + k, row, get_pixel(v, k));
        }
#if DST_CHANNELS != 0
        UNROLL for (int k = 0; k < PIXELS; ++k)
            if (x + k < params.width) {
                const DST_PIXEL before = load_pixel(src, params.src_stride, x + k, row);
                const DST_PIXEL after = DST_VALUE;
                store_pixel(dst, params.dst_stride, x + k, row, is_finite(before) ? after : before);
            }
#endif
    }
}
