/* BUILD
   math: opacity extinction torus octahedral hash
   module f32x4: KIND=READ PIXEL=f32x4 SAMPLED=0 SPECULAR=0 COUNT=0
   module count_f32x4: KIND=READ PIXEL=f32x4 SAMPLED=0 SPECULAR=0 COUNT=1
   module texels_f32x4: KIND=TEXELS PIXEL=f32x4 SAMPLED=0 SPECULAR=0 COUNT=0
   module f16x4: KIND=READ PIXEL=f16x4 SAMPLED=0 SPECULAR=0 COUNT=0
   module count_f16x4: KIND=READ PIXEL=f16x4 SAMPLED=0 SPECULAR=0 COUNT=1
   module texels_f16x4: KIND=TEXELS PIXEL=f16x4 SAMPLED=0 SPECULAR=0 COUNT=0
   module unorm8x4: KIND=READ PIXEL=unorm8x4 SAMPLED=0 SPECULAR=0 COUNT=0
   module count_unorm8x4: KIND=READ PIXEL=unorm8x4 SAMPLED=0 SPECULAR=0 COUNT=1
   module texels_unorm8x4: KIND=TEXELS PIXEL=unorm8x4 SAMPLED=0 SPECULAR=0 COUNT=0
   module sampled: KIND=SAMPLED3D PIXEL=f32x4 SAMPLED=1 SPECULAR=0 COUNT=0
   module count_sampled: KIND=SAMPLED3D PIXEL=f32x4 SAMPLED=1 SPECULAR=0 COUNT=1
   module specular_f32x4: KIND=READ PIXEL=f32x4 SAMPLED=0 SPECULAR=1 COUNT=0
   module specular_count_f32x4: KIND=READ PIXEL=f32x4 SAMPLED=0 SPECULAR=1 COUNT=1
   module specular_texels_f32x4: KIND=TEXELS PIXEL=f32x4 SAMPLED=0 SPECULAR=1 COUNT=0
   module specular_f16x4: KIND=READ PIXEL=f16x4 SAMPLED=0 SPECULAR=1 COUNT=0
   module specular_count_f16x4: KIND=READ PIXEL=f16x4 SAMPLED=0 SPECULAR=1 COUNT=1
   module specular_texels_f16x4: KIND=TEXELS PIXEL=f16x4 SAMPLED=0 SPECULAR=1 COUNT=0
   module specular_unorm8x4: KIND=READ PIXEL=unorm8x4 SAMPLED=0 SPECULAR=1 COUNT=0
   module specular_count_unorm8x4: KIND=READ PIXEL=unorm8x4 SAMPLED=0 SPECULAR=1 COUNT=1
   module specular_texels_unorm8x4: KIND=TEXELS PIXEL=unorm8x4 SAMPLED=0 SPECULAR=1 COUNT=0
   module specular_sampled: KIND=SAMPLED3D PIXEL=f32x4 SAMPLED=1 SPECULAR=1 COUNT=0
   module specular_count_sampled: KIND=SAMPLED3D PIXEL=f32x4 SAMPLED=1 SPECULAR=1 COUNT=1
   module clipmap_f32x4: KIND=READ PIXEL=f32x4 SAMPLED=0 SPECULAR=0 COUNT=0 CLIPMAP=1
   module clipmap_f16x4: KIND=READ PIXEL=f16x4 SAMPLED=0 SPECULAR=0 COUNT=0 CLIPMAP=1
   module clipmap_unorm8x4: KIND=READ PIXEL=unorm8x4 SAMPLED=0 SPECULAR=0 COUNT=0 CLIPMAP=1
   module count_clipmap_f32x4: KIND=READ PIXEL=f32x4 SAMPLED=0 SPECULAR=0 COUNT=1 CLIPMAP=1
   module count_clipmap_f16x4: KIND=READ PIXEL=f16x4 SAMPLED=0 SPECULAR=0 COUNT=1 CLIPMAP=1
   module count_clipmap_unorm8x4: KIND=READ PIXEL=unorm8x4 SAMPLED=0 SPECULAR=0 COUNT=1 CLIPMAP=1
   module specular_clipmap_f32x4: KIND=READ PIXEL=f32x4 SAMPLED=0 SPECULAR=1 COUNT=0 CLIPMAP=1
   module specular_clipmap_f16x4: KIND=READ PIXEL=f16x4 SAMPLED=0 SPECULAR=1 COUNT=0 CLIPMAP=1
   module specular_clipmap_unorm8x4: KIND=READ PIXEL=unorm8x4 SAMPLED=0 SPECULAR=1 COUNT=0 CLIPMAP=1
   module specular_count_clipmap_f32x4: KIND=READ PIXEL=f32x4 SAMPLED=0 SPECULAR=1 COUNT=1 CLIPMAP=1
   module specular_count_clipmap_f16x4: KIND=READ PIXEL=f16x4 SAMPLED=0 SPECULAR=1 COUNT=1 CLIPMAP=1
   module specular_count_clipmap_unorm8x4: KIND=READ PIXEL=unorm8x4 SAMPLED=0 SPECULAR=1 COUNT=1 CLIPMAP=1
*/
// Lengths count finest voxels, except where the name says otherwise. Spread of a cone: width of the voxels that it looks up
// by distance, 2 tan(aperture/2) times the footprint.
#define PARAMETERS(_) \
    _(int, width)      /* receivers in a row, and rows of them */ \
    _(int, height) \
    _(int, extent_x)   /* of the finest level */ \
    _(int, extent_y) \
    _(int, extent_z) \
    _(int, levels)     /* the finest counts */ \
    _(int, atlas_x)    /* extent of the image that holds all coarse levels */ \
    _(int, atlas_y) \
    _(int, atlas_z) \
    _(float, origin_x) /* of the volume, scene units */ \
    _(float, origin_y) \
    _(float, origin_z) \
    _(float, per_voxel)     /* finest voxels in a scene unit */ \
    _(float, normal_offset) /* cones start this far above the surface */ \
    _(float, start)         /* and are seen from here on */ \
    _(float, reach)         /* up to here */ \
    _(float, step_scale)    /* step, in voxels that are looked up (at least one of the finest) */ \
    _(int, step_cap) \
    _(float, stop)          /* a cone ends where no more than this part of light passes */ \
    _(float, gamma)         /* occluders at distance r count 1 / (1 + gamma r) */ \
    _(float, environment_r) /* radiance beyond the volume, and beyond reach; of the sky, where there is one, a factor */ \
    _(float, environment_g) \
    _(float, environment_b) \
    _(int, cones) \
    _(int, pattern_x)       /* the cones are dealt to this many neighbouring receivers of a row, and rows of them */ \
    _(int, pattern_y) \
    _(int, seed)            /* of the turns */ \
    _(int, sky_size)        /* points along a side of a level of the sky */
