#include <luxel/bilateral.h>
#include <luxel/discontinuity_mask.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include <fmt/format.h>

#include "bench/io/image.h"
#include "bench/io/pixels.h"
#include "commands.h"
#include "common.h"

namespace luxel::program {
namespace {

struct Arguments {
  std::string in, out, guide, depth, normal, variance, device;
  std::string variant, range, range_norm, window, taps, depth_term, border, format;
  double sigma_space = 3, sigma_range = 0.1, sigma_depth = 1, footprint = 0.001, sigma_normal = 128,
         sigma_luminance = 4, variance_target = 0, flat = 0;
  double low = 0, high = 1, depth_threshold = 0.02, normal_threshold = 0.9;
  int radius = -1, step = 1, levels = 5;
  bool adaptive = false, alpha = false;
};

// A guide of the image's size; the first `most` channels of more, and at least `least`.
Result<io::Image> read_guide(const char* option, const std::string& path, const io::Image& like, int least, int most) {
  Result<io::Image> read = io::read_image(path);
  if (!read) return read;
  io::Image& g = read.value();
  if (g.width != like.width || g.height != like.height)
    return Status(Code::io, fmt::format("{}: has {}x{} pixels; {} expects those of --in, {}x{}", path, g.width,
                                        g.height, option, like.width, like.height));
  if (g.channels < least)
    return Status(Code::io, fmt::format("{}: has {} channels; {} expects {} or more", path, g.channels, option, least));
  if (g.channels <= most) return read;
  std::vector<float> kept;
  for (std::size_t i = 0; i < g.pixels.size(); ++i)
    if (i % static_cast<std::size_t>(g.channels) < static_cast<std::size_t>(most)) kept.push_back(g.pixels[i]);
  g.pixels = std::move(kept);
  g.channels = most;
  return read;
}

BilateralParams parameters(const Arguments& a, const io::Image& image) {
  BilateralParams p;
  p.width = image.width;
  p.height = image.height;
  p.variant = a.variant == "direct"      ? BilateralVariant::direct
              : a.variant == "separable" ? BilateralVariant::separable
              : a.variant == "atrous"    ? BilateralVariant::atrous
              : a.variant == "grid"      ? BilateralVariant::grid
                                         : BilateralVariant::discontinuity;
  p.low = a.low;
  p.high = a.high;
  p.sigma_space = a.sigma_space;
  p.radius = a.radius;
  p.step = a.step;
  p.window = a.window == "circle" ? FilterWindow::circle : FilterWindow::square;
  p.adaptive = a.adaptive;
  p.levels = a.levels;
  p.taps = a.taps == "5" ? 5 : 3;
  p.range = a.range == "off" ? RangeTerm::off : a.guide.empty() ? RangeTerm::self : RangeTerm::guide;
  p.sigma_range = a.sigma_range;
  p.range_norm = a.range_norm == "l1" ? RangeNorm::l1 : RangeNorm::l2;
  p.depth = a.depth.empty() ? DepthTerm::off : a.depth_term == "plane" ? DepthTerm::plane : DepthTerm::svgf;
  p.sigma_depth = a.sigma_depth;
  p.footprint = a.footprint;
  p.normal = !a.normal.empty();
  p.sigma_normal = a.sigma_normal;
  p.luminance = !a.variance.empty();
  p.sigma_luminance = a.sigma_luminance;
  p.variance_target = a.variance_target;
  p.flat = a.flat;
  p.border = a.border == "clamp"    ? Border::clamp
             : a.border == "mirror" ? Border::mirror
             : a.border == "wrap"   ? Border::wrap
                                    : Border::zero;
  p.format = storage_format(a.format, image.channels);
  p.alpha = a.alpha;
  p.count = p.variant != BilateralVariant::grid && p.variant != BilateralVariant::discontinuity;
  if (p.variant == BilateralVariant::discontinuity) {  // its guides make the mask
    p.range = RangeTerm::off;
    p.depth = DepthTerm::off;
    p.normal = false;
  }
  return p;
}

Status make_mask(Context& context, const Arguments& a, const BilateralParams& p, ResourceData& data) {
  DiscontinuityMaskParams m;
  m.width = p.width;
  m.height = p.height;
  m.normal = !a.normal.empty();
  m.depth_threshold = a.depth_threshold;
  m.normal_threshold = a.normal_threshold;
  if (Status s = validate(m); !s) return s;
  const Result<Plan> plan = luxel::plan(m, context.profile());
  if (!plan) return plan.status();
  Times times;
  return run_plan(context, plan.value(), data, times);
}

// What was left out of the averages.
std::string counts_text(const std::vector<std::uint8_t>& bytes) {
  std::array<std::uint32_t, 4> counts{};
  if (bytes.size() < sizeof counts) return {};
  std::memcpy(counts.data(), bytes.data(), sizeof counts);
  const char* const what[] = {"pixels that are not finite", "guide colours that are not finite",
                              "pixels without a surface", "pixels without a normal"};
  std::string text;
  for (std::size_t i = 0; i < 4; ++i)
    if (counts[i] > 0) text += fmt::format("; {} {}", counts[i], what[i]);
  return text;
}

int run(const Arguments& a) {
  if (Status s = io::check_image_path(a.out); !s) return complain(s);
  if (a.range == "guide" && a.guide.empty())
    return complain("--range is guide; expected --guide with an image", misused);
  if (a.range == "off" && !a.guide.empty()) return complain("--range is off; expected guide with --guide", misused);
  if (a.variant == "discontinuity" && a.depth.empty())
    return complain("--variant is discontinuity; expected --depth with an image", misused);
  Result<io::Image> read = io::read_image(a.in);
  if (!read) return complain(read.status(), true);
  io::Image& image = read.value();
  BilateralParams p = parameters(a, image);

  struct Guide {
    const char* option;
    const std::string& path;
    const char* resource;
    int least, most;
    io::Image image = {};
  };
  Guide guides[] = {{"--guide", a.guide, "guide", 1, 4},
                    {"--depth", a.depth, "depth", 1, 1},
                    {"--normal", a.normal, "normals", 3, 3},
                    {"--variance", a.variance, "variance", 1, 1}};
  for (Guide& g : guides) {
    if (g.path.empty()) continue;
    Result<io::Image> found = read_guide(g.option, g.path, image, g.least, g.most);
    if (!found) return complain(found.status(), true);
    g.image = std::move(found).value();
  }
  if (!a.guide.empty()) p.guide_format = io::format_for(Format::f32x1, guides[0].image.channels);
  if (Status s = validate(p); !s) return complain(s);

  const auto opened = open_device(a.device);
  if (!opened) return complain(opened.status());
  Context& context = *opened.value();
  const Result<Plan> plan = luxel::plan(p, context.profile());
  if (!plan) return complain(plan.status());
  ResourceData data{{"src", io::pack(image.pixels, image.channels, p.format, context.real64())},
                    {"counters", std::vector<std::uint8_t>(16)}};
  for (const Guide& g : guides)
    if (!g.path.empty())
      data[g.resource] =
          io::pack(g.image.pixels, g.image.channels, io::format_for(Format::f32x1, g.image.channels), context.real64());
  if (p.variant == BilateralVariant::discontinuity)
    if (Status s = make_mask(context, a, p, data); !s) return complain(s);
  Times times;
  if (Status s = run_plan(context, plan.value(), data, times); !s) return complain(s.message(), failed);

  image.pixels = io::unpack(data["dst"], p.format, context.real64(), image.channels);
  io::WriteReport changes;
  if (Status s = io::write_image(a.out, image, &changes); !s) return complain(s);
  fmt::print("bilateral {} {} {}x{}, {} on {}: {}; wrote {}{}{}\n", a.variant, name(p.format), p.width, p.height,
             a.border, context.info().id, time_text(times), a.out, counts_text(data["counters"]),
             changes_text(changes));
  return done;
}

}  // namespace

void add_bilateral(CLI::App& app, int& exit_status) {
  const Kernel& k = kernel("bilateral");
  CLI::App* command = app.add_subcommand("bilateral", "filter an image file and keep its edges");
  auto a = std::make_shared<Arguments>();
  add_image_in(*command, a->in, "image to filter");
  add_image_out(*command, a->out, "filtered image");
  command->add_option("--guide", a->guide, "image whose differences of colour weigh, in place of those of --in")
      ->type_name("FILE");
  command
      ->add_option("--depth", a->depth, "view-space depth, first channel; 1e10 and more is sky, which stays as it is")
      ->type_name("FILE");
  command->add_option("--normal", a->normal, "unit normals, first three channels, -1..1")->type_name("FILE");
  command->add_option("--variance", a->variance, "variance of the luminance of --in, first channel")->type_name("FILE");
  add_variant(*command, k, a->variant);
  for (const auto& [name, value] : {std::pair{"--range", &a->range},
                                    {"--range-norm", &a->range_norm},
                                    {"--window", &a->window},
                                    {"--taps", &a->taps},
                                    {"--depth-term", &a->depth_term},
                                    {"--border", &a->border},
                                    {"--format", &a->format}})
    add_choice(*command, k, name, *value);
  for (const auto& [name, value] : {std::pair{"--adaptive", &a->adaptive}, {"--alpha", &a->alpha}})
    add_switch(*command, k, name, *value);
  for (const auto& [name, value] : {std::pair{"--sigma-space", &a->sigma_space},
                                    {"--sigma-range", &a->sigma_range},
                                    {"--sigma-depth", &a->sigma_depth},
                                    {"--footprint", &a->footprint},
                                    {"--sigma-normal", &a->sigma_normal},
                                    {"--sigma-luminance", &a->sigma_luminance},
                                    {"--variance-target", &a->variance_target},
                                    {"--flat", &a->flat},
                                    {"--low", &a->low},
                                    {"--high", &a->high},
                                    {"--depth-threshold", &a->depth_threshold},
                                    {"--normal-threshold", &a->normal_threshold}})
    add_number(*command, k, name, *value);
  for (const auto& [name, value] : {std::pair{"--radius", &a->radius}, {"--step", &a->step}, {"--levels", &a->levels}})
    add_number(*command, k, name, *value);
  add_device_option(*command, a->device);
  command->footer(
      "Images pass without colour conversion. Pixels that are not finite stay as they are and weigh nothing.");
  command->callback([a, &exit_status] { exit_status = run(*a); });
}

}  // namespace luxel::program
