/* BUILD
   modules READ TEXELS: f32x1 f32x2 f32x4 f32x4_f16x4 f32x4_unorm8x4
*/
#define PARAMETERS(_) \
    _(int, src_width)  /* pixels */ \
    _(int, src_height) \
    _(int, dst_width) \
    _(int, dst_height) \
    _(int, src_stride) /* pixels from row to row */ \
    _(int, dst_stride) \
    _(int, first_x)    /* position in src of the first tap of dst's first pixel */ \
    _(int, first_y) \
    _(int, odd_x)      /* 1: dst begins with the second half of a coarse pixel */ \
    _(int, odd_y)
#define CONSTANTS(_) \
    _(0, int, TAPS, 3)     /* of an axis; the middle one is the pixel's own coarse pixel */ \
    _(1, int, DOUBLE_X, 1) /* 0: the axis has one pixel, and stays */ \
    _(2, int, DOUBLE_Y, 1) \
    _(3, int, COVERED, 0)  /* 1: results are divided by both coverages */
#define SHAPE(_) \
    _(8, int, LANES, CHANNELS) \
    _(9, int, BLOCK, 4)    /* neighbouring coarse pixels of an invocation */
#define BINDINGS(_) \
    _(SRC_KIND, 0, SRC, src) \
    _(WRITE, 1, DST, dst) \
    _(UNIFORM, 2, 8, weights)     /* of the first half of a coarse pixel; the second half's are their mirror image */ \
    _(READ, 3, float, coverage_x) /* zero border: what a line of ones becomes */ \
    _(READ, 4, float, coverage_y)
