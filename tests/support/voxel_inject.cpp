#include "tests/support/voxel_inject.h"

#include <cstring>

namespace luxel {

std::vector<Bytes> inject(const std::string& device, const Grid& g, const VoxelInjectParams& p,
                          const std::vector<float>& light, const Bytes& before) {
  Context& context = test_context(device);
  const Result<Plan> made = plan(p, context.profile());
  EXPECT_TRUE(made.ok()) << made.status().message();
  if (!made.ok()) return {};
  const bool wide = context.real64();
  std::vector<std::uint32_t> bricks = g.bricks;
  bricks.resize(static_cast<std::size_t>(p.bricks));
  NamedBytes inputs{{"colour", encode(p.format, g.colour, wide)},
                    {"bricks", bytes_of(bricks)},
                    {"voxel_counters", bytes_of(g.counters)}};
  if (p.lights > 0 || p.map_width == 0) {
    std::vector<float> normal = g.normal;
    if (p.format == Format::unorm8x4)
      for (float& v : normal) v = v / 2 + 0.5f;
    inputs.push_back({"normal", encode(p.format, normal, wide)});
  }
  const std::size_t lights = static_cast<std::size_t>(p.lights) * 12;
  if (lights > 0)
    inputs.push_back(
        {"lights", encode(Format::f32x4, {light.begin(), light.begin() + static_cast<std::ptrdiff_t>(lights)}, wide)});
  if (p.shadow.width > 0) inputs.push_back({"shadow", encode(Format::f32x1, g.shadow, wide)});
  if (p.map_width > 0)
    inputs.push_back(
        {"map", encode(Format::f32x4, {light.begin() + static_cast<std::ptrdiff_t>(lights), light.end()}, wide)});
  if (p.emission) inputs.push_back({"emission", encode(p.format, g.emission, wide)});
  if (!before.empty()) inputs.push_back({"radiance", before});
  std::vector<std::string> outputs{"radiance"};
  if (p.count) outputs.push_back("outcomes");
  return run_bytes(context, made.value(), inputs, outputs);
}

std::vector<double> radiance(const std::string& device, const Grid& g, const VoxelInjectParams& p,
                             const std::vector<float>& light) {
  const std::vector<Bytes> out = inject(device, g, p, light);
  return out.empty() ? std::vector<double>() : decode(p.format, out[0], test_context(device).real64());
}

std::vector<std::string> all_devices() {
  std::vector<std::string> all = test_devices();
  all.push_back("cpu:double");
  return all;
}

std::vector<std::uint32_t> words(const Bytes& bytes) {
  std::vector<std::uint32_t> w(bytes.size() / 4);
  std::memcpy(w.data(), bytes.data(), bytes.size());
  return w;
}

void floor_at(Grid& g, int y) {
  for (int z = 0; z < g.n[2]; ++z)
    for (int x = 0; x < g.n[0]; ++x) g.put(x, y, z, {0.5f, 0.25f, 1.0f, 1.0f}, {0, 1, 0});
}

Grid random_grid() {
  Grid g(13, 10, 17);
  std::uint32_t i = 0;
  for (int z = 0; z < g.n[2]; ++z)
    for (int y = 0; y < g.n[1]; ++y)
      for (int x = 0; x < g.n[0]; ++x) {
        const float r[8] = {uniform(i),     uniform(i + 1), uniform(i + 2), uniform(i + 3),
                            uniform(i + 4), uniform(i + 5), uniform(i + 6), uniform(i + 7)};
        i += 8;
        if (r[0] < 0.8f) continue;
        g.put(x, y, z, {r[1], r[2], r[3], r[0] < 0.84f ? 1.0f : 0.05f + 0.9f * r[4]},
              {0.57f * (2 * r[5] - 1), 0.57f * (2 * r[6] - 1), 0.57f * (2 * r[7] - 1)});
        for (int c = 0; c < 3; ++c) g.emission[g.at(x, y, z) * 4 + c] = r[c + 4];
      }
  g.list_bricks();
  return g;
}

const std::vector<VoxelLight> several{{VoxelLight::Kind::sun, {0.3, 0.8, 0.2}, {1, 0.5, 0.25}, {}, 0},
                                      {VoxelLight::Kind::point, {6.3, 20.1, 8.2}, {100, 200, 300}, {}, 0},
                                      {VoxelLight::Kind::patch, {-5.2, 4.7, 3.1}, {50, 20, 10}, {2, 0.5, 0.1}, 0}};

}  // namespace luxel
