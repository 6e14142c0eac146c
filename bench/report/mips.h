// What the report measures of mip_build.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <luxel/mip_build.h>

#include "bench/report/scenes.h"
#include "bench/report/session.h"
#include "tests/cases/mip_build_support.h"

namespace luxel::report {

/// A level 0: interleaved values, x first, then y, z.
struct MipScene {
  std::string name;
  std::array<int, 3> extent{1, 1, 1};
  int channels = 4;
  std::vector<double> values;
};

/// How a pyramid is compared with the truth.
enum class MipMetric {
  largest,  // max |x - t| over the largest |input|, all levels and directions
  drift     // |mean of x - t| of one level, in steps of the storage format at full scale
};

struct MipSetting {
  std::shared_ptr<const MipScene> scene;
  MipBuildParams params;
  bool single_pass = false;  // several levels a dispatch, through workgroup memory
};

/// "mip_build isotropic f32x4 on room (generated) 64x64x64"
std::string label(const MipSetting& setting);

/// "64x64x64", "1920x1080"
std::string size_text(const std::array<int, 3>& extent);

/// A setting for a scene: extent and channels of it.
MipSetting setting_for(const std::shared_ptr<const MipScene>& scene, MipVariant variant, Format format);

/// Level 0 in the channels of the setting's format, as that holds them: the first channels, or grey.
std::vector<double> level_0(const MipSetting& setting);

/// Times a setting, splits its error, and makes a frontier row; with `drift` also a row a level of the drift.
Status measure_mips(Session& session, const MipSetting& setting, bool drift = false);

/// A compiled run with level 0 in place.
Result<std::shared_ptr<cases::Run>> ready_mips(Session& session, const MipSetting& setting);
/// Bytes that a pyramid reads and writes at least, of a plan made for the device.
double mip_bytes(Session& session, const MipSetting& setting);

/// The scenes: generated ones always, the voxelised bunny and a rendered depth map where the data folder has them.
struct MipScenes {
  std::shared_ptr<const MipScene> room, hall, picture, bunny, rendered_depth;  // the last two may be null
};
MipScenes mip_scenes(const Settings& settings, const std::vector<std::shared_ptr<const Scene>>& files,
                     std::vector<std::string>& missing);

std::vector<Job> mip_grid(Session& session, const MipScenes& scenes);
std::vector<Job> mip_left_out(Session& session, const MipScenes& scenes);
std::vector<Job> mip_reproduction(Session& session, const MipScenes& scenes);
std::vector<Job> mip_peers(Session& session);
std::vector<Job> mip_marches(Session& session, const MipScenes& scenes);
std::vector<Job> mip_pictures(Session& session, const MipScenes& scenes);

}  // namespace luxel::report
