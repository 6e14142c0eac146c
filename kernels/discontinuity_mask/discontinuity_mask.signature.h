/* BUILD
   module depth: NORMALS=0 NORMAL=f32x4
   module f32x4: NORMALS=1 NORMAL=f32x4
   module f16x4: NORMALS=1 NORMAL=f16x4
   module unorm8x4: NORMALS=1 NORMAL=unorm8x4
*/
#define PARAMETERS(_) \
    _(int, width)            /* pixels */ \
    _(int, height)           /* pixels */ \
    _(float, depth_threshold)  /* parts of depth off the plane */ \
    _(float, normal_threshold) /* cosine */ \
    _(float, scale)            /* normals are scale * stored + offset */ \
    _(float, offset)
#define BINDINGS(_) \
    _(READ, 0, float, depth) \
    _(READ, 1, NORMAL, normals) \
    _(WRITE, 2, uint, mask)
