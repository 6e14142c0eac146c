/* BUILD
   math: bound exact
   module f32x1: CHANNELS=1 SRC_KIND=READ SRC=f32x1 DST=f32x1 ONE=0 OUTWARD=0
   module f32x2: CHANNELS=2 SRC_KIND=READ SRC=f32x2 DST=f32x2 ONE=0 OUTWARD=0
   module f16x2: CHANNELS=2 SRC_KIND=READ SRC=f16x2 DST=f16x2 ONE=0 OUTWARD=0
   module f32x1_f32x2: CHANNELS=1 SRC_KIND=READ SRC=f32x1 DST=f32x2 ONE=1 OUTWARD=0
   module f32x1_f16x2: CHANNELS=1 SRC_KIND=READ SRC=f32x1 DST=f16x2 ONE=1 OUTWARD=1
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
#define PHASE_COUNT 3
#define PARAMETERS(_) \
    _(int, src_x)      /* extent of the finer level; halved, rounded up */ \
    _(int, src_y)
#define CONSTANTS(_) \
    _(0, int, UPPER, 0)   /* one channel: 0 minimum, 1 maximum; two channels hold both */
#define SHARED_MEMORY(_) \
    _(RANGE, 256, tile) \
    _(RANGE, 64, small)
#define BINDINGS(_) \
    _(SRC_KIND, 0, SRC, src) \
    _(WRITE, 1, DST, dst_a) \
    _(WRITE, 2, DST, dst_b) \
    _(WRITE, 3, DST, dst_c)
