/* BUILD
   math: border
   module f32x4: SRC=f32x4
   module f16x4: SRC=f16x4
   module unorm8x4: SRC=unorm8x4
*/
#define PARAMETERS(_) \
    _(int, width)      /* pixels */ \
    _(int, height)     /* pixels */ \
    _(int, src_stride) /* pixels from row to row */ \
    _(int, pitch)      /* pixels from row to row of `packed` */ \
    _(int, pad)        /* pixels of `packed` left of column 0 */
#define CONSTANTS(_) \
    _(0, int, BORDER, 0) /* math/border.h */ \
    _(1, int, GUIDE, 0)  /* 1: a guide, which becomes NaN where `colours` is marked */
#define BINDINGS(_) \
    _(READ, 0, SRC, src) \
    _(READ, 1, f32x4, colours) /* src as this part packed it */ \
    _(WRITE, 2, f32x4, packed)
