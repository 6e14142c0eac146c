#include "bench/report/probes.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <thread>

#include <fmt/format.h>
#include <luxel/probe_build.h>
#include <luxel/probe_trace.h>

#include "bench/report/bench.h"
#include "bench/report/claims.h"
#include "bench/report/dependent_reads.h"
#include "bench/scene/images.h"
#include "bench/truth/probe_scene.h"
#include "tests/cases/octahedral_march_support.h"

namespace luxel::report {
namespace {

using cases::ProbeScene;
using cases::Run;
using cases::Values;
using Count = std::array<int, 3>;

// A scene with the rays that leave its surfaces, and probes in it.
struct ProbeWorld {
  std::shared_ptr<const scene::Scene> scene;
  std::shared_ptr<const scene::Rays> rays;
  truth::SceneRays asked;
};

struct ProbeField {
  scene::Probes probes;
  scene::ProbeHits hits;
  cases::TexelValues values;
};

std::string sponza() {
  const char* folder = std::getenv("LUXEL_DATA");
  const std::string path = std::string(folder ? folder : LUXEL_SOURCE_DIR "/../shared/data") + "/crytek_sponza/sponza.glb";
  return std::filesystem::exists(path) ? path : "";
}

Result<std::shared_ptr<ProbeWorld>> world_of(const std::string& name, std::size_t rays) {
  static std::map<std::pair<std::string, std::size_t>, std::shared_ptr<ProbeWorld>> worlds;
  auto& world = worlds[{name, rays}];
  if (world) return world;
  auto read = scene::scene_from(name == "sponza" ? sponza() : name);
  if (!read) return read.status();
  auto made = std::make_shared<ProbeWorld>();
  made->scene = std::make_shared<const scene::Scene>(std::move(read.value()));
  auto tree = scene::Rays::make(*made->scene);
  if (!tree) return tree.status();
  made->rays = std::make_shared<const scene::Rays>(std::move(tree.value()));
  made->asked = truth::surface_rays(*made->rays, rays, 5);
  return world = made;
}

// The last few are kept: one of 1024^2 takes much memory.
std::shared_ptr<const ProbeField> field_of(const std::string& name, const ProbeWorld& world, int size, const Count& count) {
  static std::vector<std::pair<std::string, std::shared_ptr<const ProbeField>>> fields;
  const std::string key = fmt::format("{} {} {}x{}x{}", name, size, count[0], count[1], count[2]);
  for (const auto& [k, f] : fields)
    if (k == key) return f;
  auto f = std::make_shared<ProbeField>();
  f->probes = scene::place_probes(*world.scene, count);
  scene::find_dead_probes(f->probes, *world.rays);
  f->hits = scene::cast_probes(f->probes, *world.rays, size);
  f->values.distance = f->hits.distance;
  for (double& d : f->values.distance) d = std::min(d, 1e30);
  f->values.normal = f->hits.normal;
  if (fields.size() >= 2) fields.erase(fields.begin());
  fields.emplace_back(key, f);
  return f;
}

ProbeMaps compact(int size) {
  ProbeMaps m;
  m.size = size;
  return m;
}

ProbeMaps exact(int size) {
  ProbeMaps m;
  m.size = size;
  m.distance = ProbeDistance::f32;
  m.normal = ProbeNormal::snorm16;
  return m;
}

// Rays off surfaces: nothing within a footprint.
ProbeTraceParams usual() {
  ProbeTraceParams p;
  p.bias = 1;
  return p;
}

struct Made {
  ProbeScene scene;
  cases::Traced traced;
};

Result<Made> traced_on(Context& context, const ProbeField& f, const ProbeMaps& maps, ProbeTraceParams p, const ProbeWorld& world) {
  auto scene = ProbeScene::make(context, maps, f.probes.grid, f.values, f.probes.positions());
  if (!scene) return scene.status();
  auto traced = scene.value().trace(p, world.asked.rays);
  if (!traced) return traced.status();
  return Made{std::move(scene.value()), std::move(traced.value())};
}

// A trace with its maps, as the session times it.
Result<std::shared_ptr<Run>> ready(Session& session, const ProbeField& f, const ProbeMaps& maps, ProbeTraceParams p, const Values& rays,
                                   bool all_alive = false) {
  auto built = ProbeScene::make(session.context(), maps, f.probes.grid, f.values, f.probes.positions());
  if (!built) return built.status();
  p.grid = f.probes.grid;
  const ProbeMaps asked = p.maps;
  p.maps = maps;
  if (asked.ratio == 1) p.maps.ratio = 1;
  if (asked.normal == ProbeNormal::none) p.maps.normal = ProbeNormal::none;
  p.rays = static_cast<int>(rays.size() / 8);
  auto made = Run::make(session.context(), plan(p, session.context().profile()));
  if (!made) return made.status();
  const auto run = std::make_shared<Run>(std::move(made.value()));
  for (const Resource& r : run->plan().resources) {
    Values v;
    if (r.name == "rays") {
      v = rays;
    } else if (r.name == "positions") {
      v = f.probes.positions();
      for (std::size_t i = 3; all_alive && i < v.size(); i += 4) v[i] = 1;
    } else if (r.name == "counters") {
      v.assign(probe_outcomes, 0);
    } else if (!r.written) {
      auto read = built.value().maps().read(r.name);
      if (!read) return read.status();
      v = std::move(read.value());
    } else {
      continue;
    }
    if (Status s = run->write(r.name, v); !s) return s;
  }
  return run;
}

std::uint64_t bits_of(Values a, const Values& b) {
  a.insert(a.end(), b.begin(), b.end());
  return hash_values(a);
}

// The share of rays that end differently.
double apart(const cases::Traced& a, const cases::Traced& b) {
  double different = 0;
  for (std::size_t i = 0; i < a.texels.size(); ++i)
    different += a.hits[4 * i + 1] != b.hits[4 * i + 1] || a.texels[i] != b.texels[i];
  return different / static_cast<double>(a.texels.size());
}

double wrong(const ProbeWorld& world, const ProbeField& f, const cases::Traced& t) {
  return 1 - truth::agreement(world.asked, t.hits, t.texels, f.hits.distance, f.hits.size).right;
}

Status measure(Session& session, const std::string& name, std::size_t rays, int size, const Count& count, bool normals) {
  const auto found = world_of(name, rays);
  if (!found) return found.status();
  const ProbeWorld& world = *found.value();
  const auto f = field_of(name, world, size, count);
  ProbeTraceParams p = usual();
  if (!normals) {
    p.maps.normal = ProbeNormal::none;
    p.thickness = 2;
  }
  const std::string grid = fmt::format("{}x{}x{}", count[0], count[1], count[2]);
  const std::string where = fmt::format("octahedral_march {} {}^2 {} {} {} rays", name, size, grid, normals ? "normals" : "no normals", rays);
  const auto run = ready(session, *f, compact(size), p, world.asked.rays);
  if (!run) return run.status();
  const Result<Sample> ms = session.time(*run.value(), where);
  if (!ms) return ms.status();
  cases::Traced own;
  for (auto [to, from] : {std::pair{&own.hits, "hits"}, {&own.texels, "texels"}}) {
    auto read = run.value()->read(from);
    if (!read) return read.status();
    *to = std::move(read.value());
  }
  const truth::ProbeAgreement a = truth::agreement(world.asked, own.hits, own.texels, f->hits.distance, size);
  const auto errors = session.errors(
      where, {"share of rays that end elsewhere than Embree's: other outcome, or off by 2 footprints and 1 %"}, bits_of(own.hits, own.texels), true,
      [&]() -> Result<std::vector<Oracle>> {
        const auto in_float = traced_on(session.cpu_float(), *f, compact(size), p, world);
        const auto in_double = traced_on(session.cpu_double(), *f, compact(size), p, world);
        const auto unrounded = traced_on(session.cpu_float(), *f, exact(size), p, world);
        if (!in_float) return in_float.status();
        if (!in_double) return in_double.status();
        if (!unrounded) return unrounded.status();
        const double method = wrong(world, *f, in_double.value().traced);
        return std::vector<Oracle>{{bits_of(in_float.value().traced.hits, in_float.value().traced.texels),
                                    apart(in_float.value().traced, in_double.value().traced),
                                    std::fabs(method - wrong(world, *f, unrounded.value().traced)), method}};
      },
      [&]() -> Result<std::vector<double>> {
        const auto expected = traced_on(session.cpu_float(), *f, compact(size), p, world);
        if (!expected) return expected.status();
        return std::vector<double>{apart(own, expected.value().traced)};
      });
  if (!errors) return errors.status();
  double dead = 0;
  for (const std::uint8_t alive : f->probes.alive) dead += alive == 0;
  FrontierRow row{"octahedral_march", "two levels", name, fmt::format("{} rays", rays),
                  {{"distance", "f16"}, {"normal", normals ? "snorm8" : "none"}, {"grid", fmt::format("{},{},{}", count[0], count[1], count[2])}},
                  {{"resolution", size}, {"probes", f->probes.size()}, {"dead", dead}, {"thickness", p.thickness}, {"agree", a.agree},
                   {"known_right", a.known_right}, {"median_footprints", a.median}, {"p95_footprints", a.p95}, {"relative", a.relative},
                   {"unknown", a.unknown}, {"capped", a.capped}, {"probes_a_ray", a.probes}, {"looks_a_ray", a.steps}},
                  "rays off surfaces", errors.value()[0]};
  row.shade = cell_of(ms.value());
  ProbeBuildParams b;
  b.maps = compact(size);
  b.probes = static_cast<int>(f->probes.size());
  b.unit = probe_unit(f->probes.grid);
  b.radiance = false;
  auto build = Run::make(session.context(), plan(b, session.context().profile()));
  if (!build) return build.status();
  if (Status s = build.value().write("distance_source", f->values.distance); !s) return s;
  if (Status s = build.value().write("normal_source", f->values.normal); !s) return s;
  const Result<Sample> built = session.time(build.value(), where + " build");
  if (!built) return built.status();
  row.build = cell_of(built.value());
  row.costs_of(*run.value());
  session.frontier(row);
  return {};
}

Status save(Session& session, const std::string& name, std::size_t rays, int size, const Count& count, const std::string& what, int level) {
  const auto found = world_of(name, rays);
  if (!found) return found.status();
  const ProbeWorld& world = *found.value();
  const auto f = field_of(name, world, size, count);
  ProbeTraceParams more = usual(), fewer = usual();
  const bool dead = level == 2;
  if (level == 1 && what.starts_with("normals")) {
    fewer.maps.normal = ProbeNormal::none;
    fewer.thickness = 2;
  } else if (level == 1) {
    more.count = true;
  }
  const auto a = ready(session, *f, compact(size), more, world.asked.rays, dead);
  const auto b = ready(session, *f, compact(size), fewer, world.asked.rays);
  if (!a) return a.status();
  if (!b) return b.status();
  const auto pair = session.interleave(timed(a.value()), timed(b.value()), "left out: " + what);
  if (!pair) return pair.status();
  const Sample saved = summarise(differences(pair.value().a, pair.value().b));
  double shares[2];
  for (int k = 0; k < 2; ++k) {
    const auto& run = k == 0 ? a.value() : b.value();
    const auto hits = run->read("hits"), texels = run->read("texels");
    if (!hits) return hits.status();
    if (!texels) return texels.status();
    shares[k] = 1 - truth::agreement(world.asked, hits.value(), texels.value(), f->hits.distance, size).right;
  }
  session.row("left_out", {{"kernel", "octahedral_march"},
                           {"scene", fmt::format("{} {}^2, {} probes", name, size, f->probes.size())},
                           {"what", fmt::format("{} ({:.3f} of the rays end elsewhere than Embree's, with it {:.3f})", what, shares[1], shares[0])},
                           {"level", level},
                           {"saved_ms", saved.median},
                           {"saved_bytes", static_cast<double>(a.value()->memory_bytes()) - static_cast<double>(b.value()->memory_bytes())},
                           {"error", std::max(0.0, shares[1] - shares[0])},
                           {"device", session.device()}});
  return {};
}

// Three of ten runs of 256 rays have a direction, as where few pixels of a picture are glossy.
Status save_matte(Session& session, const std::string& name, std::size_t rays, int size, const Count& count) {
  const auto found = world_of(name, rays);
  if (!found) return found.status();
  const ProbeWorld& world = *found.value();
  const auto f = field_of(name, world, size, count);
  Values some = world.asked.rays;
  const auto glossy = [](std::size_t ray) { return scene::random01(static_cast<std::uint32_t>(ray / 256), 23) < 0.3; };
  for (std::size_t i = 0; i < rays; ++i)
    if (!glossy(i)) std::fill_n(some.begin() + static_cast<std::ptrdiff_t>(8 * i + 4), 3, 0.0);
  const auto a = ready(session, *f, compact(size), usual(), world.asked.rays), b = ready(session, *f, compact(size), usual(), some);
  if (!a) return a.status();
  if (!b) return b.status();
  const auto pair = session.interleave(timed(a.value()), timed(b.value()), "left out: rays of matte pixels");
  if (!pair) return pair.status();
  const Sample saved = summarise(differences(pair.value().a, pair.value().b));
  const auto all = a.value()->read("hits"), few = b.value()->read("hits");
  if (!all) return all.status();
  if (!few) return few.status();
  double traced = 0, different = 0;
  for (std::size_t i = 0; i < rays; ++i) {
    if (!glossy(i)) continue;
    ++traced;
    const auto hit = [i](const Values& v) { return v.begin() + static_cast<std::ptrdiff_t>(4 * i); };
    different += !std::equal(hit(all.value()), hit(all.value()) + 4, hit(few.value()));
  }
  const Sample share = summarise(ratios(pair.value().b, pair.value().a));
  session.row("left_out", {{"kernel", "octahedral_march"},
                           {"scene", fmt::format("{} {}^2, {} probes", name, size, f->probes.size())},
                           {"what", fmt::format("rays of pixels that are not glossy: {:.0f} % of the rays have a direction, {:.0f} % of the time is left",
                                                100 * traced / static_cast<double>(rays), 100 * share.median)},
                           {"level", 2},
                           {"saved_ms", saved.median},
                           {"saved_bytes", 0},
                           {"error", different / std::max(traced, 1.0)},
                           {"device", session.device()}});
  return {};
}

Status two_levels(Session& session, std::size_t rays, int size) {
  const auto found = world_of("atrium", rays);
  if (!found) return found.status();
  const ProbeWorld& world = *found.value();
  const auto f = field_of("atrium", world, size, {4, 2, 4});
  ProbeTraceParams flat = usual();
  flat.maps.ratio = 1;
  const auto a = ready(session, *f, compact(size), flat, world.asked.rays), b = ready(session, *f, compact(size), usual(), world.asked.rays);
  if (!a) return a.status();
  if (!b) return b.status();
  const auto pair = session.interleave(timed(a.value()), timed(b.value()), "two levels beside one");
  if (!pair) return pair.status();
  const Sample r = summarise(ratios(pair.value().a, pair.value().b));
  double looks[2] = {};
  for (int k = 0; k < 2; ++k) {
    const auto hits = (k == 0 ? a.value() : b.value())->read("hits");
    if (!hits) return hits.status();
    for (std::size_t i = 3; i < hits.value().size(); i += 4) looks[k] += hits.value()[i] / static_cast<double>(rays);
  }
  add(session, {"a minimum map of 1/16 is faster than every texel (time ratio)", "McGuire et al. 2017, 4.2 (no number is printed)", nullptr, r,
                above_one(r),
                fmt::format("atrium, {}^2, 32 probes: {:.0f} looks a ray texel by texel, {:.0f} by two levels; the same answers to the bit",
                            size, looks[0], looks[1])});
  return {};
}

Status resolution(Session& session, std::size_t rays, int small_size, int large_size) {
  const auto found = world_of("atrium", rays);
  if (!found) return found.status();
  const ProbeWorld& world = *found.value();
  const auto large = ready(session, *field_of("atrium", world, large_size, {2, 2, 2}), compact(large_size), usual(), world.asked.rays);
  const auto small = ready(session, *field_of("atrium", world, small_size, {2, 2, 2}), compact(small_size), usual(), world.asked.rays);
  if (!large) return large.status();
  if (!small) return small.status();
  const auto pair = session.interleave(timed(large.value()), timed(small.value()), "resolution against time");
  if (!pair) return pair.status();
  const Sample r = summarise(ratios(pair.value().a, pair.value().b));
  const double sides = static_cast<double>(large_size) / small_size;
  add(session, {fmt::format("time of rays, {0}^2 over {1}^2: less than in proportion to the side ({2:.0f})", large_size, small_size, sides),
                "McGuire et al. 2017, table 1 (2048^2 over 256^2, Lambertian: 1.19)", 1.19, r,
                {fmt::format("upper quartile below {:.0f}", sides), r.q3 < sides},
                "atrium, 8 probes. Lambertian light of the table is looked up, not traced: its 1.19 is of caches alone"});
  return {};
}

Status bytes(Session& session, std::size_t rays, int size) {
  const auto found = world_of("atrium", rays);
  if (!found) return found.status();
  const ProbeWorld& world = *found.value();
  const auto f = field_of("atrium", world, size, {4, 2, 4});
  const auto small = traced_on(session.cpu_float(), *f, compact(size), usual(), world);
  const auto large = traced_on(session.cpu_float(), *f, exact(size), usual(), world);
  if (!small) return small.status();
  if (!large) return large.status();
  const double a = wrong(world, *f, small.value().traced), b = wrong(world, *f, large.value().traced);
  ProbeMaps widest = exact(size);
  widest.radiance = ProbeRadiance::f32x4;
  add(session, {"radiance, normal and distance in 8 bytes a texel", "McGuire et al. 2017, section 3", 8,
                once(probe_texel_bytes(compact(size))),
                {"8 bytes, and fewer than 1 % of the rays more than with f32 end elsewhere",
                 probe_texel_bytes(compact(size)) == 8 && std::fabs(a - b) < 0.01},
                fmt::format("r11g11b10, snorm 2x8, f16 over the cage's diagonal: {:.4f} of atrium's rays end elsewhere than Embree's, with "
                            "{:.0f} bytes a texel {:.4f}",
                            a, probe_texel_bytes(widest), b)});
  // The largest solid angle of a texel: octahedron, middle of a face 3 sqrt(3) (2 / n)^2; cube, middle of a face (2 / m)^2.
  const double ratio = 6 / (3 * std::sqrt(3.0));
  add(session, {"an octahedral map takes a quarter of a cube map's texels at equal quality (ratio)", "McGuire et al. 2017, section 3", 4,
                once(ratio), within(ratio, 4, 1.25),
                "where equal quality means an equal largest solid angle of a texel: 6 m^2 over n^2 with (2/m)^2 = 3 sqrt(3) (2/n)^2. A "
                "quarter is what resampling cubes of twice the resolution gives"});
  return {};
}

// Rays a second by Embree, one at a time on all cores, beside ours.
Status beside_embree(Session& session, const std::string& name, std::size_t rays, int size, const Count& count) {
  const auto found = world_of(name, rays);
  if (!found) return found.status();
  const ProbeWorld& world = *found.value();
  const auto f = field_of(name, world, size, count);
  const auto own = ready(session, *f, compact(size), usual(), world.asked.rays);
  if (!own) return own.status();
  const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
  const auto embree = [&]() -> Result<double> {
    const auto begin = std::chrono::steady_clock::now();
    std::atomic<std::size_t> hits = 0;
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < cores; ++t)
      threads.emplace_back([&, t] {
        std::size_t mine = 0;
        for (std::size_t i = t; i < rays; i += cores) {
          const double* r = &world.asked.rays[8 * i];
          mine += world.rays->first({r[0], r[1], r[2]}, {r[4], r[5], r[6]}).has_value();
        }
        hits += mine;
      });
    for (std::thread& t : threads) t.join();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  };
  const auto pair = session.interleave(timed(own.value()), embree, "peer: Embree");
  if (!pair) return pair.status();
  const Sample r = summarise(ratios(pair.value().b, pair.value().a)), theirs = summarise(pair.value().b), ours = summarise(pair.value().a);
  const double n = static_cast<double>(rays);
  session.row("peers", {{"peer", fmt::format("Embree, one ray at a time on all cores ({:.2f} M rays/s; ours {:.2f})", n / theirs.median * 1e-3,
                                             n / ours.median * 1e-3)},
                        {"version", "3"},
                        {"kernel", "octahedral_march"},
                        {"size", fmt::format("{} rays, {} {}^2", rays, name, size)},
                        {"time_ms", cell_of(theirs)},
                        {"error", 0},
                        {"ratio", r.median},
                        {"q1", r.q1},
                        {"q3", r.q3},
                        {"device", session.device()},
                        {"options", {{"probes", f->probes.size()}}},
                        {"own_ms", cell_of(ours)},
                        {"own_error", nullptr},
                        {"goal", nullptr}});
  return {};
}

Status beside_march(Session& session, std::size_t rays, int size, const Count& count) {
  const auto found = world_of("atrium", rays);
  if (!found) return found.status();
  const ProbeWorld& world = *found.value();
  const auto f = field_of("atrium", world, size, count);
  const auto own = ready(session, *f, compact(size), usual(), world.asked.rays);
  if (!own) return own.status();
  // The distances of all probes, two a word, and their minima.
  const std::size_t entries = probe_distance_elements(compact(size), f->probes.size()) +
                              probe_minimum_elements(compact(size), f->probes.size());
  return beside_dependent_reads(session, own.value(),
                                {"octahedral_march", "two levels", fmt::format("{}^2, {} probes", size, f->probes.size()),
                                 "the maps'", "hits", static_cast<double>(rays),
                                 static_cast<int>(std::min<std::size_t>(entries, (1u << 24) - 1))});
}

}  // namespace

