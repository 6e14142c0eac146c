/* BUILD
   math: voxel_grid
   module u32:
*/
#define SPAN 256  // as voxelize_scan has it
#define PARAMETERS(_) \
    _(int, bricks)    /* bricks of the grid */ \
    _(int, capacity)  /* bricks that there are accumulators for */
#define BINDINGS(_) \
    _(READ, 0, uint, sums) \
    _(UPDATE, 1, uint, slots) \
    _(WRITE, 2, uint, brick_list) \
    _(UPDATE, 3, uint, counters)
