/* BUILD
   math: octahedral direction_bits probe_grid probe_maps screen_ray vector
   module f32: F16=0 NORMALS=0 PLACED=0 COUNT=0
   module f32_normals: F16=0 NORMALS=1 PLACED=0 COUNT=0
   module f16: F16=1 NORMALS=0 PLACED=0 COUNT=0
   module f16_normals: F16=1 NORMALS=1 PLACED=0 COUNT=0
   module f32_placed: F16=0 NORMALS=0 PLACED=1 COUNT=0
   module f32_normals_placed: F16=0 NORMALS=1 PLACED=1 COUNT=0
   module f16_placed: F16=1 NORMALS=0 PLACED=1 COUNT=0
   module f16_normals_placed: F16=1 NORMALS=1 PLACED=1 COUNT=0
   module f32_count: F16=0 NORMALS=0 PLACED=0 COUNT=1
   module f32_normals_count: F16=0 NORMALS=1 PLACED=0 COUNT=1
   module f16_count: F16=1 NORMALS=0 PLACED=0 COUNT=1
   module f16_normals_count: F16=1 NORMALS=1 PLACED=0 COUNT=1
   module f32_placed_count: F16=0 NORMALS=0 PLACED=1 COUNT=1
   module f32_normals_placed_count: F16=0 NORMALS=1 PLACED=1 COUNT=1
   module f16_placed_count: F16=1 NORMALS=0 PLACED=1 COUNT=1
   module f16_normals_placed_count: F16=1 NORMALS=1 PLACED=1 COUNT=1
*/
#define PARAMETERS(_) \
    _(int, rays) \
    _(int, stride)        /* invocations */ \
    _(int, size)          /* texels along a side of a map */ \
    _(int, coarse)        /* log2 of the minimum map's ratio; 0: none is read */ \
    _(int, count_x)       /* probes */ \
    _(int, count_y) \
    _(int, count_z) \
    _(int, probe)         /* the only one that is asked; -1: those of cages */ \
    _(int, tries)         /* probes asked in a cage */ \
    _(int, step_cap) \
    _(float, origin_x)    /* of probe 0 */ \
    _(float, origin_y) \
    _(float, origin_z) \
    _(float, spacing_x) \
    _(float, spacing_y) \
    _(float, spacing_z) \
    _(float, unit_length) /* of f16 distances */ \
    _(float, thickness)   /* of what is seen, in texel footprints */ \
    _(float, slope)       /* with normals: most that a footprint's depth counts for, in its width */ \
    _(float, bias)        /* no hit nearer to the ray's beginning than this, in texel footprints there */
#define CONSTANTS(_) \
    _(0, int, ORDER, 0)   /* of a cage's probes: 0 (i + 3) mod 8, 1 xor */ \
    _(1, int, BITS, 8)    /* of a normal's coordinate, 8 or 16 */
#define SHAPE(_) \
    _(8, int, SPLIT, 0)   /* 1: looks, and what they meet, in loops of their own */
#if F16
#define DISTANCE uint
#else
#define DISTANCE float
#endif
#if NORMALS
#define NORMAL_MAP(_) _(READ, 3, uint, normals)
#else
#define NORMAL_MAP(_)
#endif
#if PLACED
#define POSITIONS(_) _(READ, 4, vec4, positions)
#else
#define POSITIONS(_)
#endif
#if COUNT
#define COUNTERS(_) _(UPDATE, 5, uint, counters)
#else
#define COUNTERS(_)
#endif
#define BINDINGS(_) \
    _(READ, 0, vec4, rays) \
    _(READ, 1, DISTANCE, distances) \
    _(READ, 2, DISTANCE, minimum) \
    NORMAL_MAP(_) \
    POSITIONS(_) \
    COUNTERS(_) \
    _(WRITE, 6, vec4, hits) \
    _(WRITE, 7, uint, texels)
