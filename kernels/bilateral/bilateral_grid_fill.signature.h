/* BUILD
   math: luminance
   module f32x1: CHANNELS=1 SRC=f32x1
   module f32x2: CHANNELS=2 SRC=f32x2
   module f32x4: SRC=f32x4
   module f16x4: SRC=f16x4
   module unorm8x4: SRC=unorm8x4
*/
#define PARAMETERS(_) \
    _(int, width)      /* pixels */ \
    _(int, height)     /* pixels */ \
    _(int, src_stride) /* pixels from row to row */ \
    _(int, columns)    /* cells */ \
    _(int, rows)       /* cells */ \
    _(int, bins)       /* cells */ \
    _(int, cell)       /* pixels of a cell along an axis */ \
    _(float, low)      /* luminance of bin 0 */ \
    _(float, per_step) /* bins for each unit of luminance */
#define BINDINGS(_) \
    _(READ, 0, SRC, src) \
    _(UPDATE, 1, vec4, grid) /* colour of the pixels of a cell, and how many they are */
