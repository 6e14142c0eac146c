/* BUILD
   module f32x4: PIXEL=f32x4
   module f16x4: PIXEL=f16x4
*/
#define PARAMETERS(_) \
    _(int, width)    /* cells along x, y, z */ \
    _(int, height) \
    _(int, depth) \
    _(int, run)      /* neighbouring cells that share a flag */ \
    _(int, volumes)  /* of four coefficients, of all channels */ \
    _(int, quads)    /* of them a channel's */
#define BINDINGS(_) \
    _(READ, 0, PIXEL, injected) \
    _(WRITE, 1, uint, reached) \
    _(WRITE, 2, uint, reaches)  /* what the first step writes its flags to: none */ \
    _(UPDATE, 3, uint, state)
