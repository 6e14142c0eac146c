// The generated building: a hall of 32 x 16 m around an open court; galleries on two floors behind arcades of eight bays,
// cloth over the balustrades, a sail across the court.
#include <numbers>

#include "bench/scene/images.h"
#include "bench/scene/mesh_builder.h"

namespace luxel::scene {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double length = 16, width = 8, arcade = 4, bay = 4;  // half length and half width, z of the arcades, a bay
constexpr double wall = 0.35;                                  // half thickness of the arcades
constexpr double lower = 5.5, upper = 9.3;                     // top of the gallery's floor and of its roof

struct Materials {
  std::uint32_t floor, stone, plaster, slab, wood, lace;
  std::uint32_t cloth[4];
};

std::uint8_t byte(double v) { return static_cast<std::uint8_t>(std::lround(std::clamp(v, 0.0, 1.0) * 255)); }

// Four tiles of two stones with grain and joints, sRGB.
Texture tiles() {
  Texture t{"tiles", 64, 64, true, {}};
  for (int y = 0; y < t.height; ++y)
    for (int x = 0; x < t.width; ++x) {
      const bool joint = x % 32 == 0 || y % 32 == 0, dark = (x / 32 + y / 32) % 2 == 1;
      const double grain = 0.06 * random01(static_cast<std::uint32_t>(y * t.width + x), 11);
      const double v = joint ? 0.35 : (dark ? 0.55 : 0.78) + grain;
      for (const double c : {v, v * 0.95, v * 0.87}) t.rgba.push_back(byte(c));
      t.rgba.push_back(255);
    }
  return t;
}

// A lattice: threads where alpha is 1, holes between.
Texture lattice() {
  Texture t{"lattice", 32, 32, true, {}};
  for (int y = 0; y < t.height; ++y)
    for (int x = 0; x < t.width; ++x) {
      const bool thread = (x + y) % 16 < 6 || (x - y + 32) % 16 < 6;
      t.rgba.insert(t.rgba.end(), {226, 214, 190, static_cast<std::uint8_t>(thread ? 255 : 0)});
    }
  return t;
}

class Atrium {
 public:
  Atrium(double detail, int floor_cells, bool counting) : b(counting), detail_(detail) {
    materials();
    shell(floor_cells);
    for (const double side : {-1.0, 1.0}) {
      for (int i = 0; i < 8; ++i) {
        const double x = -length + bay * (i + 0.5);
        arch(x, side, 3.0, 1.65, lower - 0.3);
        arch(x, side, 7.4, 1.0, upper - 0.3);
        b.block({x - bay / 2 + 0.3, lower, side * arcade - 0.12},
                {x + bay / 2 - 0.3, lower + 0.9, side * arcade + 0.12}, m.plaster, 0, step(0.6));
        if (i < 7) column(x + bay / 2, side, 0, 3.0, 0.34), column(x + bay / 2, side, lower, 7.4, 0.24);
        if (i % 2 == (side < 0 ? 0 : 1)) hanging(x, side, i == 5 || i == 2 ? m.lace : m.cloth[i / 2]);
      }
    }
    sail(7, m.cloth[0]);
    for (const double x : {-9.0, 3.0}) b.block({x - 0.6, 0, -0.6}, {x + 0.6, 0.7, 0.6}, m.wood, 0.2, step(0.3));
  }

  MeshBuilder b;

 private:
  double detail_;
  Materials m{};

  // Cells that a surface is cut into: `n` at the coarsest.
  int cells(double n) const { return std::max(static_cast<int>(n), static_cast<int>(std::lround(n * detail_))); }
  // Side of a block's cells: none at the coarsest.
  double step(double size) const { return detail_ < 1.5 ? 1e9 : size * 4 / detail_; }

  void materials() {
    b.scene.textures = {tiles(), lattice()};
    m.floor =
        b.material({.name = "floor", .base_color = glm::dvec3(0.9), .roughness = 0.35, .specular = 0.04, .texture = 0});
    m.stone = b.material({.name = "stone", .base_color = {0.62, 0.56, 0.46}, .roughness = 0.8, .specular = 0.04});
    m.plaster = b.material({.name = "plaster", .base_color = {0.72, 0.66, 0.55}});
    m.slab = b.material({.name = "slab", .base_color = {0.55, 0.5, 0.45}});
    m.wood = b.material({.name = "wood", .base_color = {0.3, 0.17, 0.08}, .roughness = 0.5, .specular = 0.04});
    const glm::dvec3 dyes[4] = {{0.55, 0.04, 0.03}, {0.05, 0.28, 0.07}, {0.06, 0.12, 0.5}, {0.7, 0.45, 0.05}};
    const char* names[4] = {"red cloth", "green cloth", "blue cloth", "yellow cloth"};
    for (int i = 0; i < 4; ++i) m.cloth[i] = b.material({.name = names[i], .base_color = dyes[i]});
    m.lace = b.material({.name = "lace", .base_color = glm::dvec3(1), .alpha_mode = AlphaMode::mask, .texture = 1});
  }

