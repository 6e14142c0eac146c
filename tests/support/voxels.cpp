#include "tests/support/voxels.h"

#include <cstdlib>
#include <filesystem>

namespace luxel {

std::string data_file(const std::string& name) {
  const char* const folder = std::getenv("LUXEL_DATA");
  const std::string path = folder ? std::string(folder) + "/" + name : "";
  return !path.empty() && std::filesystem::exists(path) ? path : "";
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
