/* BUILD
   module f32x4: PIXEL=f32x4
   module f16x4: PIXEL=f16x4
*/
#define PARAMETERS(_) \
    _(int, width)    /* cells along x, y, z */ \
    _(int, height) \
    _(int, depth) \
    _(int, pitch)    /* values from row to row, slice to slice, plane to plane */ \
    _(int, slice) \
    _(int, plane) \
    _(int, channels) \
    _(int, keep)     /* 1: the sum holds the injected light */
#define CONSTANTS(_) \
    _(0, int, QUADS, 1)  /* pixels of a cell: 1 for 2 bands, 3 for 3 */ \
    _(1, int, ACTIVE, 0) /* 1: of the two sums the one of the last step that was made; nothing beyond the box of lpv_start */ \
    _(2, int, CELLS, 0)  /* 1: from pixels of four, a cell each */
#define BINDINGS(_) \
    _(READ, 0, PIXEL, injected) \
    _(READ, 1, float, sum) \
    _(WRITE, 2, PIXEL, result) \
    _(READ, 3, float, odd)  /* the sum after an odd number of steps */ \
    _(READ, 4, uint, state) \
    _(READ, 5, uint, boxes)
