/* BUILD
   math: screen_ray vector ggx
   module mirror: CHANNELS=1 STOCHASTIC=0 FALLBACK=0 FACTOR=0
   module mirror_fallback: CHANNELS=1 STOCHASTIC=0 FALLBACK=1 FACTOR=0
   module mirror_factor: CHANNELS=1 STOCHASTIC=0 FALLBACK=0 FACTOR=1
   module mirror_fallback_factor: CHANNELS=1 STOCHASTIC=0 FALLBACK=1 FACTOR=1
   module stochastic: CHANNELS=1 STOCHASTIC=1 FALLBACK=0 FACTOR=0
   module stochastic_fallback: CHANNELS=1 STOCHASTIC=1 FALLBACK=1 FACTOR=0
   module stochastic_factor: CHANNELS=1 STOCHASTIC=1 FALLBACK=0 FACTOR=1
   module stochastic_fallback_factor: CHANNELS=1 STOCHASTIC=1 FALLBACK=1 FACTOR=1
*/
#define TILE 8  // traced pixels along a side of a tile
#define PARAMETERS(_) \
    _(int, width)           /* of the image, pixels */ \
    _(int, height) \
    _(int, each)            /* rays a traced pixel */ \
    _(int, scale)           /* pixels along each axis for one that is traced, 1 or 2 */ \
    _(int, reuse)           /* traced pixels around a pixel whose rays it takes */ \
    _(int, stride)          /* invocations */ \
    _(int, top)             /* the coarsest level of colour */ \
    _(int, table_size)      /* of split_sum, along both axes */ \
    _(float, focal_x)       /* pixels */ \
    _(float, focal_y) \
    _(float, centre_x) \
    _(float, centre_y) \
    _(float, depth_scale) \
    _(float, depth_offset) \
    _(float, cutoff) \
    _(float, prefilter)     /* width of what is looked up, in that of the lobe's part that a ray stands for */ \
    _(float, environment_r) \
    _(float, environment_g) \
    _(float, environment_b)
#define CONSTANTS(_) \
    _(0, int, DEPTH, 0)
#if STOCHASTIC
#define DIRECTIONS(_) _(READ, 8, vec4, directions)
#else
#define DIRECTIONS(_) _(UNIFORM, 8, 65, spreads)
#endif
#if FALLBACK
#define FALLBACK_BINDING(_) _(READ, 9, vec4, fallback)
#else
#define FALLBACK_BINDING(_)
#endif
#if FACTOR
#define FACTOR_BINDINGS(_) \
    _(READ, 10, vec4, specular) \
    _(READ, 11, float, split_sum)
#else
#define FACTOR_BINDINGS(_)
#endif
#define BINDINGS(_) \
    _(READ, 0, f32x1, depth) \
    _(READ, 1, vec4, normals) \
    _(READ, 2, uint, tile_list) \
    _(READ, 3, vec4, hits) \
    _(READ, 4, vec4, paths) \
    _(READ, 5, vec4, colour) \
    _(WRITE, 6, vec4, radiance) \
    DIRECTIONS(_) \
    FALLBACK_BINDING(_) \
    FACTOR_BINDINGS(_)
