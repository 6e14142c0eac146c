/* BUILD
   math: vector octahedral octahedral_map
   module visible_f32: KIND=READ LIGHT=f32x4 MOMENTS=f32x2 VISIBILITY=1 PLACED=0 COUNT=0
   module visible_f16: KIND=READ LIGHT=f16x4 MOMENTS=f16x2 VISIBILITY=1 PLACED=0 COUNT=0
   module texels_visible_f32: KIND=TEXELS LIGHT=f32x4 MOMENTS=f32x2 VISIBILITY=1 PLACED=0 COUNT=0
   module texels_visible_f16: KIND=TEXELS LIGHT=f16x4 MOMENTS=f16x2 VISIBILITY=1 PLACED=0 COUNT=0
   module count_visible_f32: KIND=READ LIGHT=f32x4 MOMENTS=f32x2 VISIBILITY=1 PLACED=0 COUNT=1
   module count_visible_f16: KIND=READ LIGHT=f16x4 MOMENTS=f16x2 VISIBILITY=1 PLACED=0 COUNT=1
   module visible_placed_f32: KIND=READ LIGHT=f32x4 MOMENTS=f32x2 VISIBILITY=1 PLACED=1 COUNT=0
   module visible_placed_f16: KIND=READ LIGHT=f16x4 MOMENTS=f16x2 VISIBILITY=1 PLACED=1 COUNT=0
   module texels_visible_placed_f32: KIND=TEXELS LIGHT=f32x4 MOMENTS=f32x2 VISIBILITY=1 PLACED=1 COUNT=0
   module texels_visible_placed_f16: KIND=TEXELS LIGHT=f16x4 MOMENTS=f16x2 VISIBILITY=1 PLACED=1 COUNT=0
   module count_visible_placed_f32: KIND=READ LIGHT=f32x4 MOMENTS=f32x2 VISIBILITY=1 PLACED=1 COUNT=1
   module count_visible_placed_f16: KIND=READ LIGHT=f16x4 MOMENTS=f16x2 VISIBILITY=1 PLACED=1 COUNT=1
   module plain_f32: KIND=READ LIGHT=f32x4 MOMENTS=f32x2 VISIBILITY=0 PLACED=0 COUNT=0
   module plain_f16: KIND=READ LIGHT=f16x4 MOMENTS=f16x2 VISIBILITY=0 PLACED=0 COUNT=0
   module texels_plain_f32: KIND=TEXELS LIGHT=f32x4 MOMENTS=f32x2 VISIBILITY=0 PLACED=0 COUNT=0
   module texels_plain_f16: KIND=TEXELS LIGHT=f16x4 MOMENTS=f16x2 VISIBILITY=0 PLACED=0 COUNT=0
   module count_plain_f32: KIND=READ LIGHT=f32x4 MOMENTS=f32x2 VISIBILITY=0 PLACED=0 COUNT=1
   module count_plain_f16: KIND=READ LIGHT=f16x4 MOMENTS=f16x2 VISIBILITY=0 PLACED=0 COUNT=1
   module plain_placed_f32: KIND=READ LIGHT=f32x4 MOMENTS=f32x2 VISIBILITY=0 PLACED=1 COUNT=0
   module plain_placed_f16: KIND=READ LIGHT=f16x4 MOMENTS=f16x2 VISIBILITY=0 PLACED=1 COUNT=0
   module texels_plain_placed_f32: KIND=TEXELS LIGHT=f32x4 MOMENTS=f32x2 VISIBILITY=0 PLACED=1 COUNT=0
   module texels_plain_placed_f16: KIND=TEXELS LIGHT=f16x4 MOMENTS=f16x2 VISIBILITY=0 PLACED=1 COUNT=0
   module count_plain_placed_f32: KIND=READ LIGHT=f32x4 MOMENTS=f32x2 VISIBILITY=0 PLACED=1 COUNT=1
   module count_plain_placed_f16: KIND=READ LIGHT=f16x4 MOMENTS=f16x2 VISIBILITY=0 PLACED=1 COUNT=1
*/
#define PARAMETERS(_) \
    _(int, width)     /* receivers in a row, and rows of them */ \
    _(int, height) \
    _(int, count_x)   /* probes along each axis */ \
    _(int, count_y) \
    _(int, count_z) \
    _(float, origin_x)   /* of the first probe, scene units */ \
    _(float, origin_y) \
    _(float, origin_z) \
    _(float, spacing_x)  /* scene units */ \
    _(float, spacing_y) \
    _(float, spacing_z) \
    _(float, per_unit)   /* unit lengths, which moments count, in a scene unit */ \
    _(float, normal_bias)    /* probes look at a point so far above the surface, scene units */ \
    _(int, light_size)   /* of the maps, without their border */ \
    _(int, moments_size) \
    _(float, footprint)  /* least standard deviation of a distance, in it */ \
    _(float, least)      /* of visibility */ \
    _(float, least_facing)
#define CONSTANTS(_) \
    _(0, int, FACING, 2)   /* 0: all probes alike; 1: the cosine; 2: smooth */ \
    _(1, int, SHARPEN, 3)  /* power of the visibility */ \
    _(2, int, DARK, 0)     /* receivers that no probe sees: 0 as without visibility, 1 dark */
#if VISIBILITY
#define MOMENTS_BINDING(_) _(KIND, 3, MOMENTS, moments)
#else
#define MOMENTS_BINDING(_)
#endif
#if PLACED
#define PLACES_BINDING(_) _(READ, 4, vec4, positions)
#else
#define PLACES_BINDING(_)
#endif
#if COUNT
#define COUNT_BINDING(_) _(UPDATE, 5, uint, counters)
#else
#define COUNT_BINDING(_)
#endif
#define BINDINGS(_) \
    _(READ, 0, vec4, receivers) \
    _(WRITE, 1, vec4, irradiance) \
    _(KIND, 2, LIGHT, light) \
    MOMENTS_BINDING(_) \
    PLACES_BINDING(_) \
    COUNT_BINDING(_)
