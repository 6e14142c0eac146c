/* BUILD
   math: border
   modules: f32x1 f32x2 f32x4 f16x4_f32x4 f32x4_f16x4 unorm8x4_f32x4 f32x4_unorm8x4
*/
#define PARAMETERS(_) \
    _(int, width)      /* pixels */ \
    _(int, height)     /* pixels */ \
    _(int, src_stride) /* pixels from row to row */ \
    _(int, dst_stride)
#define CONSTANTS(_) \
    _(0, int, RADIUS, 1) /* taps on each side */ \
    _(1, int, AXIS, 0)   /* 0: along rows, 1: along columns */ \
    _(2, int, ALPHA, 0)  /* 1: the fourth channel is filtered; else it is copied */
#define BINDINGS(_) \
    _(READ, 0, SRC, src) \
    _(READ, 1, uint, mask) \
    _(WRITE, 2, DST, dst) \
    _(UNIFORM, 3, 4096, weights) /* of tap t; of the centre 1 */