#define CONSTANTS(_) \
    _(0, int, ANISOTROPIC, 0)  /* 1: coarse levels are six directional volumes */ \
    _(1, int, RADIANCE, 1)     /* 0: only occlusion is wanted */ \
    _(2, int, OCCLUSION, 1)    /* 0: only radiance is wanted; 1: gamma is 0; 2: it is not */ \
    _(3, int, SKIP_EMPTY, 0)   /* 1: where the coarser of two levels is empty, the finer is not read */ \
    _(10, int, OWN_LENGTH, 1)  /* clipmap: opacity is per voxel of the level; 0: of the finest */ \
    _(4, int, ROTATE, 0)       /* 1: cones are turned about the normal, at random */ \
    _(5, int, SKY, 0)          /* 1: the environment is a sky */
#if COUNT
#define COUNTERS(_) _(UPDATE, 6, uint, counters)
#else
#define COUNTERS(_)
#endif
// A clipmap's levels stand one after the other in `fine`, all of the extent of the finest. Eight floats a level: the first
// voxel of its window, in finest voxels from that of the finest window; where that is stored; 1 / the width of its voxels
// (in finest ones); 1 / the voxels over which it gives way to the next.
#ifdef CLIPMAP
#define WINDOWED(_) _(UNIFORM, 9, 128, windows)
#else
#define WINDOWED(_)
#endif
#if SPECULAR
#define GATHERED specular
#define RECEIVED(_) \
    _(UNIFORM, 3, 136, spreads) \
    _(READ, 4, vec4, views) \
    _(WRITE, 5, vec4, specular)
#else
#define GATHERED irradiance
#define RECEIVED(_) \
    _(UNIFORM, 3, 512, cones) \
    _(WRITE, 5, vec4, irradiance)
#endif
#define BINDINGS(_) \
    _(KIND, 0, PIXEL, fine) \
    _(KIND, 1, PIXEL, coarse) \
    _(READ, 2, vec4, receivers) \
    _(READ, 7, vec4, sky) \
    RECEIVED(_) \
    WINDOWED(_) \
    COUNTERS(_)
