/* BUILD
   math: wide_int voxel_grid torus
   module f32x4: PIXEL=f32x4 UNORM=0
   module f16x4: PIXEL=f16x4 UNORM=0
   module unorm8x4: PIXEL=unorm8x4 UNORM=1
   module over_f32x4: PIXEL=f32x4 UNORM=0 OVER=1
   module over_f16x4: PIXEL=f16x4 UNORM=0 OVER=1
   module over_unorm8x4: PIXEL=unorm8x4 UNORM=1 OVER=1
*/
#define OF_COLOUR 0
#define OF_NORMAL 1
#define OF_EMISSION 2
#define OF_PACKED 3   // colour of moving_average and last_write
#define PARAMETERS(_) \
    _(int, width)            /* voxels of the grid */ \
    _(int, height) \
    _(int, depth) \
    _(int, stored_x)         /* voxels of the volume, which may be a torus */ \
    _(int, stored_y) \
    _(int, stored_z) \
    _(int, turn_x)           /* where the grid's first voxel lies in it */ \
    _(int, turn_y) \
    _(int, turn_z) \
    _(int, first_x)          /* the region of the grid that is made */ \
    _(int, first_y) \
    _(int, first_z) \
    _(int, last_x)           /* included */ \
    _(int, last_y) \
    _(int, last_z) \
    _(int, words)            /* of a voxel's accumulators */ \
    _(int, at)               /* first of the three that are read; colour: that of opacity, or 0 for none */ \
    _(float, emission_unit)  /* emission of one step of 2^-14 */ \
    _(int, capacity)         /* bricks that the list holds at most */ \
    _(int, stride)           /* invocations along x */ \
    _(int, opacity)          /* 1: the fourth channel of packed colour is it; 0: it is 1 wherever there is something */
#define CONSTANTS(_) \
    _(0, int, OF, 0) \
    _(1, int, TOUCHED, 0)  /* 1: only bricks of the list are written, in a launch along x that strides over it */
#ifdef OVER
#define COVERED(_) _(READ, 6, PIXEL, under)
#else
#define COVERED(_)
#endif
#define BINDINGS(_) \
    _(READ, 0, uint, slots) \
    _(READ, 1, uint, sums) \
    _(READ, 2, uint, carries) \
    _(UPDATE, 3, uint, counters) \
    _(WRITE, 4, PIXEL, dst) \
    _(READ, 5, uint, brick_list) \
    COVERED(_)
