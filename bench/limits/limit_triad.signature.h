/* BUILD
   module f32x4: SRC_KIND=READ PIXEL=f32x4
   module texels_f32x4: SRC_KIND=TEXELS PIXEL=f32x4
*/
#define PARAMETERS(_) \
    _(int, width)  /* pixels, and from row to row; a multiple of the lanes */ \
    _(int, height)
#define SHAPE(_) \
    _(8, int, LANES, 16)
#define BINDINGS(_) \
    _(SRC_KIND, 0, PIXEL, b) \
    _(SRC_KIND, 1, PIXEL, c) \
    _(WRITE, 2, PIXEL, a)
