/* BUILD
   math: torus voxel_light
   module f32x4: PIXEL=f32x4
   module f16x4: PIXEL=f16x4
   module unorm8x4: PIXEL=unorm8x4
*/
#define PARAMETERS(_) \
    _(int, width)        /* voxels of the grid */ \
    _(int, height) \
    _(int, depth) \
    _(int, inner_x)      /* TORUS: voxels of the grid of bricks before the window's first */ \
    _(int, inner_y) \
    _(int, inner_z) \
    _(int, turn_x)       /* where the window's first voxel lies in the volumes */ \
    _(int, turn_y) \
    _(int, turn_z) \
    _(int, map_width)    /* texels */ \
    _(int, map_height) \
    _(float, per_unit)   /* steps of a sum per irradiance 1 */
#define CONSTANTS(_) \
    _(0, int, COUNT, 0)  /* 1: outcomes are counted */ \
    _(1, int, TORUS, 0)  /* 1: the grid is a window, its volumes are addressed modulo their extents */
#define BINDINGS(_) \
    _(READ, 0, vec4, map) \
    _(READ, 1, PIXEL, colour) \
    _(READ, 2, uint, slots) \
    _(UPDATE, 3, uint, sums) \
    _(UPDATE, 4, uint, outcomes)
