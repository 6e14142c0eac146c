// Clears the accumulators of the bricks that are touched.

KERNEL(voxelize_zero) {
    const int count = int(min(load(counters, COUNT_BRICKS), uint(params.capacity))) * BRICK_VOXELS;
    for (int v = invocation_x(); v < count; v += params.stride)
        for (int word = 0; word < params.words; ++word) {
            store(sums, v * params.words + word, 0u);
#if CARRIES
            store(carries, v * params.words + word, 0u);
#endif
        }
}
