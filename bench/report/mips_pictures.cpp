// Pictures of mip_build: levels of an image, slices of a volume's levels, the two walls.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/report/mips.h"
#include "bench/report/pictures.h"

namespace luxel::report {
namespace {

using cases::Values;

// A rectangle of a level, each texel `scale` times as large, into `to` at (left, top).
struct Canvas {
  int width = 0, height = 0;
  Values values;
  Canvas(int w, int h) : width(w), height(h), values(static_cast<std::size_t>(w) * h * 3, 0.0) {}
  void put(const double* from, int w, int h, int channels, int row, int scale, int left, int top) {
    for (int y = 0; y < h * scale && top + y < height; ++y)
      for (int x = 0; x < w * scale && left + x < width; ++x)
        for (int c = 0; c < 3; ++c)
          values[(static_cast<std::size_t>(top + y) * width + left + x) * 3 + c] =
              from[(static_cast<std::size_t>(y / scale) * row + x / scale) * channels + (channels < 3 ? 0 : c)];
  }
};

// Levels 0, 1, 2 ... side by side: the first whole, the others in a column beside it.
Status levels_of_image(Session& session, const MipSetting& s, const std::string& file, const std::string& caption,
                       double exposure) {
  const auto made = cases::build(session.context(), s.params, level_0(s));
  if (!made) return made.status();
  const auto e = s.scene->extent;
  Canvas canvas(e[0] + e[0] / 2 + 4, e[1]);
  const Values finest = level_0(s);
  canvas.put(finest.data(), e[0], e[1], channels(s.params.format), e[0], 1, 0, 0);
  int top = 0;
  for (int level = 1; level <= mip_levels(s.params) && top < e[1]; ++level) {
    const auto size = mip_extent(s.params, level);
    canvas.put(made.value().at(mip_level_name(level)).data(), size[0], size[1], channels(s.params.format), size[0], 1,
               e[0] + 4, top);
    top += size[1] + 2;
  }
  return write_picture(session, "mip_build", file, caption, canvas.width, canvas.height, 3, canvas.values, exposure,
                       false);
}

// The slice at `slice` of the depth of a volume, y up.
void put_slice(Canvas& canvas, const Values& level, const std::array<int, 3>& e, double slice, int left, int side) {
  const int z = std::min(static_cast<int>(slice * e[2]), e[2] - 1), scale = std::max(1, side / e[0]);
  for (int y = 0; y < e[1]; ++y)
    canvas.put(level.data() + (static_cast<std::size_t>(z) * e[1] + y) * e[0] * 4, e[0], 1, 4, e[0], scale, left,
               (e[1] - 1 - y) * scale);
}

Status slices_of_room(Session& session, const MipScenes& scenes) {
  constexpr int side = 192, gap = 4;
  const auto e = scenes.room->extent;
  for (const bool directional : {false, true}) {
    const MipSetting s =
        setting_for(scenes.room, directional ? MipVariant::anisotropic : MipVariant::isotropic, Format::f32x4);
    const auto made = cases::build(session.context(), s.params, level_0(s));
    if (!made) return made.status();
    Canvas canvas(5 * (side + gap) - gap, side);
    put_slice(canvas, level_0(s), e, 0.4, 0, side);
    for (int level = 1; level <= 4; ++level)
      put_slice(canvas, made.value().at(directional ? mip_level_name(level, 0) : mip_level_name(level)),
                mip_extent(s.params, level), 0.4, level * (side + gap), side);
    const char* caption = directional
                              ? "room, slice z = 0.4: levels 0 to 4 as seen along +x (anisotropic): red hides green"
                              : "room, slice z = 0.4: levels 0 to 4, isotropic: red and green mix, walls fade";
    if (Status status =
            write_picture(session, "mip_build", directional ? "mip_build_anisotropic" : "mip_build_isotropic", caption,
                          canvas.width, canvas.height, 3, canvas.values, 1, false);
        !status)
      return status;
  }
  return {};
}

}  // namespace

std::vector<Job> mip_pictures(Session& session, const MipScenes& scenes) {
  return {{"mip_build pictures of " + scenes.picture->name,
           [&session, scenes] {
             const auto& p = *scenes.picture;
             const Scene as_image{p.name, p.extent[0], p.extent[1], p.channels, p.values};
             return levels_of_image(session, setting_for(scenes.picture, MipVariant::isotropic, Format::f32x4),
                                    "mip_build_image", p.name + ": all levels, isotropic f32x4",
                                    exposure_for(as_image));
           }},
          {"mip_build pictures of depth",
           [&session, scenes] {
             const auto depth = scenes.rendered_depth ? scenes.rendered_depth : scenes.hall;
             const double farthest = *std::max_element(depth->values.begin(), depth->values.end());
             return levels_of_image(session, setting_for(depth, MipVariant::min, Format::f32x1), "mip_build_min",
                                    depth->name + ": all levels of the lower bound (min)", 2 / farthest);
           }},
          {"mip_build pictures of the room", [&session, scenes] { return slices_of_room(session, scenes); }}};
}

}  // namespace luxel::report
