/* BUILD
   math: vector sh wide_int wide_sum
   module lights: SURFELS=0
   module surfels: SURFELS=1
*/
#define PARAMETERS(_) \
    _(int, width)      /* cells of the grid; surfels: its corners */ \
    _(int, height) \
    _(int, depth) \
    _(int, count)      /* lights or surfels */ \
    _(int, stride)     /* invocations */ \
    _(float, origin_x) /* outer corner of the grid, scene units */ \
    _(float, origin_y) \
    _(float, origin_z) \
    _(float, per_cell) /* cells in a scene unit */ \
    _(float, most)     /* largest flux of a channel; surfels: largest area, squared cells */ \
    _(float, to_one)   /* a power of two that makes it 1/2..1 */ \
    _(float, offset)   /* cells along the normal */ \
    _(int, two_sided)  /* surfels block from both sides */ \
    _(int, second)     /* surfels: where the second source begins, and so on */ \
    _(int, third) \
    _(int, fourth)
#define CONSTANTS(_) \
    _(0, int, BANDS, 2)    /* 2 or 3 */ \
    _(1, int, COLOURS, 3)  /* channels */ \
    _(2, int, COUNT, 0)    /* 1: outcomes are counted */
#define BINDINGS(_) \
    _(READ, 0, vec4, lights) \
    _(UPDATE, 1, uint, sums) \
    _(UPDATE, 2, uint, outcomes)
