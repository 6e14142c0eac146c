/* BUILD
   math: border
   module f32x1: CHANNELS=1 PIXEL=f32x1
   module f32x2: CHANNELS=2 PIXEL=f32x2
   module f32x4: PIXEL=f32x4
   module f16x2: CHANNELS=2 PIXEL=f16x2
   module f16x4: PIXEL=f16x4
   module unorm8x4: PIXEL=unorm8x4
*/
#define PHASE_COUNT 2
#define PARAMETERS(_) \
    _(int, width) \
    _(float, scale) \
    _(uint, seed) \
    _(int, height)
#define CONSTANTS(_) \
    _(0, int, STEP, 1) \
    _(1, float, BIAS, 0.25f) \
    _(2, uint, MASK, 255u)
#define SHAPE(_) \
    _(8, int, LANES, 16)
#define SHARED_MEMORY(_) \
    _(float, 64, tile)
#define BINDINGS(_) \
    _(READ, 0, PIXEL, src) \
    _(WRITE, 1, PIXEL, dst) \
    _(UNIFORM, 2, 16, weights) \
    _(UPDATE, 3, uint, counters) \
    _(READ, 4, float, numbers) \
    _(WRITE, 5, float, results) \
    _(WRITE, 6, uint, bits) \
    _(TEXELS, 7, PIXEL, linear_texels)
