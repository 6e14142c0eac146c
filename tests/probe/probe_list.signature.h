/* BUILD
   math: launch
   module make: CHANNELS=1 MAKE=1
   module walk: CHANNELS=1 MAKE=0
*/
#if MAKE
#define PARAMETERS(_) \
    _(int, items) \
    _(uint, workgroup)  /* of the pass that walks */ \
    _(uint, most)       /* its fixed launch, workgroups */
#define BINDINGS(_) \
    _(READ, 0, uint, marked) \
    _(WRITE, 1, uint, list) \
    _(WRITE, 2, uint, counts)
#else
#define PARAMETERS(_) \
    _(int, stride)      /* invocations of the fixed launch */ \
    _(int, items)
#define BINDINGS(_) \
    _(READ, 0, uint, list) \
    _(UPDATE, 1, uint, done)
#endif
