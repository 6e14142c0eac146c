/* BUILD
   math: wide_int wide_sum
   module f32x4: PIXEL=f32x4
   module f16x4: PIXEL=f16x4
*/
#define PARAMETERS(_) \
    _(int, cells)      /* cells or corners */ \
    _(int, stride)     /* invocations */ \
    _(float, from_one) /* what a sum of 1 stands for */ \
    _(float, scale)    /* of what is stored */
#define CONSTANTS(_) \
    _(0, int, BANDS, 2)    /* 2 or 3 */ \
    _(1, int, COLOURS, 3)  /* channels */ \
    _(2, int, SOURCES, 1)  /* of surfels, 1..4: what stands is the one that blocks most */ \
    _(3, int, KEPT, 0)     /* 1: `kept` is one more */
#define BINDINGS(_) \
    _(READ, 0, uint, sums) \
    _(READ, 1, PIXEL, kept) \
    _(WRITE, 2, PIXEL, volume)
