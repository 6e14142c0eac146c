/* BUILD
   module u32:
*/
#define SPAN 256  // tiles that an invocation counts
#define PARAMETERS(_) \
    _(int, tiles)
#define BINDINGS(_) \
    _(READ, 0, uint, flags) \
    _(WRITE, 1, uint, sums)
