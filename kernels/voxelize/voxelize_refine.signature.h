/* BUILD
   math: wide_int triangle_box triangle_filter voxel_grid
   module root_blocks: ROOT=1 MARK=0
   module root_bricks: ROOT=1 MARK=1
   module bricks: ROOT=0 MARK=1
*/
#define PARAMETERS(_) \
    _(int, width)      /* voxels of the grid */ \
    _(int, height) \
    _(int, depth) \
    _(int, base_x)     /* first voxel of the grid, as triangles count them */ \
    _(int, base_y) \
    _(int, base_z) \
    _(int, first_x)    /* the region of the grid that is made */ \
    _(int, first_y) \
    _(int, first_z) \
    _(int, last_x)     /* included */ \
    _(int, last_y) \
    _(int, last_z) \
    _(int, parents)    /* triangles (root), or how many parents the list holds at most */ \
    _(int, capacity)   /* pieces that `pieces` holds */ \
    _(int, counter)    /* of the pieces that are found */ \
    _(int, stride)     /* invocations */
#define CONSTANTS(_) \
    _(0, int, PARENT, 64)  /* voxels along a parent's side (root: the whole grid) */ \
    _(1, int, SIDE, 8)     /* voxels along a piece's side */
#if ROOT
#define PARENTS(_)
#else
#define PARENTS(_) _(READ, 3, uint, parent_list)
#endif
#if MARK
#define MARKED(_) _(UPDATE, 4, uint, slots)
#else
#define MARKED(_)
#endif
#define BINDINGS(_) \
    _(READ, 0, int, triangles) \
    _(UPDATE, 1, uint, counters) \
    _(WRITE, 2, uint, pieces) \
    PARENTS(_) \
    MARKED(_)
