#include "tests/support/voxels.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace luxel {

void Mesh::add(const std::array<double, 9>& corners, std::uint32_t material) {
  for (std::uint32_t i = 0; i < 3; ++i) indices.push_back(static_cast<std::uint32_t>(positions.size() / 3) + i);
  positions.insert(positions.end(), corners.begin(), corners.end());
  materials.push_back(material);
}

VoxelMesh Mesh::view() const {
  VoxelMesh mesh;
  mesh.positions = positions.data();
  mesh.vertices = positions.size() / 3;
  mesh.indices = indices.data();
  mesh.triangles = triangles();
  mesh.materials = materials.empty() ? nullptr : materials.data();
  return mesh;
}

Mesh read_obj(const std::string& path) {
  Mesh mesh;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      for (int i = 0; i < 3; ++i) {
        std::string number;
        words >> number;
        mesh.positions.push_back(std::strtod(number.c_str(), nullptr));
      }
    } else if (word == "f") {
      std::vector<std::uint32_t> corners;
      while (words >> word) {
        const long long i = std::strtoll(word.c_str(), nullptr, 10);
        const long long at = i < 0 ? static_cast<long long>(mesh.positions.size() / 3) + i : i - 1;
        corners.push_back(static_cast<std::uint32_t>(at));
      }
      for (std::size_t i = 2; i < corners.size(); ++i)
        mesh.indices.insert(mesh.indices.end(), {corners[0], corners[i - 1], corners[i]});
    }
  }
  return mesh;
}

std::string data_file(const std::string& name) {
  const char* const folder = std::getenv("LUXEL_DATA");
  const std::string path = folder ? std::string(folder) + "/" + name : "";
  return !path.empty() && std::filesystem::exists(path) ? path : "";
}

VoxelGrid unit_grid(int n) {
  VoxelGrid grid;
  grid.width = grid.height = grid.depth = n;
  return grid;
}

double random01(std::uint32_t i) {
  std::uint32_t v = i * 747796405u + 2891336453u;
  v = ((v >> ((v >> 28) + 4)) ^ v) * 277803737u;
  return static_cast<double>(((v >> 22) ^ v) >> 8) * 0x1p-24;
}

Mesh icosphere(std::array<double, 3> centre, double radius, int level) {
  std::vector<std::array<double, 3>> points;
  const double phi = (1 + std::sqrt(5.0)) / 2;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-phi, phi}) {
      points.push_back({0, a, b});
      points.push_back({a, b, 0});
      points.push_back({b, 0, a});
    }
  // Faces: triples of mutually nearest points, counter-clockwise from outside.
  std::vector<std::array<std::uint32_t, 3>> faces;
  const auto near = [&](std::uint32_t i, std::uint32_t j) {
    double d = 0;
    for (std::size_t k = 0; k < 3; ++k) d += (points[i][k] - points[j][k]) * (points[i][k] - points[j][k]);
    return d < 4.1;
  };
  for (std::uint32_t i = 0; i < 12; ++i)
    for (std::uint32_t j = i + 1; j < 12; ++j)
      for (std::uint32_t k = j + 1; k < 12; ++k) {
        if (!near(i, j) || !near(j, k) || !near(i, k)) continue;
        const auto &a = points[i], &b = points[j], &c = points[k];
        const double volume = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                              a[2] * (b[0] * c[1] - b[1] * c[0]);
        faces.push_back(volume > 0 ? std::array{i, j, k} : std::array{i, k, j});
      }
  for (; level > 0; --level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t i, std::uint32_t j) {
      const auto [at, fresh] = middles.try_emplace(std::minmax(i, j), static_cast<std::uint32_t>(points.size()));
      if (fresh) {
        std::array<double, 3> p{};
        for (std::size_t k = 0; k < 3; ++k) p[k] = points[i][k] + points[j][k];
        points.push_back(p);
      }
      return at->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : faces) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = std::move(finer);
    for (auto& p : points) {
      const double size = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
      for (double& v : p) v /= size;
    }
  }
  Mesh mesh;
  for (const auto& p : points) {
    const double size = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    for (std::size_t k = 0; k < 3; ++k) mesh.positions.push_back(centre[k] + radius * p[k] / size);
  }
  for (const auto& face : faces) mesh.indices.insert(mesh.indices.end(), face.begin(), face.end());
  return mesh;
}

std::vector<std::uint32_t> Voxelized::words(const std::string& name) const {
  const Bytes& raw = bytes.at(name);
  std::vector<std::uint32_t> words(raw.size() / 4);
  if (!words.empty()) std::memcpy(words.data(), raw.data(), words.size() * 4);
  return words;
}

Voxelized voxelize(Context& context, const VoxelizeParams& params, const VoxelTriangles& triangles,
                   const std::vector<truth::Material>& materials) {
  Voxelized result;
  const Result<Plan> made = plan(params, context.profile());
  if (!made) {
    ADD_FAILURE() << made.status().message();
    return result;
  }
  std::vector<float> table;
  for (const truth::Material& m : materials) {
    for (const double v : m.colour) table.push_back(static_cast<float>(v));
    for (const double v : m.emission) table.push_back(static_cast<float>(v));
    table.push_back(0);
  }
  std::vector<std::string> names;
  for (const Resource& r : made.value().resources)
    if (r.written) names.push_back(r.name);
  std::vector<Bytes> out = run_bytes(context, made.value(),
                                     {{"triangles", bytes_of(triangles.records)},
                                      {"materials", encode(Format::f32x4, table, context.real64())}},
                                     names);
  for (std::size_t i = 0; i < names.size(); ++i) result.bytes[names[i]] = std::move(out[i]);
  const Bytes& counters = result.bytes["counters"];
  if (counters.size() == sizeof result.counters) std::memcpy(result.counters.data(), counters.data(), counters.size());
  return result;
}

std::vector<char> occupied(const VoxelizeParams& params, const Voxelized& result) {
  const Bytes& colour = result.bytes.at("colour");
  const std::size_t voxels = static_cast<std::size_t>(params.width) * params.height * params.depth;
  const bool real64 = colour.size() > voxels * bytes_per_pixel(params.format);
  const std::vector<double> values = decode(params.format, colour, real64);
  std::vector<char> set(values.size() / 4);
  for (std::size_t i = 0; i < set.size(); ++i) set[i] = values[4 * i + 3] > 0;
  return set;
}

std::vector<char> occupied(const std::vector<truth::Voxel>& voxels) {
  std::vector<char> set;
  for (const truth::Voxel& v : voxels) set.push_back(v.touched);
  return set;
}

std::size_t different(const std::vector<char>& a, const std::vector<char>& b) {
  if (a.size() != b.size()) return std::max(a.size(), b.size());
  std::size_t n = 0;
  for (std::size_t i = 0; i < a.size(); ++i) n += a[i] != b[i];
  return n;
}

}  // namespace luxel
