#include "bench/report/mips.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/truth/mip_truth.h"
#include "tests/cases/compare.h"
#include "tests/cases/storage.h"

namespace luxel::report {
namespace {

using cases::Pyramid;
using cases::Run;
using cases::Values;

struct Outcome {
  std::uint64_t bits = 0;
  Pyramid levels;
};

Result<Outcome> read_all(Run& run, Context& context, const MipBuildParams& p) {
  Outcome outcome;
  std::vector<std::byte> all;
  for (const std::string& name : cases::mip_names(p)) {
    const auto bytes = run.bytes(name);
    if (!bytes) return bytes.status();
    all.insert(all.end(), bytes.value().begin(), bytes.value().end());
    outcome.levels[name] = cases::fetch(bytes.value(), p.format, context.real64());
  }
  outcome.bits = hash_bytes(all);
  return outcome;
}

Result<Plan> plan_of(const MipSetting& s, Profile profile) {
  profile.workgroup_memory = s.single_pass;
  return plan(s.params, profile);
}

Result<Outcome> outcome(Context& context, const MipSetting& s, const Values& src) {
  Result<Run> run = Run::make(context, plan_of(s, context.profile()));
  if (!run) return run.status();
  if (Status status = run.value().write("level_0", src); !status) return status;
  if (Status status = run.value().go(); !status) return status;
  return read_all(run.value(), context, s.params);
}

Pyramid truth_of(const MipBuildParams& p, const Values& src) {
  Pyramid levels;
  std::map<int, std::vector<truth::Level>> by_direction;
  for (const std::string& name : cases::mip_names(p)) {
    const int direction = cases::direction_of(name);
    if (!by_direction.contains(direction)) by_direction[direction] = truth::pyramid(p, src, direction);
    levels[name] = by_direction[direction][cases::level_of(name)].values;
  }
  return levels;
}

double largest(const Pyramid& a, const Pyramid& b, double full_scale) {
  double most = 0;
  for (const auto& [name, values] : a) {
    const double d = cases::max_difference(values, b.at(name));
    if (!(d <= most)) most = d;
  }
  return most / full_scale;
}

// |mean of a - b| of a level in steps at `full_scale`.
double drift_of(const Values& a, const Values& b, Format format, double full_scale) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] - b[i];
  return std::fabs(sum / static_cast<double>(a.size())) / cases::step(format, 0.75 * full_scale);
}

Format in_f32(Format format) {
  return format == Format::f16x4 || format == Format::unorm8x4 ? Format::f32x4
         : format == Format::f16x2                             ? Format::f32x2
                                                               : format;
}

// The errors that no device changes: first of all levels, then (with `drift`) of each level by the other metric.
Result<std::vector<Oracle>> compute_oracles(Session& session, const MipSetting& s, const Values& src, double full_scale,
                                            bool drift) {
  const auto exact = outcome(session.cpu_double(), s, src);
  if (!exact) return exact.status();
  const auto stored = outcome(session.cpu_float(), s, src);
  if (!stored) return stored.status();
  MipSetting wide = s;
  wide.params.format = in_f32(s.params.format);
  const auto unrounded = wide.params.format == s.params.format ? stored : outcome(session.cpu_float(), wide, src);
  if (!unrounded) return unrounded.status();
  const Pyramid truth = truth_of(s.params, src);
  const Pyramid &d = exact.value().levels, &f = stored.value().levels, &f32 = unrounded.value().levels;
  std::vector<Oracle> oracles{
      {stored.value().bits, largest(f32, d, full_scale), largest(f, f32, full_scale), largest(d, truth, full_scale)}};
  for (int level = 1; drift && level <= mip_levels(s.params); ++level) {
    const std::string name = mip_level_name(level);
    const auto apart = [&](const Pyramid& a, const Pyramid& b) {
      return drift_of(a.at(name), b.at(name), s.params.format, full_scale);
    };
    oracles.push_back({stored.value().bits, apart(f32, d), apart(f, f32), apart(d, truth)});
  }
  return oracles;
}

Cell options_of(const MipBuildParams& p) {
  Cell options{{"format", name(p.format)}, {"input", p.input == Input::image ? "image" : "buffer"}};
  if (p.variant == MipVariant::min || p.variant == MipVariant::max || p.variant == MipVariant::minmax) {
    options.set("sizes", p.sizes == MipSizes::ceil ? "ceil" : "floor");
    options.set("ratio", p.ratio);
  }
  if (p.variant == MipVariant::gaussian3) options.set("samples", p.samples == MipSamples::vertices ? "vertices" : "cells");
  return options;
}

}  // namespace

