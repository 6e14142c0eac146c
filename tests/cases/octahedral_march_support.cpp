#include "tests/cases/octahedral_march_support.h"

#include <algorithm>
#include <cmath>

#include <luxel/reference.h>

#include "tests/cases/storage.h"

namespace luxel::cases {
namespace {

reference::Precision precision(const Context& context) {
  return context.real64() ? reference::Precision::real64 : reference::Precision::real32;
}

}  // namespace

Result<HeldPlan> HeldPlan::make(Context& context, const Result<Plan>& plan, const std::vector<Named>& shared) {
  if (!plan) return plan.status();
  HeldPlan held;
  held.context_ = &context;
  held.plan_ = plan.value();
  Result<std::shared_ptr<Program>> program = context.compile(held.plan_);
  if (!program) return program.status();
  held.program_ = program.value();
  for (const Resource& r : held.plan_.resources) {
    const auto found = std::find_if(shared.begin(), shared.end(), [&](const Named& n) { return n.name == r.name; });
    if (found != shared.end()) {
      held.memory_.push_back(found->memory);
      continue;
    }
    Result<std::shared_ptr<Memory>> memory = context.make(r);
    if (!memory) return memory.status();
    held.memory_.push_back(memory.value());
  }
  return held;
}

std::size_t HeldPlan::index(std::string_view name) const {
  std::size_t i = 0;
  while (i < plan_.resources.size() && plan_.resources[i].name != name) ++i;
  return i;
}

std::shared_ptr<Memory> HeldPlan::memory(std::string_view name) const {
  const std::size_t i = index(name);
  return i < memory_.size() ? memory_[i] : nullptr;
}

Status HeldPlan::write(std::string_view name, std::span<const double> values) {
  const std::size_t i = index(name);
  if (i == memory_.size()) return {Code::invalid_argument, plan_.kernel + " has no resource " + std::string(name)};
  const std::vector<std::byte> data = store(values, plan_.resources[i].format, context_->real64());
  return context_->upload(*memory_[i], data.data(), data.size());
}

Result<std::vector<std::byte>> HeldPlan::bytes(std::string_view name) const {
  const std::size_t i = index(name);
  if (i == memory_.size())
    return Status(Code::invalid_argument, plan_.kernel + " has no resource " + std::string(name));
  std::vector<std::byte> data(reference::resource_bytes(plan_.resources[i], precision(*context_)));
  if (Status s = context_->download(*memory_[i], data.data(), data.size()); !s) return s;
  return data;
}

Result<Values> HeldPlan::read(std::string_view name) const {
  Result<std::vector<std::byte>> data = bytes(name);
  if (!data) return data.status();
  return fetch(data.value(), plan_.resources[index(name)].format, context_->real64());
}

Status HeldPlan::go(int repeat, Times* times) {
  std::vector<Named> named;
  for (std::size_t i = 0; i < memory_.size(); ++i) named.push_back({plan_.resources[i].name, memory_[i]});
  if (repeat > 1) return context_->run_many(*program_, named, repeat, times);
  return context_->run(*program_, named, times);
}

std::size_t HeldPlan::memory_bytes() const {
  std::size_t sum = plan_.scratch_bytes;
  for (const Resource& r : plan_.resources) sum += r.bytes;
  return sum;
}

void HeldPlan::keep_outputs() {
  for (std::size_t i = 0; i < memory_.size(); ++i)
    if (!plan_.resources[i].written) memory_[i] = nullptr;
}

Values ray_values(const std::vector<Ray>& rays) {
  Values v;
  for (const Ray& r : rays)
    for (const double x : {r.origin[0], r.origin[1], r.origin[2], r.begin, r.direction[0], r.direction[1], r.direction[2], r.reach})
      v.push_back(static_cast<float>(x));
  return v;
}

TexelValues texel_values(int size, int probes,
                         const std::function<double(int, const std::array<double, 3>&, std::array<double, 3>&)>& see) {
  TexelValues v;
  for (int p = 0; p < probes; ++p)
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const auto d = truth::octahedral_direction((2.0 * x + 1) / size - 1, (2.0 * y + 1) / size - 1);
        std::array<double, 3> n{-d[0], -d[1], -d[2]};
        v.distance.push_back(static_cast<float>(std::min(see(p, d, n), 1e30)));
        for (const double c : n) v.normal.push_back(static_cast<float>(c));
        v.normal.push_back(0);
      }
  return v;
}

