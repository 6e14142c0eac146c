// The dialect in OpenCL C 1.2: GLSL's names for types and functions, and the words. See README.md beside this file.
#pragma OPENCL FP_CONTRACT OFF
typedef float2 vec2;
typedef float3 vec3;
typedef float4 vec4;
typedef int2 ivec2;
typedef int3 ivec3;
typedef int4 ivec4;
typedef uint2 uvec2;
typedef uint3 uvec3;
typedef uint4 uvec4;
#define vec2(...) ((float2)(__VA_ARGS__))
#define vec3(...) ((float3)(__VA_ARGS__))
#define vec4(...) ((float4)(__VA_ARGS__))
#define ivec2(...) ((int2)(__VA_ARGS__))
#define ivec3(...) ((int3)(__VA_ARGS__))
#define ivec4(...) ((int4)(__VA_ARGS__))
#define uvec2(...) ((uint2)(__VA_ARGS__))
#define uvec3(...) ((uint3)(__VA_ARGS__))
#define uvec4(...) ((uint4)(__VA_ARGS__))
#define float(v) ((float)(v))
#define int(v) ((int)(v))
#define uint(v) ((uint)(v))
#define floatBitsToUint(v) as_uint(v)
#define floatBitsToInt(v) as_int(v)
#define uintBitsToFloat(v) as_float(v)
#define intBitsToFloat(v) as_float(v)
#define OVERLOAD static inline __attribute__((overloadable))
OVERLOAD float abs(float v) { return fabs(v); }
OVERLOAD float2 abs(float2 v) { return fabs(v); }
OVERLOAD float3 abs(float3 v) { return fabs(v); }
OVERLOAD float4 abs(float4 v) { return fabs(v); }

#define FN static inline
#define CTX const Parameters params BINDINGS(OCL_PARAMETER) SHARED_MEMORY(OCL_SHARED)
#define ctx params BINDINGS(OCL_ARGUMENT) SHARED_MEMORY(OCL_SHARED_ARGUMENT)
#define KERNEL(name) \
    __kernel __attribute__((reqd_work_group_size(WORKGROUP_X, WORKGROUP_Y, WORKGROUP_Z))) \
    void name(const Parameters params BINDINGS(OCL_KERNEL_PARAMETER) SHARED_MEMORY(OCL_SHARED))
#define FIRST
#define THEN barrier(CLK_LOCAL_MEM_FENCE);
#define UNROLL _Pragma("unroll")
#define invocation_x() ((int)get_global_id(0))
#define invocation_y() ((int)get_global_id(1))
#define invocation_z() ((int)get_global_id(2))
#define local_x() ((int)get_local_id(0))
#define local_y() ((int)get_local_id(1))
#define local_z() ((int)get_local_id(2))
#define group_x() ((int)get_group_id(0))
#define group_y() ((int)get_group_id(1))
#define group_z() ((int)get_group_id(2))

// Parameters and bindings. Every line of a list becomes a parameter or an argument behind `params`.
#define OCL_MEMBER(type, name) type name;
#define OCL_SHARED(type, count, name) , __local type* name
#define OCL_SHARED_ARGUMENT(type, count, name) , name
// Only the kernel's own are `restrict`: where a function's are, Oclgrind stops at what the compiler makes of inlining it.
#define OCL_PARAMETER(kind, slot, type, name) OCL_PARAMETER_(kind, type, name, )
#define OCL_KERNEL_PARAMETER(kind, slot, type, name) OCL_PARAMETER_(kind, type, name, restrict)
#define OCL_PARAMETER_(kind, type, name, alone) OCL_##kind(type, name, alone)
#define OCL_ARGUMENT(kind, slot, type, name) OCL_ARGUMENT_(kind, slot, type, name)
#define OCL_ARGUMENT_(kind, slot, type, name) OCL_ARG_##kind(name)
#define OCL_READ(type, name, alone) , __global const OCL_TYPE_##type* alone name
#define OCL_TEXELS(type, name, alone) , __global const OCL_TYPE_##type* alone name
#define OCL_WRITE(type, name, alone) , __global OCL_TYPE_##type* alone name
#define OCL_UPDATE(type, name, alone) , volatile __global OCL_TYPE_##type* name
#define OCL_UNIFORM(count, name, alone) , __constant float* alone name
#define OCL_IMAGE2D(type, name, alone) , __read_only image2d_t name
#define OCL_IMAGE_READ2D(type, name, alone) , __read_only image2d_t name
#define OCL_IMAGE3D(type, name, alone) , __read_only image3d_t name
#define OCL_SAMPLED2D(type, name, alone) , __read_only image2d_t name, sampler_t name##_sampler
#define OCL_SAMPLED3D(type, name, alone) , __read_only image3d_t name, sampler_t name##_sampler
#define OCL_IMAGE_WRITE2D(type, name, alone) , __write_only image2d_t name
#define OCL_ARG_READ(name) , name
#define OCL_ARG_TEXELS(name) , name
#define OCL_ARG_WRITE(name) , name
#define OCL_ARG_UPDATE(name) , name
#define OCL_ARG_UNIFORM(name) , name
#define OCL_ARG_IMAGE2D(name) , name
#define OCL_ARG_IMAGE_READ2D(name) , name
#define OCL_ARG_IMAGE3D(name) , name
#define OCL_ARG_SAMPLED2D(name) , name, name##_sampler
#define OCL_ARG_SAMPLED3D(name) , name, name##_sampler
#define OCL_ARG_IMAGE_WRITE2D(name) , name
#define OCL_TYPE_float float
#define OCL_TYPE_vec4 float4
#define OCL_TYPE_uint uint
#define OCL_TYPE_int int
#define OCL_TYPE_f32x1 float
#define OCL_TYPE_f32x2 float2
#define OCL_TYPE_f32x4 float4
#define OCL_TYPE_f16x2 ushort2
#define OCL_TYPE_f16x4 ushort4
#define OCL_TYPE_unorm8x4 uchar4

