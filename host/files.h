// Small files: whole reads, atomic writes, and a checksummed envelope for caches.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace luxel {

/// Seed of a first call of fnv1a; a later call continues from an earlier one's result.
constexpr std::uint64_t fnv1a_seed = 0xcbf29ce484222325ull;

/// FNV-1a, 64 bits.
std::uint64_t fnv1a(const void* data, std::size_t bytes, std::uint64_t seed = fnv1a_seed);

/// The whole file. False when it cannot be read; `content` is empty then.
bool read_file(const std::string& path, std::vector<std::uint8_t>& content);

/// Writes beside `path` and renames, so that a reader sees the old file or the new one, never a part. Makes missing
/// folders. False when that fails; nothing is left behind then.
bool write_file_atomically(const std::string& path, std::span<const std::uint8_t> content);

/// What write_checked wrote. False for a file that is missing, truncated, lengthened or altered; `payload` is empty
/// then.
bool read_checked(const std::string& path, std::vector<std::uint8_t>& payload);

/// Writes magic, length, checksum and payload, atomically.
bool write_checked(const std::string& path, std::span<const std::uint8_t> payload);

/// Where caches go: $LUXEL_CACHE, else $XDG_CACHE_HOME/luxel, else $HOME/.cache/luxel, else empty: no cache. The folder
/// need not exist.
std::string cache_directory();

}  // namespace luxel
