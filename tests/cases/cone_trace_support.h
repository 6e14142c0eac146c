// Cones traced through a pyramid that mip_build makes on the device: what tests, cases and the report share.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <luxel/cone_trace.h>
#include <luxel/device.h>

#include "tests/cases/case.h"

namespace luxel::cases {

using Values = std::vector<double>;

/// A pyramid of premultiplied radiance and opacity on a device, and lists of receivers to trace from.
class ConeScene {
 public:
  /// Builds all levels of the params' volume from level 0, [z][y][x][4]. The context must outlive it.
  static Result<ConeScene> make(Context& context, const ConeTraceParams& params, std::span<const double> level_0);
  /// The same from level 0 as a device stores it, for volumes that are large; for buffers, not in double.
  static Result<ConeScene> make(Context& context, const ConeTraceParams& params, std::span<const std::byte> level_0);

  /// Sets the receivers ([n][8]; n = width * height of the params that are traced) and, for specular, views ([n][4]).
  Status receive(std::span<const double> receivers, std::span<const double> views = {});

  /// Sets the sky, as cone_sky makes it.
  Status shine(const std::vector<float>& sky);

  /// Traces. The params must have the volume that the scene was made with.
  Status trace(const ConeTraceParams& params, int repeat = 1, Times* times = nullptr);
  /// `irradiance`, `specular` ([n][4]) or `counters` of the last trace.
  Result<Values> read(const std::string& name) const;
  /// Times of building all coarse levels, warm.
  Times build_times() const { return build_times_; }
  /// Bytes of both volumes as the device holds them.
  std::size_t volume_bytes() const { return volume_bytes_; }

 private:
  struct Held {
    Resource resource;
    std::shared_ptr<Memory> memory;
  };
  Result<Held> hold(const Resource& resource, std::span<const double> values);
  Status build(const ConeTraceParams& params, std::span<const double> level_0);
  Status build_coarse(const ConeTraceParams& params, const Held& fine);

  Context* context_ = nullptr;
  std::vector<Held> held_;  // volumes and receivers
  std::vector<Held> made_;  // what the last trace wrote
  std::shared_ptr<Program> program_;
  ConeTraceParams compiled_;
  bool has_program_ = false;
  Times build_times_;
  std::size_t volume_bytes_ = 0;
};

/// Volume and receivers in, one result out (ConeScene in one go).
struct ConeResult {
  Values irradiance, specular, counters;  // empty where not asked for
};
Result<ConeResult> trace(Context& context, const ConeTraceParams& params, std::span<const double> level_0,
                         std::span<const double> receivers, std::span<const double> views = {});

/// A cube of n^3 voxels with one receiver.
ConeTraceParams cone_params(int n, ConeVariant variant = ConeVariant::isotropic, Format format = Format::f32x4);

/// A receiver as eight values.
void add_receiver(Values& receivers, std::array<double, 3> position, std::array<double, 3> normal, double roughness = 0);

/// Receivers all over the volume, with all kinds of normals; scene units, floats.
Values cone_receivers(const ConeTraceParams& params, int count, std::uint32_t seed);

/// Every voxel the same.
Values uniform_volume(int n, std::array<double, 4> value);

/// Every built-in set and the classic one, with names.
struct NamedSet {
  std::string name;
  std::vector<Cone> cones;
};
std::vector<NamedSet> cone_sets();

}  // namespace luxel::cases
