/* BUILD
   math: mip opacity exact stored
   module f32x4: SRC_KIND=READ PIXEL=f32x4 LINEAR=1 STORAGE=0
   module f16x4: SRC_KIND=READ PIXEL=f16x4 LINEAR=1 STORAGE=1
   module unorm8x4: SRC_KIND=READ PIXEL=unorm8x4 LINEAR=1 STORAGE=2
   module texels_f32x4: SRC_KIND=TEXELS PIXEL=f32x4 LINEAR=1 STORAGE=0
   module texels_f16x4: SRC_KIND=TEXELS PIXEL=f16x4 LINEAR=1 STORAGE=1
   module texels_unorm8x4: SRC_KIND=TEXELS PIXEL=unorm8x4 LINEAR=1 STORAGE=3
   module image_f32x4: SRC_KIND=IMAGE2D PIXEL=f32x4 LINEAR=0 BY_ROWS=1 STORAGE=0
   module image_f16x4: SRC_KIND=IMAGE2D PIXEL=f16x4 LINEAR=0 BY_ROWS=1 STORAGE=1
   module image_unorm8x4: SRC_KIND=IMAGE2D PIXEL=unorm8x4 LINEAR=0 BY_ROWS=1 STORAGE=3
   module volume_f32x4: SRC_KIND=IMAGE3D PIXEL=f32x4 LINEAR=0 BY_ROWS=0 STORAGE=0
   module volume_f16x4: SRC_KIND=IMAGE3D PIXEL=f16x4 LINEAR=0 BY_ROWS=0 STORAGE=1
   module volume_unorm8x4: SRC_KIND=IMAGE3D PIXEL=unorm8x4 LINEAR=0 BY_ROWS=0 STORAGE=3
*/
#define PARAMETERS(_) \
    _(int, src_x)      /* extent of the finer level */ \
    _(int, src_y) \
    _(int, src_z) \
    _(int, dst_x)      /* extent of the level that is made */ \
    _(int, dst_y) \
    _(int, dst_z) \
    _(int, axis)       /* the volume's direction: 0 x, 1 y, 2 z */ \
    _(int, backward)   /* 0: seen by who looks along +axis, 1: along -axis */ \
    _(int, clean)      /* 1: colour that no opacity goes with may be NaN or infinite (level 0) */
#define CONSTANTS(_) \
    _(0, int, MODE_ALONG, 1)  /* math/mip.h: copy, pair or triple; along the axis */ \
    _(1, int, MODE_U, 1)      /* the other two axes, in the order x, y, z */ \
    _(2, int, MODE_V, 1)
#define SHAPE(_) \
    _(8, int, SPLIT, 1)  /* 1: a result that is not finite is taken again, cleaned; 0: each voxel is cleaned as it is read */
#define BINDINGS(_) \
    _(SRC_KIND, 0, PIXEL, src) \
    _(WRITE, 1, PIXEL, dst)
