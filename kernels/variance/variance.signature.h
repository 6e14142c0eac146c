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
    _(int, src_stride) /* pixels from row to row */
#define CONSTANTS(_) \
    _(0, int, RADIUS, 3) /* pixels on each side */
#define BINDINGS(_) \
    _(READ, 0, SRC, src) \
    _(WRITE, 1, float, variances)
