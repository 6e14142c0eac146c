/* BUILD
   math: border
   module f32x1: CHANNELS=1 SRC_KIND=READ SRC=f32x1 DST=f32x1
   module f32x2: CHANNELS=2 SRC_KIND=READ SRC=f32x2 DST=f32x2
   module f32x4: SRC_KIND=READ SRC=f32x4 DST=f32x4
   module f16x4_f32x4: SRC_KIND=READ SRC=f16x4 DST=f32x4
   module unorm8x4_f32x4: SRC_KIND=READ SRC=unorm8x4 DST=f32x4
   module image_f32x1: CHANNELS=1 SRC_KIND=IMAGE2D SRC=f32x1 DST=f32x1
   module image_f32x2: CHANNELS=2 SRC_KIND=IMAGE2D SRC=f32x2 DST=f32x2
   module image_f32x4: SRC_KIND=IMAGE2D SRC=f32x4 DST=f32x4
   module image_f16x4_f32x4: SRC_KIND=IMAGE2D SRC=f16x4 DST=f32x4
   module image_unorm8x4_f32x4: SRC_KIND=IMAGE2D SRC=unorm8x4 DST=f32x4
   module texels_f32x1: CHANNELS=1 SRC_KIND=TEXELS SRC=f32x1 DST=f32x1
   module texels_f32x2: CHANNELS=2 SRC_KIND=TEXELS SRC=f32x2 DST=f32x2
   module texels_f32x4: SRC_KIND=TEXELS SRC=f32x4 DST=f32x4
   module texels_f16x4_f32x4: SRC_KIND=TEXELS SRC=f16x4 DST=f32x4
   module texels_unorm8x4_f32x4: SRC_KIND=TEXELS SRC=unorm8x4 DST=f32x4
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
