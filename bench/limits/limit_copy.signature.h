/* BUILD
   module f32x1: CHANNELS=1 SRC_KIND=READ PIXEL=f32x1
   module f32x2: CHANNELS=2 SRC_KIND=READ PIXEL=f32x2
   module f32x4: SRC_KIND=READ PIXEL=f32x4
   module texels_f32x1: CHANNELS=1 SRC_KIND=TEXELS PIXEL=f32x1
   module texels_f32x2: CHANNELS=2 SRC_KIND=TEXELS PIXEL=f32x2
   module texels_f32x4: SRC_KIND=TEXELS PIXEL=f32x4
*/
#define PARAMETERS(_) \
    _(int, width)  /* pixels, and from row to row */ \
    _(int, height)
#define SHAPE(_) \
    _(8, int, LANES, 16) \
    _(9, int, BLOCK, 1)    /* pieces of LANES an invocation moves */
#define BINDINGS(_) \
    _(SRC_KIND, 0, PIXEL, src) \
    _(WRITE, 1, PIXEL, dst)