Result<ProbeScene> ProbeScene::make(Context& context, const ProbeMaps& maps, const ProbeGrid& grid, const TexelValues& values,
                                    std::span<const double> positions) {
  ProbeScene scene;
  scene.context_ = &context;
  scene.maps_ = maps;
  scene.grid_ = grid;
  ProbeBuildParams p;
  p.maps = maps;
  p.probes = static_cast<int>(probe_count(grid));
  p.unit = probe_unit(grid);
  p.radiance = !values.radiance.empty();
  auto built = HeldPlan::make(context, luxel::plan(p, context.profile()));
  if (!built) return built.status();
  scene.built_ = std::move(built.value());
  if (Status s = scene.built_.write("distance_source", values.distance); !s) return s;
  if (p.radiance)
    if (Status s = scene.built_.write("radiance_source", values.radiance); !s) return s;
  if (maps.normal != ProbeNormal::none)
    if (Status s = scene.built_.write("normal_source", values.normal); !s) return s;
  if (Status s = scene.built_.go(); !s) return s;
  scene.built_.keep_outputs();
  if (grid.placed) {
    Resource r{"positions"};
    r.format = Format::f32x4;
    r.bytes = probe_count(grid) * 16;
    auto memory = context.make(r);
    if (!memory) return memory.status();
    const std::vector<std::byte> data = store(positions, r.format, context.real64());
    if (Status s = context.upload(*memory.value(), data.data(), data.size()); !s) return s;
    scene.positions_ = memory.value();
  }
  return scene;
}

Status ProbeScene::prepare(ProbeTraceParams p, std::span<const double> rays) {
  p.grid = grid_;
  const ProbeMaps asked = p.maps;
  p.maps = maps_;
  if (asked.ratio == 1) p.maps.ratio = 1;
  if (asked.normal == ProbeNormal::none) p.maps.normal = ProbeNormal::none;
  p.rays = static_cast<int>(rays.size() / 8);
  std::vector<Named> shared;
  for (const char* name : {"distances", "minimum", "normals"})
    if (auto memory = built_.memory(name)) shared.push_back({name, memory});
  if (positions_) shared.push_back({"positions", positions_});
  auto held = HeldPlan::make(*context_, luxel::plan(p, context_->profile()), shared);
  if (!held) return held.status();
  last_ = std::make_shared<HeldPlan>(std::move(held.value()));
  if (Status s = last_->write("rays", rays); !s) return s;
  if (p.count) return last_->write("counters", Values(probe_outcomes, 0.0));
  return {};
}

Result<Traced> ProbeScene::result() const {
  Traced t;
  auto hits = last_->read("hits");
  if (!hits) return hits.status();
  t.hits = std::move(hits.value());
  auto texels = last_->read("texels");
  if (!texels) return texels.status();
  t.texels = std::move(texels.value());
  if (last_->memory("counters")) {
    auto counters = last_->read("counters");
    if (!counters) return counters.status();
    t.counters = std::move(counters.value());
  }
  return t;
}

Result<Traced> ProbeScene::trace(ProbeTraceParams params, std::span<const double> rays, int repeat, Times* times) {
  if (Status s = prepare(params, rays); !s) return s;
  if (Status s = last_->go(repeat, times); !s) return s;
  return result();
}

Result<truth::ProbeMap> ProbeScene::decoded(int probe, bool normals) const {
  truth::ProbeMap map;
  map.size = maps_.size;
  const std::size_t n = static_cast<std::size_t>(map.size) * static_cast<std::size_t>(map.size),
                    first = static_cast<std::size_t>(probe) * n;
  const auto stored = built_.read("distances");
  if (!stored) return stored.status();
  const auto half = [&](const Values& words, std::size_t i) {
    return (static_cast<std::uint32_t>(words[i / 2]) >> (16 * (i & 1))) & 0xffffu;
  };
  for (std::size_t i = first; i < first + n; ++i) {
    if (maps_.distance == ProbeDistance::f32) {
      map.distance.push_back(stored.value()[i]);
      continue;
    }
    const std::uint32_t bits = half(stored.value(), i), e = bits >> 10 & 31, m = bits & 1023;
    const double v = e == 0 ? m * 0x1p-24 : std::ldexp(1024.0 + m, static_cast<int>(e) - 25);
    map.distance.push_back(v >= 65504 ? 1e30 : v * probe_unit(grid_));
  }
  if (!normals) return map;
  const auto words = built_.read("normals");
  if (!words) return words.status();
  for (std::size_t i = first; i < first + n; ++i)
    map.normal.push_back(maps_.normal == ProbeNormal::snorm8
                             ? truth::direction_of_code(half(words.value(), i), 8)
                             : truth::direction_of_code(static_cast<std::uint32_t>(words.value()[i]), 16));
  return map;
}

}  // namespace luxel::cases
