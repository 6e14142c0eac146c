/* BUILD
   module u32:
*/
#define SPAN 256  // bricks that an invocation counts
#define PARAMETERS(_) \
    _(int, bricks)  /* bricks of the grid */
#define BINDINGS(_) \
    _(READ, 0, uint, slots) \
    _(WRITE, 1, uint, sums)
