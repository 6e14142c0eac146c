// What the report measures of cone_trace.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <luxel/cone_trace.h>

#include "bench/report/session.h"
#include "tests/cases/cone_trace_support.h"

namespace luxel::report {

/// A volume, receivers on its surfaces, and what rays through its finest voxels see from them.
struct ConeWorld {
  std::string name;
  int side = 0;
  cases::Values voxels;     // premultiplied radiance and opacity
  cases::Values receivers;  // [height][width][8]
  int width = 0, height = 0;
  std::array<double, 3> environment{};
  double max_distance = 0;
};

/// A box with a lamp, a block, and one open side, 64 x 64 x 64 or finer; receivers on the floor and the back wall.
std::shared_ptr<const ConeWorld> cone_box(int side, int width, int height);

/// Thin fog of one density; receivers in the middle, so that all cones of one direction take the same steps.
std::shared_ptr<const ConeWorld> cone_fog(int side, int width, int height);

struct ConeSetting {
  std::shared_ptr<const ConeWorld> world;
  ConeTraceParams params;
  std::string set;  // "6", "classic 6"
};

/// A setting for a world: its volume, receivers, environment and distance.
ConeSetting setting_for(const std::shared_ptr<const ConeWorld>& world, ConeVariant variant, Format format,
                        const std::string& set = "6");
std::string label(const ConeSetting& setting);

/// A scene on the session's device with its receivers, made once for a volume as it is bound.
class ConeScenes {
 public:
  Result<std::shared_ptr<cases::ConeScene>> on(Context& context, const ConeSetting& setting);

 private:
  using Key = std::tuple<Context*, std::string, int, ConeVariant, Format, Input>;
  std::map<Key, std::shared_ptr<cases::ConeScene>> scenes_;
};

/// Milliseconds of one trace.
Session::Timed timed(const std::shared_ptr<cases::ConeScene>& scene, const ConeTraceParams& params);

std::vector<Job> cone_grid(Session& session);
std::vector<Job> cone_left_out(Session& session);
std::vector<Job> cone_reproduction(Session& session);
std::vector<Job> cone_peers(Session& session);

}  // namespace luxel::report
