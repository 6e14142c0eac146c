/* BUILD
   math: wide_int triangle_box triangle_filter voxel_grid clip texture
   module plain: LIST=0 TEXTURES=0 CLIP_CENTROID=0
   module list: LIST=1 TEXTURES=0 CLIP_CENTROID=0
   module textured: LIST=0 TEXTURES=1 CLIP_CENTROID=1
   module textured_list: LIST=1 TEXTURES=1 CLIP_CENTROID=1
*/
#define MODE_CONSERVATIVE 0
#define MODE_THIN 1
#define MODE_DILATED 2
#define MERGE_EXACT 0
#define MERGE_MOVING_AVERAGE 1
#define MERGE_LAST_WRITE 2
#define PARAMETERS(_) \
    _(int, width)            /* voxels of the grid */ \
    _(int, height) \
    _(int, depth) \
    _(int, base_x)           /* first voxel of the grid, as triangles count them */ \
    _(int, base_y) \
    _(int, base_z) \
    _(int, first_x)          /* the region of the grid that is made */ \
    _(int, first_y) \
    _(int, first_z) \
    _(int, last_x)           /* included */ \
    _(int, last_y) \
    _(int, last_z) \
    _(int, materials)        /* in the table */ \
    _(int, capacity)         /* pieces that the list holds at most */ \
    _(int, fragments)        /* that `fragment_list` holds */ \
    _(float, emission_unit)  /* emission of one step of 2^-14 */ \
    _(int, stride)           /* invocations */
#define CONSTANTS(_) \
    _(0, int, MODE, 0) \
    _(1, int, MERGE, 0) \
    _(2, int, OPACITY, 0)   /* 1: a mean of it is asked for; 0: it is 1 everywhere */ \
    _(3, int, NORMAL, 0)    /* 1: a mean of it is asked for */ \
    _(4, int, EMISSION, 0)
#if LIST
#define LISTED(_) _(WRITE, 7, uint, fragment_list)
#else
#define LISTED(_)
#endif
#if TEXTURES
#define TEXTURED(_) \
    _(READ, 8, float, uvs)           /* of the corners of each record, u and v */ \
    _(READ, 9, uint, texture_table)  /* math/texture.h; a texture for each material */ \
    _(READ, 10, uint, texels)        /* sRGB colour and alpha, 8 bits each */ \
    _(UNIFORM, 11, 256, srgb)
#else
#define TEXTURED(_)
#endif
#define BINDINGS(_) \
    _(READ, 0, int, triangles) \
    _(READ, 1, vec4, materials) \
    _(READ, 2, uint, pieces) \
    _(READ, 3, uint, slots) \
    _(UPDATE, 4, uint, counters) \
    _(UPDATE, 5, uint, sums) \
    _(UPDATE, 6, uint, carries) \
    LISTED(_) \
    TEXTURED(_)
