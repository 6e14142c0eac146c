/* BUILD
   module u32:
*/
#define PARAMETERS(_) \
    _(int, width)    /* cells along x, y, z */ \
    _(int, height) \
    _(int, depth) \
    _(int, run)      /* neighbouring cells that share a flag */ \
    _(int, at)       /* word of state that the six bounds begin at */
#define BINDINGS(_) \
    _(READ, 0, uint, reached) \
    _(UPDATE, 1, uint, state)
