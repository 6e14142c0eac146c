/* BUILD
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
    _(int, counter)    /* the counter that is added to */ \
    _(float, scale)    /* rule 2: normals are scale * src + offset */ \
    _(float, offset)
#define CONSTANTS(_) \
    _(0, int, RULE, 0) /* counted: 0 not finite, 1 no depth of a surface, 2 no normal */
#define BINDINGS(_) \
    _(READ, 0, SRC, src) \
    _(UPDATE, 1, uint, counters)
