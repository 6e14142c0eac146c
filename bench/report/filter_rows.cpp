#include "bench/report/filter_rows.h"

namespace luxel::report {

std::string variant_text(const BilateralParams& p) {
  constexpr const char* names[] = {"direct", "separable", "atrous", "grid", "discontinuity"};
  return std::string(names[static_cast<int>(p.variant)]) + (p.adaptive ? ", adaptive" : "");
}

Cell options_of(const BilateralParams& p) {
  return {{"format", name(p.format)},
          {"window", p.window == FilterWindow::circle ? "circle" : "square"},
          {"colour", p.range == RangeTerm::off    ? "off"
                     : p.range == RangeTerm::self ? "self"
                                                  : "guide"},
          {"depth", p.depth == DepthTerm::off     ? "off"
                    : p.depth == DepthTerm::plane ? "plane"
                                                  : "svgf"},
          {"normal", p.normal},
          {"luminance", p.luminance},
          {"adaptive", p.adaptive}};
}

Cell knobs_of(const BilateralParams& p) {
  Cell knobs = {{"radius", p.radius}, {"step", p.step}, {"sigma_space", p.sigma_space}, {"sigma_range", p.sigma_range}};
  if (p.variant == BilateralVariant::atrous) knobs = {{"levels", p.levels}, {"taps", p.taps}, {"sigma_luminance", p.sigma_luminance}};
  if (p.variant == BilateralVariant::atrous && p.range != RangeTerm::off) knobs.set("sigma_range", p.sigma_range);
  if (p.variant == BilateralVariant::grid) knobs.set("high", p.high);
  if (p.depth != DepthTerm::off) knobs.set("sigma_depth", p.sigma_depth), knobs.set("footprint", p.footprint);
  if (p.normal) knobs.set("sigma_normal", p.sigma_normal);
  return knobs;
}

Status write_inputs(cases::Run& run, std::initializer_list<std::pair<const char*, const std::vector<double>*>> inputs) {
  for (const auto& [name, values] : inputs)
    for (const Resource& resource : run.plan().resources)
      if (resource.name == name)
        if (Status s = run.write(name, *values); !s) return s;
  return {};
}

}  // namespace luxel::report