// wide: LANES neighbouring channels, PIXELS whole pixels.
#ifndef LANES
#define LANES CHANNELS
#endif
#define OCL_JOIN(a, b) OCL_JOIN_(a, b)
#define OCL_JOIN_(a, b) a##b
#if CHANNELS == 1
typedef float pixel;
#else
typedef OCL_JOIN(float, CHANNELS) pixel;
#endif
#if LANES == 1
typedef float wide;
#else
typedef OCL_JOIN(float, LANES) wide;
#endif
#define PIXELS (LANES / CHANNELS)
#define ARRAY(type, name, count) type name[count];
// yes where `which` is not 0, else no.
#if LANES == 1
OVERLOAD wide choose(wide which, wide yes, wide no) { return which != 0.0f ? yes : no; }
#else
OVERLOAD wide choose(wide which, wide yes, wide no) { return select(no, yes, which != 0.0f); }
#endif
#define wide_splat(s) ((wide)(s))
OVERLOAD pixel get_pixel(wide w, int k) { return ((const pixel*)&w)[k]; }
#define set_pixel(w, k, p) ((pixel*)&(w))[k] = (p)
// w with the fourth channel of each pixel taken from `alpha`.
OVERLOAD wide with_alpha_of(wide w, wide alpha) {
#if CHANNELS == 4
    UNROLL for (int k = 3; k < LANES; k += 4) ((float*)&w)[k] = ((const float*)&alpha)[k];
#endif
    return w;
}

#include "math/packing.h"

// Words that touch memory; `stride` and `x` count pixels.
#define load(b, i) ((b)[i])
#define store(b, i, v) (b)[i] = (v)
#define table(b, i) ((b)[i])
OVERLOAD float ocl_decode(float v) { return v; }
OVERLOAD float2 ocl_decode(float2 v) { return v; }
OVERLOAD float4 ocl_decode(float4 v) { return v; }
OVERLOAD float2 ocl_decode(ushort2 v) { return vload_half2(0, (const __private half*)&v); }
OVERLOAD float4 ocl_decode(ushort4 v) { return vload_half4(0, (const __private half*)&v); }
OVERLOAD float4 ocl_decode(uchar4 v) { return convert_float4(v) / 255.0f; }
OVERLOAD void ocl_encode(__global float* b, float v) { *b = v; }
OVERLOAD void ocl_encode(__global float2* b, float2 v) { *b = v; }
OVERLOAD void ocl_encode(__global float4* b, float4 v) { *b = v; }
OVERLOAD void ocl_encode(__global ushort2* b, float2 v) { *b = (ushort2)(f16_bits(v.x), f16_bits(v.y)); }
OVERLOAD void ocl_encode(__global ushort4* b, float4 v) {
    *b = (ushort4)(f16_bits(v.x), f16_bits(v.y), f16_bits(v.z), f16_bits(v.w));
}
OVERLOAD void ocl_encode(__global uchar4* b, float4 v) {
    *b = (uchar4)(unorm8_bits(v.x), unorm8_bits(v.y), unorm8_bits(v.z), unorm8_bits(v.w));
}
__constant sampler_t ocl_nearest = CLK_NORMALIZED_COORDS_FALSE | CLK_ADDRESS_NONE | CLK_FILTER_NEAREST;
#if CHANNELS == 1
#define OCL_CHANNELS(v) (v).x
#define OCL_TEXEL(v) (float4)(v, 0.0f, 0.0f, 0.0f)
#elif CHANNELS == 2
#define OCL_CHANNELS(v) (v).xy
#define OCL_TEXEL(v) (float4)(v, 0.0f, 0.0f)
#else
#define OCL_CHANNELS(v) (v)
#define OCL_TEXEL(v) (v)
#endif
#define OCL_ACCESS(stored, type) \
    OVERLOAD type load_pixel(__global const stored* b, int stride, int x, int y) { return ocl_decode(b[y * stride + x]); } \
    OVERLOAD void store_pixel(__global stored* b, int stride, int x, int y, type v) { ocl_encode(b + y * stride + x, v); } \
    OVERLOAD type load_voxel(__global const stored* b, int3 extent, int3 p) { \
        return ocl_decode(b[(p.z * extent.y + p.y) * extent.x + p.x]); \
    } \
    OVERLOAD void store_voxel(__global stored* b, int3 extent, int3 p, type v) { \
        ocl_encode(b + (p.z * extent.y + p.y) * extent.x + p.x, v); \
    }
