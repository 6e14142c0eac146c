/* BUILD
   module f32x1:
*/
#define PARAMETERS(_) \
    _(int, width)  /* pixels */ \
    _(int, height) /* pixels */ \
    _(int, pitch)  /* pixels from row to row of a plane */ \
    _(int, pad)    /* pixels of a plane left of column 0 */ \
    _(int, plane)  /* the first plane that is looked at */ \
    _(int, first)  /* the first quantity that is written */
#define CONSTANTS(_) \
    _(0, int, KIND, 0) /* quantities: 0: planes; 1: 1/z and its differences along rows and columns; 2: normals x, y, z, length^2 */
#define BINDINGS(_) \
    _(READ, 0, float, planes) \
    _(WRITE, 1, float, ranges) /* quantity by quantity, tile row by tile row: width least values, width greatest */
