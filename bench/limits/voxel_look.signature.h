/* BUILD
   module dense: OCTREE=0
   module octree: OCTREE=1
*/
#define PARAMETERS(_) \
    _(int, width) \
    _(int, height) \
    _(int, depth)    /* the volume is 2^depth wide */ \
    _(int, level)    /* that is looked up; 0: the finest */ \
    _(int, looks)    /* of an invocation */ \
    _(float, step_x) /* between them, in voxels of the level */ \
    _(float, step_y) \
    _(float, step_z)
#if OCTREE
#define BINDINGS(_) \
    _(READ, 0, uint, children) \
    _(READ, 1, vec4, values) \
    _(WRITE, 2, vec4, dst)
#else
#define BINDINGS(_) \
    _(READ, 0, vec4, volume) \
    _(WRITE, 1, vec4, dst)
#endif
