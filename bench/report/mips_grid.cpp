// The scenes and settings of mip_build that a report measures.
#include <algorithm>

#include <fmt/format.h>

#include "bench/io/array.h"
#include "bench/io/image.h"
#include "bench/report/limits.h"
#include "bench/report/mips.h"
#include "bench/scene/images.h"
#include "bench/scene/volumes.h"

namespace luxel::report {
namespace {

// Packed bits, index (x N + y) N + z, first of the closed mesh: white where there is a surface.
std::shared_ptr<const MipScene> bunny(const std::string& path, int side, std::vector<std::string>& missing) {
  const Result<io::Array> bits = io::read_npy(path);
  const std::size_t voxels = static_cast<std::size_t>(side) * side * side;
  if (!bits || bits.value().data.size() < voxels / 8) {
    missing.push_back(bits ? path + " holds fewer voxels than its name says" : bits.status().message());
    return nullptr;
  }
  MipScene scene{"Stanford bunny, voxels", {side, side, side}, 4, std::vector<double>(voxels * 4, 0.0)};
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z) {
        const std::size_t i = (static_cast<std::size_t>(x) * side + y) * side + z;
        if (bits.value().data[i / 8] >> (7 - i % 8) & 1)
          for (int c = 0; c < 4; ++c)
            scene.values[((static_cast<std::size_t>(z) * side + y) * side + x) * 4 + c] = c == 3 ? 1.0 : 0.8;
      }
  return std::make_shared<MipScene>(std::move(scene));
}

std::shared_ptr<const MipScene> rendered_depth(const std::string& path, std::vector<std::string>& missing) {
  const Result<io::Image> image = io::read_image(path);
  if (!image) {
    missing.push_back(image.status().message());
    return nullptr;
  }
  const io::Image& i = image.value();
  MipScene scene{"Cornell box, depth", {i.width, i.height, 1}, 1, {}};
  double farthest = 0;
  for (std::size_t p = 0; p * i.channels < i.pixels.size(); ++p) {
    const double v = i.pixels[p * i.channels];
    if (v < 1e10) farthest = std::max(farthest, v);
    scene.values.push_back(v);
  }
  // The sky lies at 1e10, beyond f16 and beside any scale: here at twice the farthest surface.
  for (double& v : scene.values) v = std::min(v, 2 * farthest);
  return std::make_shared<MipScene>(std::move(scene));
}

}  // namespace

MipScenes mip_scenes(const Settings& settings, const std::vector<std::shared_ptr<const Scene>>& files,
                     std::vector<std::string>& missing) {
  const int side = settings.quick ? 64 : 128;
  MipScenes scenes;
  scenes.room =
      std::make_shared<MipScene>(MipScene{"room (generated)", {side, side, side}, 4, scene::voxel_room(side)});
  const int width = settings.quick ? 960 : 1920, height = settings.quick ? 540 : 1080;
  scenes.hall =
      std::make_shared<MipScene>(MipScene{"hall (generated)", {width, height, 1}, 1, scene::depth_map(width, height)});
  if (files.empty()) {
    scenes.picture = std::make_shared<MipScene>(
        MipScene{"landscape (generated)", {512, 288, 1}, 4, scene::hdr_landscape(512, 288, 4)});
  } else {
    const Scene& f = *files.front();
    scenes.picture =
        std::make_shared<MipScene>(MipScene{f.name, {f.width, f.height, 1}, 4, in_format(f, Format::f32x4)});
  }
  scenes.bunny = bunny(fmt::format("{}/numeric/vox_bunny_stanford_{}.npy", data_folder(), side), side, missing);
  scenes.rendered_depth = rendered_depth(data_folder() + "/gbuffer_cycles_cbox/n1_depth.exr", missing);
  return scenes;
}

