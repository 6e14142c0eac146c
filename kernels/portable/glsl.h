// The dialect in GLSL 450: nearly nothing, since the dialect is spelled like GLSL. See README.md beside this file.
#define FN
#define CTX int ctx_
#define ctx 0
#define KERNEL(name) void main()
#define FIRST
#define THEN memoryBarrierShared(); barrier();
#define UNROLL [[unroll]]
#define invocation_x() int(gl_GlobalInvocationID.x)
#define invocation_y() int(gl_GlobalInvocationID.y)
#define invocation_z() int(gl_GlobalInvocationID.z)
#define local_x() int(gl_LocalInvocationID.x)
#define local_y() int(gl_LocalInvocationID.y)
#define local_z() int(gl_LocalInvocationID.z)
#define group_x() int(gl_WorkGroupID.x)
#define group_y() int(gl_WorkGroupID.y)
#define group_z() int(gl_WorkGroupID.z)
layout(local_size_x_id = 100, local_size_y_id = 101, local_size_z_id = 102) in;

// One wide is one pixel here: the driver puts neighbouring invocations side by side itself.
#define PIXELS 1
#if CHANNELS == 1
#define wide float
#define pixel float
wide choose(wide which, wide yes, wide no) { return which != 0.0f ? yes : no; }
#define with_alpha_of(w, alpha) (w)
#elif CHANNELS == 2
#define wide vec2
#define pixel vec2
wide choose(wide which, wide yes, wide no) { return mix(no, yes, notEqual(which, vec2(0.0f))); }
#define with_alpha_of(w, alpha) (w)
#else
#define wide vec4
#define pixel vec4
wide choose(wide which, wide yes, wide no) { return mix(no, yes, notEqual(which, vec4(0.0f))); }
vec4 with_alpha_of(vec4 w, vec4 alpha) { return vec4(w.xyz, alpha.w); }
#endif
#define wide_splat(s) wide(s)
#define ARRAY(type, name, count) type name[count];
#define get_pixel(w, k) (w)
#define set_pixel(w, k, p) w = (p)

#include "math/packing.h"
vec4 f16x4_value(uvec2 u) { return vec4(unpackHalf2x16(u.x), unpackHalf2x16(u.y)); }
uint f16x2_bits(vec2 v) { return f16_bits(v.x) | (f16_bits(v.y) << 16); }
uvec2 f16x4_bits(vec4 v) { return uvec2(f16x2_bits(v.xy), f16x2_bits(v.zw)); }
vec4 unorm8x4_value(uint u) {
    return vec4(float(u & 255u), float((u >> 8) & 255u), float((u >> 16) & 255u), float(u >> 24)) / 255.0f;
}
uint unorm8x4_bits(vec4 v) {
    return unorm8_bits(v.x) | (unorm8_bits(v.y) << 8) | (unorm8_bits(v.z) << 16) | (unorm8_bits(v.w) << 24);
}

// Parameters, constants, workgroup memory.
#define GLSL_PARAMETER(type, name) type name;
#define GLSL_CONSTANT(id, type, name, fallback) layout(constant_id = id) const type name = fallback;
#define GLSL_SHARED(type, count, name) shared type name[count];

// Bindings. Every kind defines what the words below paste a binding's name onto.
#define GLSL_BINDING(kind, slot, type, name) GLSL_BINDING_(kind, slot, type, name)
#define GLSL_BINDING_(kind, slot, type, name) GLSL_##kind(slot, type, name)
#define GLSL_READ(slot, type, name) GLSL_READ_##type(slot, name)
#define GLSL_WRITE(slot, type, name) GLSL_WRITE_##type(slot, name)
#define GLSL_UPDATE(slot, type, name) layout(std430, set = 0, binding = slot) buffer name##_block { type name[]; };
#define GLSL_UNIFORM(slot, count, name) \
    layout(std140, set = 0, binding = slot) uniform name##_block { vec4 name[((count) + 3) / 4]; };

#define GLSL_IN(slot, type, name) \
    layout(std430, set = 0, binding = slot) restrict readonly buffer name##_block { type name[]; };
#define GLSL_READ_PIXELS(slot, stored, type, decode, name) \
    GLSL_IN(slot, stored, name) \
    type load_pixel_##name(int stride, int x, int y) { return decode(name[y * stride + x]); } \
    type load_voxel_##name(ivec3 extent, ivec3 p) { return decode(name[(p.z * extent.y + p.y) * extent.x + p.x]); }
