// luxel's small layer in twelve lines: a picture, blurred on whatever device there is.
//
//   twelve_lines IN OUT [DEVICE]     EXR, HDR, PNG or NPY; DEVICE: opencl, vulkan, cpu, or part of a name
#include <cstdio>
#include <cstdlib>

#include <luxel/device.h>
#include <luxel/gaussian_blur.h>

#include "bench/io/image.h"
#include "bench/io/pixels.h"

// What an error says, where there is one; an engine would pass the Status on.
void done(const luxel::Status& status) {
  if (!status) std::exit((std::fprintf(stderr, "twelve_lines: %s\n", status.message().c_str()), 1));
}
template <class T> T take(luxel::Result<T> result) {
  done(result.status());
  return std::move(result).value();
}

int main(int argc, char** argv) {
  if (argc < 3) return std::fprintf(stderr, "usage: twelve_lines IN OUT [DEVICE]\n"), 2;
  luxel::io::Image image = take(luxel::io::read_image(argv[1]));
  luxel::GaussianBlurParams blur;
  blur.width = image.width, blur.height = image.height, blur.sigma = 4;  // f32x4; the border is clamped, the radius 12
  auto context = take(luxel::Context::open(argc > 3 ? argv[3] : "opencl"));
  const luxel::Plan plan = take(luxel::plan(blur, context->profile()));  // or what is wrong: field, value, range
  auto program = take(context->compile(plan));
  auto src = take(context->make(plan.resources[0])), dst = take(context->make(plan.resources[1]));
  std::vector<std::uint8_t> pixels = luxel::io::pack(image.pixels, image.channels, blur.format, false);  // padded to four
  done(context->upload(*src, pixels.data(), pixels.size()));
  done(context->run(*program, {{"src", src}, {"dst", dst}}));
  done(context->download(*dst, pixels.data(), pixels.size()));
  image.pixels = luxel::io::unpack(pixels, blur.format, false, image.channels);
  done(luxel::io::write_image(argv[2], image));
}
