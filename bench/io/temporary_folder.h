// A folder of its own for files that nobody keeps.
#pragma once
#include <stdlib.h>

#include <filesystem>
#include <string>

namespace luxel::io {

/// Made in the system's folder for temporary files (TMPDIR), gone with all that is in it when this is. `name` is part of the folder's.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const char* name) {
    std::error_code error;
    std::string pattern = (std::filesystem::temp_directory_path(error) / (std::string(name) + "-XXXXXX")).string();
    if (!error && ::mkdtemp(pattern.data()) != nullptr) path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  /// Empty where none could be made.
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace luxel::io
