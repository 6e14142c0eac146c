// How many tiles of each span reflect.

KERNEL(hiz_ssr_spans) {
    const int span = invocation_x();
    const int first = span * SPAN;
    if (first >= params.tiles) return;
    uint sum = 0u;
    for (int t = first; t < min(first + SPAN, params.tiles); ++t) sum += load(flags, t);
    store(sums, span, sum);
}
