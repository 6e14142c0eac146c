/* BUILD
   math: border
   module f32x1: CHANNELS=1
*/
#define PARAMETERS(_) \
    _(int, width)  /* pixels */ \
    _(int, height) /* pixels */ \
    _(int, pitch)  /* pixels from row to row of a plane */ \
    _(int, pad)    /* pixels of a plane left of column 0 */ \
    _(int, first)  /* the first of three planes that are written */
#define CONSTANTS(_) \
    _(0, int, BORDER, 0) /* math/border.h */ \
    _(1, int, INVERSE, 1) /* 1: of 1/z, 0: of z */
#define BINDINGS(_) \
    _(READ, 0, f32x1, z) \
    _(WRITE, 1, f32x1, planes)
