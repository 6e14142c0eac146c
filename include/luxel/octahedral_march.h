/// \file
/// octahedral_march: probes that hold radiance, normal and radial distance of all directions in octahedral maps, and rays
/// that are marched through them (McGuire, Mara, Nowrouzezahrai and Luebke, Real-Time Global Illumination using
/// Precomputed Light Field Probes, I3D 2017).
#pragma once
#include <array>

#include <luxel/plan.h>

namespace luxel {

/// Probes on a grid. Probe (x, y, z) is number x + count[0] * (y + count[1] * z). Eight neighbours are a cage; its corner
/// i is the probe at x = i & 1, y = i >> 1 & 1, z = i >> 2 from its lower one.
struct ProbeGrid {
  std::array<int, 3> count{1, 1, 1};          ///< along x, y, z; 1..1024 each, at most 65536 in all
  std::array<double, 3> origin{0, 0, 0};      ///< of probe 0, scene units
  std::array<double, 3> spacing{1, 1, 1};     ///< scene units, > 0
  bool placed = false;  ///< a buffer `positions` says where probes are (jitter, relocation) and which are of use: a vec4 a
                        ///< probe, xyz in scene units, w 1, or 0 for a probe that is not asked (inside geometry, say)
};

/// How radiance is stored; see ProbeMaps.
enum class ProbeRadiance { f32x4, f16x4, r11g11b10 };
/// How distance is stored; see ProbeMaps.
enum class ProbeDistance { f32, f16 };
/// How normals are stored; see ProbeMaps.
enum class ProbeNormal { none, snorm8, snorm16 };

/// Maps of probes: size x size texels in the octahedral map (pole +z, u right, v down; kernels/math/octahedral.h), one
/// buffer a quantity; texel (x, y) of a probe is number (probe * size + y) * size + x. Distances are radial, from the
/// probe, in the direction of the texel's centre:
///   radiance   f32x4, f16x4 (fourth channel 0), or r11g11b10: a u32 a texel, red lowest; no negative values
///   distance   f32: scene units, 1e30 (or more) where there is no surface; f16: in units of probe_unit(), 65504 where there
///              is none, two texels to a u32, the even number in the low half
///   normal     unit, world space, facing the probe: snorm8: 2 x 8 bits, two texels to a u32; snorm16: a u32 a texel
///              (kernels/math/direction_bits.h)
///   minimum    the least distance of ratio x ratio texels, as distance is stored: (size / ratio)^2 entries a probe
/// r11g11b10, f16 and snorm8 are 8 bytes a texel.
struct ProbeMaps {
  int size = 256;    ///< 16..2048, even, a multiple of the ratio
  int ratio = 16;    ///< 1 (no minimum map), 2, 4 .. 256, at most size
  ProbeRadiance radiance = ProbeRadiance::r11g11b10;  ///< how radiance is stored
  ProbeDistance distance = ProbeDistance::f16;  ///< how distance is stored
  ProbeNormal normal = ProbeNormal::snorm8;  ///< how normals are stored; none: there are none
};

/// Probes of a grid.
std::size_t probe_count(const ProbeGrid& grid);
/// What 1 stands for in f16 distances: the diagonal of a cage.
double probe_unit(const ProbeGrid& grid);
/// Elements (Resource::format) of the map buffers for `probes` probes.
std::size_t probe_radiance_elements(const ProbeMaps& maps, std::size_t probes);
/// The same of distance.
std::size_t probe_distance_elements(const ProbeMaps& maps, std::size_t probes);
/// The same of normals; 0 where there are none.
std::size_t probe_normal_elements(const ProbeMaps& maps, std::size_t probes);
/// The same of the minimum map; 0 where there is none.
std::size_t probe_minimum_elements(const ProbeMaps& maps, std::size_t probes);
/// Formats of these buffers.
Format probe_radiance_format(const ProbeMaps& maps);
/// Of distance, and of its minimum map.
Format probe_distance_format(const ProbeMaps& maps);
/// Bytes a texel of all maps together, without the minimum map.
double probe_texel_bytes(const ProbeMaps& maps);

/// Range checks shared by all parts. Errors: invalid_argument, naming field, value and range.
Status validate(const ProbeGrid& grid);
/// The same for maps of `probes` probes.
Status validate(const ProbeMaps& maps, std::size_t probes);

}  // namespace luxel
