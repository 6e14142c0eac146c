/* BUILD
   math: launch
   module u32:
*/
#define SPAN 256  // tiles that an invocation lists; as hiz_ssr_spans has it
#define PARAMETERS(_) \
    _(int, tiles) \
    _(uint, rays)        /* invocations a tile, of the pass that traces */ \
    _(uint, pixels)      /* and of the one that resolves */ \
    _(uint, workgroup)   /* of both */ \
    _(uint, most_rays)   /* workgroups of their fixed launches */ \
    _(uint, most_pixels)
#define BINDINGS(_) \
    _(READ, 0, uint, flags) \
    _(WRITE, 1, uint, tile_list) \
    _(WRITE, 2, uint, counts) \
    _(READ, 3, uint, sums)
