/* BUILD
   module f32x1: CHANNELS=1
*/
#define PARAMETERS(_) \
    _(int, pitch)  /* pixels from row to row of a plane */ \
    _(int, height) /* pixels */ \
    _(int, first)  /* the plane that is marked */
#define CONSTANTS(_) \
    _(0, int, BIAS, 0) /* 0: NaN where src is marked, else nothing is written; 1: -1e30 there, else 0 */
#define BINDINGS(_) \
    _(READ, 0, float, colours) /* the first plane is looked at */ \
    _(UPDATE, 1, float, planes)
