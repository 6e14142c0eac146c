/* BUILD
   module f32x4: PIXEL=f32x4
   module f16x4: PIXEL=f16x4
*/
#define PARAMETERS(_) \
    _(int, width)   /* cells */ \
    _(int, height) \
    _(int, depth) \
    _(int, pixels)  /* of the volume, all quads and channels */ \
    _(int, stride)  /* invocations */ \
    _(float, weight) /* of each neighbour along an axis */
#define BINDINGS(_) \
    _(READ, 0, PIXEL, src) \
    _(WRITE, 1, PIXEL, dst)
