/* BUILD
   math: octahedral direction_bits small_float arc vector
   module radiance_f32x4: QUANTITY=0 STORED=f32x4 PAIRS=0 PACKED=0
   module radiance_f16x4: QUANTITY=0 STORED=f16x4 PAIRS=0 PACKED=0
   module radiance_r11g11b10: QUANTITY=0 STORED=uint PAIRS=0 PACKED=1
   module distance_f32: QUANTITY=1 STORED=float PAIRS=0 PACKED=0
   module distance_f16: QUANTITY=1 STORED=uint PAIRS=1 PACKED=0
   module normal_snorm8: QUANTITY=2 STORED=uint PAIRS=1 PACKED=0
   module normal_snorm16: QUANTITY=2 STORED=uint PAIRS=0 PACKED=0
*/
#define PARAMETERS(_) \
    _(int, size)      /* texels along a side of a map */ \
    _(int, texels)    /* of all maps */ \
    _(int, width)     /* of an image; of a cube's face */ \
    _(int, height) \
    _(int, samples)   /* radiance from images: directions along each axis of a texel */ \
    _(int, planar)    /* distance from cubes: 1 depth along the face's axis, 0 radial */ \
    _(int, stride)    /* invocations */ \
    _(float, per_unit) /* f16: 1 / what 1 stands for */
#define CONSTANTS(_) \
    _(0, int, SOURCE, 0)  /* 0 one value a texel, 1 equirect images, 2 cubes */
#if QUANTITY == 1
#define GIVEN float
#else
#define GIVEN vec4
#endif
#define BINDINGS(_) \
    _(READ, 0, GIVEN, source) \
    _(WRITE, 1, STORED, map)
