/* BUILD
   math: opacity torus voxel_light
   module lights_f32x4: PIXEL=f32x4 UNORM=0 LIGHTS=1 MAP=0 EMISSION=0
   module lights_f16x4: PIXEL=f16x4 UNORM=0 LIGHTS=1 MAP=0 EMISSION=0
   module lights_unorm8x4: PIXEL=unorm8x4 UNORM=1 LIGHTS=1 MAP=0 EMISSION=0
   module lights_emission_f32x4: PIXEL=f32x4 UNORM=0 LIGHTS=1 MAP=0 EMISSION=1
   module lights_emission_f16x4: PIXEL=f16x4 UNORM=0 LIGHTS=1 MAP=0 EMISSION=1
   module lights_emission_unorm8x4: PIXEL=unorm8x4 UNORM=1 LIGHTS=1 MAP=0 EMISSION=1
   module map_f32x4: PIXEL=f32x4 UNORM=0 LIGHTS=0 MAP=1 EMISSION=0
   module map_f16x4: PIXEL=f16x4 UNORM=0 LIGHTS=0 MAP=1 EMISSION=0
   module map_unorm8x4: PIXEL=unorm8x4 UNORM=1 LIGHTS=0 MAP=1 EMISSION=0
   module map_emission_f32x4: PIXEL=f32x4 UNORM=0 LIGHTS=0 MAP=1 EMISSION=1
   module map_emission_f16x4: PIXEL=f16x4 UNORM=0 LIGHTS=0 MAP=1 EMISSION=1
   module map_emission_unorm8x4: PIXEL=unorm8x4 UNORM=1 LIGHTS=0 MAP=1 EMISSION=1
   module both_f32x4: PIXEL=f32x4 UNORM=0 LIGHTS=1 MAP=1 EMISSION=0
   module both_f16x4: PIXEL=f16x4 UNORM=0 LIGHTS=1 MAP=1 EMISSION=0
   module both_unorm8x4: PIXEL=unorm8x4 UNORM=1 LIGHTS=1 MAP=1 EMISSION=0
   module both_emission_f32x4: PIXEL=f32x4 UNORM=0 LIGHTS=1 MAP=1 EMISSION=1
   module both_emission_f16x4: PIXEL=f16x4 UNORM=0 LIGHTS=1 MAP=1 EMISSION=1
   module both_emission_unorm8x4: PIXEL=unorm8x4 UNORM=1 LIGHTS=1 MAP=1 EMISSION=1
*/
#define PARAMETERS(_) \
    _(int, width)            /* voxels of the grid */ \
    _(int, height) \
    _(int, depth) \
    _(int, inner_x)          /* TORUS: voxels of the grid of bricks before the window's first */ \
    _(int, inner_y) \
    _(int, inner_z) \
    _(int, turn_x)           /* where the window's first voxel lies in the volumes */ \
    _(int, turn_y) \
    _(int, turn_z) \
    _(int, bricks)           /* capacity of the list */ \
    _(int, lights)           /* in the list */ \
    _(float, voxel)          /* side of a voxel, scene units */ \
    _(float, normal_offset)  /* voxels */ \
    _(int, two_sided)        /* 0: only the side that the mean normal points to is lit */ \
    _(float, unit)           /* irradiance of one step of the map's sums */ \
    _(float, scale)          /* of stored radiance */ \
    _(int, shadow_width)     /* texels of the first light's shadow map */ \
    _(int, shadow_height) \
    _(float, u_x)            /* from positions in voxels to texels, and to what the map holds */ \
    _(float, u_y) \
    _(float, u_z) \
    _(float, u_at) \
    _(float, v_x) \
    _(float, v_y) \
    _(float, v_z) \
    _(float, v_at) \
    _(float, w_x) \
    _(float, w_y) \
    _(float, w_z) \
    _(float, w_at)
#define CONSTANTS(_) \
    _(0, int, COUNT, 0)  /* 1: outcomes are counted */ \
    _(1, int, TORUS, 0)  /* 1: the grid is a window, its volumes are addressed modulo their extents */ \
    _(2, int, SHADOW, 0) /* 1: the first light has a shadow map */
#if EMISSION
#define EMITTED(_) _(READ, 7, PIXEL, emission)
#else
#define EMITTED(_)
#endif
#if LIGHTS
#define LISTED(_) \
    _(READ, 1, PIXEL, normal) \
    _(READ, 6, vec4, lights) \
    _(READ, 9, float, shadow)
#else
#define LISTED(_)
#endif
#if MAP
#define ARRIVED(_) _(READ, 8, uint, sums)
#else
#define ARRIVED(_)
#endif
#define BINDINGS(_) \
    _(READ, 0, PIXEL, colour) \
    _(READ, 2, uint, brick_list) \
    _(READ, 3, uint, voxel_counters) \
    _(WRITE, 4, PIXEL, radiance) \
    _(UPDATE, 5, uint, outcomes) \
    LISTED(_) \
    EMITTED(_) \
    ARRIVED(_)