  // Floor, walls and slabs. Walls are as thick as the arcades, and stand outside of the hall.
  void shell(int floor_cells) {
    b.quad({-length, 0, width}, {2 * length, 0, 0}, {0, 0, -2 * width}, m.floor, 2 * floor_cells, floor_cells, {16, 8});
    const double t = 2 * wall;
    for (const double side : {-1.0, 1.0}) {
      const double z0 = side < 0 ? -width - t : width, x0 = side < 0 ? -length - t : length;
      b.block({-length - t, -t, z0}, {length + t, upper, z0 + t}, m.plaster, 0, step(1.0));
      b.block({x0, -t, -width}, {x0 + t, upper, width}, m.plaster, 0, step(1.0));
      const double inner = side < 0 ? -width : arcade + wall;
      for (const double top : {lower, upper})
        b.block({-length, top - 0.3, inner}, {length, top, inner + width - arcade - wall}, m.slab, 0, step(1.0));
    }
    b.quad({-length, -t, -width}, {2 * length, 0, 0}, {0, 0, 2 * width}, m.slab);
  }

  // One bay of an arcade: an elliptic opening of height `rise` over piers that spring at `foot`, wall up to `top`.
  void arch(double x, double side, double foot, double rise, double top) {
    constexpr double half = 1.65;  // of the opening
    const int around = cells(6), up = cells(1), deep = cells(1);
    const auto curve = [=](double u) {
      return glm::dvec2(x - half * std::cos(pi * u), foot + rise * std::sin(pi * u));
    };
    for (const double face : {-1.0, 1.0}) {
      const double z = side * arcade + face * wall;
      b.patch(around, up, m.plaster, [&](double u, double v) {
        const glm::dvec2 c = curve(face > 0 ? u : 1 - u);
        return glm::dvec3(c.x, c.y + v * (top - c.y), z);
      });
      for (const double pier : {-1.0, 1.0}) {
        const double from = pier < 0 ? x - bay / 2 : x + half, size = bay / 2 - half;
        b.quad({face > 0 ? from : from + size, foot, z}, {face * size, 0, 0}, {0, top - foot, 0}, m.plaster, cells(0.5),
               up);
      }
    }
    b.patch(around, deep, m.stone, [&](double u, double v) {
      const glm::dvec2 c = curve(u);
      return glm::dvec3(c.x, c.y, side * arcade + wall * (1 - 2 * v));
    });
    for (const double pier : {-1.0, 1.0})
      b.quad({pier < 0 ? x - bay / 2 : x + half, foot, side * arcade - wall}, {bay / 2 - half, 0, 0}, {0, 0, 2 * wall},
             m.stone);
    b.quad({x - bay / 2, top, side * arcade + wall}, {bay, 0, 0}, {0, 0, -2 * wall}, m.slab);
  }

  // A turned column on a round foot under a square plate.
  void column(double x, double side, double y0, double y1, double radius) {
    constexpr double profile[6][2] = {{1.45, 0}, {1.45, 0.04}, {1.0, 0.09}, {0.88, 0.86}, {1.0, 0.9}, {1.3, 0.95}};
    const double height = y1 - y0, z = side * arcade;
    b.patch(cells(6), cells(5), m.stone, [&](double u, double v) {
      const double at = std::min(v * 5, 4.999999);
      const int i = static_cast<int>(at);
      const double f = at - i, r = radius * (profile[i][0] * (1 - f) + profile[i + 1][0] * f);
      const double y = y0 + height * (profile[i][1] * (1 - f) + profile[i + 1][1] * f);
      return glm::dvec3(x + r * std::sin(2 * pi * u), y, z + r * std::cos(2 * pi * u));
    });
    const double plate = radius * 1.4;
    b.block({x - plate, y0 + 0.95 * height, z - plate}, {x + plate, y1, z + plate}, m.stone, 0, step(0.3));
  }

  // Cloth over the balustrade, hanging into the court, with folds that open downwards.
  void hanging(double x, double side, std::uint32_t material) {
    b.patch(cells(7), cells(5), material, [&](double u, double v) {
      const double s = u - 0.5, fall = 3.6 * v, fold = 0.03 + 0.12 * v;
      const double bulge = fold * std::sin(2 * pi * (4 * u + 0.15 * std::sin(5 * v))) + 0.15 * v * v;
      return glm::dvec3(x + 2.6 * s * (1 - 0.08 * v), lower + 1.0 - fall, side * (arcade - wall - 0.2 - bulge));
    }, {6, 8});
  }

  // Cloth across the court, sagging.
  void sail(double x, std::uint32_t material) {
    b.patch(cells(5), cells(8), material, [&](double u, double v) {
      const double s = 2 * v - 1, t = 2 * u - 1;
      return glm::dvec3(x + 1.8 * t, 8.8 - 1.1 * (1 - s * s) - 0.1 * std::cos(3 * pi * t), (arcade - wall) * s);
    });
  }
};

}  // namespace

Scene atrium(int triangles) {
  const auto budget = static_cast<std::size_t>(triangles);
  const auto count = [](double detail, int floor_cells) { return Atrium(detail, floor_cells, true).b.triangles(); };
  // The finest detail that leaves the floor a tenth; then the floor takes what is left.
  double low = 1, high = 64;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    (count(middle, 1) <= budget * 9 / 10 ? low : high) = middle;
  }
  int floor_cells = 1;
  while (count(low, floor_cells + 1) <= budget) ++floor_cells;
  Scene scene = std::move(Atrium(low, floor_cells, false).b.scene);
  scene.name = "atrium:" + std::to_string(triangles);
  scene.camera = {{-14.2, 2.4, 1.2}, {4, 3.9, -0.6}, 62};
  scene.sun = {glm::normalize(glm::dvec3(0.3, 1.0, 0.33)), {16, 15, 13}};
  scene.sky.radiance = {0.9, 1.15, 1.5};
  return scene;
}

}  // namespace luxel::scene
