/* BUILD
   module f32: KIND=READ LIGHT=f32x4 MOMENTS=f32x2
   module f16: KIND=READ LIGHT=f16x4 MOMENTS=f16x2
   module texels_f32: KIND=TEXELS LIGHT=f32x4 MOMENTS=f32x2
   module texels_f16: KIND=TEXELS LIGHT=f16x4 MOMENTS=f16x2
*/
#define PARAMETERS(_) \
    _(int, width)    /* receivers in a row, and rows */ \
    _(int, height) \
    _(int, count_x)  /* probes along each axis */ \
    _(int, count_y) \
    _(int, count_z) \
    _(int, light_size)    /* of the maps, without their border */ \
    _(int, moments_size)
#define CONSTANTS(_) \
    _(0, int, CORNERS, 1)  /* texels of a look-up: the nearest, or 4 */
#define BINDINGS(_) \
    _(READ, 0, vec4, receivers) \
    _(WRITE, 1, vec4, dst) \
    _(KIND, 2, LIGHT, light) \
    _(KIND, 3, MOMENTS, moments)
