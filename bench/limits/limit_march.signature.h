/* BUILD
   module f32x1: CHANNELS=1 KIND=READ
   module texels_f32x1: CHANNELS=1 KIND=TEXELS
*/
#define PARAMETERS(_) \
    _(int, invocations) \
    _(int, entries)  /* of the table, below 2^24 */ \
    _(int, steps)    /* at most, of an invocation */
#define BINDINGS(_) \
    _(KIND, 0, f32x1, links) \
    _(WRITE, 1, float, dst)
