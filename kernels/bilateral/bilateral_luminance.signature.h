/* BUILD
   math: border
   module f32x1: CHANNELS=1
*/
#define PARAMETERS(_) \
    _(int, width)     /* pixels */ \
    _(int, height)    /* pixels */ \
    _(int, pitch)     /* pixels from row to row of a plane */ \
    _(int, pad)       /* pixels of a plane left of column 0 */ \
    _(int, first)     /* the first of two planes that are written */ \
    _(int, variance)  /* the plane of `variances` */ \
    _(float, sigma)   /* sigma_l */ \
    _(float, target)  /* variance below which nothing weighs */ \
    _(float, epsilon) /* of luminance: the least difference that counts */
#define CONSTANTS(_) \
    _(0, int, COLOURS, 1) /* planes of `colours`: 1, 2 (their mean), or red, green, blue */ \
    _(1, int, BORDER, 0)  /* math/border.h */
#define BINDINGS(_) \
    _(READ, 0, f32x1, colours) \
    _(READ, 1, f32x1, variances) \
    _(WRITE, 2, f32x1, planes)
