/* BUILD
   math: border
   modules READ IMAGE2D IMAGE_READ2D TEXELS: f32x1 f32x2 f32x4 f16x4 f16x4_f32x4 unorm8x4 unorm8x4_f32x4
   modules READ TEXELS: f32x4_f16x4 f32x4_unorm8x4
*/
#define PARAMETERS(_) \
    _(int, width)      /* pixels */ \
    _(int, height)     /* pixels */ \
    _(int, src_stride) /* pixels from row to row */ \
    _(int, dst_stride) \
    _(int, radius)     /* taps on each side */
#define CONSTANTS(_) \
    _(0, int, RADIUS, 1)     /* the same where the loop is unrolled */ \
    _(1, int, AXIS, 0)       /* 0: along rows, 1: along columns */ \
    _(2, int, BORDER, 0)     /* math/border.h */ \
    _(3, int, DIFFERENCE, 0) /* 1: x + sum w (x_t - x) */ \
    _(4, int, KEEP_ALPHA, 0) /* 1: the fourth channel is copied */ \
    _(5, int, UNROLLED, 0)   /* 1: the loop over taps is unrolled */ \
    _(6, int, SPLIT, 1)      /* 1: the inside has code of its own, without borders */
#define SHAPE(_) \
    _(8, int, LANES, 16)     /* neighbouring channels an invocation computes */ \
    _(9, int, BLOCK, 1)      /* results an invocation computes along the axis */
#define BINDINGS(_) \
    _(SRC_KIND, 0, SRC, src) \
    _(WRITE, 1, DST, dst) \
    _(UNIFORM, 2, 4096, weights) /* 0: centre, t: the taps at -t and t */