#define GLSL_READ_float(slot, name) GLSL_IN(slot, float, name)
#define GLSL_READ_vec4(slot, name) GLSL_IN(slot, vec4, name)
#define GLSL_READ_uint(slot, name) GLSL_IN(slot, uint, name)
#define GLSL_READ_int(slot, name) GLSL_IN(slot, int, name)
#define GLSL_READ_f32x1(slot, name) GLSL_READ_PIXELS(slot, float, float, float, name)
#define GLSL_READ_f32x2(slot, name) GLSL_READ_PIXELS(slot, vec2, vec2, vec2, name)
#define GLSL_READ_f32x4(slot, name) GLSL_READ_PIXELS(slot, vec4, vec4, vec4, name)
#define GLSL_READ_f16x2(slot, name) GLSL_READ_PIXELS(slot, uint, vec2, unpackHalf2x16, name)
#define GLSL_READ_f16x4(slot, name) GLSL_READ_PIXELS(slot, uvec2, vec4, f16x4_value, name)
#define GLSL_READ_unorm8x4(slot, name) GLSL_READ_PIXELS(slot, uint, vec4, unorm8x4_value, name)

#define GLSL_OUT(slot, type, name) \
    layout(std430, set = 0, binding = slot) restrict writeonly buffer name##_block { type name[]; };
#define GLSL_WRITE_PIXELS(slot, stored, type, encode, name) \
    GLSL_OUT(slot, stored, name) \
    void store_pixel_##name(int stride, int x, int y, type v) { name[y * stride + x] = encode(v); } \
    void store_voxel_##name(ivec3 extent, ivec3 p, type v) { name[(p.z * extent.y + p.y) * extent.x + p.x] = encode(v); }
#define GLSL_WRITE_float(slot, name) GLSL_OUT(slot, float, name)
#define GLSL_WRITE_vec4(slot, name) GLSL_OUT(slot, vec4, name)
#define GLSL_WRITE_uint(slot, name) GLSL_OUT(slot, uint, name)
#define GLSL_WRITE_int(slot, name) GLSL_OUT(slot, int, name)
#define GLSL_WRITE_f32x1(slot, name) GLSL_WRITE_PIXELS(slot, float, float, float, name)
#define GLSL_WRITE_f32x2(slot, name) GLSL_WRITE_PIXELS(slot, vec2, vec2, vec2, name)
#define GLSL_WRITE_f32x4(slot, name) GLSL_WRITE_PIXELS(slot, vec4, vec4, vec4, name)
#define GLSL_WRITE_f16x2(slot, name) GLSL_WRITE_PIXELS(slot, uint, vec2, f16x2_bits, name)
#define GLSL_WRITE_f16x4(slot, name) GLSL_WRITE_PIXELS(slot, uvec2, vec4, f16x4_bits, name)
#define GLSL_WRITE_unorm8x4(slot, name) GLSL_WRITE_PIXELS(slot, uint, vec4, unorm8x4_bits, name)

// Texel buffers and images hand out four channels; a pixel takes as many as it has.
#if CHANNELS == 1
#define GLSL_CHANNELS(v) (v).x
#elif CHANNELS == 2
#define GLSL_CHANNELS(v) (v).xy
#else
#define GLSL_CHANNELS(v) (v)
#endif
// Drivers turn unorm8 into floats in ways of their own: texel buffers hand out its integers, and of what images hand out
// the integer is found again, so that the value has the same bits as everywhere.
#define GLSL_SAME(v) (v)
#define GLSL_UNORM8(v) (floor((v) * 255.0f + 0.5f) / 255.0f)
#define GLSL_DECODE_f32x1 GLSL_SAME
#define GLSL_DECODE_f32x2 GLSL_SAME
#define GLSL_DECODE_f32x4 GLSL_SAME
#define GLSL_DECODE_f16x2 GLSL_SAME
#define GLSL_DECODE_f16x4 GLSL_SAME
#define GLSL_DECODE_unorm8x4 GLSL_UNORM8
#define GLSL_TEXEL_BUFFER(slot, kind, decode, name) \
    layout(set = 0, binding = slot) uniform kind name; \
    pixel load_pixel_##name(int stride, int x, int y) { return GLSL_CHANNELS(decode(texelFetch(name, y * stride + x))); }
