/* BUILD
   math: border exact range_weight wide_weight
   module planes: CHANNELS=1 PLANES=READ DST=f32x1 DST_CHANNELS=0
   module f32x1: CHANNELS=1 PLANES=READ DST=f32x1 DST_CHANNELS=1
   module f32x2: CHANNELS=1 PLANES=READ DST=f32x2 DST_CHANNELS=2
   module f32x4: CHANNELS=1 PLANES=READ DST=f32x4 DST_CHANNELS=4
   module f16x4: CHANNELS=1 PLANES=READ DST=f16x4 DST_CHANNELS=4
   module unorm8x4: CHANNELS=1 PLANES=READ DST=unorm8x4 DST_CHANNELS=4
   module texels_planes: CHANNELS=1 PLANES=TEXELS DST=f32x1 DST_CHANNELS=0
   module texels_f32x1: CHANNELS=1 PLANES=TEXELS DST=f32x1 DST_CHANNELS=1
   module texels_f32x2: CHANNELS=1 PLANES=TEXELS DST=f32x2 DST_CHANNELS=2
   module texels_f32x4: CHANNELS=1 PLANES=TEXELS DST=f32x4 DST_CHANNELS=4
   module texels_f16x4: CHANNELS=1 PLANES=TEXELS DST=f16x4 DST_CHANNELS=4
   module texels_unorm8x4: CHANNELS=1 PLANES=TEXELS DST=unorm8x4 DST_CHANNELS=4
*/
#define PARAMETERS(_) \
    _(int, width)       /* pixels */ \
    _(int, height)      /* pixels */ \
    _(int, src_stride)  /* pixels from row to row */ \
    _(int, dst_stride) \
    _(int, pitch)       /* pixels from row to row of a plane */ \
    _(int, pad)         /* pixels of a plane left of column 0 */ \
    _(int, bias)        /* planes of `guides`: added to the exponent */ \
    _(int, guide)       /* colours that weigh */ \
    _(int, depth)       /* 1/z (or z) and its two derivatives */ \
    _(int, normal)      /* x, y, z */ \
    _(int, luminance)   /* luminance, and the factor of its difference */ \
    _(int, variance)    /* of the image before the pass */ \
    _(int, carried_stride) /* pixels from row to row of `variances` */ \
    _(int, carried_at)     /* its first pixel */ \
    _(int, reach)          /* FLAT 2: rows from a result of 3 to its farthest tap */ \
    _(float, range_factor)  /* log2(e) / (2 sigma_r^2) */ \
    _(float, normal_power)  /* sigma_n */ \
    _(float, depth_scale)   /* plane: sigma_z * footprint at distance 1; svgf: sigma_z */
#define CONSTANTS(_) \
    _(0, int, COLUMNS, 1)    /* taps on each side along a row */ \
    _(1, int, ROWS, 1)       /* taps on each side along a column */ \
    _(2, int, REACH, 2)      /* taps with i^2 + j^2 <= REACH count */ \
    _(3, int, STEP, 1)       /* pixels from tap to tap */ \
    _(4, int, BORDER, 0)     /* math/border.h */ \
    _(5, int, COLOURS, 1)    /* planes that are filtered, 1..4 */ \
    _(6, int, RANGE, 0)      /* 0: no colour term, 1: of what is filtered, 2: of `guide` */ \
    _(7, int, GUIDES, 0)     /* planes of `guide`, 0..4 */ \
    _(8, int, L1, 0)         /* 1: colour distance is the sum of absolute differences */ \
    _(9, int, BIAS, 0) \
    _(10, int, DEPTH, 0)     /* 0: none, 1: plane, 2: svgf */ \
    _(11, int, NORMAL, 0) \
    _(12, int, LUMINANCE, 0) \
    _(13, int, CARRY, 0)     /* 1: the variance of the result is computed too */ \
    _(14, int, ADAPTIVE, 0)  /* taps beyond this one are pairs of pixels, averaged; 0: none */ \
    _(15, int, FLAT, 0)      /* of tiles of 16 x 16: 0: all; 1: those not in `flats`; 2: rows that 3 reads; 3: those in `flats` */
#define SHAPE(_) \
    _(16, int, LANES, 16)    /* neighbouring pixels an invocation computes */ \
    _(17, int, BLOCK, 1)     /* results an invocation computes along a column, STEP apart */
#define BINDINGS(_) \
    _(PLANES, 0, f32x1, planes) /* COLOURS planes, one below the other */ \
    _(PLANES, 1, f32x1, guides) \
    _(READ, 2, DST, src)        /* the image before it was split */ \
    _(WRITE, 3, DST, dst)       /* pixels, or planes like `planes` */ \
    _(WRITE, 4, f32x1, variances) \
    _(UNIFORM, 5, 4096, spatial) /* log2 of the spatial weight of tap i */ \
    _(READ, 6, uint, flats) /* of bilateral_flat */
