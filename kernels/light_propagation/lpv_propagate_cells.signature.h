/* BUILD
   math: lobe
   module buffers: CHANNELS=4 KIND=READ LOBE=float WIDE=0
   module texels: CHANNELS=4 KIND=TEXELS LOBE=float WIDE=0
*/
#define PARAMETERS(_) \
    _(int, width)          /* cells along x, y, z */ \
    _(int, height) \
    _(int, depth) \
    _(int, channels) \
    _(int, across)         /* 1: band 2 has parts across axes: injected light, not light that came through faces */ \
    _(int, last)           /* 1: nothing travels on; 2: dst is an output: the lobes as they came */ \
    _(int, step)           /* steps before this one */ \
    _(float, error)        /* active: stop where what travels is at most this share of what was injected */
#define CONSTANTS(_) \
    _(0, int, LOBES, 0)     /* 0 linear, 1 clamp, 2 shrink, 3 rescale */ \
    _(1, int, PERIODIC, 0)  /* 1: beyond the grid is its opposite side */ \
    _(2, int, APART, 0)     /* 1: an invocation makes one channel; 0: all */ \
    _(3, int, BANDS, 2)     /* 2 or 3 */ \
    _(4, int, BLOCKED, 0)   /* 1: `geometry` blocks */ \
    _(5, int, ACTIVE, 0)    /* 1: cells that no light has reached are left out */ \
    _(6, int, ENERGY, 0)    /* 1: `energy` is added to */
// Of the last five a buffer stands in for what its constant leaves out.
#define BINDINGS(_) \
    _(KIND, 0, f32x4, src)  /* light that travels: lpv_start */ \
    _(WRITE, 1, f32x4, dst) \
    _(KIND, 2, f32x4, sum)  /* of the steps so far */ \
    _(WRITE, 3, f32x4, total) \
    _(KIND, 4, f32x4, geometry) \
    _(READ, 5, uint, reached)   /* 1: light came to this cell before */ \
    _(WRITE, 6, uint, reaches)  /* the same after this step */ \
    _(UPDATE, 7, uint, state)   /* steps made; bits of the largest c0 before each step */ \
    _(UPDATE, 8, vec4, energy) \
    _(READ, 9, uint, boxes)     /* lpv_boxes: the cells that steps can reach */
