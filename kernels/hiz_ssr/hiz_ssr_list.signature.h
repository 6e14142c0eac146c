/* BUILD
   module u32:
*/
#define SPAN 64  // tiles that an invocation lists
#define PARAMETERS(_) \
    _(int, tiles)
#define BINDINGS(_) \
    _(READ, 0, uint, flags) \
    _(WRITE, 1, uint, tile_list)
