/* BUILD
   module mark: STEP=0
   module allocate: STEP=1
   module fill: STEP=2
   module average: STEP=3
   module begin: STEP=4
*/
#define PARAMETERS(_) \
    _(int, voxels)  /* of the list */ \
    _(int, level)   /* of the nodes that the step works on; the root's is 0 */ \
    _(int, depth)   /* levels below the root */ \
    _(int, stride)  /* invocations */
#if STEP == 0
#define BINDINGS(_) \
    _(READ, 0, uint, list) \
    _(UPDATE, 1, uint, children) \
    _(UPDATE, 2, uint, ends)
#elif STEP == 1
#define BINDINGS(_) \
    _(UPDATE, 0, uint, children) \
    _(WRITE, 1, vec4, values) \
    _(UPDATE, 2, uint, ends)
#elif STEP == 2
#define BINDINGS(_) \
    _(READ, 0, uint, list) \
    _(READ, 1, vec4, volume) \
    _(READ, 2, uint, children) \
    _(UPDATE, 3, vec4, values)
#elif STEP == 3
#define BINDINGS(_) \
    _(READ, 0, uint, children) \
    _(UPDATE, 1, vec4, values) \
    _(READ, 2, uint, ends)
#else
#define BINDINGS(_) \
    _(WRITE, 0, uint, children) \
    _(WRITE, 1, uint, ends)
#endif
