// The kept inputs of a fuzzer, and each of them cut short, through the fuzzer's function: what runs without libFuzzer.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/fuzz/fuzz.h"

int main(int argc, char** argv) {
  namespace fs = std::filesystem;
  std::size_t files = 0, runs = 0;
  for (int i = 1; i < argc; ++i) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(argv[i], error)) {
      std::ifstream in(entry.path(), std::ios::binary);
      const std::vector<char> bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
      // Of its own size, so that a sanitizer sees the first byte past the end.
      const std::size_t step = std::max<std::size_t>(1, bytes.size() / 32);
      for (std::size_t cut = 0; cut <= bytes.size(); cut += step) {
        const std::vector<std::uint8_t> input(bytes.begin(), bytes.end() - static_cast<std::ptrdiff_t>(cut));
        LLVMFuzzerTestOneInput(input.data(), input.size());
        ++runs;
      }
      ++files;
    }
  }
  std::printf("%zu inputs of %zu files\n", runs, files);
  return files == 0;  // a folder that is not there tests nothing
}
