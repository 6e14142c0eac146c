#include "bench/report/cones.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "bench/truth/cone_truth.h"
#include "tests/cases/compare.h"
#include "tests/cases/storage.h"

namespace luxel::report {
namespace {

using cases::ConeScene;
using cases::Values;

const char* name(ConeVariant v) { return v == ConeVariant::isotropic ? "isotropic" : "anisotropic"; }

// Root mean square of the differences of the three colours, over the mean of the truth's.
double apart(const Values& a, const Values& b, double mean) {
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (i % 4 != 3) squares += (a[i] - b[i]) * (a[i] - b[i]);
  return a.size() == b.size() ? std::sqrt(squares / (0.75 * static_cast<double>(a.size()))) / mean
                              : std::numeric_limits<double>::quiet_NaN();
}

// Irradiance by rays, and by each half of them. The same for all settings of a world with equal places and distances.
struct Truth {
  Values all, first, second;
  double mean = 0;
};
const Truth& truth_of(const ConeSetting& s) {
  static std::map<std::string, Truth> made;
  const ConeTraceParams& p = s.params;
  Truth& t = made[fmt::format("{} {} {} {}", s.world->name, s.world->side, p.normal_offset, p.start)];
  if (!t.all.empty()) return t;
  Values halves;
  t.all = truth::irradiance(p, {p.extent, s.world->voxels}, s.world->receivers, 4096, &halves);
  const auto middle = halves.begin() + static_cast<std::ptrdiff_t>(halves.size() / 2);
  t.first.assign(halves.begin(), middle);
  t.second.assign(middle, halves.end());
  for (std::size_t i = 0; i < t.all.size(); ++i)
    if (i % 4 != 3) t.mean += t.all[i] / (0.75 * static_cast<double>(t.all.size()));
  return t;
}

Result<Values> run_on(Context& context, ConeSetting s, Format format) {
  s.params.format = format;
  s.params.count = false;
  const auto r = cases::trace(context, s.params, s.world->voxels, s.world->receivers);
  if (!r) return r.status();
  return r.value().irradiance;
}

Result<std::vector<Oracle>> compute_oracle(Session& session, const ConeSetting& s) {
  const auto stored = run_on(session.cpu_float(), s, s.params.format);
  if (!stored) return stored.status();
  const auto f32 = s.params.format == Format::f32x4 ? stored : run_on(session.cpu_float(), s, Format::f32x4);
  if (!f32) return f32.status();
  const auto exact = run_on(session.cpu_double(), s, Format::f32x4);
  if (!exact) return exact.status();
  const Truth& t = truth_of(s);
  // mean((x - t1)(x - t2)): the truth's own noise cancels.
  double product = 0;
  const Values& x = exact.value();
  for (std::size_t i = 0; i < x.size(); ++i)
    if (i % 4 != 3) product += (x[i] - t.first[i]) * (x[i] - t.second[i]) / (0.75 * static_cast<double>(x.size()));
  return std::vector<Oracle>{{hash_values(stored.value()), apart(f32.value(), x, t.mean),
                              apart(stored.value(), f32.value(), t.mean), std::sqrt(std::max(0.0, product)) / t.mean}};
}

std::string size_of(const ConeSetting& s) {
  return fmt::format("{0}x{0}x{0}, {1}x{2} receivers", s.world->side, s.world->width, s.world->height);
}

Status measure(Session& session, ConeScenes& scenes, const ConeSetting& s) {
  const ConeTraceParams& p = s.params;
  const std::string where = label(s);
  const auto scene = scenes.on(session.context(), s);
  if (!scene) return scene.status();
  const Session::Timed once = timed(scene.value(), p);
  const auto pair = session.interleave(once, once, where);
  if (!pair) return pair.status();
  std::vector<double> ms = pair.value().a;
  ms.insert(ms.end(), pair.value().b.begin(), pair.value().b.end());
  const Result<Values> result = scene.value()->read("irradiance");
  if (!result) return result.status();
  const auto errors = session.errors(
      where, {"root mean square of x - rays through the voxels, over their mean"}, hash_values(result.value()),
      p.input == Input::buffer, [&] { return compute_oracle(session, s); },
      [&]() -> Result<std::vector<double>> {
        const auto expected = run_on(session.cpu_float(), s, p.format);
        if (!expected) return expected.status();
        return std::vector{apart(result.value(), expected.value(), truth_of(s).mean)};
      });
  if (!errors) return errors.status();
  const Result<Plan> made = plan(p, session.context().profile());
  if (!made) return made.status();
  FrontierRow row{"cone_trace", name(p.variant), s.world->name, size_of(s),
                  {{"format", luxel::name(p.format)}, {"input", p.input == Input::image ? "image" : "buffer"}},
                  {{"cones", s.set}, {"footprint", p.footprint}, {"step_scale", p.step_scale}, {"error", p.error}},
                  luxel::name(p.format), errors.value()[0]};
  row.build = cell_of(summarise({scene.value()->build_times().total}));
  row.shade = cell_of(summarise(ms));
  row.bytes = made.value().bytes;
  row.memory = scene.value()->volume_bytes() + s.world->receivers.size() * 6;
  session.frontier(row);
  return {};
}

}  // namespace

std::shared_ptr<const ConeWorld> cone_box(int side, int width, int height) {
  ConeWorld w{"box (generated)", side, {}, {}, width, height, {0.16, 0.23, 0.33}, 0.7};
  const int wall = std::max(1, side / 32);
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const double u = (x + 0.5) / side, v = (y + 0.5) / side, t = (z + 0.5) / side;
        const bool lamp = y >= side - wall && std::fabs(u - 0.5) < 0.16 && std::fabs(t - 0.5) < 0.16;
        std::array<double, 4> c{};
        if (x < wall) c = {0.6, 0.1, 0.1, 1};
        else if (x >= side - wall) c = {0.1, 0.6, 0.1, 1};
        else if (y < wall) c = {0.4, 0.4, 0.4, 1};
        else if (y >= side - wall) c = {lamp ? 3.0 : 0.3, lamp ? 3.0 : 0.3, lamp ? 2.5 : 0.3, 1};
        else if (z >= side - wall) c = {0.3, 0.3, 0.5, 1};
        else if (u > 0.22 && u < 0.44 && t > 0.31 && t < 0.53 && v < 0.34) c = {0.2, 0.2, 0.2, 1};
        // Scaled so that the lamp is 1, which unorm8 holds.
        for (int k = 0; k < 4; ++k) w.voxels.push_back(static_cast<float>(k < 3 ? c[k] / 3 : c[k]));
      }
  const double floor = static_cast<double>(wall) / side;
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const double u = 0.05 + 0.9 * (column + 0.5) / width;
      const bool up = row < height / 2;
      const double v = 0.05 + 0.9 * (up ? row + 0.5 : row - height / 2 + 0.5) / (height / 2);
      const std::array<double, 3> at = up ? std::array{u, floor, v} : std::array{u, v, 1 - floor};
      // On the floor, or on top of the block that stands there.
      const bool covered = up && u > 0.22 && u < 0.44 && v > 0.31 && v < 0.53;
      const double top = (std::ceil(0.34 * side - 0.5)) / side;
      cases::add_receiver(w.receivers,
                          {static_cast<float>(at[0]), static_cast<float>(covered ? top : at[1]), static_cast<float>(at[2])},
                          up ? std::array{0.0, 1.0, 0.0} : std::array{0.0, 0.0, -1.0});
    }
  return std::make_shared<ConeWorld>(std::move(w));
}

