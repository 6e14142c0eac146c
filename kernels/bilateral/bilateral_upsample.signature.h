/* BUILD
   math: exact range_weight
   module f32x1: CHANNELS=1 PIXEL=f32x1 NORMALS=0
   module f32x4: PIXEL=f32x4 NORMALS=0
   module f16x4: PIXEL=f16x4 NORMALS=0
   module normal_f32x1: CHANNELS=1 PIXEL=f32x1 NORMALS=1
   module normal_f32x4: PIXEL=f32x4 NORMALS=1
   module normal_f16x4: PIXEL=f16x4 NORMALS=1
*/
#define PARAMETERS(_) \
    _(int, width)          /* pixels of dst */ \
    _(int, height)         /* pixels of dst */ \
    _(int, low_width)      /* pixels of src */ \
    _(int, low_height)     /* pixels of src */ \
    _(float, depth_scale)  /* sigma_depth * footprint at distance 1 */ \
    _(float, normal_power) \
    _(float, least)        /* sum of weights below which the nearest depth is taken */
#define CONSTANTS(_) \
    _(0, int, RATIO, 2) \
    _(1, int, NEAREST, 0) /* 1: always the tap of nearest depth */
#define BINDINGS(_) \
    _(READ, 0, PIXEL, src) \
    _(READ, 1, float, depth_low) \
    _(READ, 2, float, depth) \
    _(READ, 3, f32x4, normals_low) \
    _(READ, 4, f32x4, normals) \
    _(WRITE, 5, PIXEL, dst)
