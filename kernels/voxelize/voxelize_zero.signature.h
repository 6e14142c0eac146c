/* BUILD
   math: voxel_grid
   module exact: CARRIES=1
   module packed: CARRIES=0
*/
#define PARAMETERS(_) \
    _(int, capacity)  /* bricks that there are accumulators for */ \
    _(int, words)     /* of a voxel's accumulators */ \
    _(int, stride)    /* invocations */
#if CARRIES
#define CARRIED(_) _(WRITE, 2, uint, carries)
#else
#define CARRIED(_)
#endif
#define BINDINGS(_) \
    _(UPDATE, 0, uint, counters) \
    _(WRITE, 1, uint, sums) \
    CARRIED(_)
