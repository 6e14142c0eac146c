// decode_npy: what it takes comes back the same from what encode_npy writes of it; all else is refused in one line.
#include "bench/io/array.h"
#include "bench/io/image.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace luxel;
  const Result<io::Array> array = io::decode_npy({data, size}, "fuzz.npy");
  if (!array) return fuzz::require_one_line(array.status()), 0;
  const io::Array& a = array.value();
  fuzz::require(a.data.size() <= size, "an array is no larger than its file");
  fuzz::require(a.elements() * io::bytes_of(a.dtype) == a.data.size(), "shape and data agree");
  fuzz::require(io::to_float(a).size() == a.elements(), "a float for each element");
  const Result<io::Array> again = io::decode_npy(io::encode_npy(a), "fuzz.npy");
  fuzz::require(again.ok() && again.value().shape == a.shape && again.value().dtype == a.dtype && again.value().data == a.data,
                "what is written is read again");
  const Result<io::Image> image = io::image_from_array(a, "fuzz.npy");
  if (!image) return fuzz::require_one_line(image.status()), 0;
  const io::Image& i = image.value();
  fuzz::require(i.pixels.size() == static_cast<std::size_t>(i.width) * static_cast<std::size_t>(i.height) *
                                       static_cast<std::size_t>(i.channels),
                "an image has all of its pixels");
  return 0;
}