std::vector<Job> probe_grid(Session& session) {
  const bool quick = session.settings().quick;
  std::vector<Job> jobs;
  // A million where the scene is largest; a fifth of it for how that grows and for other scenes.
  const auto add = [&](const std::string& name, int size, const Count& count, bool normals, std::size_t rays = 200000) {
    jobs.push_back({fmt::format("octahedral_march {} {}^2 {}x{}x{}{} {} rays", name, size, count[0], count[1], count[2], normals ? "" : " no normals", rays),
                    [=, &session] { return measure(session, name, rays, size, count, normals); }});
  };
  if (quick) {
    add("cornell", 64, {2, 2, 2}, true, 20000);
    return jobs;
  }
  if (session.is_cpu()) {
    for (const int size : {64, 256}) add("cornell", size, {2, 2, 2}, true);
    return jobs;
  }
  std::vector<std::string> names{"cornell", "two_rooms", "atrium"};
  if (!sponza().empty()) names.push_back("sponza");
  for (const std::string& name : names) {
    // As many in Sponza as lavapipe's largest buffer holds, 128 MiB.
    const Count few = name == "sponza" ? Count{4, 2, 4} : Count{2, 2, 2}, many = name == "sponza" ? Count{6, 3, 6} : Count{4, 4, 4};
    for (const int size : {64, 256}) add(name, size, few, true);
    if (name == "atrium") add(name, 1024, few, true);
    add(name, 256, {1, 1, 1}, true);
    add(name, 256, few, false);
    add(name, 256, many, true, name == names.back() ? 1000000 : 200000);
  }
  return jobs;
}

