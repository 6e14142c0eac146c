/* BUILD
   module f32x4: PIXEL=f32x4
   module f16x4: PIXEL=f16x4
   module unorm8x4: PIXEL=unorm8x4
*/
#define PARAMETERS(_) \
    _(int, count)   /* voxels */ \
    _(int, stride)  /* invocations */
#define BINDINGS(_) \
    _(WRITE, 0, PIXEL, radiance)
