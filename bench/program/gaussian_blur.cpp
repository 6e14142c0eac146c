#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <luxel/gaussian_blur.h>

#include "bench/io/image.h"
#include "bench/io/pixels.h"
#include "commands.h"
#include "common.h"

namespace luxel::program {
namespace {

struct Arguments {
  std::string in, out, device, variant, border, format, input, filter;
  double sigma = 0;
  int radius = -1, order = 5, passes = 3, levels = -1;
  bool difference = false, keep_alpha = false, drop_taps = false;
};

GaussianBlurParams parameters(const Arguments& a, const io::Image& image) {
  GaussianBlurParams p;
  p.width = image.width;
  p.height = image.height;
  p.sigma = a.sigma;
  p.radius = a.radius;
  p.border = a.border == "clamp"    ? Border::clamp
             : a.border == "mirror" ? Border::mirror
             : a.border == "wrap"   ? Border::wrap
                                    : Border::zero;
  const auto& variants = kernel("gaussian_blur").variants;  // in the order of the enumeration
  p.variant = static_cast<GaussianVariant>(
      std::find_if(variants.begin(), variants.end(), [&](const Variant& v) { return v.name == a.variant; }) -
      variants.begin());
  p.order = a.order;
  p.passes = a.passes;
  p.levels = a.levels;
  p.filter = a.filter == "linear" ? PyramidFilter::linear : PyramidFilter::cubic;
  p.format = storage_format(a.format, image.channels);
  p.input = a.input == "image" || p.variant == GaussianVariant::sampler ? Input::image : Input::buffer;
  p.difference = a.difference;
  p.keep_alpha = a.keep_alpha;
  p.drop_taps = a.drop_taps;
  return p;
}

int run(const Arguments& a) {
  if (Status s = io::check_image_path(a.out); !s) return complain(s);
  Result<io::Image> read = io::read_image(a.in);
  if (!read) return complain(read.status(), true);
  io::Image& image = read.value();
  const GaussianBlurParams p = parameters(a, image);
  if (Status s = validate(p); !s) return complain(s);

  const auto opened = open_device(a.device);
  if (!opened) return complain(opened.status());
  Context& context = *opened.value();
  const Result<Plan> plan = luxel::plan(p, context.profile());
  if (!plan) return complain(plan.status());
  ResourceData data{{"src", io::pack(image.pixels, image.channels, p.format, context.real64())}};
  Times times;
  if (Status s = run_plan(context, plan.value(), data, times); !s) return complain(s.message(), failed);

  image.pixels = io::unpack(data["dst"], p.format, context.real64(), image.channels);
  io::WriteReport changes;
  if (Status s = io::write_image(a.out, image, &changes); !s) return complain(s);
  const std::string knob = p.variant == GaussianVariant::recursive ? fmt::format("order {}", p.order)
                           : p.variant == GaussianVariant::box     ? fmt::format("{} passes", p.passes)
                           : p.variant == GaussianVariant::pyramid
                               ? fmt::format("{} levels {}", effective_levels(p), a.filter)
                               : fmt::format("radius {}", effective_radius(p));
  fmt::print("gaussian_blur {} {} {}x{}, sigma {}, {}, {} on {}: {}; wrote {}{}\n", a.variant, name(p.format), p.width,
             p.height, p.sigma, knob, a.border, context.info().id, time_text(times), a.out, changes_text(changes));
  return done;
}

}  // namespace

void add_gaussian_blur(CLI::App& app, int& exit_status) {
  const Kernel& k = kernel("gaussian_blur");
  CLI::App* command = app.add_subcommand("gaussian_blur", "blur an image file");
  auto a = std::make_shared<Arguments>();
  add_image_in(*command, a->in, "image to blur");
  add_image_out(*command, a->out, "blurred image");
  add_number(*command, k, "--sigma", a->sigma);
  add_number(*command, k, "--radius", a->radius);
  add_number(*command, k, "--order", a->order);
  add_number(*command, k, "--passes", a->passes);
  add_number(*command, k, "--levels", a->levels);
  add_variant(*command, k, a->variant);
  for (const auto& [name, value] :
       {std::pair{"--border", &a->border}, {"--format", &a->format}, {"--input", &a->input}, {"--filter", &a->filter}})
    add_choice(*command, k, name, *value);
  for (const auto& [name, value] :
       {std::pair{"--difference", &a->difference}, {"--keep-alpha", &a->keep_alpha}, {"--drop-taps", &a->drop_taps}})
    add_switch(*command, k, name, *value);
  add_device_option(*command, a->device);
  command->footer("Images pass without colour conversion. With taps, sigma above 1365 needs --radius.");
  command->callback([a, &exit_status] { exit_status = run(*a); });
}

}  // namespace luxel::program
