// One bright pixel, blurred on the first OpenCL device: what is left of it in the middle, and the sum, which a blur keeps.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <luxel/device.h>
#include <luxel/gaussian_blur.h>

void done(const luxel::Status& status) {
  if (!status) std::exit((std::fprintf(stderr, "first_kernel: %s\n", status.message().c_str()), 1));
}
template <class T> T take(luxel::Result<T> result) {
  done(result.status());
  return std::move(result).value();
}

int main() {
  luxel::GaussianBlurParams blur;
  blur.width = blur.height = 256, blur.sigma = 4;  // f32x4, radius 12
  std::vector<float> pixels(256 * 256 * 4);
  pixels[(128 * 256 + 128) * 4] = 1;
  auto context = take(luxel::Context::open("opencl"));
  const luxel::Plan plan = take(luxel::plan(blur, context->profile()));
  auto program = take(context->compile(plan));
  auto src = take(context->make(plan.resources[0])), dst = take(context->make(plan.resources[1]));
  const std::size_t bytes = pixels.size() * sizeof(float);
  done(context->upload(*src, pixels.data(), bytes));
  done(context->run(*program, {{"src", src}, {"dst", dst}}));
  done(context->download(*dst, pixels.data(), bytes));
  double sum = 0;
  for (std::size_t i = 0; i < pixels.size(); i += 4) sum += pixels[i];
  std::printf("middle %.6f, sum %.6f\n", static_cast<double>(pixels[(128 * 256 + 128) * 4]), sum);
}
