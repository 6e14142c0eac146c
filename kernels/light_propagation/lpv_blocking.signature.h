/* BUILD
   module f32x4: PIXEL=f32x4
   module f16x4: PIXEL=f16x4
*/
#define PARAMETERS(_) \
    _(int, width)    /* corners along x, y, z */ \
    _(int, height) \
    _(int, depth) \
    _(int, pitch)    /* values from row to row, slice to slice, plane to plane */ \
    _(int, slice) \
    _(int, plane)
#define CONSTANTS(_) \
    _(0, int, CELLS, 0)  /* 1: pixels of four */
#define BINDINGS(_) \
    _(READ, 0, PIXEL, geometry) \
    _(WRITE, 1, float, planes)
