/* BUILD
   module f32x4:
*/
#define PARAMETERS(_) \
    _(int, width)   /* invocations */ \
    _(int, rounds)  /* of 64 multiply-adds a lane */ \
    _(float, scale) /* just below 1 */ \
    _(float, shift)
#define SHAPE(_) \
    _(8, int, LANES, 16)
#define BINDINGS(_) \
    _(WRITE, 0, f32x4, dst)
