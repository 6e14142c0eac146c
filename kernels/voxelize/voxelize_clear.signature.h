/* BUILD
   module u32:
*/
#define PARAMETERS(_) \
    _(int, bricks)  /* bricks of the grid */ \
    _(int, stride)  /* invocations */
#define BINDINGS(_) \
    _(WRITE, 0, uint, counters) \
    _(WRITE, 1, uint, slots)
