/* BUILD
   math: border exact range_weight
   module f32x4: DST=f32x4
   module f16x4: DST=f16x4
   module unorm8x4: DST=unorm8x4
*/
#define PARAMETERS(_) \
    _(int, width)      /* pixels */ \
    _(int, height)     /* pixels */ \
    _(int, src_stride) /* pixels from row to row */ \
    _(int, dst_stride) \
    _(int, pitch)      /* pixels from row to row of what is packed */ \
    _(int, pad)        /* its pixels left of column 0 */ \
    _(float, range_factor) /* log2(e) / (2 sigma_r^2) */
#define CONSTANTS(_) \
    _(0, int, RADIUS, 1)  /* taps on each side */ \
    _(1, int, REACH, 2)   /* taps with i^2 + j^2 <= REACH count */ \
    _(2, int, BORDER, 0)  /* math/border.h, but zero */ \
    _(3, int, COLOURS, 3) /* channels that are filtered: 3, or 4 */ \
    _(4, int, RANGE, 1)   /* 1: the colours weigh themselves, 2: `guides` */ \
    _(5, int, L1, 0)      /* 1: colour distance is the sum of absolute differences */ \
    _(6, int, FLAT, 0)    /* 1: tiles of 16 x 16 in `flats` are left out */
#define SHAPE(_) \
    _(8, int, ACROSS, 2)  /* results an invocation computes along a row */ \
    _(9, int, DOWN, 4)    /* and along a column */
#define BINDINGS(_) \
    _(TEXELS, 0, f32x4, colours) \
    _(TEXELS, 1, f32x4, guides) \
    _(READ, 2, DST, src)  /* the image before it was packed */ \
    _(WRITE, 3, DST, dst) \
    _(UNIFORM, 4, 4096, spatial) /* log2 of the spatial weight of tap i */ \
    _(READ, 5, uint, flats) /* of bilateral_flat */
