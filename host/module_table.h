// Turns a signature's lists into the tables of host/module.h. The last entry of each array only keeps it from being empty.
#pragma once
#include "host/module.h"

namespace luxel {
constexpr Scalar scalar_of(int) { return Scalar::int32; }
constexpr Scalar scalar_of(unsigned) { return Scalar::uint32; }
constexpr Scalar scalar_of(float) { return Scalar::float32; }
}  // namespace luxel

#define TABLE_BINDING(kind, slot, type, name) TABLE_BINDING_(kind, slot, type, name)
#define TABLE_BINDING_(kind, slot, type, name) BindingInfo{TABLE_##kind, slot, #type, #name, TABLE_COUNT_##kind(type)},
#define TABLE_PARAMETER(type, name) ParameterInfo{scalar_of(type{}), #name},
#define TABLE_CONSTANT(id, type, name, fallback) ConstantInfo{id, scalar_of(type{}), #name, fallback, false},
#define TABLE_SHAPE(id, type, name, fallback) ConstantInfo{id, scalar_of(type{}), #name, fallback, true},
#define TABLE_SHARED(type, count, name) SharedInfo{sizeof(type) * (count), #name},
#define TABLE_READ BindingKind::read
#define TABLE_WRITE BindingKind::write
#define TABLE_UPDATE BindingKind::update
#define TABLE_TEXELS BindingKind::texels
#define TABLE_UNIFORM BindingKind::uniform
#define TABLE_IMAGE2D BindingKind::image2d
#define TABLE_IMAGE3D BindingKind::image3d
#define TABLE_SAMPLED2D BindingKind::sampled2d
#define TABLE_SAMPLED3D BindingKind::sampled3d
#define TABLE_IMAGE_WRITE2D BindingKind::image_write2d
#define TABLE_IMAGE_READ2D BindingKind::image_read2d
#define TABLE_COUNT_IMAGE_READ2D(type) 0
#define TABLE_COUNT_READ(type) 0
#define TABLE_COUNT_WRITE(type) 0
#define TABLE_COUNT_UPDATE(type) 0
#define TABLE_COUNT_TEXELS(type) 0
#define TABLE_COUNT_UNIFORM(type) type
#define TABLE_COUNT_IMAGE2D(type) 0
#define TABLE_COUNT_IMAGE3D(type) 0
#define TABLE_COUNT_SAMPLED2D(type) 0
#define TABLE_COUNT_SAMPLED3D(type) 0
#define TABLE_COUNT_IMAGE_WRITE2D(type) 0
