// Clamps luminance to what the neighbours say: mean +- k standard deviations, or median +- k 1.4826 MAD, both without the
// pixel itself (with it, mean + k deviations cannot be passed for k >= sqrt(n - 1)). Colour is scaled, so that its hue stays;
// a pixel that is not finite becomes grey of the neighbours' mean or median.

#if CHANNELS == 1
FN float brightness(float v) { return v; }
FN bool is_finite(float v) { return v - v == 0.0f; }
#define GREY(l, alpha) (l)
#define SCALED(v, s) ((v) * (s))
#define ALPHA(v) 1.0f
#else
FN float brightness(vec4 v) { return 0.2126f * v.x + 0.7152f * v.y + 0.0722f * v.z; }
FN bool is_finite(vec4 v) { vec4 zero = v - v; return (zero.x + zero.y) + (zero.z + zero.w) == 0.0f; }
#define GREY(l, alpha) vec4(l, l, l, alpha)
#define SCALED(v, s) vec4((v).x * (s), (v).y * (s), (v).z * (s), (v).w)
#define ALPHA(v) (v).w
#endif

KERNEL(outlier_clamp) {
    const int x = invocation_x();
    const int y = invocation_y();
    if (x >= params.width || y >= params.height) return;
    const pixel v = load_pixel(src, params.src_stride, x, y);
    ARRAY(float, around, 48)
    int n = 0;
    float sum = 0.0f;
    for (int j = max(y - RADIUS, 0); j <= min(y + RADIUS, params.height - 1); ++j)
        for (int i = max(x - RADIUS, 0); i <= min(x + RADIUS, params.width - 1); ++i) {
            const pixel q = load_pixel(src, params.src_stride, i, j);
            if ((i != x || j != y) && is_finite(q)) {
                around[n] = brightness(q);
                sum += around[n];
                ++n;
            }
        }

    float middle = n > 0 ? sum / float(n) : 0.0f;
    float spread = 0.0f;
    if (MEDIAN == 0) {
        for (int i = 0; i < n; ++i) spread += (around[i] - middle) * (around[i] - middle);
        spread = sqrt(spread / max(float(n) - 1.0f, 1.0f));
    } else {
        // The median by counting ranks (equal values rank by place), first of the values, then of their distances from it.
        for (int turn = 0; turn < 2; ++turn) {
            float low = 0.0f;
            float high = 0.0f;
            for (int i = 0; i < n; ++i) {
                int rank = 0;
                for (int j = 0; j < n; ++j) rank += around[j] < around[i] || (around[j] == around[i] && j < i) ? 1 : 0;
                if (rank == (n - 1) / 2) low = around[i];
                if (rank == n / 2) high = around[i];
            }
            if (turn == 0) middle = 0.5f * (low + high);
            else spread = 1.4826f * (0.5f * (low + high));
            for (int i = 0; i < n; ++i) around[i] = abs(around[i] - middle);
        }
    }

    const bool finite = is_finite(v);
    const float l = finite ? brightness(v) : middle;
    const float above = middle + params.k * spread;
    const float below = middle - params.k * spread;
    const float kept = n == 0 ? l : l > above ? above : l < below ? below : l;
    pixel result = v;
    if (!finite) result = GREY(middle, 1.0f);
    else if (kept != l) result = l > 0.0f ? SCALED(v, kept / l) : GREY(kept, ALPHA(v));
    store_pixel(dst, params.dst_stride, x, y, result);
    if (COUNTED != 0) {
        if (!finite) atomic_add(counters, 1, 1u);
        else if (kept != l) atomic_add(counters, 0, 1u);
    }
}
