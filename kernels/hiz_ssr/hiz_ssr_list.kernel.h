// The tiles that reflect, in the order of the image, behind their number: the same list however invocations run.
// counts: the workgroups of the two passes that walk it.

KERNEL(hiz_ssr_list) {
    const int span = invocation_x();
    const int first = span * SPAN;
    if (first >= params.tiles) return;
    const int last = min(first + SPAN, params.tiles);
    uint number = 0u;
    for (int s = 0; s < span; ++s) number += load(sums, s);
    for (int t = first; t < last; ++t)
        if (load(flags, t) != 0u) {
            store(tile_list, 1 + int(number), uint(t));
            ++number;
        }
    if (last != params.tiles) return;
    store(tile_list, 0, number);
    store(counts, 0, groups_for(number * params.rays, params.workgroup, params.most_rays));
    store(counts, 1, 1u);
    store(counts, 2, 1u);
    store(counts, 3, groups_for(number * params.pixels, params.workgroup, params.most_pixels));
    store(counts, 4, 1u);
    store(counts, 5, 1u);
}
