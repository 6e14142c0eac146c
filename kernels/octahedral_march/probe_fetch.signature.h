/* BUILD
   math: small_float
   module f32x4: STORED=f32x4 PACKED=0
   module f16x4: STORED=f16x4 PACKED=0
   module r11g11b10: STORED=uint PACKED=1
*/
#define PARAMETERS(_) \
    _(int, rays) \
    _(int, texel_count)    /* of all maps */ \
    _(int, stride)         /* invocations */ \
    _(float, environment_r) \
    _(float, environment_g) \
    _(float, environment_b)
#define BINDINGS(_) \
    _(READ, 0, vec4, hits) \
    _(READ, 1, uint, texels) \
    _(READ, 2, STORED, radiance) \
    _(WRITE, 3, vec4, seen)
