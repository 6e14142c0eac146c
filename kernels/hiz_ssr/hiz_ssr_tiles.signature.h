/* BUILD
   math: screen_ray
   module hits: CHANNELS=1 SHADE=0
   module shaded: CHANNELS=1 SHADE=1
*/
#define TILE 8  // traced pixels along a side of a tile
#define PARAMETERS(_) \
    _(int, width)         /* of the image, pixels */ \
    _(int, height) \
    _(int, scale)         /* pixels along each axis for one that is traced, 1 or 2 */ \
    _(int, each)          /* rays a traced pixel */ \
    _(float, depth_scale) \
    _(float, depth_offset) \
    _(float, cutoff)
#define CONSTANTS(_) \
    _(0, int, DEPTH, 0)
#if SHADE
#define RADIANCE(_) _(WRITE, 5, vec4, radiance)
#else
#define RADIANCE(_)
#endif
#define BINDINGS(_) \
    _(READ, 0, f32x1, depth) \
    _(READ, 1, vec4, normals) \
    _(WRITE, 2, uint, flags) \
    _(WRITE, 3, vec4, hits) \
    _(WRITE, 4, vec4, paths) \
    RADIANCE(_)
