/* BUILD
   module f32x1: CHANNELS=1 PIXEL=f32x1
   module f32x4: PIXEL=f32x4
   module f16x4: PIXEL=f16x4
*/
#define PARAMETERS(_) \
    _(int, width)      /* pixels */ \
    _(int, height)     /* pixels */ \
    _(int, src_stride) /* pixels from row to row */ \
    _(int, dst_stride) \
    _(float, k)        /* deviations that are let through */
#define CONSTANTS(_) \
    _(0, int, RADIUS, 2)  /* pixels on each side, 1..3 */ \
    _(1, int, MEDIAN, 0)  /* 0: mean and standard deviation, 1: median and MAD */ \
    _(2, int, COUNTED, 0) /* 1: counters */
#define BINDINGS(_) \
    _(READ, 0, PIXEL, src) \
    _(WRITE, 1, PIXEL, dst) \
    _(UPDATE, 2, uint, counters)
