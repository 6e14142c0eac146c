/* BUILD
   math: lobe
   module bands2: CHANNELS=1 LOBE=wide WIDE=1 BANDS=2 BLOCKED=0 ACTIVE=0
   module bands2_geometry: CHANNELS=1 LOBE=wide WIDE=1 BANDS=2 BLOCKED=1 ACTIVE=0
   module bands3: CHANNELS=1 LOBE=wide WIDE=1 BANDS=3 BLOCKED=0 ACTIVE=0
   module bands3_geometry: CHANNELS=1 LOBE=wide WIDE=1 BANDS=3 BLOCKED=1 ACTIVE=0
   module bands2_active: CHANNELS=1 LOBE=wide WIDE=1 BANDS=2 BLOCKED=0 ACTIVE=1
   module bands2_geometry_active: CHANNELS=1 LOBE=wide WIDE=1 BANDS=2 BLOCKED=1 ACTIVE=1
   module bands3_active: CHANNELS=1 LOBE=wide WIDE=1 BANDS=3 BLOCKED=0 ACTIVE=1
   module bands3_geometry_active: CHANNELS=1 LOBE=wide WIDE=1 BANDS=3 BLOCKED=1 ACTIVE=1
*/
#define PARAMETERS(_) \
    _(int, width)          /* cells along x, y, z */ \
    _(int, height) \
    _(int, depth) \
    _(int, pitch)          /* values from row to row, slice to slice, plane to plane */ \
    _(int, slice) \
    _(int, plane) \
    _(int, geometry_pitch) /* the same of `geometry` */ \
    _(int, geometry_slice) \
    _(int, geometry_plane) \
    _(int, channels) \
    _(int, across)         /* 1: band 2 has parts across axes: injected light, not light that came through faces */ \
    _(int, last)           /* 1: nothing travels on; 2: dst is an output: the lobes as they came */ \
    _(int, step)           /* steps before this one */ \
    _(float, error)        /* active: stop where what travels is at most this share of what was injected */
#define CONSTANTS(_) \
    _(0, int, LOBES, 0)     /* 0 linear, 1 clamp, 2 shrink, 3 rescale */ \
    _(1, int, PERIODIC, 0)  /* 1: beyond the grid is its opposite side */ \
    _(2, int, APART, 0)     /* 1: an invocation makes one channel, which streams less at a time; 0: all */
#define SHAPE(_) \
    _(8, int, LANES, 16)
#if BLOCKED
#define GEOMETRY(_) _(READ, 4, f32x1, geometry)
#else
#define GEOMETRY(_)
#endif
#if ACTIVE
#define REACHED(_) \
    _(READ, 5, uint, reached)  /* 1: light came to these PIXELS cells before */ \
    _(WRITE, 6, uint, reaches) /* the same after this step */ \
    _(UPDATE, 7, uint, state)  /* steps made; bits of the largest c0 before each step */ \
    _(READ, 8, uint, boxes)    /* lpv_boxes: the cells that steps can reach */
#else
#define REACHED(_)
#endif
#define BINDINGS(_) \
    _(READ, 0, f32x1, src)  /* light that travels: lpv_start */ \
    _(WRITE, 1, f32x1, dst) \
    _(READ, 2, f32x1, sum)  /* of the steps so far */ \
    _(WRITE, 3, f32x1, total) \
    GEOMETRY(_) \
    REACHED(_)
