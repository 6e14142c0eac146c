/* BUILD
   module f32x4:
*/
#define PARAMETERS(_) \
    _(int, columns) /* cells */ \
    _(int, rows)    /* cells */ \
    _(int, bins)    /* cells */
#define CONSTANTS(_) \
    _(0, int, AXIS, 0) /* 0: along rows, 1: along columns, 2: along luminance */
#define BINDINGS(_) \
    _(READ, 0, vec4, from) \
    _(WRITE, 1, vec4, to)
