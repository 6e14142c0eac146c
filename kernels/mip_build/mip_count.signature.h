/* BUILD
   module f32x1: CHANNELS=1 SRC_KIND=READ PIXEL=f32x1 BY_ROWS=0
   module f32x2: CHANNELS=2 SRC_KIND=READ PIXEL=f32x2 BY_ROWS=0
   module f32x4: SRC_KIND=READ PIXEL=f32x4 BY_ROWS=0
   module f16x2: CHANNELS=2 SRC_KIND=READ PIXEL=f16x2 BY_ROWS=0
   module f16x4: SRC_KIND=READ PIXEL=f16x4 BY_ROWS=0
   module image_f32x1: CHANNELS=1 SRC_KIND=IMAGE2D PIXEL=f32x1 BY_ROWS=1
   module image_f32x2: CHANNELS=2 SRC_KIND=IMAGE2D PIXEL=f32x2 BY_ROWS=1
   module image_f32x4: SRC_KIND=IMAGE2D PIXEL=f32x4 BY_ROWS=1
   module image_f16x2: CHANNELS=2 SRC_KIND=IMAGE2D PIXEL=f16x2 BY_ROWS=1
   module image_f16x4: SRC_KIND=IMAGE2D PIXEL=f16x4 BY_ROWS=1
   module volume_f32x1: CHANNELS=1 SRC_KIND=IMAGE3D PIXEL=f32x1 BY_ROWS=0
   module volume_f32x4: SRC_KIND=IMAGE3D PIXEL=f32x4 BY_ROWS=0
   module volume_f16x4: SRC_KIND=IMAGE3D PIXEL=f16x4 BY_ROWS=0
*/
#define PARAMETERS(_) \
    _(int, src_x)      /* extent of level 0 */ \
    _(int, src_y) \
    _(int, src_z)
#define CONSTANTS(_) \
    _(0, int, HIDDEN, 0)  /* 1: colour without opacity is cleaned, and counted as such */
#define BINDINGS(_) \
    _(SRC_KIND, 0, PIXEL, src) \
    _(UPDATE, 1, uint, counters)
