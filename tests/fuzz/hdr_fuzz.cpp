// decode_hdr (Radiance RGBE): whole images or a refusal of one line. Images that would take more than 64 MB are left out.
#include <cmath>

#include "bench/io/codecs.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace luxel;
  const Result<io::Image> image = io::decode_hdr({data, size}, "fuzz.hdr");
  if (!image) return fuzz::require_one_line(image.status()), 0;
  const io::Image& i = image.value();
  fuzz::require(i.width >= 1 && i.height >= 1 && i.width <= io::largest_side && i.height <= io::largest_side, "sizes in range");
  fuzz::require(i.pixels.size() == static_cast<std::size_t>(i.width) * static_cast<std::size_t>(i.height) *
                                       static_cast<std::size_t>(i.channels),
                "an image has all of its pixels");
  for (const float v : i.pixels) fuzz::require(std::isfinite(v) && v >= 0, "RGBE holds finite values that are not negative");
  return 0;
}
