/* BUILD
   module f32x1: CHANNELS=1 PIXEL=f32x1 DST_KIND=WRITE
   module f32x2: CHANNELS=2 PIXEL=f32x2 DST_KIND=WRITE
   module f32x4: PIXEL=f32x4 DST_KIND=WRITE
   module f16x4: PIXEL=f16x4 DST_KIND=WRITE
   module unorm8x4: PIXEL=unorm8x4 DST_KIND=WRITE
   module to_image_f32x1: CHANNELS=1 PIXEL=f32x1 DST_KIND=IMAGE_WRITE2D
   module to_image_f32x2: CHANNELS=2 PIXEL=f32x2 DST_KIND=IMAGE_WRITE2D
   module to_image_f32x4: PIXEL=f32x4 DST_KIND=IMAGE_WRITE2D
*/
#define PARAMETERS(_) \
    _(int, width)      /* pixels */ \
    _(int, height)     /* pixels */ \
    _(int, dst_stride) /* pixels from row to row */ \
    _(float, pixel_x)  /* 1 / width */ \
    _(float, pixel_y)  /* 1 / height */
#define CONSTANTS(_) \
    _(0, int, PAIRS, 1)      /* two-texel taps on each side */ \
    _(1, int, AXIS, 0)       /* 0: along rows, 1: along columns */ \
    _(2, int, UNROLLED, 0)   /* 1: the loop over taps is unrolled */
#define BINDINGS(_) \
    _(SAMPLED2D, 0, PIXEL, src) \
    _(DST_KIND, 1, PIXEL, dst) \
    _(UNIFORM, 2, 4096, weights) /* 0: centre; 2i-1: weight of pair i, 2i: its distance in pixels */
