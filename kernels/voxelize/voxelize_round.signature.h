/* BUILD
   math: voxel_grid
   module plain: MATERIALS=0 TEXTURED=0
   module materials: MATERIALS=1 TEXTURED=0
   module textured: MATERIALS=0 TEXTURED=1
   module textured_materials: MATERIALS=1 TEXTURED=1
*/
#define PARAMETERS(_) \
    _(int, triangles) \
    _(int, vertices) \
    _(float, origin_x)  /* scene units, rounded to float */ \
    _(float, origin_y) \
    _(float, origin_z) \
    _(float, rest_x)    /* what rounding took from it */ \
    _(float, rest_y) \
    _(float, rest_z) \
    _(float, scale)     /* units of 2^-16 voxel in a scene unit */ \
    _(int, width)       /* voxels of the grid */ \
    _(int, height) \
    _(int, depth) \
    _(int, stride)      /* invocations */
#if MATERIALS
#define CHOSEN(_) _(READ, 4, uint, material_list)
#else
#define CHOSEN(_)
#endif
#if TEXTURED
#define MAPPED(_) \
    _(READ, 5, float, vertex_uvs) \
    _(WRITE, 6, float, record_uvs)
#else
#define MAPPED(_)
#endif
#define BINDINGS(_) \
    _(READ, 0, float, positions) \
    _(READ, 1, uint, indices) \
    _(WRITE, 2, int, records) \
    _(UPDATE, 3, uint, counters) \
    CHOSEN(_) \
    MAPPED(_)
