/* BUILD
   module f32x4: KIND=READ PIXEL=f32x4 SAMPLED=0
   module f16x4: KIND=READ PIXEL=f16x4 SAMPLED=0
   module unorm8x4: KIND=READ PIXEL=unorm8x4 SAMPLED=0
   module texels_f32x4: KIND=TEXELS PIXEL=f32x4 SAMPLED=0
   module texels_f16x4: KIND=TEXELS PIXEL=f16x4 SAMPLED=0
   module texels_unorm8x4: KIND=TEXELS PIXEL=unorm8x4 SAMPLED=0
   module sampled: KIND=SAMPLED3D PIXEL=f32x4 SAMPLED=1
*/
#define PARAMETERS(_) \
    _(int, width)    /* invocations in a row, and rows */ \
    _(int, height) \
    _(int, side)     /* voxels along each axis */ \
    _(int, looks)    /* an invocation */ \
    _(float, step_x) /* voxels from look-up to look-up */ \
    _(float, step_y) \
    _(float, step_z)
#define BINDINGS(_) \
    _(KIND, 0, PIXEL, volume) \
    _(WRITE, 1, vec4, dst)
