/* BUILD
   math: octahedral octahedral_map
   module f32x2: CHANNELS=2 DST=f32x2 PREVIOUS=0 LIST=0
   module f16x2: CHANNELS=2 DST=f16x2 PREVIOUS=0 LIST=0
   module list_f32x2: CHANNELS=2 DST=f32x2 PREVIOUS=0 LIST=1
   module list_f16x2: CHANNELS=2 DST=f16x2 PREVIOUS=0 LIST=1
   module previous_f32x2: CHANNELS=2 DST=f32x2 PREVIOUS=1 LIST=0
   module previous_f16x2: CHANNELS=2 DST=f16x2 PREVIOUS=1 LIST=0
   module previous_list_f32x2: CHANNELS=2 DST=f32x2 PREVIOUS=1 LIST=1
   module previous_list_f16x2: CHANNELS=2 DST=f16x2 PREVIOUS=1 LIST=1
*/
#define PARAMETERS(_) \
    _(int, probes)      /* that are made: all, or those of the list */ \
    _(int, reduced)     /* size of the maps of distance, even, 64 at most */ \
    _(int, size)        /* of the maps of moments, without their border */ \
    _(int, power)       /* of the cosine, 1.. */ \
    _(float, least)     /* cosines up to here weigh nothing */ \
    _(float, keep)      /* part of the previous map that stays, 0..1 */
#if PREVIOUS
#define PREVIOUS_BINDING(_) _(READ, 3, DST, previous)
#else
#define PREVIOUS_BINDING(_)
#endif
#if LIST
#define LIST_BINDING(_) _(READ, 4, uint, list)
#else
#define LIST_BINDING(_)
#endif
#define BINDINGS(_) \
    _(READ, 0, f32x2, distances) \
    _(UNIFORM, 1, 4096, texels)  /* of a quarter of the map: direction, and length of the vector area */ \
    _(WRITE, 2, DST, moments) \
    PREVIOUS_BINDING(_) \
    LIST_BINDING(_)
