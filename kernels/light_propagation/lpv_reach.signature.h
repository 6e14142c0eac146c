/* BUILD
   module plain: CHANNELS=1
*/
#define PARAMETERS(_) \
    _(int, width)    /* cells along x, y, z */ \
    _(int, height) \
    _(int, depth) \
    _(int, pitch)    /* values from row to row, slice to slice, plane to plane */ \
    _(int, slice) \
    _(int, plane) \
    _(int, planes)       /* of all channels */ \
    _(int, coefficients) /* planes of a channel */
#define CONSTANTS(_) \
    _(0, int, CELLS, 0)  /* 1: pixels of four, a cell each; coefficients then counts their values */
#define SHAPE(_) \
    _(8, int, LANES, 16)
#define BINDINGS(_) \
    _(READ, 0, f32x1, travelling) \
    _(WRITE, 1, uint, reached) \
    _(UPDATE, 2, uint, state)
