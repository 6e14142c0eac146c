// Moments of luminance over frames (Schied et al. 2017, 4.2), as mean and variance: E(l^2) - E(l)^2 would cancel. With weight
// a of the new frame: d = l - mean, mean' = mean + a d, variance' = (1 - a)(variance + a d^2).

KERNEL(variance_temporal) {
    const int x = invocation_x();
    const int y = invocation_y();
    if (x >= params.width || y >= params.height) return;
    const int i = y * params.width + x;
    const float l = luminance_of(load_pixel(src, params.src_stride, x, y));
    const float mean = load(history, 3 * i);
    const float variance = load(history, 3 * i + 1);
    // A history that is no number is none.
    const bool has = load(history, 3 * i + 2) >= 1.0f && mean - mean == 0.0f && variance - variance == 0.0f;
    const float frames = has ? load(history, 3 * i + 2) : 0.0f;
    const bool counts = l - l == 0.0f;
    const float a = max(1.0f / (frames + 1.0f), params.alpha);
    const float d = has ? l - mean : 0.0f;
    const float new_mean = has ? mean + a * d : l;
    const float new_variance = has ? (1.0f - a) * (variance + a * (d * d)) : 0.0f;
    const float length_now = counts ? frames + 1.0f : frames;
    store(history_out, 3 * i, counts ? new_mean : has ? mean : 0.0f);
    store(history_out, 3 * i + 1, counts ? new_variance : has ? variance : 0.0f);
    store(history_out, 3 * i + 2, length_now);
    // The variance of one frame, from n of them: a population's times n / (n - 1), while all frames count alike.
    const float unbiased = 1.0f / max(params.alpha, 1.0f / max(length_now, 2.0f));
    const float now = counts ? new_variance : variance;
    if (length_now >= params.shortest) store(variances, i, now * (unbiased / (unbiased - 1.0f)));
}
