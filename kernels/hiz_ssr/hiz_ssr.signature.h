/* BUILD
   math: screen_ray vector ggx
   module pixels: CHANNELS=1 KIND=READ RAYS=0 STOCHASTIC=0 COUNT=0
   module stochastic: CHANNELS=1 KIND=READ RAYS=0 STOCHASTIC=1 COUNT=0
   module rays: CHANNELS=1 KIND=READ RAYS=1 STOCHASTIC=0 COUNT=0
   module count_pixels: CHANNELS=1 KIND=READ RAYS=0 STOCHASTIC=0 COUNT=1
   module count_stochastic: CHANNELS=1 KIND=READ RAYS=0 STOCHASTIC=1 COUNT=1
   module count_rays: CHANNELS=1 KIND=READ RAYS=1 STOCHASTIC=0 COUNT=1
   module texels_pixels: CHANNELS=1 KIND=TEXELS RAYS=0 STOCHASTIC=0 COUNT=0
   module texels_stochastic: CHANNELS=1 KIND=TEXELS RAYS=0 STOCHASTIC=1 COUNT=0
   module texels_rays: CHANNELS=1 KIND=TEXELS RAYS=1 STOCHASTIC=0 COUNT=0
*/
#define TILE 8  // traced pixels along a side of a tile
#define PARAMETERS(_) \
    _(int, width)            /* of the depth image, pixels */ \
    _(int, height) \
    _(int, rays)             /* in the list; 0: of the pixels */ \
    _(int, each)             /* rays a traced pixel */ \
    _(int, scale)            /* pixels along each axis for one that is traced, 1 or 2 */ \
    _(int, seed) \
    _(int, stride)           /* invocations */ \
    _(int, top)              /* the coarsest level that rays climb to */ \
    _(int, first)            /* the level that they start on */ \
    _(int, step_cap) \
    _(int, steps)            /* linear: along the whole ray */ \
    _(int, refinements)      /* linear: halvings of the step that crossed a surface */ \
    _(float, focal_x)        /* pixels */ \
    _(float, focal_y) \
    _(float, centre_x) \
    _(float, centre_y) \
    _(float, depth_scale)    /* reciprocal depth = scale * stored + offset, standard: of 1 - stored */ \
    _(float, depth_offset) \
    _(float, nearest)        /* depth where rays end towards the camera */ \
    _(float, reach)          /* length of rays, at most 1e30 */ \
    _(float, thickness) \
    _(float, bias)           /* pixels of the surface's slope that rays start in front of it */ \
    _(float, cutoff)         /* roughness from which on a pixel does not reflect */ \
    _(float, fade_edge)      /* of the image's side */ \
    _(float, fade_distance)  /* of the reach */ \
    _(float, fade_thickness) \
    _(float, fade_back)
#define CONSTANTS(_) \
    _(0, int, METHOD, 0)  /* 0 hiz, 1 dda, 2 linear */ \
    _(1, int, DEPTH, 0)   /* 0 linear, 1 standard, 2 reversed */
#if COUNT
#define COUNTERS(_) _(UPDATE, 4, uint, counters)
#else
#define COUNTERS(_)
#endif
#if RAYS
#define TILES(_)
#else
#define TILES(_) _(READ, 5, uint, tile_list)
#endif
#if STOCHASTIC
#define DIRECTIONS(_) _(WRITE, 6, vec4, directions)
#else
#define DIRECTIONS(_)
#endif
#define BINDINGS(_) \
    _(KIND, 0, f32x1, depth) \
    _(READ, 1, vec4, source) \
    _(WRITE, 2, vec4, hits) \
    _(WRITE, 3, vec4, paths) \
    COUNTERS(_) \
    TILES(_) \
    DIRECTIONS(_)