std::shared_ptr<const ConeWorld> cone_fog(int side, int width, int height) {
  ConeWorld w{"fog (generated)", side, cases::uniform_volume(side, {1e-3, 1e-3, 1e-3, 1e-3}), {}, width, height, {}, 0};
  for (int i = 0; i < width * height; ++i) cases::add_receiver(w.receivers, {0.5, 0.3, 0.5}, {0, 1, 0});
  return std::make_shared<ConeWorld>(std::move(w));
}

ConeSetting setting_for(const std::shared_ptr<const ConeWorld>& world, ConeVariant variant, Format format,
                        const std::string& set) {
  ConeTraceParams p = cases::cone_params(world->side, variant, format);
  p.width = world->width;
  p.height = world->height;
  p.environment = world->environment;
  p.max_distance = world->max_distance;
  p.cones = set == "classic 6" ? classic_cones() : cone_set(std::stoi(set)).value();
  return {world, p, set};
}

std::string label(const ConeSetting& s) {
  const ConeTraceParams& p = s.params;
  return fmt::format("cone_trace {} {}{}, {} cones, footprint {}, step {}{}{}{} on {} {}", name(p.variant),
                     luxel::name(p.format), p.input == Input::image ? " image" : "", s.set, p.footprint, p.step_scale,
                     p.error > 0 ? fmt::format(", error {}", p.error) : "",
                     p.pattern_x > 1 ? fmt::format(", pattern {}x{}", p.pattern_x, p.pattern_y) : "",
                     p.skip_empty ? "" : ", empty read too", s.world->name, size_of(s));
}

