#include <fmt/format.h>

#include "bench/report/json.h"
#include "bench/report/kept.h"
#include "bench/report/scene_savings.h"
#include "bench/scene/scene_plan.h"
#include "commands.h"
#include "common.h"
#include "scene_options.h"

namespace luxel::program {
namespace {

constexpr const char* methods[] = {"cone", "probe", "lpv"};

struct Arguments {
  SceneOptions view;
  std::string method = methods[0], device, json;
  double cutoff = 1;
  int resolution = 64, repeats = 5;
  bool explain = false, measure = false, no_occlusion = false, no_reflections = false;
};

void print(const std::vector<scene::Decision>& decisions, bool explain) {
  for (const bool runs : {true, false}) {
    fmt::print("{}\n", runs ? "runs" : "left out");
    for (const scene::Decision& d : decisions) {
      if (d.runs() != runs) continue;
      fmt::print("  {:<18} {}{}\n", d.kernel, d.what, runs ? "" : fmt::format(" (level {})", d.level));
      if (explain) fmt::print("  {:<18} because {}\n", "", d.why);
    }
  }
}

report::Json to_json(const std::string& scene, const std::vector<scene::Decision>& decisions,
                     const std::vector<report::SceneSaving>& savings) {
  report::Json json{{"scene", scene}, {"plan", report::Json::array()}, {"left_out", report::Json::array()}};
  for (const scene::Decision& d : decisions)
    json["plan"].push_back({{"kernel", d.kernel}, {"what", d.what}, {"runs", d.runs()}, {"level", d.level}, {"why", d.why}});
  for (const report::SceneSaving& s : savings)
    json["left_out"].push_back({{"what", s.what}, {"level", s.level}, {"ms", report::cell_of(s.whole).json()},
                                {"saved_ms", report::cell_of(s.saved).json()}, {"saved_bytes", s.saved_bytes}, {"error", s.error}});
  return json;
}

int run(const Arguments& a) {
  const auto chosen = parse(a.view);
  if (!chosen) return complain(chosen.status());
  const SceneChoice& choice = chosen.value();
  const auto found = read(a.view, choice);
  if (!found) return complain(found.status(), true);
  const scene::Scene& scene = found.value();
  const auto rays = scene::Rays::make(scene);
  if (!rays) return complain(rays.status());
  const scene::GBuffer g = scene::gbuffer(rays.value(), scene.camera, choice.width, choice.height);
  const scene::SceneFacts facts = facts_of(scene, g, a.cutoff);
  const auto decisions = decide(facts, {a.method, !a.no_occlusion, !a.no_reflections});
  fmt::print("plan {} {}x{} by {}\n", scene.name, g.width, g.height, a.method);
  for (const std::string& line : lines_of(facts)) fmt::print("  {}\n", line);
  print(decisions, a.explain);

  std::vector<report::SceneSaving> savings;
  if (a.measure) {
    auto context = open_device(a.device);
    if (!context) return complain(context.status());
    auto measured = report::scene_savings(context.value(), scene, rays.value(), g, a.resolution, a.repeats);
    if (!measured) return complain(measured.status());
    savings = std::move(measured).value();
    fmt::print("saved on {}, {}^3 voxels, of a frame with everything made anew (quartiles of {})\n",
               context.value()->info().id, a.resolution, a.repeats);
    for (const report::SceneSaving& s : savings)
      fmt::print("  {:<52} {:8.2f} ms ({:.2f}..{:.2f}) of {:.2f}, {:.1f} MiB, difference {:.3g}\n", s.what, s.saved.median,
                 s.saved.q1, s.saved.q3, s.whole.median, s.saved_bytes / 1048576, s.error);
    if (savings.empty()) fmt::print("  nothing: the scene has a use for everything that can be left out by a switch\n");
  }
  if (!a.json.empty()) {
    const std::string text = to_json(scene.name, decisions, savings).dump(1) + "\n";
    if (Status s = report::write_file(a.json, text); !s) return complain(s);
  }
  return done;
}

}  // namespace

void add_plan(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand("plan", "what a scene needs: which kernels run, in which form, what is left out and why");
  auto a = std::make_shared<Arguments>();
  add_scene_options(*command, a->view, "320x180");
  std::vector<std::string> names(std::begin(methods), std::end(methods));
  command->add_option("--method", a->method, fmt::format("{}: what carries light; default {}", fmt::join(names, "|"), a->method))
      ->type_name("NAME")
      ->check(one_of(names));
  command->add_flag("--explain", a->explain, "why each runs or does not");
  command->add_flag("--no-occlusion", a->no_occlusion, "ambient occlusion is not used");
  command->add_flag("--no-reflections", a->no_reflections, "reflections are not used");
  command->add_option("--cutoff", a->cutoff, "roughness from which on reflections are not looked for on the screen, 0..2; default 1")
      ->type_name("NUMBER")
      ->check(within(0, 2, false));
  command->add_flag("--measure", a->measure, "measure what leaving out saves, by cones: time, memory, difference");
  command->add_option("--resolution", a->resolution, "of --measure: voxels along each side, 8..512; default 64")
      ->type_name("N")
      ->check(within(8, 512, true));
  command->add_option("--repeats", a->repeats, "of --measure: frames with and without in turn, 1..100; default 5")
      ->type_name("N")
      ->check(within(1, 100, true));
  command->add_option("--json", a->json, "file for the same as JSON")->type_name("FILE");
  add_device_option(*command, a->device);
  command->callback([a, &exit_status] { exit_status = run(*a); });
}

}  // namespace luxel::program
