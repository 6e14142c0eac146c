/* BUILD
   math: sh
   module plain:
*/
#define PARAMETERS(_) \
    _(int, count)  /* directions */
#define BINDINGS(_) \
    _(READ, 0, float, directions) /* count times x, y, z; then the images of the axes under the rotation, nine floats */ \
    _(WRITE, 1, float, values)    /* count times 25 basis functions, cosine lobes, zonal lobes (1 in each band), 2 x 4 of bands 0, 1 */ \
    _(WRITE, 2, float, rotations) /* by the first 5 invocations: band l, 9 x 9 each */
