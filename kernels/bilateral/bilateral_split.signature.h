/* BUILD
   math: border
   module f32x1: SRC=f32x1 SRC_CHANNELS=1
   module f32x2: SRC=f32x2 SRC_CHANNELS=2
   module f32x4: SRC=f32x4 SRC_CHANNELS=4
   module f16x4: SRC=f16x4 SRC_CHANNELS=4
   module unorm8x4: SRC=unorm8x4 SRC_CHANNELS=4
*/
#define PARAMETERS(_) \
    _(int, width)      /* pixels */ \
    _(int, height)     /* pixels */ \
    _(int, src_stride) /* pixels from row to row */ \
    _(int, pitch)      /* pixels from row to row of a plane */ \
    _(int, pad)        /* pixels of a plane left of column 0 */ \
    _(int, first)      /* the first plane that is written */ \
    _(float, scale)    /* planes hold scale * src + offset */ \
    _(float, offset)
#define CONSTANTS(_) \
    _(0, int, COUNT, 1)  /* planes, at most the channels of src */ \
    _(1, int, BORDER, 0) /* math/border.h */ \
    _(2, int, MARK, 0)   /* pixels that are not finite: 0 as they are, 1 as 2^120 */
#define BINDINGS(_) \
    _(READ, 0, SRC, src) \
    _(WRITE, 1, f32x1, planes)
