// How many bricks of each span are touched.

KERNEL(voxelize_scan) {
    const int span = invocation_x();
    const int first = span * SPAN;
    if (first >= params.bricks) return;
    uint sum = 0u;
    for (int b = first; b < min(first + SPAN, params.bricks); ++b) sum += load(slots, b);
    store(sums, span, sum);
}
