#include "tests/cases/voxelize_meshes.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "bench/scene/images.h"

namespace luxel::cases {

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

VoxelGrid unit_grid(int n) {
  VoxelGrid grid;
  grid.width = grid.height = grid.depth = n;
  return grid;
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

Mesh awkward_mesh(std::uint32_t count, double n, std::uint32_t seed) {
  Mesh mesh;
  for (std::uint32_t t = 0; t < count; ++t) {
    std::uint32_t at = t * 32u;
    const auto next = [&] { return scene::random01(at++, seed); };
    std::array<double, 9> v;
    const double reach = t % 16 == 0 ? 2 * n : t % 4 == 0 ? n : 2.5;  // from +-2 grids down to small ones
    for (std::size_t k = 0; k < 3; ++k) {
      const double centre = n * next();
      for (std::size_t i = 0; i < 3; ++i) v[3 * i + k] = centre + reach * (2 * next() - 1);
    }
    switch (t / 16 % 8) {
      case 0: break;
      case 1: for (double& c : v) c = std::floor(c); break;               // voxel corners
      case 2: for (double& c : v) c = std::floor(2 * c) / 2; break;       // corners, faces, centres
      case 3: for (std::size_t i = 0; i < 3; ++i) v[3 * i + t % 3] = std::floor(v[t % 3]); break;  // in a grid plane
      case 4: for (std::size_t k = 0; k < 3; ++k) v[6 + k] = v[k]; break;                          // a segment
      case 5: for (std::size_t k = 0; k < 6; ++k) v[3 + k] = v[k % 3]; break;                      // a point
      case 6: for (std::size_t k = 0; k < 3; ++k) v[6 + k] = 0.25 * v[k] + 0.75 * v[3 + k] + 1e-5 * (next() - 0.5); break;
      default: for (std::size_t k = 0; k < 3; ++k) v[3 + k] = k == t % 3 ? v[3 + k] : std::floor(v[k] = std::floor(v[k]));
    }  // 6: slivers; 7: an edge along a grid line
    mesh.add(v);
  }
  return mesh;
}

Mesh cube_mesh(double low, double high) {
  Mesh mesh;
  const double us[2][3] = {{low, high, low}, {high, high, low}}, ws[2][3] = {{low, low, high}, {low, high, high}};
  for (std::size_t face = 0; face < 12; ++face) {
    const std::size_t axis = face / 4, half = face % 2;
    std::array<double, 9> v;
    for (std::size_t i = 0; i < 3; ++i) {
      v[3 * i + axis] = face / 2 % 2 ? high : low;
      v[3 * i + (axis + 1) % 3] = us[half][i];
      v[3 * i + (axis + 2) % 3] = ws[half][i];
    }
    mesh.add(v);
  }
  return mesh;
}

std::size_t enclosed(const std::vector<char>& occupied, int n, bool by_corners) {
  std::vector<char> seen(occupied);
  if (seen.empty() || seen[0]) return 0;
  seen[0] = 1;
  const auto at = [&](const std::array<int, 3>& p) { return (static_cast<std::size_t>(p[2]) * n + p[1]) * n + p[0]; };
  std::vector<std::array<int, 3>> front{{0, 0, 0}};
  while (!front.empty()) {
    const auto p = front.back();
    front.pop_back();
    for (int d = 0; d < 27; ++d) {
      const std::array<int, 3> q{p[0] + d % 3 - 1, p[1] + d / 3 % 3 - 1, p[2] + d / 9 - 1};
      const int steps = std::abs(q[0] - p[0]) + std::abs(q[1] - p[1]) + std::abs(q[2] - p[2]);
      if (steps == 0 || (steps > 1 && !by_corners)) continue;
      if (std::any_of(q.begin(), q.end(), [&](int c) { return c < 0 || c >= n; }) || seen[at(q)]) continue;
      seen[at(q)] = 1;
      front.push_back(q);
    }
  }
  return static_cast<std::size_t>(std::count(seen.begin(), seen.end(), 0));
}

}  // namespace luxel::cases
