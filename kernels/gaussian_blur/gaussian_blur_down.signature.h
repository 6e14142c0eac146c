/* BUILD
   math: border
   modules READ IMAGE2D TEXELS: f32x1 f32x2 f32x4 f16x4_f32x4 unorm8x4_f32x4
*/
#define PARAMETERS(_) \
    _(int, src_width)  /* pixels */ \
    _(int, src_height) \
    _(int, dst_width) \
    _(int, dst_height) \
    _(int, src_stride) /* pixels from row to row */ \
    _(int, first_x)    /* position in src of the first tap of dst's first pixel */ \
    _(int, first_y)
#define CONSTANTS(_) \
    _(0, int, TAPS, 4)    /* of an axis */ \
    _(1, int, HALVE_X, 1) /* 0: the axis has one pixel, and stays */ \
    _(2, int, HALVE_Y, 1) \
    _(3, int, BORDER, 0)  /* math/border.h; what pixels outside src are */ \
    _(4, int, ONES, 0)    /* 1: src is taken to be 1 everywhere */
#define SHAPE(_) \
    _(8, int, LANES, CHANNELS) \
    _(9, int, BLOCK, 4)   /* neighbouring results of an invocation */
#define BINDINGS(_) \
    _(SRC_KIND, 0, SRC, src) \
    _(WRITE, 1, DST, dst) \
    _(UNIFORM, 2, 8, weights)