std::vector<Job> mip_grid(Session& session, const MipScenes& scenes) {
  const bool quick = session.settings().quick;
  std::vector<Job> jobs;
  const auto add = [&](const MipSetting& s, bool drift = false) {
    jobs.push_back({label(s), [&session, s, drift] { return measure_mips(session, s, drift); }});
  };
  const auto ways = [&](MipSetting s) {  // buffer, image, several levels a dispatch
    add(s);
    if (quick && s.params.format != Format::f32x4 && s.params.format != Format::f32x2) return;
    s.params.input = Input::image;
    add(s);
    s.params.input = Input::buffer;
    s.single_pass = true;
    if (s.params.variant != MipVariant::anisotropic && s.params.variant != MipVariant::gaussian3 &&
        s.params.variant != MipVariant::moments)
      add(s);
  };
  constexpr Format colour[] = {Format::f32x4, Format::f16x4, Format::unorm8x4};

  // Volumes.
  for (const Format format : colour) {
    ways(setting_for(scenes.room, MipVariant::isotropic, format));
    add(setting_for(scenes.room, MipVariant::anisotropic, format));
    if (!quick || format != Format::f16x4) add(setting_for(scenes.room, MipVariant::gaussian3, format));
    if (scenes.bunny && (!quick || format == Format::f32x4)) add(setting_for(scenes.bunny, MipVariant::isotropic, format));
    if (scenes.bunny && !quick) add(setting_for(scenes.bunny, MipVariant::anisotropic, format));
  }
  add(setting_for(scenes.room, MipVariant::isotropic, Format::f32x1));

  // Images.
  for (const Format format : colour)
    if (!quick || format == Format::f32x4) ways(setting_for(scenes.picture, MipVariant::isotropic, format));
  MipSetting vertices = setting_for(scenes.room, MipVariant::gaussian3, Format::f32x4);
  const auto odd =
      std::make_shared<MipScene>(MipScene{"noise (generated)", {129, 65, 33}, 4, scene::noise(129, 65 * 33, 4, 51)});
  vertices = setting_for(odd, MipVariant::gaussian3, Format::f32x4);
  vertices.params.samples = MipSamples::vertices;
  add(vertices);

  // Depth.
  std::vector<std::shared_ptr<const MipScene>> depths{scenes.hall};
  if (scenes.rendered_depth) depths.push_back(scenes.rendered_depth);
  for (const auto& depth : depths) {
    if (quick && depth != scenes.hall) {
      add(setting_for(depth, MipVariant::minmax, Format::f32x2));
      continue;
    }
    for (const MipVariant v : {MipVariant::min, MipVariant::max}) add(setting_for(depth, v, Format::f32x1));
    for (const Format format : {Format::f32x2, Format::f16x2}) {
      ways(setting_for(depth, MipVariant::minmax, format));
      add(setting_for(depth, MipVariant::moments, format));
    }
    MipSetting s = setting_for(depth, MipVariant::minmax, Format::f32x2);
    s.params.sizes = MipSizes::ceil;
    add(s);
    s = setting_for(depth, MipVariant::min, Format::f32x1);
    s.params.ratio = 16;
    add(s);
  }

  // Drift over eight levels (seven in quick reports): multiples of a step of unorm8, so that ties are as frequent as can be.
  const int half = quick ? 2 : 1;
  const std::array<int, 3> side{256 / half, 64 / half, 64 / half};
  MipScene ties{"multiples of 1/255 (generated)", side, 4, scene::noise(side[0], side[1] * side[2], 4, 52)};
  for (double& v : ties.values) v = static_cast<float>(static_cast<int>(v * 256) / 255.0);
  const auto drifting = std::make_shared<MipScene>(std::move(ties));
  for (const Format format : colour)
    if (!quick || format == Format::unorm8x4) add(setting_for(drifting, MipVariant::isotropic, format), true);

  for (const auto& scene : {scenes.room, scenes.hall, scenes.picture})
    add_copies(session, jobs, size_text(scene->extent), scene->extent[0], scene->extent[1] * scene->extent[2]);
  return jobs;
}

}  // namespace luxel::report