std::vector<Job> probe_left_out(Session& session) {
  const bool quick = session.settings().quick;
  const std::size_t rays = quick ? 20000 : 200000;
  const int size = quick ? 64 : 256;
  const auto job = [&](const char* what, int level) {
    return Job{fmt::format("octahedral_march left out: {}", what), [=, &session] { return save(session, "cornell", rays, size, {2, 2, 2}, what, level); }};
  };
  std::vector<Job> jobs{job("normals of closed surfaces", 1)};
  if (!quick) {
    jobs.push_back(job("outcome counters", 1));
    jobs.push_back(job("probes inside geometry", 2));
    jobs.push_back({"octahedral_march left out: rays of matte pixels", [=, &session] { return save_matte(session, "cornell", rays, size, {2, 2, 2}); }});
  }
  return jobs;
}

std::vector<Job> probe_reproduction(Session& session) {
  const bool quick = session.settings().quick;
  const std::size_t rays = quick ? 20000 : 200000;
  std::vector<Job> jobs{{"octahedral_march two levels beside one", [=, &session] { return two_levels(session, rays, quick ? 64 : 256); }}};
  if (quick) return jobs;
  jobs.push_back({"octahedral_march resolution against time", [=, &session] { return resolution(session, rays, 256, 1024); }});
  jobs.push_back({"octahedral_march bytes a texel", [=, &session] { return bytes(session, rays, 256); }});
  return jobs;
}

