/* BUILD
   math: octahedral direction_bits small_float vector
   module encode: DECODE=0
   module decode: DECODE=1
*/
#define PARAMETERS(_) \
    _(int, count) \
    _(int, stride)   /* invocations */
#define CONSTANTS(_) \
    _(0, int, CODE, 0)   /* 0 snorm8, 1 snorm16, 2 r11g11b10 */
#if DECODE
#define BINDINGS(_) \
    _(READ, 0, uint, codes) \
    _(WRITE, 1, vec4, values)
#else
#define BINDINGS(_) \
    _(READ, 0, vec4, values) \
    _(WRITE, 1, uint, codes) \
    _(WRITE, 2, vec4, places)
#endif
