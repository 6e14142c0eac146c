/* BUILD
   math: probe_maps
   module f32: F16=0
   module f16: F16=1
*/
#define PARAMETERS(_) \
    _(int, size)     /* texels along a side of a map */ \
    _(int, ratio)    /* of texels to cells */ \
    _(int, cells)    /* of all maps */ \
    _(int, stride)   /* invocations */
#if F16
#define DISTANCE uint
#else
#define DISTANCE float
#endif
#define BINDINGS(_) \
    _(READ, 0, DISTANCE, distances) \
    _(WRITE, 1, DISTANCE, minimum)
