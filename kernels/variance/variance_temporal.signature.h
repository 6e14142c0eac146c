/* BUILD
   math: luminance
   module f32x1: CHANNELS=1 SRC=f32x1
   module f32x2: CHANNELS=2 SRC=f32x2
   module f32x4: SRC=f32x4
   module f16x4: SRC=f16x4
   module unorm8x4: SRC=unorm8x4
*/
#define PARAMETERS(_) \
    _(int, width)      /* pixels */ \
    _(int, height)     /* pixels */ \
    _(int, src_stride) /* pixels from row to row */ \
    _(float, alpha)    /* least part that a new frame counts, 0..1 */ \
    _(float, shortest) /* frames of history from which on it is believed */
#define BINDINGS(_) \
    _(READ, 0, SRC, src) \
    _(READ, 1, float, history)      /* mean, variance, frames of each pixel */ \
    _(WRITE, 2, float, history_out) \
    _(UPDATE, 3, float, variances)  /* spatial in, and kept where history is short */