Result<std::shared_ptr<ConeScene>> ConeScenes::on(Context& context, const ConeSetting& s) {
  const ConeTraceParams& p = s.params;
  std::shared_ptr<ConeScene>& scene =
      scenes_[{&context, s.world->name + size_of(s), s.world->side, p.variant, p.format, p.input}];
  if (!scene) {
    Result<ConeScene> made = ConeScene::make(context, p, s.world->voxels);
    if (!made) return made.status();
    if (Status status = made.value().receive(s.world->receivers); !status) return status;
    scene = std::make_shared<ConeScene>(std::move(made).value());
  }
  return scene;
}

Session::Timed timed(const std::shared_ptr<ConeScene>& scene, const ConeTraceParams& params) {
  return [scene, params]() -> Result<double> {
    Times times;
    if (Status status = scene->trace(params, 1, &times); !status) return status;
    return times.total;
  };
}

std::vector<Job> cone_grid(Session& session) {
  const bool quick = session.settings().quick;
  const auto scenes = std::make_shared<ConeScenes>();
  const auto box = cone_box(64, quick ? 32 : 64, quick ? 16 : 32);
  std::vector<Job> jobs;
  const auto add = [&](const ConeSetting& s) {
    jobs.push_back({label(s), [&session, scenes, s] { return measure(session, *scenes, s); }});
  };
  const std::vector<std::string> sets =
      quick ? std::vector<std::string>{"1", "6", "classic 6", "16"}
            : std::vector<std::string>{"1", "4", "5", "6", "classic 6", "8", "9", "16", "25"};
  // The errors of C++ are the devices'; its times show how sets differ, and that is all that is asked of it.
  const bool few = quick || session.is_cpu();
  for (const ConeVariant v : {ConeVariant::isotropic, ConeVariant::anisotropic}) {
    for (const std::string& set : sets)
      for (const double footprint : set != "6" ? std::vector{0.25} : few ? std::vector{0.25, 1.0} : std::vector{0.125, 0.25, 0.5, 1.0})
        for (const double step : few || set != "6" ? std::vector{1.0} : std::vector{0.5, 1.0, 2.0}) {
          ConeSetting s = setting_for(box, v, Format::f32x4, set);
          s.params.footprint = footprint;
          s.params.step_scale = step;
          add(s);
        }
    for (const Format f : {Format::f32x4, Format::f16x4, Format::unorm8x4}) {
      ConeSetting s = setting_for(box, v, f);
      if (f != Format::f32x4) add(s);
      s.params.input = Input::image;
      if (!quick || f == Format::f16x4) add(s);
    }
    // How it grows with resolution.
    if (!quick)
      add(setting_for(cone_box(32, 64, 32), v, Format::f32x4));
  }
  return jobs;
}

}  // namespace luxel::report