std::string size_text(const std::array<int, 3>& e) {
  return e[2] > 1 ? fmt::format("{}x{}x{}", e[0], e[1], e[2]) : fmt::format("{}x{}", e[0], e[1]);
}

std::string label(const MipSetting& s) {
  const MipBuildParams& p = s.params;
  return fmt::format("mip_build {} {}{}{}{}{}{} on {} {}", cases::name(p.variant), name(p.format),
                     p.input == Input::image ? " image" : "", p.sizes == MipSizes::ceil ? " ceil" : "",
                     p.ratio == 16 ? " ratio 16" : "", p.samples == MipSamples::vertices ? " vertices" : "",
                     s.single_pass ? " single pass" : "", s.scene->name, size_text(s.scene->extent));
}

MipSetting setting_for(const std::shared_ptr<const MipScene>& scene, MipVariant variant, Format format) {
  return {scene, cases::mip_params(variant, format, scene->extent), false};
}

std::vector<double> level_0(const MipSetting& s) {
  const Format format = cases::finest_format(s.params);
  const int have = s.scene->channels, want = channels(format);
  Values values;
  for (std::size_t i = 0; i * have < s.scene->values.size(); ++i)
    for (int c = 0; c < want; ++c)
      values.push_back(c < have ? s.scene->values[i * have + c] : c == 3 ? 1.0 : s.scene->values[i * have]);
  return cases::quantise(values, format);
}

Status measure_mips(Session& session, const MipSetting& s, bool drift) {
  const MipBuildParams& p = s.params;
  const Values src = level_0(s);
  double full_scale = 0;
  for (const double v : src) full_scale = std::max(full_scale, std::fabs(v));
  const std::string size = size_text(s.scene->extent), where = label(s);

  const auto ready = ready_mips(session, s);
  if (!ready) return ready.status();
  Run& run = *ready.value();
  const Result<Sample> ms = session.time(run, where);
  if (!ms) return ms.status();
  const auto result = read_all(run, session.context(), p);
  if (!result) return result.status();

  std::vector<std::string> metrics{"max |x - t| / max |input|, all levels"};
  for (int level = 1; drift && level <= mip_levels(p); ++level)
    metrics.push_back(fmt::format("|mean of x - t| in steps of the format, level {}", level));
  const auto errors = session.errors(
      where, metrics, result.value().bits, true, [&] { return compute_oracles(session, s, src, full_scale, drift); },
      [&]() -> Result<std::vector<double>> {
        const auto expected = outcome(session.cpu_float(), s, src);
        if (!expected) return expected.status();
        const Pyramid &own = result.value().levels, &other = expected.value().levels;
        std::vector<double> apart{largest(own, other, full_scale)};
        for (int level = 1; drift && level <= mip_levels(p); ++level) {
          const std::string name = mip_level_name(level);
          apart.push_back(drift_of(own.at(name), other.at(name), p.format, full_scale));
        }
        return apart;
      });
  if (!errors) return errors.status();
  for (std::size_t level = 0; level < metrics.size(); ++level) {
    FrontierRow row{"mip_build", cases::name(p.variant), s.scene->name, size, options_of(p),
                    {{"levels", mip_levels(p)}, {"single_pass", s.single_pass}},
                    fmt::format("{} {} {} {} {}", cases::name(p.variant), name(p.format), static_cast<int>(p.sizes),
                                p.ratio, static_cast<int>(p.samples)),
                    errors.value()[level]};
    if (level > 0) row.knobs.set("level", level);
    row.build = cell_of(ms.value());
    row.costs_of(run);
    session.frontier(row);
  }
  return {};
}

Result<std::shared_ptr<Run>> ready_mips(Session& session, const MipSetting& s) {
  Result<Run> made = Run::make(session.context(), plan_of(s, session.context().profile()));
  if (!made) return made.status();
  const auto run = std::make_shared<Run>(std::move(made).value());
  if (Status status = run->write("level_0", level_0(s)); !status) return status;
  return run;
}

double mip_bytes(Session& session, const MipSetting& s) {
  const Result<Plan> made = plan_of(s, session.context().profile());
  return made ? made.value().bytes : 0;
}

}  // namespace luxel::report
