// lpv_propagate as an iteration: flux that is kept, growth a step, where light goes.
#include <algorithm>
#include <cmath>

#include "tests/cases/compare.h"
#include "tests/cases/light_propagation_cases.h"
#include "tests/cases/light_propagation_support.h"
#include "tests/cases/run.h"

namespace luxel::cases {
namespace {

// What travels after the steps of `params` (one channel).
Result<Values> travelling(Context& context, LpvPropagateParams params, std::span<const double> injected,
                          std::span<const double> geometry = {}) {
  params.travelling = true;
  Result<Run> run = Run::make(context, plan(params, context.profile()));
  if (!run) return run.status();
  if (Status s = run.value().write("injected", injected); !s) return s;
  if (params.geometry)
    if (Status s = run.value().write("geometry", geometry); !s) return s;
  if (Status s = run.value().go(); !s) return s;
  return run.value().read("travelling");
}

// Blocking that is the same in every direction: `share` of a flux.
Values evenly(const LpvGrid& grid, double share) {
  Values b(4 * lpv_geometry_pixels(grid), 0);
  for (std::size_t at = 0; at < b.size(); at += 4) b[at] = share * 3.5449077018110318;
  return b;
}

Case flux_kept(LpvLobes lobes, int bands, double bound, bool slow) {
  Case c{"light_propagation", std::string("flux of 1000 steps, ") + name(lobes) + ", " + std::to_string(bands) + " bands",
         "a periodic grid keeps its flux over 1000 steps, relative", bound};
  c.slow = slow;
  c.measure = [=](Context& context) -> Result<double> {
    LpvPropagateParams p = lpv_params({16, 8, 8}, bands, lobes);
    p.border = LpvBorder::periodic, p.iterations = 1000;
    const Values light = truth::lpv_to_pixels(p.grid, bands, lpv_lights(p.grid, bands, 20, 7));
    const Result<Values> after = travelling(context, p, light);
    if (!after) return after.status();
    const std::size_t cells = lpv_pixels(p.grid, 2, 1);
    return std::fabs(lpv_flux(after.value(), cells) / lpv_flux(light, cells) - 1);
  };
  return c;
}

// The largest factor of one step on the flux, from lights into the state that hundreds of steps make.
Case growth(LpvLobes lobes, double blocking, double bound) {
  const char* const share = blocking == 0 ? "0" : blocking == 1 ? "1" : "1/2";
  Case c{"light_propagation", std::string("growth, ") + name(lobes) + ", blocking " + share,
         "flux after a step over flux before, at most, on a periodic grid", bound};
  c.measure = [=](Context& context) -> Result<double> {
    LpvPropagateParams p = lpv_params({16, 4, 4}, 2, lobes);
    p.border = LpvBorder::periodic, p.iterations = 1, p.geometry = true, p.continued = true;
    const Values blocks = evenly(p.grid, blocking);
    const std::size_t cells = lpv_pixels(p.grid, 2, 1);
    Values light = truth::lpv_to_pixels(p.grid, 2, lpv_lights(p.grid, 2, 40, 11));
    double most = 0, before = lpv_flux(light, cells);
    for (int step = 0; step < 24 && before > 0; ++step) {
      const Result<Values> after = travelling(context, p, light, blocks);
      if (!after) return after.status();
      light = after.value();
      const double flux = lpv_flux(light, cells);
      if (!(flux / before <= most)) most = flux / before;
      before = flux;
      p.iterations = step < 8 ? 1 : 16;
      if (step >= 8) {
        // Sixteen steps at once: their mean growth.
        const Result<Values> later = travelling(context, p, light, blocks);
        if (!later) return later.status();
        light = later.value();
        const double then = lpv_flux(light, cells);
        const double mean = before > 0 ? std::pow(then / before, 1.0 / 16) : 0;
        if (!(mean <= most)) most = mean;
        before = then;
        p.iterations = 1;
      }
    }
    return most;
  };
  return c;
}

// Power iteration with coefficients of either sign.
Case spectral_radius() {
  Case c{"light_propagation", "growth of any light, linear", "norm after a step over norm before, after 200 steps of power iteration",
         1 + 1e-5};
  c.measure = [](Context& context) -> Result<double> {
    LpvPropagateParams p = lpv_params({16, 4, 4});
    p.border = LpvBorder::periodic, p.iterations = 20;
    Values light = truth::lpv_to_pixels(p.grid, 2, lpv_lights(p.grid, 2, 3, 5));
    for (std::size_t i = 0; i < light.size(); ++i) light[i] *= i / 4 % 3 == 0 ? -1 : 1;
    const auto norm = [](const Values& v) {
      double sum = 0;
      for (const double x : v) sum += x * x;
      return std::sqrt(sum);
    };
    double ratio = 0;
    for (int turn = 0; turn < 11; ++turn) {
      if (turn == 10) p.iterations = 1;
      const Result<Values> after = travelling(context, p, light);
      if (!after) return after.status();
      ratio = norm(after.value()) / norm(light);
      light = after.value();
      const double scale = 1 / norm(light);
      for (double& x : light) x *= scale;
    }
    return ratio;
  };
  return c;
}

Case checkerboard() {
  Case c{"light_propagation", "checkerboard", "cells of alternating sign come back after two steps: largest change after 1000", 1e-5};
  c.measure = [](Context& context) -> Result<double> {
    LpvPropagateParams p = lpv_params({16, 4, 4});
    p.border = LpvBorder::periodic, p.iterations = 1000;
    Values light(4 * lpv_pixels(p.grid, 2, 1), 0);
    for (int z = 0; z < 4; ++z)
      for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 16; ++x) light[static_cast<std::size_t>(4 * ((z * 4 + y) * 16 + x))] = (x + y + z) % 2 ? -1 : 1;
    const Result<Values> after = travelling(context, p, light);
    if (!after) return after.status();
    return max_difference(after.value(), light);
  };
  return c;
}

// What the definition says left, was absorbed or was added, against what a device still holds.
Case accounting(LpvLobes lobes, int bands) {
  Case c{"light_propagation", std::string("accounting, ") + name(lobes) + ", " + std::to_string(bands) + " bands",
         "injected + clamped - left - absorbed - held after 8 steps, over injected", 1e-5};
  c.measure = [=](Context& context) -> Result<double> {
    LpvPropagateParams p = lpv_params({12, 9, 10}, bands, lobes);
    p.geometry = true, p.iterations = 8;
    const Values lights = lpv_lights(p.grid, bands, 15, 3), blocks = lpv_surfels(p.grid, 2, 4);
    std::vector<truth::LpvLedger> ledgers;
    truth::lpv_propagated(p, lights, blocks, &ledgers);
    const Values light = truth::lpv_to_pixels(p.grid, bands, lights);
    const Result<Values> after = travelling(context, p, light, blocks);
    if (!after) return after.status();
    const std::size_t cells = lpv_pixels(p.grid, 2, 1);
    const double injected = lpv_flux(light, cells);
    double balance = injected - lpv_flux(after.value(), cells);
    for (const truth::LpvLedger& step : ledgers) balance += step.clamped - step.left - step.absorbed;
    return std::fabs(balance) / injected;
  };
  return c;
}

Case border(const char* what, std::array<int, 3> extent, std::array<int, 3> at) {
  Case c{"light_propagation", what, "what a bright cell holds and what left the grid is what was injected, after 8 steps, relative", 1e-5};
  c.measure = [=](Context& context) -> Result<double> {
    LpvPropagateParams p = lpv_params(extent);
    Values lights(4 * lpv_pixels(p.grid, 2, 1), 0);
    for (std::size_t i = 0; i < 4; ++i)
      lights[static_cast<std::size_t>(4 * ((at[2] * extent[1] + at[1]) * extent[0] + at[0])) + i] =
          lpv_cosine(static_cast<int>(i), {0, 0.6, 0.8}, 1e4);
    std::vector<truth::LpvLedger> ledgers;
    truth::lpv_propagated(p, lights, {}, &ledgers);
    const Result<Values> after = travelling(context, p, lights);
    if (!after) return after.status();
    const std::size_t cells = lpv_pixels(p.grid, 2, 1);
    double balance = lpv_flux(lights, cells) - lpv_flux(after.value(), cells);
    for (const truth::LpvLedger& step : ledgers) balance -= step.left;
    return std::fabs(balance) / lpv_flux(lights, cells);
  };
  return c;
}

}  // namespace

