/* BUILD
   math: voxel_grid
   module f32x4: PIXEL=f32x4
   module f16x4: PIXEL=f16x4
   module unorm8x4: PIXEL=unorm8x4
*/
#define PARAMETERS(_) \
    _(int, width)     /* voxels of the grid */ \
    _(int, height) \
    _(int, depth) \
    _(int, capacity)  /* bricks that the list holds at most */ \
    _(int, stride)    /* invocations */
#define BINDINGS(_) \
    _(READ, 0, uint, left_bricks) \
    _(READ, 1, uint, left_counters) \
    _(READ, 2, PIXEL, under) \
    _(WRITE, 3, PIXEL, dst)
