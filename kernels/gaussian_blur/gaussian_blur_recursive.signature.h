/* BUILD
   math: border
   modules READ IMAGE2D TEXELS: f32x1 f32x2 f32x4 f16x4_f32x4 unorm8x4_f32x4
   modules READ TEXELS: f32x4_f16x4 f32x4_unorm8x4
*/
#define PARAMETERS(_) \
    _(int, lines)        /* rows or columns of the image */ \
    _(int, count)        /* pixels of a line */ \
    _(int, image_stride) /* pixels from row to row of the image that the pass reads or writes */ \
    _(int, kept_stride)  /* between the directions: pixels from one position of a line to the next */ \
    _(int, kept_group)   /* and from one invocation's lines to the next's */ \
    _(int, stored)       /* positions of a line that are kept: count, or more where the image is mirrored */ \
    _(int, period)       /* after which the image repeats (wrap, mirror) */ \
    _(int, warm)         /* positions that the filter runs over before the first result (wrap, mirror) */
#define CONSTANTS(_) \
    _(0, int, ORDER, 5)      /* poles of a direction: 3, 4, 5 */ \
    _(1, int, ZEROS, 0)      /* 1: zeros instead of poles, for small sigma */ \
    _(2, int, AXIS, 0)       /* 0: along rows, 1: along columns */ \
    _(3, int, BACKWARD, 0)   /* 1: from the kept lines to the image */ \
    _(4, int, BORDER, 0)     /* math/border.h */ \
    _(5, int, CLOSED, 0)     /* 1: the state is put through the matrix before the first result */ \
    _(6, int, ONES, 0)       /* 1: the image is taken to be 1 everywhere */ \
    _(7, int, KEEP_ALPHA, 0) /* 1: the fourth channel is copied */
#define SHAPE(_) \
    _(8, int, LANES, 16)     /* neighbouring lines times channels an invocation computes */
#define BINDINGS(_) \
    _(SRC_KIND, 0, SRC, src) \
    _(WRITE, 1, DST, dst) \
    _(UNIFORM, 2, 64, coefficients) /* 0: real pole; 1, 4: pairs; 8: the matrix, 5x5 */ \
    _(READ, 3, float, coverage)     /* zero border: what a line of ones becomes */
