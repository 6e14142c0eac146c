// What rays through one probe's maps should meet, in double, without walking: every texel of the map is a cone about the
// probe, clipped out of the ray in space.
#pragma once
#include <array>
#include <span>
#include <vector>

#include <luxel/probe_trace.h>

namespace luxel::truth {

using Vec3 = std::array<double, 3>;

/// Direction of a place (-1..1) of the octahedral map, and the place of a direction; pole +z.
Vec3 octahedral_direction(double u, double v);
std::array<double, 2> octahedral_place(const Vec3& direction);

/// The codes of kernels/math/direction_bits.h, decoded in double.
Vec3 direction_of_code(std::uint32_t code, int bits);

/// One probe's maps, decoded.
struct ProbeMap {
  int size = 0;
  std::vector<double> distance;  // 1e30 and above: no surface
  std::vector<Vec3> normal;      // empty: none are read
};

/// A ray about the probe; `direction` unit.
struct ProbeRay {
  Vec3 origin{}, direction{};
  double begin = 0, reach = 1e30;
};

struct ProbeAnswer {
  ProbeOutcome outcome = ProbeOutcome::miss;
  double t = 0;
  int texel = -1;
  double margin = 1e30;  // the least relative difference that any decision on the way turned on: where it is of the size of
                         // rounding, another answer is as good
};

/// The answer to a ray that starts at `from` along itself (begin: where the bias counts from).
ProbeAnswer probe_truth(const ProbeMap& map, const ProbeRay& ray, const ProbeTraceParams& params);

}  // namespace luxel::truth
