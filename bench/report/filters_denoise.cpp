// A noisy render denoised by every variant of bilateral and by OpenCV.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <luxel/discontinuity_mask.h>

#include "bench/io/image.h"
#include "bench/report/denoise.h"
#include "bench/report/filter_rows.h"
#include "bench/report/filters.h"
#include "bench/report/filters_opencv.h"
#include "bench/report/scenes.h"
#include "tests/cases/bilateral_support.h"

namespace luxel::report {
namespace {

using cases::Run;
using cases::Values;

struct Render {
  NoisyRender noisy;
  Values light, truth, mask;
  std::vector<bool> edge;  // what discontinuity_mask marks at its defaults, grown by one
  double mean = 0, footprint = 0;
};

Result<Values> read(const char* file, int count) {
  Result<io::Image> image = io::read_image(data_folder() + "/gbuffer_cycles_cbox/" + file);
  if (!image) return image.status();
  const io::Image& i = image.value();
  Values values;
  for (std::size_t p = 0; p < i.pixels.size(); p += static_cast<std::size_t>(i.channels))
    for (int c = 0; c < count; ++c) values.push_back(c < i.channels ? i.pixels[p + static_cast<std::size_t>(c)] : 0.0);
  return values;
}

Result<std::shared_ptr<const Render>> load_render(Context& cpu) {
  auto r = std::make_shared<Render>();
  r->noisy.width = r->noisy.height = 256;
  const struct {
    const char* file;
    int count;
    Values& to;
  } files[] = {{"n1_color.exr", 4, r->noisy.color},
               {"n1_albedo.exr", 4, r->noisy.albedo},
               {"n1_normal.exr", 4, r->noisy.normals},
               {"n1_depth.exr", 1, r->noisy.depth},
               {"ref512_color.exr", 4, r->truth}};
  for (const auto& f : files) {
    auto values = read(f.file, f.count);
    if (!values) return values.status();
    if (values.value().size() != static_cast<std::size_t>(256 * 256 * f.count))
      return Status(Code::io, std::string(f.file) + " does not have 256x256 pixels");
    f.to = std::move(values).value();
  }
  r->light = without_albedo(r->noisy, r->noisy.color);
  r->footprint = 2 * std::tan(39.3077 * M_PI / 360) / 256;  // the field of view of the scene's file
  for (std::size_t i = 0; i < r->truth.size(); ++i) r->mean += i % 4 == 3 ? 0 : r->truth[i] / (3.0 * 256 * 256);
  DiscontinuityMaskParams p;
  p.width = p.height = 256;
  Result<Run> made = Run::make(cpu, plan(p, cpu.profile()));
  if (!made) return made.status();
  if (Status s = made.value().write("depth", r->noisy.depth); !s) return s;
  if (Status s = made.value().write("normals", r->noisy.normals); !s) return s;
  if (Status s = made.value().go(); !s) return s;
  auto mask = made.value().read("mask");
  if (!mask) return mask.status();
  r->mask = std::move(mask).value();
  r->edge.assign(256 * 256, false);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) {
      // The image's border is no edge of a surface.
      const int bits = static_cast<int>(r->mask[static_cast<std::size_t>(y) * 256 + x]) &
                       ((x < 255 ? 1 : 0) | (y < 255 ? 2 : 0) | (x > 0 ? 4 : 0) | (y > 0 ? 8 : 0));
      for (int j = std::max(y - 1, 0); bits != 0 && j <= std::min(y + 1, 255); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, 255); ++i)
          r->edge[static_cast<std::size_t>(j) * 256 + i] = true;
    }
  return std::shared_ptr<const Render>(r);
}

const std::vector<std::string> noise_metrics{"relmse_pixel, all pixels", "relmse_pixel, off edges"};

// Both metrics: mean of (x - t)^2 / (t^2 + (0.01 mean t)^2).
std::vector<double> noise_left(const Render& r, const Values& color) {
  const double epsilon = 0.01 * r.mean * 0.01 * r.mean;
  double all = 0, off = 0, count = 0, count_off = 0;
  for (std::size_t i = 0; i < color.size(); ++i) {
    if (i % 4 == 3) continue;
    const double d = color[i] - r.truth[i], e = d * d / (r.truth[i] * r.truth[i] + epsilon);
    all += e;
    ++count;
    if (r.edge[i / 4]) continue;
    off += e;
    ++count_off;
  }
  return {all / count, off / count_off};
}

