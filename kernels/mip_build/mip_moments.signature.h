/* BUILD
   math: mip
   module f32x2: CHANNELS=2 SRC_KIND=READ SRC=f32x2 DST=f32x2 SCALAR_MEANS=1 ONE=0
   module f16x2: CHANNELS=2 SRC_KIND=READ SRC=f16x2 DST=f16x2 SCALAR_MEANS=1 ONE=0
   module f32x1_f32x2: CHANNELS=1 SRC_KIND=READ SRC=f32x1 DST=f32x2 SCALAR_MEANS=1 ONE=1
   module f32x1_f16x2: CHANNELS=1 SRC_KIND=READ SRC=f32x1 DST=f16x2 SCALAR_MEANS=1 ONE=1
   module texels_f32x2: CHANNELS=2 SRC_KIND=TEXELS SRC=f32x2 DST=f32x2 SCALAR_MEANS=1 ONE=0
   module texels_f16x2: CHANNELS=2 SRC_KIND=TEXELS SRC=f16x2 DST=f16x2 SCALAR_MEANS=1 ONE=0
   module texels_f32x1_f32x2: CHANNELS=1 SRC_KIND=TEXELS SRC=f32x1 DST=f32x2 SCALAR_MEANS=1 ONE=1
   module texels_f32x1_f16x2: CHANNELS=1 SRC_KIND=TEXELS SRC=f32x1 DST=f16x2 SCALAR_MEANS=1 ONE=1
   module image_f32x2: CHANNELS=2 SRC_KIND=IMAGE2D SRC=f32x2 DST=f32x2 SCALAR_MEANS=1 ONE=0
   module image_f16x2: CHANNELS=2 SRC_KIND=IMAGE2D SRC=f16x2 DST=f16x2 SCALAR_MEANS=1 ONE=0
   module image_f32x1_f32x2: CHANNELS=1 SRC_KIND=IMAGE2D SRC=f32x1 DST=f32x2 SCALAR_MEANS=1 ONE=1
   module image_f32x1_f16x2: CHANNELS=1 SRC_KIND=IMAGE2D SRC=f32x1 DST=f16x2 SCALAR_MEANS=1 ONE=1
*/
#define PARAMETERS(_) \
    _(int, src_x)      /* extent of the finer level */ \
    _(int, src_y) \
    _(int, dst_x)      /* extent of the level that is made */ \
    _(int, dst_y)
#define CONSTANTS(_) \
    _(0, int, MODE_X, 1)  /* math/mip.h: copy, pair or triple */ \
    _(1, int, MODE_Y, 1)
#define BINDINGS(_) \
    _(SRC_KIND, 0, SRC, src) \
    _(WRITE, 1, DST, dst)
