// No brick is touched, nothing is counted yet.

KERNEL(voxelize_clear) {
    const int i = invocation_x();
    if (i < 16) store(counters, i, 0u);
    for (int b = i; b < params.bricks; b += params.stride) store(slots, b, 0u);
}
