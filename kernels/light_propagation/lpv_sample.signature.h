/* BUILD
   math: vector sh
   modules READ TEXELS: f32x4 f16x4
*/
#define PARAMETERS(_) \
    _(int, width)      /* cells along x, y, z, of every cascade */ \
    _(int, height) \
    _(int, depth) \
    _(int, cascades)   /* 1..3, finest first */ \
    _(int, receivers) \
    _(int, channels)   /* 1 or 3 */ \
    _(int, apart)      /* pixels from one cascade's volume to the next one's */ \
    _(float, offset)   /* look-ups are so many cells above the surface */ \
    _(float, damping)  /* 0: none; 1: whole */ \
    _(float, per_blend) /* 1 / the cells over which a cascade gives way to the next */ \
    _(int, steps)      /* of the glossy look-up, along the mirror direction */
#define CONSTANTS(_) \
    _(0, int, BANDS, 2)   /* 2 or 3 */ \
    _(1, int, DAMPED, 0)  /* 1: damping is not 0 */ \
    _(2, int, GLOSSY, 0)  /* 1: `specular` is wanted */ \
    _(3, int, COUNT, 0)   /* 1: outcomes are counted */
// Eight floats a cascade: outer corner, scene units; cells in a scene unit; what coefficients are multiplied with; unused.
#define BINDINGS(_) \
    _(SRC_KIND, 0, SRC, light) \
    _(READ, 1, vec4, places) \
    _(READ, 2, vec4, views) \
    _(WRITE, 3, vec4, irradiance) \
    _(WRITE, 4, vec4, specular) \
    _(UPDATE, 5, uint, outcomes) \
    _(UNIFORM, 6, 24, grids)
