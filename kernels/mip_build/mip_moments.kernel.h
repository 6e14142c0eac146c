// A coarser level of mean and standard deviation, as those of the mixture of what a texel covers:
//   mu = sum w mu_i,   sigma^2 = sum w (sigma_i^2 + (mu_i - mu)^2).
// No difference of squares: nothing cancels, and squares live in f32 only, so that f16 holds values up to 65504.

// (mean, standard deviation)
FN vec2 fine(CTX, int x, int y) {
#if ONE
    return vec2(load_pixel(src, params.src_x, x, y), 0.0f);
#else
    return load_pixel(src, params.src_x, x, y);
#endif
}

// Weighted means over what texel (i, j) covers: of the means, or (about) of the second moments about mu.
FN float along_x(CTX, int i, int y, bool about, float mu) {
    float t[5];
    UNROLL for (int k = 0; k < mip_taps(MODE_X); ++k) {
        vec2 v = fine(ctx, mip_tap(MODE_X, i, k, params.src_x), y);
        t[k] = about ? v.y * v.y + (v.x - mu) * (v.x - mu) : v.x;
    }
    return mip_mean(MODE_X, t, i, params.dst_x, params.src_x);
}

FN float along_y(CTX, int i, int j, bool about, float mu) {
    float t[5];
    UNROLL for (int k = 0; k < mip_taps(MODE_Y); ++k)
        t[k] = along_x(ctx, i, mip_tap(MODE_Y, j, k, params.src_y), about, mu);
    return mip_mean(MODE_Y, t, j, params.dst_y, params.src_y);
}

KERNEL(mip_moments) {
    const int x = invocation_x();
    const int y = invocation_y();
    if (x >= params.dst_x || y >= params.dst_y) return;
    const float mu = along_y(ctx, x, y, false, 0.0f);
    store_pixel(dst, params.dst_x, x, y, vec2(mu, sqrt(along_y(ctx, x, y, true, mu))));
}
