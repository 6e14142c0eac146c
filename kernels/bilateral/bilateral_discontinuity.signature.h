/* BUILD
   math: border
   module f32x1: CHANNELS=1 SRC=f32x1 DST=f32x1
   module f32x2: CHANNELS=2 SRC=f32x2 DST=f32x2
   module f32x4: SRC=f32x4 DST=f32x4
   module f16x4_f32x4: SRC=f16x4 DST=f32x4
   module f32x4_f16x4: SRC=f32x4 DST=f16x4
   module unorm8x4_f32x4: SRC=unorm8x4 DST=f32x4
   module f32x4_unorm8x4: SRC=f32x4 DST=unorm8x4
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
