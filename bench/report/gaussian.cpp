#include "bench/report/gaussian.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/truth/gaussian_truth.h"
#include "tests/cases/compare.h"
#include "tests/cases/gaussian_blur_support.h"
#include "tests/cases/storage.h"

namespace luxel::report {
namespace {

using cases::Run;
using cases::Values;

const char* name_of(Input input) {
  return input == Input::buffer ? "buffer" : input == Input::image ? "image" : "storage image";
}

const char* name_of(BlurMetric metric) {
  return metric == BlurMetric::largest ? "max |x - t| / max |input|" : "half L1 of the impulse response's error";
}

double largest_of(const Values& v) {
  double most = 0;
  for (const double x : v) most = std::max(most, std::fabs(x));
  return most;
}

double distance(BlurMetric metric, double full_scale, const Values& a, const Values& b) {
  return metric == BlurMetric::largest ? cases::max_difference(a, b) / full_scale : cases::half_l1(a, b);
}

struct Outcome {
  std::vector<std::byte> bytes;
  Values values;
};

Result<Outcome> outcome(Context& context, const GaussianBlurParams& p, const Values& src) {
  Result<Run> run = Run::make(context, plan(p, context.profile()));
  if (!run) return run.status();
  if (Status status = run.value().write("src", src); !status) return status;
  if (Status status = run.value().go(); !status) return status;
  const auto bytes = run.value().bytes("dst");
  if (!bytes) return bytes.status();
  return Outcome{bytes.value(), cases::fetch(bytes.value(), p.format, context.real64())};
}

// The truth of the last setting: a grid walks through its radii with the truth unchanged.
const Values& truth_of(const GaussianBlurParams& p, const Values& src) {
  struct Kept {
    std::uint64_t key = 0;
    Values values;
  };
  thread_local Kept kept;
  const auto text =
      fmt::format("{} {} {} {} {}", p.width, p.height, channels(p.format), p.sigma, static_cast<int>(p.border));
  std::vector<std::byte> bytes(text.size() + src.size() * sizeof(double));
  std::memcpy(bytes.data(), text.data(), text.size());
  std::memcpy(bytes.data() + text.size(), src.data(), src.size() * sizeof(double));
  if (const std::uint64_t key = hash_bytes(bytes); key != kept.key)
    kept = {key, truth::gaussian(src, p.width, p.height, channels(p.format), p.sigma, p.border)};
  return kept.values;
}

bool stores_less_than_f32(Format format) { return format == Format::f16x4 || format == Format::unorm8x4; }

Result<std::vector<Oracle>> compute_oracle(Session& session, const BlurSetting& s, const Values& src,
                                           double full_scale) {
  const auto apart = [&](const Values& a, const Values& b) { return distance(s.metric, full_scale, a, b); };
  const auto exact = outcome(session.cpu_double(), s.params, src);
  if (!exact) return exact.status();
  const auto stored = outcome(session.cpu_float(), s.params, src);
  if (!stored) return stored.status();
  Oracle oracle;
  oracle.bits = hash_bytes(stored.value().bytes);
  oracle.method = apart(exact.value().values, truth_of(s.params, src));
  if (!stores_less_than_f32(s.params.format)) {
    oracle.rounding = apart(stored.value().values, exact.value().values);
    return std::vector{oracle};
  }
  // The same arithmetic, stored in f32: what is left of the difference is the storage format's.
  GaussianBlurParams wide = s.params;
  wide.format = Format::f32x4;
  if (cases::has_taps(wide.variant)) wide.radius = effective_radius(s.params);
  wide.drop_taps = false;
  const auto unrounded = outcome(session.cpu_float(), wide, src);
  if (!unrounded) return unrounded.status();
  oracle.rounding = apart(unrounded.value().values, exact.value().values);
  oracle.storage = apart(stored.value().values, unrounded.value().values);
  return std::vector{oracle};
}

Cell options_of(const GaussianBlurParams& p) {
  return {{"format", name(p.format)},   {"border", cases::name(p.border)}, {"input", name_of(p.input)},
          {"difference", p.difference}, {"keep_alpha", p.keep_alpha},      {"drop_taps", p.drop_taps}};
}

Cell knobs_of(const BlurSetting& s) {
  const GaussianBlurParams& p = s.params;
  switch (p.variant) {
    case GaussianVariant::recursive: return {{"sigma", p.sigma}, {"order", p.order}};
    case GaussianVariant::box: return {{"sigma", p.sigma}, {"passes", p.passes}};
    case GaussianVariant::pyramid:
      return {{"sigma", p.sigma},
              {"levels", effective_levels(p)},
              {"filter", p.filter == PyramidFilter::linear ? "linear" : "cubic"}};
    default: return {{"sigma", p.sigma}, {"k", s.k}, {"radius", effective_radius(p)}};
  }
}

}  // namespace

std::string label(const BlurSetting& s) {
  const GaussianBlurParams& p = s.params;
  const char* const filter = p.filter == PyramidFilter::linear ? "linear" : "cubic";
  const std::string knob = p.variant == GaussianVariant::recursive ? fmt::format("order {}", p.order)
                           : p.variant == GaussianVariant::box     ? fmt::format("{} passes", p.passes)
                           : p.variant == GaussianVariant::pyramid
                               ? fmt::format("{} levels {}", effective_levels(p), filter)
                           : s.k > 0 ? fmt::format("k {}", s.k)
                                     : fmt::format("R {}", p.radius);
  return fmt::format("gaussian_blur {} {} sigma {} {}{}{}{}{}{} on {}", cases::name(p.variant), name(p.format), p.sigma,
                     knob, p.border == Border::clamp ? "" : fmt::format(" {}", cases::name(p.border)),
                     p.input == Input::buffer || p.variant == GaussianVariant::sampler ? "" : " image",
                     p.difference ? " difference" : "", p.keep_alpha ? " keep_alpha" : "",
                     p.drop_taps ? " drop_taps" : "", s.scene->name);
}

GaussianBlurParams params_for(const Scene& scene, double sigma, double k, Format format, GaussianVariant variant) {
  return cases::blur_params(scene.width, scene.height, sigma, static_cast<int>(std::ceil(k * sigma)), format,
                            Border::clamp, variant);
}

double blur_error(const BlurSetting& s, const Values& source, const Values& values) {
  return distance(s.metric, largest_of(source), values, truth_of(s.params, source));
}

Status measure_blur(Session& session, const BlurSetting& s) {
  const GaussianBlurParams& p = s.params;
  const Values src = in_format(*s.scene, p.format);
  const double full_scale = largest_of(src);
  const std::string size = size_text(p.width, p.height), where = label(s), metric = name_of(s.metric);

  Result<Run> made = Run::make(session.context(), plan(p, session.context().profile()));
  if (!made) return made.status();
  Run& run = made.value();
  if (Status status = run.write("src", src); !status) return status;
  const Result<Sample> ms = session.time(run, where);
  if (!ms) return ms.status();
  const auto bytes = run.bytes("dst");
  if (!bytes) return bytes.status();

  const auto errors = session.errors(
      where + " " + size + " " + metric, {metric}, hash_bytes(bytes.value()), p.variant != GaussianVariant::sampler,
      [&] { return compute_oracle(session, s, src, full_scale); },
      [&]() -> Result<std::vector<double>> {
        const auto expected = outcome(session.cpu_float(), p, src);
        if (!expected) return expected.status();
        const Values own = cases::fetch(bytes.value(), p.format, session.context().real64());
        return std::vector{distance(s.metric, full_scale, own, expected.value().values)};
      });
  if (!errors) return errors.status();
  if (p.variant == GaussianVariant::separable && s.metric == BlurMetric::largest && !p.difference)
    session.promise_share("gaussian_blur", "rounding of the whole grid",
                          "float against double stays within (3R + 6) 2^-24 of the largest value",
                          errors.value()[0].rounding.number() / cases::rounding_bound(effective_radius(p)), where);

  FrontierRow row{"gaussian_blur",
                  cases::name(p.variant),
                  s.scene->name,
                  size,
                  options_of(p),
                  knobs_of(s),
                  fmt::format("{} {} {}", name(p.format), cases::name(p.border), p.sigma),
                  errors.value()[0]};
  row.shade = cell_of(ms.value());
  row.costs_of(run);
  session.frontier(row);
  return {};
}

Result<Session::Timed> timed_blur(Session& session, const BlurSetting& s) {
  Result<Run> made = Run::make(session.context(), plan(s.params, session.context().profile()));
  if (!made) return made.status();
  const auto run = std::make_shared<Run>(std::move(made).value());
  if (Status status = run->write("src", in_format(*s.scene, s.params.format)); !status) return status;
  if (Status status = run->go(); !status) return status;
  return timed(run);
}

Status beside_peer(Session& session, const BlurSetting& s, const GaussianPeer& peer, Cell goal) {
  const auto own = timed_blur(session, s);
  if (!own) return own.status();
  const auto pair = session.interleave(own.value(), peer.run, "peer " + peer.name);
  if (!pair) return pair.status();
  const Sample ratio = summarise(ratios(pair.value().b, pair.value().a));
  const std::vector<double> source = in_format(*s.scene, s.params.format);
  const auto result = cases::blur(session.context(), s.params, source);
  if (!result) return result.status();
  session.row("peers", {{"peer", peer.name},
                        {"version", peer.version},
                        {"kernel", "gaussian_blur"},
                        {"size", size_text(s.params.width, s.params.height)},
                        {"time_ms", cell_of(summarise(pair.value().b))},
                        {"error", blur_error(s, source, peer.result())},
                        {"ratio", ratio.median},
                        {"q1", ratio.q1},
                        {"q3", ratio.q3},
                        {"device", session.device()},
                        {"options",
                         {{"format", name(s.params.format)},
                          {"border", "clamp"},
                          {"sigma", s.params.sigma},
                          {"variant", cases::name(s.params.variant)},
                          {"taps", 2 * peer.radius + 1}}},
                        {"own_ms", cell_of(summarise(pair.value().a))},
                        {"own_error", blur_error(s, source, result.value())},
                        {"goal", std::move(goal)}});
  return {};
}

}  // namespace luxel::report