void add_noise_rows(Session& session, const std::string& variant, Cell options, Cell knobs, const Sample& ms,
                    std::vector<ErrorSplit> errors, const Run* run) {
  for (ErrorSplit& error : errors) {
    FrontierRow row;
    row.kernel = "bilateral";
    row.variant = variant;
    row.scene = "Cornell box by Cycles, 1 sample a pixel";
    row.size = "256x256";
    row.options = options;
    row.knobs = knobs;
    row.group = "denoise";
    row.error = std::move(error);
    row.shade = cell_of(ms);
    if (run != nullptr) row.costs_of(*run);
    session.frontier(row);
  }
}

Result<Run> prepared(Context& context, const Render& r, const BilateralParams& p) {
  Result<Run> made = Run::make(context, plan(p, context.profile()));
  if (!made) return made;
  if (Status s = write_inputs(made.value(), {{"src", &r.light},
                                             {"guide", &r.noisy.albedo},
                                             {"depth", &r.noisy.depth},
                                             {"normals", &r.noisy.normals},
                                             {"mask", &r.mask}});
      !s)
    return s;
  return made;
}

Result<Values> filtered(Context& context, const Render& r, const BilateralParams& p) {
  Result<Run> run = prepared(context, r, p);
  if (!run) return run.status();
  if (Status s = run.value().go(); !s) return s;
  return run.value().read("dst");
}

std::vector<Oracle> oracles_of(const std::vector<double>& single, const std::vector<double>& exact,
                               std::uint64_t bits) {
  std::vector<Oracle> oracles;
  for (std::size_t i = 0; i < single.size(); ++i)
    oracles.push_back({bits, std::fabs(single[i] - exact[i]), 0, exact[i]});
  return oracles;
}

Status measure_noise(Session& session, const Render& r, const BilateralParams& p, const std::string& label) {
  Result<Run> made = prepared(session.context(), r, p);
  if (!made) return made.status();
  const Result<Sample> ms = session.time(made.value(), label);
  if (!ms) return ms.status();
  const auto out = made.value().read("dst");
  if (!out) return out.status();
  const auto left = [&](const Values& v) { return noise_left(r, with_albedo(r.noisy, v)); };
  const auto errors = session.errors(
      label, noise_metrics, hash_values(out.value()), true,
      [&]() -> Result<std::vector<Oracle>> {
        const auto single = filtered(session.cpu_float(), r, p), exact = filtered(session.cpu_double(), r, p);
        if (!single) return single.status();
        if (!exact) return exact.status();
        return oracles_of(left(single.value()), left(exact.value()), hash_values(single.value()));
      },
      [&]() -> Result<std::vector<double>> {
        const auto single = filtered(session.cpu_float(), r, p);
        if (!single) return single.status();
        const std::vector<double> a = left(out.value()), b = left(single.value());
        return std::vector{std::fabs(a[0] - b[0]), std::fabs(a[1] - b[1])};
      });
  if (!errors) return errors.status();
  add_noise_rows(session, variant_text(p), options_of(p), knobs_of(p), ms.value(), errors.value(), &made.value());
  return {};
}

Status measure_denoise(Session& session, const Render& r, const DenoiseParams& p, const std::string& label) {
  std::vector<double> times;
  Values color;
  for (int turn = 0; turn < (session.settings().once ? 1 : session.settings().quick ? 5 : 9); ++turn) {
    const auto result = denoise(session.context(), r.noisy, p);
    if (!result) return result.status();
    times.push_back(result.value().ms);
    color = result.value().color;
  }
  const auto errors = session.errors(
      label, noise_metrics, hash_values(color), true,
      [&]() -> Result<std::vector<Oracle>> {
        const auto single = denoise(session.cpu_float(), r.noisy, p), exact = denoise(session.cpu_double(), r.noisy, p);
        if (!single) return single.status();
        if (!exact) return exact.status();
        return oracles_of(noise_left(r, single.value().color), noise_left(r, exact.value().color),
                          hash_values(single.value().color));
      },
      [&]() -> Result<std::vector<double>> {
        const auto single = denoise(session.cpu_float(), r.noisy, p);
        if (!single) return single.status();
        const std::vector<double> a = noise_left(r, color), b = noise_left(r, single.value().color);
        return std::vector{std::fabs(a[0] - b[0]), std::fabs(a[1] - b[1])};
      });
  if (!errors) return errors.status();
  add_noise_rows(session, "luxel denoise", {{"clamp", p.clamp}},
                 {{"levels", p.levels},
                  {"sigma_luminance", p.sigma_luminance},
                  {"variance_target", p.variance_target},
                  {"k", p.clamp ? p.k : 0}},
                 summarise(times), errors.value(), nullptr);
  return {};
}

