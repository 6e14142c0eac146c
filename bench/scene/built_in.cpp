#include <charconv>
#include <numbers>

#include <fmt/format.h>

#include "bench/scene/mesh_builder.h"

namespace luxel::scene {
namespace {

constexpr int fewest = 5000, most = 500000, usual = 50000;  // triangles of the atrium

// A ceiling from `low` to `high` (x, z) at height y with a lamp let into it, so that the lamp's back lights nothing.
void ceiling(MeshBuilder& b, double y, glm::dvec2 low, glm::dvec2 high, std::uint32_t plaster, glm::dvec2 lamp_low,
             glm::dvec2 lamp_high, std::uint32_t lamp) {
  const double x[4] = {low.x, lamp_low.x, lamp_high.x, high.x}, z[4] = {low.y, lamp_low.y, lamp_high.y, high.y};
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      b.quad({x[i], y, z[j]}, {x[i + 1] - x[i], 0, 0}, {0, 0, z[j + 1] - z[j]}, i == 1 && j == 1 ? lamp : plaster);
}

// The box's paints as they were measured at Cornell, reduced to linear RGB, as renderers' copies of it have them.
Scene cornell() {
  MeshBuilder b;
  b.scene.name = "cornell";
  const auto white = b.material({.name = "white", .base_color = {0.73, 0.73, 0.73}});
  const auto red = b.material({.name = "red", .base_color = {0.63, 0.065, 0.05}});
  const auto green = b.material({.name = "green", .base_color = {0.14, 0.45, 0.091}});
  const auto gloss =
      b.material({.name = "gloss", .base_color = {0.73, 0.73, 0.73}, .roughness = 0.3, .specular = 0.04});
  const auto lamp = b.material({.name = "lamp", .base_color = {0.78, 0.78, 0.78}, .emission = {17, 12, 4}});
  b.quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, white);    // floor
  ceiling(b, 2, {-1, -1}, {1, 1}, white, {-0.24, -0.22}, {0.24, 0.22}, lamp);
  b.quad({-1, 0, -1}, {2, 0, 0}, {0, 2, 0}, white);    // back
  b.quad({-1, 0, 1}, {0, 0, -2}, {0, 2, 0}, red);      // left
  b.quad({1, 0, -1}, {0, 0, 2}, {0, 2, 0}, green);     // right
  b.block({-0.65, 0, -0.6}, {-0.05, 1.2, 0}, gloss, 0.3);
  b.block({0.05, 0, 0.0}, {0.65, 0.6, 0.6}, white, -0.3);
  b.scene.camera = {{0, 1, 3.9}, {0, 1, 0}, 39.3};
  return std::move(b.scene);
}

Scene two_rooms() {
  MeshBuilder b;
  b.scene.name = "two_rooms";
  const auto white = b.material({.name = "white", .base_color = {0.7, 0.7, 0.7}});
  const auto orange = b.material({.name = "orange", .base_color = {0.8, 0.4, 0.1}});
  const auto blue = b.material({.name = "blue", .base_color = {0.15, 0.3, 0.7}});
  const auto lamp = b.material({.name = "lamp", .base_color = {0, 0, 0}, .emission = {10, 10, 9}});
  constexpr double half_wall = 0.01;  // rooms of 4 x 3 x 4
  for (const double side : {-1.0, 1.0}) {
    const double x0 = side < 0 ? -4 : half_wall, width = 4 - half_wall;
    b.quad({x0, 0, 2}, {width, 0, 0}, {0, 0, -4}, white);
    if (side < 0)
      ceiling(b, 3, {x0, -2}, {x0 + width, 2}, white, {-2.5, -0.5}, {-1.5, 0.5}, lamp);
    else
      b.quad({x0, 3, -2}, {width, 0, 0}, {0, 0, 4}, white);
    b.quad({x0, 0, -2}, {width, 0, 0}, {0, 3, 0}, white);
    const double middle = 2 * side;
    b.block({middle - 0.5, 0, -0.9}, {middle + 0.5, 1, 0.1}, side < 0 ? orange : blue, 0.4);
  }
  b.quad({-4, 0, 2}, {0, 0, -4}, {0, 3, 0}, orange);                  // outer walls
  b.quad({4, 0, -2}, {0, 0, 4}, {0, 3, 0}, blue);
  b.block({-half_wall, 0, -2}, {half_wall, 3, 2}, white);             // the thin wall
  b.scene.camera = {{0, 1.5, 7.2}, {0, 1.5, 0}, 46};
  return std::move(b.scene);
}

Scene furnace() {
  MeshBuilder b;
  b.scene.name = "furnace";
  const auto wall = b.material({.name = "wall", .base_color = {0.5, 0.5, 0.5}, .emission = {1, 1, 1}});
  b.block({-1, 0, -1}, {1, 2, 1}, wall);
  b.block({-0.3, 0, -0.6}, {0.3, 0.8, 0}, wall, 0.3);
  b.scene.camera = {{0, 1, 0.9}, {0, 0.8, 0}, 60};
  return std::move(b.scene);
}

// A room of 6 x 3 x 6, open towards +z, with a lamp off its middle.
void lit_room(MeshBuilder& b, std::uint32_t floor, std::uint32_t left, std::uint32_t right, std::uint32_t white, glm::dvec2 lamp_low,
              glm::dvec2 lamp_high) {
  const auto lamp = b.material({.name = "lamp", .base_color = {0, 0, 0}, .emission = {12, 11, 9}});
  b.quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}, floor);
  ceiling(b, 3, {-3, -3}, {3, 3}, white, lamp_low, lamp_high, lamp);
  b.quad({-3, 0, -3}, {6, 0, 0}, {0, 3, 0}, white);
  b.quad({-3, 0, 3}, {0, 0, -6}, {0, 3, 0}, left);
  b.quad({3, 0, -3}, {0, 0, 6}, {0, 3, 0}, right);
  b.scene.camera = {{0, 1.8, 8.6}, {0, 1.4, 0}, 44};
}