std::vector<Job> probe_peers(Session& session) {
  const bool quick = session.settings().quick;
  const std::size_t rays = quick ? 20000 : 200000;
  const int size = quick ? 64 : 256;
  std::vector<Job> jobs{{"octahedral_march peer: a march of dependent reads", [=, &session] { return beside_march(session, rays, size, {4, 2, 4}); }},
                        {"octahedral_march peer: Embree", [=, &session] { return beside_embree(session, "atrium", rays, size, {4, 2, 4}); }}};
  return jobs;
}

std::vector<BenchSetting> octahedral_march_settings(const Profile& profile) {
  std::vector<BenchSetting> settings;
  const auto found = world_of("atrium", 100000);
  const auto cpu = Context::open("cpu");
  if (!found || !cpu) return settings;
  const ProbeWorld& world = *found.value();
  const auto f = field_of("atrium", world, 256, {4, 2, 4});
  const auto scene = ProbeScene::make(*cpu.value(), compact(256), f->probes.grid, f->values, f->probes.positions());
  if (!scene) return settings;
  const auto shared = [](Values v) { return std::make_shared<const Values>(std::move(v)); };
  const auto rays = shared(world.asked.rays), positions = shared(f->probes.positions());
  std::map<std::string, std::shared_ptr<const Values>> maps;
  for (const char* name : {"distances", "minimum", "normals"})
    if (auto v = scene.value().maps().read(name)) maps[name] = shared(std::move(v.value()));
  for (const auto& [name, ratio, normal] : {std::tuple{"two levels", 16, ProbeNormal::snorm8}, {"flat", 1, ProbeNormal::snorm8}, {"two levels, no normals", 16, ProbeNormal::none}}) {
    ProbeTraceParams p = usual();
    p.grid = f->probes.grid;
    p.maps = compact(256);
    p.maps.ratio = ratio;
    p.maps.normal = normal;
    p.rays = 100000;
    const auto made = plan(p, profile);
    if (!made) continue;
    BenchSetting s{fmt::format("trace 100000 rays, atrium 32 x 256^2, {}", name), made.value(), {}, {}};
    for (const Resource& r : made.value().resources) {
      if (r.name == "rays") s.data.emplace_back(r.name, rays);
      else if (r.name == "positions") s.data.emplace_back(r.name, positions);
      else if (maps.count(r.name)) s.data.emplace_back(r.name, maps[r.name]);
    }
    settings.push_back(std::move(s));
  }
  ProbeBuildParams b;
  b.maps = compact(256);
  b.probes = 8;
  if (const auto made = plan(b, profile))
    settings.push_back({"build 8 x 256^2 from texels", made.value(), {"radiance_source", "distance_source", "normal_source"}, {}});
  b.source = ProbeSource::equirect;
  b.width = 512;
  b.height = 256;
  b.samples = 2;
  if (const auto made = plan(b, profile))
    settings.push_back({"build 8 x 256^2 from images 512x256", made.value(), {"radiance_source", "distance_source", "normal_source"}, {}});
  return settings;
}

}  // namespace luxel::report
