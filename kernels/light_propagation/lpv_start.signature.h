/* BUILD
   math: lobe
   module f32x4_bands2: PIXEL=f32x4 LOBE=float WIDE=0 BANDS=2
   module f16x4_bands2: PIXEL=f16x4 LOBE=float WIDE=0 BANDS=2
   module f32x4_bands3: PIXEL=f32x4 LOBE=float WIDE=0 BANDS=3
   module f16x4_bands3: PIXEL=f16x4 LOBE=float WIDE=0 BANDS=3
*/
#define PARAMETERS(_) \
    _(int, width)    /* cells along x, y, z */ \
    _(int, height) \
    _(int, depth) \
    _(int, pitch)    /* values from row to row, slice to slice, plane to plane */ \
    _(int, slice) \
    _(int, plane) \
    _(int, channels) \
    _(int, keep)     /* 1: the sum begins with the injected light, 0: with none */
#define CONSTANTS(_) \
    _(0, int, LOBES, 0)  /* 0 linear, 1 clamp, 2 shrink, 3 rescale */ \
    _(1, int, ACTIVE, 0) /* 1: only what steps read (lpv_boxes), and the other two buffers too, since steps leave out cells */ \
    _(2, int, CELLS, 0)  /* 1: pixels of four, a cell each */
#define BINDINGS(_) \
    _(READ, 0, PIXEL, injected) \
    _(WRITE, 1, float, travelling) \
    _(WRITE, 2, float, other)     /* what the first step writes: its three rows are made here */ \
    _(WRITE, 3, float, sum) \
    _(WRITE, 4, float, total)     /* the other sum */ \
    _(READ, 5, uint, boxes)
