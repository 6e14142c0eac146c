#include "bench/report/kept.h"

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "bench/report/scenes.h"
#include "host/files.h"
#include "host/module.h"

namespace luxel::report {
namespace {

std::uint64_t hash_of(const std::string& text) {
  std::uint64_t value = 0xcbf29ce484222325ull;
  for (const char c : text) value = (value ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  return value;
}

std::string text_of(const Shape& s) {
  return fmt::format("{} {} {} {} {}x{}x{}", s.lanes, s.block, s.unroll, s.split, s.workgroup[0], s.workgroup[1], s.workgroup[2]);
}

// A file by its name, length and time of change.
std::string stamp(const std::string& path) {
  struct stat s{};
  if (::stat(path.c_str(), &s) != 0) return path;
  return fmt::format("{} {} {}.{}", path, s.st_size, s.st_mtim.tv_sec, s.st_mtim.tv_nsec);
}

}  // namespace

KeptJobs read_kept(const std::string& path) {
  KeptJobs all;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const Json j = Json::parse(line, nullptr, false);
    if (!j.is_object() || !j.contains("job") || !j["job"].is_string()) continue;
    const std::string key = j["job"];
    if (j.contains("begin")) all[key] = {};
    const auto job = all.find(key);
    if (job == all.end() || !job->second.finished.is_null()) continue;
    job->second.lines.push_back(line);
    if (j.contains("finished") && j["finished"].is_object()) job->second.finished = j["finished"];
  }
  std::erase_if(all, [](const auto& job) { return job.second.finished.is_null(); });
  return all;
}

Status write_kept(const std::string& path, const KeptJobs& jobs) {
  std::string text;
  for (const auto& [key, job] : jobs)
    for (const std::string& line : job.lines) text += line + "\n";
  return write_file(path, text);
}

std::string job_key(const DeviceInfo& device, const Profile& p, const Settings& settings, const std::string& label) {
  std::string text = fmt::format("{}|{}|{}|{}|{}|{}", LUXEL_VERSION, device.id, device.driver, settings.quick, data_folder(), label);
  text += fmt::format("|{}|{}|{}|{}|{}|{}|{}", p.name, text_of(p.rows), text_of(p.columns), text_of(p.pixels), text_of(p.voxels),
                      p.workgroup_memory, p.texels);
  for (const std::string& image : settings.images) text += "|" + stamp(image);
  return fmt::format("{:016x}", hash_of(text));
}

std::string module_hash(const std::string& module) {
  const std::size_t dot = module.find('.');
  if (dot == std::string::npos) return {};
  const Module* const found = find_module(module.substr(0, dot), module.substr(dot + 1));
  return found ? fmt::format("{:016x}", found->hash) : std::string();
}

bool unchanged(const Json& modules) {
  if (!modules.is_object()) return false;
  for (const auto& [name, hash] : modules.items())
    if (!hash.is_string() || hash != module_hash(name)) return false;
  return true;
}

Status write_file(const std::string& path, const std::string& text) {
  if (!write_file_atomically(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}))
    return {Code::io, path + " could not be written; check the folder and the space on its disk"};
  return {};
}

}  // namespace luxel::report
