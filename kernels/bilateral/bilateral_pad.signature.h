/* BUILD
   math: border
   module f32x1: CHANNELS=1
*/
#define PARAMETERS(_) \
    _(int, width)  /* pixels */ \
    _(int, height) /* pixels */ \
    _(int, pitch)  /* pixels from row to row of a plane */ \
    _(int, pad)    /* pixels of a plane left of column 0 */ \
    _(int, first)  /* the first plane that is padded */ \
    _(int, count)  /* planes */
#define CONSTANTS(_) \
    _(0, int, BORDER, 0) /* math/border.h */
#define BINDINGS(_) \
    _(UPDATE, 0, float, planes)
