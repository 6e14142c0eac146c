#include "host/files.h"

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

#include <unistd.h>

namespace luxel {
namespace {

namespace fs = std::filesystem;

struct Header {
  char magic[8];
  std::uint64_t bytes;
  std::uint64_t checksum;
};
static_assert(sizeof(Header) == 24);

constexpr char magic[8] = {'l', 'u', 'x', 'e', 'l', '-', 'c', '1'};

}  // namespace

std::uint64_t fnv1a(const void* data, std::size_t bytes, std::uint64_t seed) {
  const auto* byte = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < bytes; ++i) seed = (seed ^ byte[i]) * 0x100000001b3ull;
  return seed;
}

bool read_file(const std::string& path, std::vector<std::uint8_t>& content) {
  content.clear();
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) return false;
  const std::streamoff size = in.tellg();
  if (size < 0) return false;
  content.resize(static_cast<std::size_t>(size));
  in.seekg(0);
  in.read(reinterpret_cast<char*>(content.data()), size);
  if (in.gcount() == size) return true;
  content.clear();
  return false;
}

bool write_file_atomically(const std::string& path, std::span<const std::uint8_t> content) {
  static std::atomic<unsigned> counter{0};
  std::error_code error;
  const fs::path folder = fs::path(path).parent_path();
  if (!folder.empty()) fs::create_directories(folder, error);
  const std::string temporary = path + "." + std::to_string(::getpid()) + "." + std::to_string(counter++) + ".tmp";
  std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(content.data()), static_cast<std::streamsize>(content.size()));
  out.close();
  if (out) {
    fs::rename(temporary, path, error);
    if (!error) return true;
  }
  fs::remove(temporary, error);
  return false;
}

bool read_checked(const std::string& path, std::vector<std::uint8_t>& payload) {
  Header header;
  if (!read_file(path, payload) || payload.size() < sizeof header) {
    payload.clear();
    return false;
  }
  std::memcpy(&header, payload.data(), sizeof header);
  payload.erase(payload.begin(), payload.begin() + sizeof header);
  const bool good = std::memcmp(header.magic, magic, sizeof magic) == 0 && header.bytes == payload.size() &&
                    header.checksum == fnv1a(payload.data(), payload.size());
  if (!good) payload.clear();
  return good;
}

bool write_checked(const std::string& path, std::span<const std::uint8_t> payload) {
  Header header{};
  std::memcpy(header.magic, magic, sizeof magic);
  header.bytes = payload.size();
  header.checksum = fnv1a(payload.data(), payload.size());
  std::vector<std::uint8_t> file(sizeof header + payload.size());
  std::memcpy(file.data(), &header, sizeof header);
  if (!payload.empty()) std::memcpy(file.data() + sizeof header, payload.data(), payload.size());
  return write_file_atomically(path, file);
}

std::string cache_directory() {
  const auto value = [](const char* name) {
    const char* text = std::getenv(name);
    return std::string(text ? text : "");
  };
  if (const std::string own = value("LUXEL_CACHE"); !own.empty()) return own;
  if (const std::string caches = value("XDG_CACHE_HOME"); !caches.empty()) return caches + "/luxel";
  if (const std::string home = value("HOME"); !home.empty()) return home + "/.cache/luxel";
  return {};
}

}  // namespace luxel
