// The same with emitted files: `luxel emit gaussian_blur --size 256x256 --options sigma=4 --format cpp -o blur`. Names, bindings,
// parameters and groups are those of blur/gaussian_blur.json; GLM is all that is needed.
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "blur/gaussian_blur_columns.hpp"
#include "blur/gaussian_blur_rows.hpp"

// The weights: the manifest's only table.
std::vector<float> weights(const char* manifest) {
  std::stringstream text;
  text << std::ifstream(manifest).rdbuf();
  const std::string all = text.str();
  std::istringstream list(all.substr(all.find('[', all.find("\"values\"")) + 1));
  std::vector<float> found;
  for (char separator = ','; separator == ',' && list; list >> separator) {
    float w = 0;
    list >> w;
    found.push_back(w);
  }
  return found;
}

template <class Kernel> void pass(const glm::vec4* src, glm::vec4* dst, const float* weights, glm::ivec3 groups) {
  Kernel k;
  k.params.width = k.params.height = k.params.src_stride = k.params.dst_stride = 256;
  k.src = src, k.dst = dst, k.weights = weights;
  k.run(groups);
}

int main() {
  const std::vector<float> w = weights("blur/gaussian_blur.json");
  std::vector<glm::vec4> src(256 * 256), scratch(src.size()), dst(src.size());
  src[128 * 256 + 128].x = 1;
  pass<gaussian_blur_rows::Kernel>(src.data(), scratch.data(), w.data(), {2, 64, 1});
  pass<gaussian_blur_columns::Kernel>(scratch.data(), dst.data(), w.data(), {8, 16, 1});
  double sum = 0;
  for (const glm::vec4& p : dst) sum += p.x;
  std::printf("middle %.6f, sum %.6f\n", static_cast<double>(dst[128 * 256 + 128].x), sum);
}