vec4 unorm8_texel(uvec4 v) { return vec4(v) / 255.0f; }
#define GLSL_TEXELS(slot, type, name) GLSL_TEXELS_##type(slot, name)
#define GLSL_TEXELS_f32x1(slot, name) GLSL_TEXEL_BUFFER(slot, textureBuffer, GLSL_SAME, name)
#define GLSL_TEXELS_f32x2(slot, name) GLSL_TEXEL_BUFFER(slot, textureBuffer, GLSL_SAME, name)
#define GLSL_TEXELS_f32x4(slot, name) GLSL_TEXEL_BUFFER(slot, textureBuffer, GLSL_SAME, name)
#define GLSL_TEXELS_f16x2(slot, name) GLSL_TEXEL_BUFFER(slot, textureBuffer, GLSL_SAME, name)
#define GLSL_TEXELS_f16x4(slot, name) GLSL_TEXEL_BUFFER(slot, textureBuffer, GLSL_SAME, name)
#define GLSL_TEXELS_unorm8x4(slot, name) GLSL_TEXEL_BUFFER(slot, utextureBuffer, unorm8_texel, name)
#define GLSL_IMAGE2D(slot, type, name) \
    layout(set = 0, binding = slot) uniform texture2D name; \
    pixel load_pixel_##name(int stride, int x, int y) { \
        return GLSL_CHANNELS(GLSL_DECODE_##type(texelFetch(name, ivec2(x, y), 0))); \
    }
#define GLSL_IMAGE3D(slot, type, name) \
    layout(set = 0, binding = slot) uniform texture3D name; \
    pixel load_voxel_##name(ivec3 extent, ivec3 p) { return GLSL_CHANNELS(GLSL_DECODE_##type(texelFetch(name, p, 0))); }
#define GLSL_IMAGE_READ2D(slot, type, name) \
    layout(set = 0, binding = slot, GLSL_IMAGE_FORMAT_##type) restrict readonly uniform image2D name; \
    pixel load_pixel_##name(int stride, int x, int y) { \
        return GLSL_CHANNELS(GLSL_DECODE_##type(imageLoad(name, ivec2(x, y)))); \
    }
#define GLSL_SAMPLED2D(slot, type, name) layout(set = 0, binding = slot) uniform sampler2D name;
#define GLSL_SAMPLED3D(slot, type, name) layout(set = 0, binding = slot) uniform sampler3D name;
#define GLSL_IMAGE_FORMAT_f32x1 r32f
#define GLSL_IMAGE_FORMAT_f32x2 rg32f
#define GLSL_IMAGE_FORMAT_f32x4 rgba32f
#define GLSL_IMAGE_FORMAT_f16x4 rgba16f
#define GLSL_IMAGE_FORMAT_unorm8x4 rgba8
#define GLSL_IMAGE_WRITE2D(slot, type, name) \
    layout(set = 0, binding = slot, GLSL_IMAGE_FORMAT_##type) restrict writeonly uniform image2D name; \
    void store_pixel_##name(int stride, int x, int y, pixel v) { imageStore(name, ivec2(x, y), GLSL_TEXEL(v)); }
#if CHANNELS == 1
#define GLSL_TEXEL(v) vec4(v, 0.0f, 0.0f, 0.0f)
#elif CHANNELS == 2
#define GLSL_TEXEL(v) vec4(v, 0.0f, 0.0f)
#else
#define GLSL_TEXEL(v) (v)
#endif

// Words that touch memory.
#define load(b, i) b[i]
#define store(b, i, v) b[i] = (v)
#define table(b, i) b[(i) >> 2][(i) & 3]
#define load_pixel(b, stride, x, y) load_pixel_##b(stride, x, y)
#define store_pixel(b, stride, x, y, v) store_pixel_##b(stride, x, y, v)
#define load_wide(b, stride, x, y) load_pixel_##b(stride, x, y)
#define store_wide(b, stride, x, y, v) store_pixel_##b(stride, x, y, v)
#define load_voxel(b, extent, p) load_voxel_##b(extent, p)
#define store_voxel(b, extent, p, v) store_voxel_##b(extent, p, v)
#define sample2d(b, uv) GLSL_CHANNELS(textureLod(b, uv, 0.0f))
#define sample3d(b, uvw, level) GLSL_CHANNELS(textureLod(b, uvw, level))
#define atomic_add(b, i, v) atomicAdd(b[i], v)
#define atomic_min(b, i, v) atomicMin(b[i], v)
#define atomic_max(b, i, v) atomicMax(b[i], v)
#define atomic_compare_swap(b, i, expected, v) atomicCompSwap(b[i], expected, v)
