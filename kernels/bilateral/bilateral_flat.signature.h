/* BUILD
   math: exact range_weight
   module f32x1:
*/
#define PARAMETERS(_) \
    _(int, width)     /* pixels */ \
    _(int, height)    /* pixels */ \
    _(int, reach)     /* pixels from a pixel to its farthest tap along an axis */ \
    _(int, colour)    /* quantities of `ranges`: colours that weigh */ \
    _(int, bias)      /* added to the exponent */ \
    _(int, depth)     /* 1/z and its differences */ \
    _(int, normal)    /* x, y, z, length^2 */ \
    _(int, luminance) /* luminance, and the factor of its difference */ \
    _(float, limit)   /* -log2 of the least weight in a tile that is flat */ \
    _(float, range_factor)  /* as bilateral */ \
    _(float, normal_power) \
    _(float, depth_scale)
#define CONSTANTS(_) \
    _(0, int, COLOURS, 0)   /* quantities of colour, 0: no colour term */ \
    _(1, int, L1, 0) \
    _(2, int, BIAS, 0) \
    _(3, int, DEPTH, 0)     /* 1: plane */ \
    _(4, int, NORMAL, 0) \
    _(5, int, LUMINANCE, 0) \
    _(6, int, INSIDE, 0)    /* 1: a tile whose taps leave the image is not flat */
#define BINDINGS(_) \
    _(READ, 0, float, ranges) /* of bilateral_range */ \
    _(WRITE, 1, uint, flats)  /* a tile of 16 x 16 pixels: 1 where all weights but the one of space are surely high */
