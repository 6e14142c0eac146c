/* BUILD
   module u32:
*/
#define PARAMETERS(_) \
    _(int, count)   /* words */ \
    _(int, stride)  /* invocations */
#define BINDINGS(_) \
    _(WRITE, 0, uint, words)
