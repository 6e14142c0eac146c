// Each brick of the grid learns where it stands in the list of touched bricks: 1 + index (0: nowhere).

KERNEL(voxel_inject_slots) {
    const int i = invocation_x();
    if (i < int(min(load(voxel_counters, LIT_COUNT_BRICKS), uint(params.bricks)))) store(slots, int(load(brick_list, i)), uint(i + 1));
}
