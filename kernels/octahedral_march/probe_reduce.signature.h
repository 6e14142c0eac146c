/* BUILD
   math: vector octahedral_area small_float
   module radiance_f32x4: CHANNELS=4 SRC=f32x4 DISTANCE=0 PACKED=0 LIST=0
   module radiance_f16x4: CHANNELS=4 SRC=f16x4 DISTANCE=0 PACKED=0 LIST=0
   module radiance_r11g11b10: CHANNELS=4 SRC=uint DISTANCE=0 PACKED=1 LIST=0
   module radiance_list_f32x4: CHANNELS=4 SRC=f32x4 DISTANCE=0 PACKED=0 LIST=1
   module radiance_list_f16x4: CHANNELS=4 SRC=f16x4 DISTANCE=0 PACKED=0 LIST=1
   module radiance_list_r11g11b10: CHANNELS=4 SRC=uint DISTANCE=0 PACKED=1 LIST=1
   module distance_f32: CHANNELS=1 SRC=f32x1 DISTANCE=1 PACKED=0 LIST=0
   module distance_f16: CHANNELS=1 SRC=uint DISTANCE=1 PACKED=1 LIST=0
   module distance_list_f32: CHANNELS=1 SRC=f32x1 DISTANCE=1 PACKED=0 LIST=1
   module distance_list_f16: CHANNELS=1 SRC=uint DISTANCE=1 PACKED=1 LIST=1
*/
#define PARAMETERS(_) \
    _(int, probes)    /* that are made: all, or those of the list */ \
    _(int, size)      /* of the maps */ \
    _(int, reduced)   /* of what is made, divides size */ \
    _(float, unit_length)  /* diagonal of a cage, scene units: distances are stored in it */ \
    _(float, farthest)     /* distances beyond it, in diagonals, count as it */
#if LIST
#define LIST_BINDING(_) _(READ, 2, uint, list)
#else
#define LIST_BINDING(_)
#endif
#if DISTANCE
#define BINDINGS(_) \
    _(READ, 0, SRC, src) \
    _(WRITE, 1, float, moments) \
    LIST_BINDING(_)
#else
#define BINDINGS(_) \
    _(READ, 0, SRC, src) \
    _(WRITE, 1, vec4, means) \
    LIST_BINDING(_)
#endif