void add_lpv_flux_cases(std::vector<Case>& cases) {
  // A quotient by six is rounded either way; a thousand roundings of 6e-8 in sums over a thousand cells.
  constexpr double flux_bound = 1e-5;
  for (const LpvLobes lobes : {LpvLobes::linear, LpvLobes::shrink, LpvLobes::rescale})
    cases.push_back(flux_kept(lobes, 2, flux_bound, lobes != LpvLobes::linear));
  cases.push_back(flux_kept(LpvLobes::linear, 3, flux_bound, true));
  constexpr double rounding = 1e-6;       // of sums of 256 cells
  constexpr double clamp_bound = 1.141;   // first step of a lobe along a diagonal; 1.114 along an axis
  for (const LpvLobes lobes : all_lobes)
    for (const double blocking : {0.0, 0.5, 1.0})
      cases.push_back(growth(lobes, blocking, lobes == LpvLobes::clamp ? clamp_bound * (1 - blocking) + rounding : 1 - blocking + rounding));
  cases.push_back(spectral_radius());
  cases.push_back(checkerboard());
  for (const LpvLobes lobes : all_lobes) cases.push_back(accounting(lobes, 2));
  cases.push_back(accounting(LpvLobes::linear, 3));
  cases.push_back(border("a bright cell in a corner", {9, 8, 7}, {8, 7, 0}));
  cases.push_back(border("one cell", {1, 1, 1}, {0, 0, 0}));
}

}  // namespace luxel::cases