BilateralParams guided(const Render& r, BilateralVariant variant, int radius) {
  BilateralParams p;
  p.width = p.height = 256;
  p.variant = variant;
  p.radius = radius;
  p.sigma_space = std::max(radius, 1) / 1.5;
  p.range = RangeTerm::guide;
  p.sigma_range = 0.01;
  p.depth = DepthTerm::plane;
  p.footprint = r.footprint;
  p.normal = true;
  p.sigma_normal = 64;
  return p;
}

}  // namespace

std::vector<Job> denoise_grid(Session& session, std::vector<std::string>& missing) {
  const auto loaded = load_render(session.cpu_float());
  if (!loaded) {
    missing.push_back("bilateral on a noisy render: " + loaded.status().message());
    return {};
  }
  const std::shared_ptr<const Render> r = loaded.value();
  std::vector<Job> jobs;
  const auto add = [&](const BilateralParams& p, const std::string& text) {
    const std::string label = "bilateral denoise " + text;
    jobs.push_back({label, [&session, r, p, label] { return measure_noise(session, *r, p, label); }});
  };
  const bool quick = session.settings().quick;
  for (const int radius : quick ? std::vector{6} : std::vector{2, 4, 6, 12}) {
    BilateralParams p = guided(*r, BilateralVariant::direct, radius);
    add(p, fmt::format("direct R {}", radius));
    if (radius >= 6 && !quick) {
      p.step = 2;
      add(p, fmt::format("direct R {} step 2", radius));
    }
    p = guided(*r, BilateralVariant::separable, radius);
    add(p, fmt::format("separable R {}", radius));
    p.adaptive = true;
    add(p, fmt::format("separable R {} adaptive", radius));
    p = guided(*r, BilateralVariant::discontinuity, radius);
    p.range = RangeTerm::off;
    p.depth = DepthTerm::off;
    p.normal = false;
    add(p, fmt::format("discontinuity R {}", radius));
  }
  for (const int levels : quick ? std::vector{3} : std::vector{2, 3, 4, 5})
    for (const int taps : quick ? std::vector{5} : std::vector{3, 5}) {
      BilateralParams p = guided(*r, BilateralVariant::atrous, 0);
      p.levels = levels;
      p.taps = taps;
      add(p, fmt::format("atrous {} levels of {} taps", levels, taps * taps));
    }
  for (const double cell : quick ? std::vector{2.0} : std::vector{2.0, 4.0, 8.0}) {
    BilateralParams p;
    p.width = p.height = 256;
    p.variant = BilateralVariant::grid;
    p.sigma_space = cell;
    p.sigma_range = 0.3;
    p.high = 20;
    add(p, fmt::format("grid {}", cell));
  }
  for (const bool clamp : quick ? std::vector<bool>{true} : std::vector<bool>{true, false})
    for (const int levels : quick ? std::vector{5} : std::vector{3, 4, 5})
      for (const double sigma : quick || levels != 5 ? std::vector{6.0} : std::vector{4.0, 6.0, 8.0}) {
        DenoiseParams p;
        p.footprint = r->footprint;
        p.levels = levels;
        p.sigma_luminance = sigma;
        p.clamp = clamp;
        const std::string label = fmt::format("bilateral denoise preset {} levels, sigma_luminance {}{}", levels, sigma,
                                              clamp ? "" : ", no clamp");
        jobs.push_back({label, [&session, r, p, label] { return measure_denoise(session, *r, p, label); }});
      }
  // Levels that are not run where noise is below a target.
  for (const double target : quick ? std::vector{0.003} : std::vector{3e-4, 0.003, 0.03}) {
    DenoiseParams p;
    p.footprint = r->footprint;
    p.variance_target = target;
    const std::string label = fmt::format("bilateral denoise preset, variance target {}", target);
    jobs.push_back({label, [&session, r, p, label] { return measure_denoise(session, *r, p, label); }});
  }
  if (!session.is_cpu())
    for (OpenCvFilter& peer : opencv_denoisers(r->noisy, quick)) {
      const std::string label = "bilateral denoise peer " + peer.name;
      jobs.push_back(
          {label, [&session, r, peer]() -> Status {
             std::vector<double> times;
             for (int turn = 0; turn < 6; ++turn) {
               const Result<double> ms = peer.run();
               if (!ms) return ms.status();
               if (turn > 0) times.push_back(ms.value());
             }
             const std::vector<double> left = noise_left(*r, with_albedo(r->noisy, peer.result()));
             std::vector<ErrorSplit> errors(2);
             for (std::size_t i = 0; i < 2; ++i) {
               errors[i].metric = noise_metrics[i];
               errors[i].method = left[i];
             }
             add_noise_rows(session, peer.name, {{"peer", true}}, peer.knobs, summarise(times), errors, nullptr);
             return {};
           }});
    }
  return jobs;
}

}  // namespace luxel::report
