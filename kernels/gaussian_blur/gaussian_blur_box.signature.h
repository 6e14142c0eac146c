/* BUILD
   math: border
   modules READ IMAGE2D TEXELS: f32x1 f32x2 f32x4 f16x4_f32x4 unorm8x4_f32x4 f16x4 unorm8x4
   modules READ TEXELS: f32x4_f16x4 f32x4_unorm8x4
*/
#define PARAMETERS(_) \
    _(int, lines)      /* rows or columns of the image */ \
    _(int, src_count)  /* positions of a line of src */ \
    _(int, dst_count)  /* and of dst */ \
    _(int, shift)      /* position in src of dst's first */ \
    _(int, src_stride) /* pixels from row to row */ \
    _(int, dst_stride) \
    _(int, radius)     /* the window has 2 radius + 1 pixels */ \
    _(int, chunks)     /* of CHUNK pixels, which together are at least the window: 1..CHUNKS */
#define CONSTANTS(_) \
    _(1, int, CHUNK, 64)     /* pixels of the window whose sums are kept at a time */ \
    _(2, int, CHUNKS, 1)     /* most chunks */ \
    _(3, int, AXIS, 0)       /* 0: along rows, 1: along columns */ \
    _(4, int, BORDER, 0)     /* math/border.h; what pixels outside src are */ \
    _(5, int, COVERED, 0)    /* 1: results are divided by coverage */ \
    _(6, int, ONES, 0)       /* 1: src is taken to be 1 everywhere */ \
    _(7, int, KEEP_ALPHA, 0) /* 1: the fourth channel is copied */
#define SHAPE(_) \
    _(8, int, LANES, 16)     /* neighbouring lines times channels an invocation computes */
#define BINDINGS(_) \
    _(SRC_KIND, 0, SRC, src) \
    _(WRITE, 1, DST, dst) \
    _(UNIFORM, 2, 4, weights)   /* of a pixel of the window; of the one at each end, which is covered in part */ \
    _(READ, 3, float, coverage) /* zero border: what a line of ones becomes */
