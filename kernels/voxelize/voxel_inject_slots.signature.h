/* BUILD
   math: voxel_light
   module u32:
*/
#define PARAMETERS(_) \
    _(int, bricks)  /* capacity of the list */
#define BINDINGS(_) \
    _(READ, 0, uint, brick_list) \
    _(READ, 1, uint, voxel_counters) \
    _(WRITE, 2, uint, slots)
