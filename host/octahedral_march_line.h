// Launches over lists, and resources, that the parts of octahedral_march share.
#pragma once
#include <algorithm>
#include <array>

#include <luxel/octahedral_march.h>

#include "host/planner.h"

namespace luxel {

struct ProbeLine {
  std::array<std::uint32_t, 3> workgroup, invocations;
};

/// A launch that strides over `count` items: invocations are whole workgroups, at most 2^20.
inline ProbeLine probe_line(std::size_t count, const Profile& profile) {
  const auto& block = profile.pixels.workgroup;
  const std::uint32_t wide = block[0] * block[1] * block[2], most = std::max((1u << 20) / wide, 1u) * wide;
  const std::size_t whole = (std::max<std::size_t>(count, 1) + wide - 1) / wide * wide;
  return {{wide, 1, 1}, {static_cast<std::uint32_t>(std::min<std::size_t>(whole, most)), 1, 1}};
}

inline Slot probe_buffer(Planner& planner, const char* name, Format format, std::size_t count, bool written) {
  Resource r{name};
  r.format = format;
  r.bytes = count * bytes_per_pixel(format);
  r.written = written;
  return planner.resource(r);
}

inline std::size_t probe_texels(const ProbeMaps& m, std::size_t probes) {
  return probes * static_cast<std::size_t>(m.size) * static_cast<std::size_t>(m.size);
}

}  // namespace luxel
