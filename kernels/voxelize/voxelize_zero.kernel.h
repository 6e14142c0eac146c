// Clears the accumulators of the bricks that are touched.

KERNEL(voxelize_zero) {
    const int bricks = int(min(load(counters, COUNT_BRICKS), uint(params.capacity)));
    const int count = bricks * (BRICK_VOXELS / 32) * params.words;
    for (int i = invocation_x(); i < count; i += params.stride) {
        UNROLL for (int k = 0; k < 32; ++k) store(sums, 32 * i + k, 0u);
#if CARRIES
        UNROLL for (int k = 0; k < 32; ++k) store(carries, 32 * i + k, 0u);
#endif
    }
}