OCL_ACCESS(float, float)
OCL_ACCESS(float2, float2)
OCL_ACCESS(float4, float4)
OCL_ACCESS(ushort2, float2)
OCL_ACCESS(ushort4, float4)
OCL_ACCESS(uchar4, float4)
OVERLOAD pixel load_pixel(__read_only image2d_t b, int stride, int x, int y) {
    return OCL_CHANNELS(read_imagef(b, ocl_nearest, (int2)(x, y)));
}
OVERLOAD void store_pixel(__write_only image2d_t b, int stride, int x, int y, pixel v) {
    write_imagef(b, (int2)(x, y), OCL_TEXEL(v));
}
OVERLOAD pixel load_voxel(__read_only image3d_t b, int3 extent, int3 p) {
    return OCL_CHANNELS(read_imagef(b, ocl_nearest, (int4)(p, 0)));
}
#define sample2d(b, uv) OCL_CHANNELS(read_imagef(b, b##_sampler, uv))
#define sample3d(b, uvw, level) OCL_CHANNELS(read_imagef(b, b##_sampler, (float4)(uvw, 0.0f)))

#if LANES == CHANNELS
#define load_wide(b, stride, x, y) load_pixel(b, stride, x, y)
#define store_wide(b, stride, x, y, v) store_pixel(b, stride, x, y, v)
#else
// A plain load of a vector that is only aligned to its elements: vloadN is put together from halves, which the compiler
// then takes apart again around the next addition.
typedef wide ocl_wide __attribute__((aligned(4)));
#define OCL_WIDE_FLOAT(stored) \
    OVERLOAD wide load_wide(__global const stored* b, int stride, int x, int y) { \
        return *(__global const ocl_wide*)(b + y * stride + x); \
    } \
    OVERLOAD void store_wide(__global stored* b, int stride, int x, int y, wide v) { \
        *(__global ocl_wide*)(b + y * stride + x) = v; \
    }
OCL_WIDE_FLOAT(float)
OCL_WIDE_FLOAT(float2)
OCL_WIDE_FLOAT(float4)
#define OCL_WIDE_HALF(stored) \
    OVERLOAD wide load_wide(__global const stored* b, int stride, int x, int y) { \
        return OCL_JOIN(vload_half, LANES)(0, (__global const half*)(b + y * stride + x)); \
    } \
    OVERLOAD void store_wide(__global stored* b, int stride, int x, int y, wide v) { \
        __global ushort* to = (__global ushort*)(b + y * stride + x); \
        UNROLL for (int i = 0; i < LANES; ++i) to[i] = (ushort)f16_bits(((const float*)&v)[i]); \
    }
OCL_WIDE_HALF(ushort2)
OCL_WIDE_HALF(ushort4)
OVERLOAD wide load_wide(__global const uchar4* b, int stride, int x, int y) {
    return OCL_JOIN(convert_float, LANES)(OCL_JOIN(vload, LANES)(0, (__global const uchar*)(b + y * stride + x))) / 255.0f;
}
OVERLOAD void store_wide(__global uchar4* b, int stride, int x, int y, wide v) {
    __global uchar* to = (__global uchar*)(b + y * stride + x);
    UNROLL for (int i = 0; i < LANES; ++i) to[i] = (uchar)unorm8_bits(((const float*)&v)[i]);
}
OVERLOAD wide load_wide(__read_only image2d_t b, int stride, int x, int y) {
    wide w;
    UNROLL for (int k = 0; k < PIXELS; ++k) set_pixel(w, k, load_pixel(b, stride, x + k, y));
    return w;
}
#endif

// The words take the names of OpenCL's functions, which may be macros themselves: reach those first.
#define OCL_ATOMICS(type) \
    OVERLOAD type ocl_atomic_add(volatile __global type* p, type v) { return atomic_add(p, v); } \
    OVERLOAD type ocl_atomic_min(volatile __global type* p, type v) { return atomic_min(p, v); } \
    OVERLOAD type ocl_atomic_max(volatile __global type* p, type v) { return atomic_max(p, v); } \
    OVERLOAD type ocl_atomic_swap(volatile __global type* p, type e, type v) { return atomic_cmpxchg(p, e, v); }
OCL_ATOMICS(int)
OCL_ATOMICS(uint)
#undef atomic_add
#undef atomic_min
#undef atomic_max
#define atomic_add(b, i, v) ocl_atomic_add((b) + (i), v)
#define atomic_min(b, i, v) ocl_atomic_min((b) + (i), v)
#define atomic_max(b, i, v) ocl_atomic_max((b) + (i), v)
#define atomic_compare_swap(b, i, expected, v) ocl_atomic_swap((b) + (i), expected, v)
