// The tiles that reflect, in the order of the image, behind their number: the same list however invocations run.

KERNEL(hiz_ssr_list) {
    const int first = invocation_x() * SPAN;
    if (first >= params.tiles) return;
    const int last = min(first + SPAN, params.tiles);
    uint number = 0u;
    for (int t = 0; t < first; ++t) number += load(flags, t);
    for (int t = first; t < last; ++t)
        if (load(flags, t) != 0u) {
            store(tile_list, 1 + int(number), uint(t));
            ++number;
        }
    if (last == params.tiles) store(tile_list, 0, number);
}
