// The dialect in C++ with GLM: a kernel file is included inside a struct whose members are its bindings. See README.md
// beside this file; host/reference/words.h has what the words stand for.
#define FN inline
#define CTX Ctx
#define ctx Ctx{}
#define KERNEL(name) void kernel_([[maybe_unused]] int phase_)
#define FIRST int at_ = 0; if (at_++ == phase_)
#define THEN if (at_++ == phase_)
#define UNROLL
#define invocation_x() this->global_.x
#define invocation_y() this->global_.y
#define invocation_z() this->global_.z
#define local_x() this->local_.x
#define local_y() this->local_.y
#define local_z() this->local_.z
#define group_x() this->group_.x
#define group_y() this->group_.y
#define group_z() this->group_.z

#define pixel Pixel<float, CHANNELS>
#define wide Wide<float, LANES>
#define PIXELS (LANES / CHANNELS)
#define ARRAY(type, name, count) std::vector<type> name(count);
#define wide_splat(s) splat<wide, float>(s)
#define get_pixel(w, k) pixel_of<pixel>(w, k)
#define set_pixel(w, k, p) put_pixel<pixel>(w, k, p)

#define CPP_PARAMETER(type, name) type name;
#define CPP_PARAMETER_SET(type, name) params.name = static_cast<type>(d_.parameters[i_++]);
#define CPP_CONSTANT(id, type, name, fallback) type name = fallback;
#define CPP_CONSTANT_SET(id, type, name, fallback) name = static_cast<type>(d_.constants[i_++]);
#define CPP_SHAPE(id, type, name, fallback) static constexpr type name = fallback;
#define CPP_SHARED(type, count, name) Shared<type, count> name;
#define CPP_SHARED_SET(type, count, name) name.outside = d_.outside;
#define CPP_BINDING(kind, slot, type, name) CPP_BINDING_(kind, slot, type, name)
#define CPP_BINDING_(kind, slot, type, name) CPP_##kind(type, name)
#define CPP_BINDING_SET(kind, slot, type, name) name.memory = &d_.bindings[i_++]; name.outside = d_.outside;
#define CPP_READ(type, name) CPP_TYPE_##type name;
#define CPP_WRITE(type, name) CPP_TYPE_##type name;
#define CPP_UPDATE(type, name) CPP_TYPE_##type name;
#define CPP_TEXELS(type, name) CPP_TYPE_##type name;
#define CPP_IMAGE_WRITE2D(type, name) CPP_TYPE_##type name;
#define CPP_UNIFORM(count, name) Array<float> name;
#define CPP_IMAGE2D(type, name) Texture<float> name;
#define CPP_IMAGE_READ2D(type, name) Texture<float> name;
#define CPP_IMAGE3D(type, name) Texture<float> name;
#define CPP_SAMPLED2D(type, name) Texture<float> name;
#define CPP_SAMPLED3D(type, name) Texture<float> name;
#define CPP_TYPE_float Array<float>
#define CPP_TYPE_double Array<double>
#define CPP_TYPE_vec4 Array<vec4>
#define CPP_TYPE_dvec4 Array<dvec4>
#define CPP_TYPE_uint Array<uint>
#define CPP_TYPE_int Array<int>
#define CPP_TYPE_f32x1 Pixels<float, f32x1>
#define CPP_TYPE_f32x2 Pixels<float, f32x2>
#define CPP_TYPE_f32x4 Pixels<float, f32x4>
#define CPP_TYPE_f16x2 Pixels<float, f16x2>
#define CPP_TYPE_f16x4 Pixels<float, f16x4>
#define CPP_TYPE_unorm8x4 Pixels<float, unorm8x4>

#define load(b, i) (b).get(i)
#define store(b, i, v) (b).put(i, v)
#define table(b, i) (b).get(i)
#define load_pixel(b, stride, x, y) fetch_pixel<pixel>(b, stride, x, y)
#define store_pixel(b, stride, x, y, v) (b).store_pixel_(stride, x, y, v)
#define load_wide(b, stride, x, y) fetch_wide<wide, pixel>(b, stride, x, y)
#define store_wide(b, stride, x, y, v) (b).store_wide_(stride, x, y, v)
#define load_voxel(b, extent, p) fetch_voxel<pixel>(b, extent, p)
#define store_voxel(b, extent, p, v) (b).store_voxel_(extent, p, v)
#define sample2d(b, uv) take<pixel>((b).linear(vec3(uv, 0.0f)))
#define sample3d(b, uvw, level) take<pixel>((b).linear(uvw))
#define atomic_add(b, i, a) (b).atomic(i, [&](auto old_) { return old_ + (a); })
#define atomic_min(b, i, a) (b).atomic(i, [&](auto old_) { return old_ < (a) ? old_ : (a); })
#define atomic_max(b, i, a) (b).atomic(i, [&](auto old_) { return old_ > (a) ? old_ : (a); })
#define atomic_compare_swap(b, i, expected, v) \
    (b).atomic(i, [&](auto old_) { return old_ == (expected) ? (v) : old_; })
