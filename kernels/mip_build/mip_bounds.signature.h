/* BUILD
   math: bound exact
   module f32x1: CHANNELS=1 SRC_KIND=READ SRC=f32x1 DST=f32x1 ONE=0 OUTWARD=0
   module f32x2: CHANNELS=2 SRC_KIND=READ SRC=f32x2 DST=f32x2 ONE=0 OUTWARD=0
   module f16x2: CHANNELS=2 SRC_KIND=READ SRC=f16x2 DST=f16x2 ONE=0 OUTWARD=0
   module f32x1_f32x2: CHANNELS=1 SRC_KIND=READ SRC=f32x1 DST=f32x2 ONE=1 OUTWARD=0
   module f32x1_f16x2: CHANNELS=1 SRC_KIND=READ SRC=f32x1 DST=f16x2 ONE=1 OUTWARD=1
   module texels_f32x1: CHANNELS=1 SRC_KIND=TEXELS SRC=f32x1 DST=f32x1 ONE=0 OUTWARD=0
   module texels_f32x2: CHANNELS=2 SRC_KIND=TEXELS SRC=f32x2 DST=f32x2 ONE=0 OUTWARD=0
   module texels_f16x2: CHANNELS=2 SRC_KIND=TEXELS SRC=f16x2 DST=f16x2 ONE=0 OUTWARD=0
   module texels_f32x1_f32x2: CHANNELS=1 SRC_KIND=TEXELS SRC=f32x1 DST=f32x2 ONE=1 OUTWARD=0
   module texels_f32x1_f16x2: CHANNELS=1 SRC_KIND=TEXELS SRC=f32x1 DST=f16x2 ONE=1 OUTWARD=1
   module image_f32x1: CHANNELS=1 SRC_KIND=IMAGE2D SRC=f32x1 DST=f32x1 ONE=0 OUTWARD=0
   module image_f32x2: CHANNELS=2 SRC_KIND=IMAGE2D SRC=f32x2 DST=f32x2 ONE=0 OUTWARD=0
   module image_f16x2: CHANNELS=2 SRC_KIND=IMAGE2D SRC=f16x2 DST=f16x2 ONE=0 OUTWARD=0
   module image_f32x1_f32x2: CHANNELS=1 SRC_KIND=IMAGE2D SRC=f32x1 DST=f32x2 ONE=1 OUTWARD=0
   module image_f32x1_f16x2: CHANNELS=1 SRC_KIND=IMAGE2D SRC=f32x1 DST=f16x2 ONE=1 OUTWARD=1
*/
#if CHANNELS == 1 && ONE == 0
#define RANGE float
#else
#define RANGE vec2
#endif
#define PARAMETERS(_) \
    _(int, src_x)      /* extent of the finer level */ \
    _(int, src_y) \
    _(int, dst_x)      /* extent of the level that is made */ \
    _(int, dst_y) \
    _(int, cover_rest) /* 1: the last texel covers what is left over, 0: it is cut off at the end */
#define CONSTANTS(_) \
    _(0, int, UPPER, 0)   /* one channel: 0 minimum, 1 maximum; two channels hold both */ \
    _(1, int, RATIO, 2)   /* 2 or 16 */ \
    _(2, int, TAPS_X, 2)  /* ratio 2: 3 where the last texel of a row covers three, else 2 */ \
    _(3, int, TAPS_Y, 2)
#define BINDINGS(_) \
    _(SRC_KIND, 0, SRC, src) \
    _(WRITE, 1, DST, dst)
