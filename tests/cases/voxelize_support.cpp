#include "tests/cases/voxelize_support.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/cases/run.h"

namespace luxel::cases {

Result<Voxels> voxelize(Context& context, const VoxelizeParams& params, const VoxelTriangles& triangles,
                        const std::vector<truth::Material>& materials) {
  Result<Run> made = Run::make(context, plan(params, context.profile()));
  if (!made) return made.status();
  Run& run = made.value();
  std::vector<double> table;
  for (const truth::Material& m : materials) {
    table.insert(table.end(), m.colour.begin(), m.colour.end());
    table.insert(table.end(), m.emission.begin(), m.emission.end());
    table.push_back(0);
  }
  std::vector<double> records;
  for (const std::int32_t word : triangles.records) records.push_back(static_cast<std::uint32_t>(word));
  if (Status status = run.write("triangles", records); !status) return status;
  if (Status status = run.write("materials", table); !status) return status;
  if (Status status = run.go(); !status) return status;
  Voxels voxels;
  const auto read = [&](const char* name, std::vector<double>& to) -> Status {
    Result<std::vector<double>> values = run.read(name);
    if (!values) return values.status();
    to = std::move(values).value();
    return {};
  };
  std::vector<double> list;
  Status status = read("colour", voxels.colour);
  if (status && params.normal) status = read("normal", voxels.normal);
  if (status && params.emission) status = read("emission", voxels.emission);
  if (status && params.fragments > 0) status = read("fragments", list);
  if (status) status = read("counters", voxels.counters);
  if (!status) return status;
  const auto found = static_cast<std::size_t>(voxels.count(VoxelizeCount::fragments));
  for (std::size_t i = 0; i < std::min(found, list.size() / 4); ++i) {
    std::array<std::uint32_t, 4> f;
    for (std::size_t k = 0; k < 4; ++k) f[k] = static_cast<std::uint32_t>(list[4 * i + k]);
    voxels.fragments.push_back(f);
  }
  std::sort(voxels.fragments.begin(), voxels.fragments.end());
  return voxels;
}

std::vector<char> occupied(const Voxels& voxels) {
  std::vector<char> set(voxels.colour.size() / 4);
  for (std::size_t i = 0; i < set.size(); ++i) set[i] = voxels.colour[4 * i + 3] > 0;
  return set;
}

std::vector<std::array<std::uint32_t, 4>> fragments(const std::vector<truth::Voxel>& voxels, const VoxelGrid& grid) {
  std::vector<std::array<std::uint32_t, 4>> list;
  const auto w = static_cast<std::uint32_t>(grid.width), h = static_cast<std::uint32_t>(grid.height);
  for (std::uint32_t i = 0; i < voxels.size(); ++i)
    for (const std::uint32_t t : voxels[i].triangles) list.push_back({i % w, i / w % h, i / w / h, t});
  std::sort(list.begin(), list.end());
  return list;
}

double unmatched(const std::vector<std::array<std::uint32_t, 4>>& a,
                 const std::vector<std::array<std::uint32_t, 4>>& b) {
  std::vector<std::array<std::uint32_t, 4>> rest;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(rest));
  return static_cast<double>(rest.size());
}

const std::vector<truth::Material>& paints() {
  static const std::vector<truth::Material> all{{{0.8, 0.1, 0.25, 1}, {0, 0, 0}},
                                                {{0.0, 1.0, 0.5, 0.3}, {12.5, 3, 0}},
                                                {{0.3, 0.7, 0.9, 0.05}, {0, 0.01, brightest}}};
  return all;
}

double mean_bound(const truth::Voxel& v) {
  return static_cast<double>(v.triangles.size()) * 0x1p-19 / v.area + 0x1p-15 + 0x1p-20;
}

double worst_mean(const Voxels& voxels, const std::vector<truth::Voxel>& truth) {
  if (voxels.colour.size() != truth.size() * 4) return std::numeric_limits<double>::quiet_NaN();
  double most = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const truth::Voxel& v = truth[i];
    const auto compare = [&](const std::vector<double>& values, std::size_t k, double expected, double range) {
      if (values.empty()) return;
      const double difference = std::fabs(values[4 * i + k] - expected);
      const double share = v.touched ? difference / (range * mean_bound(v)) : difference == 0 ? 0 : HUGE_VAL;
      if (!(share <= most)) most = share;
    };
    compare(voxels.colour, 3, v.opacity, 1);
    for (std::size_t k = 0; k < 3; ++k) {
      compare(voxels.colour, k, v.colour[k], 1);
      compare(voxels.normal, k, v.normal[k], 2);
      compare(voxels.emission, k, v.emission[k], brightest);
    }
  }
  return most;
}

}  // namespace luxel::cases
