// The least distance of ratio x ratio texels: a lower bound for every ray that crosses them. What is no number counts as 0,
// so that no ray passes it unseen.

FN float distance_at(CTX, int i) {
#if F16
    const float v = f16_value(bits_of_texel(load(distances, i >> 1), i));
#else
    const float v = load(distances, i);
#endif
    return v >= 0.0f ? v : 0.0f;
}

FN float least_of(CTX, int cell) {
    const int across = params.size / params.ratio;
    const int x = cell % across * params.ratio;
    const int y = cell / across % across * params.ratio;
    const int probe = cell / across / across;
    float least = 3.0e38f;
    for (int j = 0; j < params.ratio; ++j)
        for (int i = 0; i < params.ratio; ++i) least = min(least, distance_at(ctx, probe_texel(probe, x + i, y + j, params.size)));
    return least;
}

KERNEL(probe_minimum) {
#if F16
    for (int j = invocation_x(); 2 * j < params.cells; j += params.stride)
        store(minimum, j, f16_bits(least_of(ctx, 2 * j)) | (2 * j + 1 < params.cells ? f16_bits(least_of(ctx, 2 * j + 1)) << 16 : 0u));
#else
    for (int i = invocation_x(); i < params.cells; i += params.stride) store(minimum, i, least_of(ctx, i));
#endif
}
