/* BUILD
   module u32:
*/
#define PARAMETERS(_) \
    _(int, width)    /* cells along x, y, z */ \
    _(int, height) \
    _(int, depth) \
    _(int, run)      /* neighbouring cells that a step's invocation makes */ \
    _(int, columns)  /* values of a row of lpv_start */ \
    _(int, channels) \
    _(int, steps) \
    _(int, at)       /* word of state that lpv_bounds began at */ \
    _(int, step_x)   /* workgroups of the steps and of lpv_start, invocations */ \
    _(int, step_y) \
    _(int, step_z) \
    _(int, start_x) \
    _(int, start_y) \
    _(int, start_z)
#define CONSTANTS(_) \
    _(0, int, PERIODIC, 0)  /* 1: beyond the grid is its opposite side */
#define BINDINGS(_) \
    _(READ, 0, uint, state) \
    _(WRITE, 1, uint, boxes)
