// Numbers the touched bricks in the order of the grid: slots (1 for a touched brick, 0) become 1 + number, and 0 where
// there is no room. The list holds the bricks by number.

KERNEL(voxelize_slots) {
    const int span = invocation_x();
    const int first = span * SPAN;
    if (first >= params.bricks) return;
    uint number = 0u;
    for (int s = 0; s < span; ++s) number += load(sums, s);
    for (int b = first; b < min(first + SPAN, params.bricks); ++b) {
        if (load(slots, b) == 0u) continue;
        const bool room = number < uint(params.capacity);
        if (room) store(brick_list, int(number), uint(b));
        ++number;
        store(slots, b, room ? number : 0u);
    }
    if (first + SPAN >= params.bricks) store(counters, COUNT_BRICKS, number);
}