// Pillars from floor to ceiling: two of them stand where a grid of 3 x 2 x 3 probes has some.
Scene pillars() {
  MeshBuilder b;
  b.scene.name = "pillars";
  const auto white = b.material({.name = "white", .base_color = {0.75, 0.75, 0.75}});
  const auto red = b.material({.name = "red", .base_color = {0.7, 0.2, 0.15}});
  const auto green = b.material({.name = "green", .base_color = {0.2, 0.6, 0.25}});
  lit_room(b, white, red, green, white, {-1.6, 0.6}, {-0.8, 1.4});
  for (const glm::dvec3 pillar : {glm::dvec3(0, 0, 0.6), glm::dvec3(2, -2, 0.5), glm::dvec3(-1, -1.3, 0.3), glm::dvec3(1.1, 1.3, 0.3)})
    b.patch(32, 1, white, [&](double u, double v) {
      const double angle = -2 * std::numbers::pi * u;
      return glm::dvec3(pillar.x + pillar.z * std::cos(angle), 3 * v, pillar.y + pillar.z * std::sin(angle));
    });
  return std::move(b.scene);
}

// A cloth across the room: light of the other half comes beneath it and beside it.
Scene curtain() {
  MeshBuilder b;
  b.scene.name = "curtain";
  const auto white = b.material({.name = "white", .base_color = {0.75, 0.75, 0.75}});
  const auto cloth = b.material({.name = "cloth", .base_color = {0.75, 0.55, 0.1}});
  lit_room(b, white, white, white, white, {-2.4, -0.4}, {-1.6, 0.4});
  b.block({0.49, 0.2, -3}, {0.51, 3, 2.6}, cloth);
  return std::move(b.scene);
}

}  // namespace

std::vector<std::string_view> built_in_names() { return {"cornell", "two_rooms", "furnace", "atrium", "pillars", "curtain"}; }

Result<Scene> built_in(const std::string& name) {
  const std::size_t colon = name.find(':');
  const std::string word = name.substr(0, colon);
  if (colon != std::string::npos && word == "atrium") {
    int n = 0;
    const char* end = name.data() + name.size();
    const auto [stop, error] = std::from_chars(name.data() + colon + 1, end, n);
    if (error != std::errc() || stop != end || n < fewest || n > most)
      return Status(Code::invalid_argument, fmt::format("scene {}: {} is no number of triangles; expected {}..{}", name,
                                                        name.substr(colon + 1), fewest, most));
    return atrium(n);
  }
  if (name == "cornell") return cornell();
  if (name == "two_rooms") return two_rooms();
  if (name == "furnace") return furnace();
  if (name == "atrium") return atrium(usual);
  if (name == "pillars") return pillars();
  if (name == "curtain") return curtain();
  return Status(Code::invalid_argument, fmt::format("scene {} is not known; expected {}, atrium:N, or a file", name,
                                                    fmt::join(built_in_names(), ", ")));
}

}  // namespace luxel::scene
