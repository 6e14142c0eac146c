/* BUILD
   math: border
   module f32x1: CHANNELS=1 SRC_KIND=READ PIXEL=f32x1
   module f32x2: CHANNELS=2 SRC_KIND=READ PIXEL=f32x2
   module f32x4: SRC_KIND=READ PIXEL=f32x4
   module f16x4: SRC_KIND=READ PIXEL=f16x4
   module unorm8x4: SRC_KIND=READ PIXEL=unorm8x4
   module image_f32x1: CHANNELS=1 SRC_KIND=IMAGE2D PIXEL=f32x1
   module image_f32x2: CHANNELS=2 SRC_KIND=IMAGE2D PIXEL=f32x2
   module image_f32x4: SRC_KIND=IMAGE2D PIXEL=f32x4
   module image_f16x4: SRC_KIND=IMAGE2D PIXEL=f16x4
   module image_unorm8x4: SRC_KIND=IMAGE2D PIXEL=unorm8x4
*/
#define PARAMETERS(_) \
    _(int, width)      /* pixels */ \
    _(int, height)     /* pixels */ \
    _(int, src_stride) /* pixels from row to row */ \
    _(int, dst_stride)
#define CONSTANTS(_) \
    _(0, int, RADIUS_X, 1)   /* taps on each side along rows */ \
    _(1, int, RADIUS_Y, 1)   /* and along columns */ \
    _(2, int, BORDER, 0)     /* math/border.h */ \
    _(3, int, DIFFERENCE, 0) /* 1: x + sum w (x_t - x) */ \
    _(4, int, KEEP_ALPHA, 0) /* 1: the fourth channel is copied */ \
    _(5, int, UNROLLED, 0)   /* 1: the loop along rows is unrolled */ \
    _(6, int, SPLIT, 1)      /* 1: the inside has code of its own, without borders */
#define SHAPE(_) \
    _(8, int, LANES, 16)     /* neighbouring channels an invocation computes */
#define BINDINGS(_) \
    _(SRC_KIND, 0, PIXEL, src) \
    _(WRITE, 1, PIXEL, dst) \
    _(UNIFORM, 2, 4096, row_weights)    /* 0: centre, t: the taps at -t and t */ \
    _(UNIFORM, 3, 4096, column_weights)
