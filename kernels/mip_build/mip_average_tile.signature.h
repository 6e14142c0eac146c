/* BUILD
   math: mip opacity exact stored
   module f32x1: CHANNELS=1 SRC_KIND=READ PIXEL=f32x1 BY_ROWS=0 STORAGE=0
   module f32x4: SRC_KIND=READ PIXEL=f32x4 BY_ROWS=0 STORAGE=0
   module f16x4: SRC_KIND=READ PIXEL=f16x4 BY_ROWS=0 STORAGE=1
   module unorm8x4: SRC_KIND=READ PIXEL=unorm8x4 BY_ROWS=0 STORAGE=2
   module image_f32x1: CHANNELS=1 SRC_KIND=IMAGE2D PIXEL=f32x1 BY_ROWS=1 STORAGE=0
   module image_f32x4: SRC_KIND=IMAGE2D PIXEL=f32x4 BY_ROWS=1 STORAGE=0
   module image_f16x4: SRC_KIND=IMAGE2D PIXEL=f16x4 BY_ROWS=1 STORAGE=1
   module image_unorm8x4: SRC_KIND=IMAGE2D PIXEL=unorm8x4 BY_ROWS=1 STORAGE=3
   module volume_f32x1: CHANNELS=1 SRC_KIND=IMAGE3D PIXEL=f32x1 BY_ROWS=0 STORAGE=0
   module volume_f32x4: SRC_KIND=IMAGE3D PIXEL=f32x4 BY_ROWS=0 STORAGE=0
   module volume_f16x4: SRC_KIND=IMAGE3D PIXEL=f16x4 BY_ROWS=0 STORAGE=1
   module volume_unorm8x4: SRC_KIND=IMAGE3D PIXEL=unorm8x4 BY_ROWS=0 STORAGE=3
*/
#define PHASE_COUNT 3
#define PARAMETERS(_) \
    _(int, src_x)      /* extent of the finer level; halved, each step is even or 1 */ \
    _(int, src_y) \
    _(int, src_z) \
    _(int, clean)      /* 1: colour that no opacity goes with may be NaN or infinite (level 0) */
#define CONSTANTS(_) \
    _(0, int, TILE_X, 8)  /* the workgroup: 8 x 8 x 8, or 16 x 16 x 1 for images */ \
    _(1, int, TILE_Y, 8) \
    _(2, int, TILE_Z, 8)
#define SHARED_MEMORY(_) \
    _(pixel, 512, tile) \
    _(pixel, 64, small)
#define BINDINGS(_) \
    _(SRC_KIND, 0, PIXEL, src) \
    _(WRITE, 1, PIXEL, dst_a) \
    _(WRITE, 2, PIXEL, dst_b) \
    _(WRITE, 3, PIXEL, dst_c)
