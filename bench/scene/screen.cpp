#include "bench/scene/screen.h"

#include <map>
#include <numbers>

namespace luxel::scene {
namespace {

double time_of(const Times& times) {
  if (times.passes.empty()) return times.total;
  double sum = 0;
  for (const double ms : times.passes) sum += ms;
  return sum;
}

// Memory by name, and plans over it.
class Session {
 public:
  Session(Context& context, std::vector<ScreenStep>& steps) : context_(context), steps_(steps) {}

  Status make(const std::string& name, Format format, std::size_t count, std::span<const float> data = {}) {
    Resource r{name};
    r.format = format;
    r.bytes = count * bytes_per_pixel(format);
    r.written = true;
    auto memory = context_.make(r);
    if (!memory) return memory.status();
    memories_[name] = memory.value();
    return data.empty() ? Status() : context_.upload(*memory.value(), data.data(), data.size() * sizeof(float));
  }

  // Runs a plan; `parts` name what is bound where it is not the memory of the resource's own name.
  Status run(const Result<Plan>& plan, const char* name, const std::vector<Named>& parts = {}) {
    if (!plan) return plan.status();
    auto program = context_.compile(plan.value());
    if (!program) return program.status();
    std::vector<Named> bound = parts;
    if (parts.empty())
      for (const Resource& r : plan.value().resources) bound.push_back({r.name, memories_.at(r.name)});
    Times times;
    if (Status s = context_.run(*program.value(), bound, &times); !s) return s;
    steps_.push_back({name, time_of(times)});
    return {};
  }

  // The levels of a pyramid, each in its part of one memory.
  template <class Offset>
  Status levels(const MipBuildParams& m, const char* memory, const char* name, const Offset& offset) {
    std::vector<std::string> names;
    for (int level = 0; level <= mip_levels(m); ++level) names.push_back(mip_level_name(level));
    std::vector<Named> parts;
    for (std::size_t level = 0; level < names.size(); ++level)
      parts.push_back({names[level], memories_.at(memory), offset(static_cast<int>(level))});
    return run(plan(m, context_.profile()), name, parts);
  }

  template <class T>
  Status read(const char* name, std::size_t count, std::vector<T>& to) {
    to.resize(count);
    return context_.download(*memories_.at(name), to.data(), count * sizeof(T));
  }

 private:
  Context& context_;
  std::vector<ScreenStep>& steps_;
  std::map<std::string, std::shared_ptr<Memory>> memories_;
};

#define TRY(status) \
  do { \
    if (Status s_ = (status); !s_) return s_; \
  } while (false)

}  // namespace

Result<ScreenOutput> reflect(Context& context, const HizSsrParams& p, const ScreenInput& input) {
  if (context.real64()) return Status(Code::unsupported, "cpu:double: reflections are made in f32");
  if (Status s = validate(p); !s) return s;
  ScreenOutput out;
  Session session(context, out.steps);
  const std::size_t pixels = static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height), rays = hiz_ssr_rays(p);
  TRY(session.make("depth", Format::f32x1, hiz_ssr_depth_texels(p), input.depth));
  if (hiz_ssr_levels(p) > 1)
    TRY(session.levels(hiz_ssr_pyramid(p), "depth", "pyramid of depth", [&](int l) { return hiz_ssr_level_offset(p, l); }));
  TRY(p.rays > 0 ? session.make("rays", Format::f32x4, 2 * rays, input.rays)
                 : session.make("normals", Format::f32x4, pixels, input.normals));
  TRY(session.make("hits", Format::f32x4, rays));
  TRY(session.make("paths", Format::f32x4, rays));
  const bool stochastic = p.variant == SsrVariant::stochastic;
  if (stochastic) TRY(session.make("directions", Format::f32x4, rays));
  const std::vector<float> zeros(ssr_outcomes, 0.0f);
  if (p.count) TRY(session.make("counters", Format::u32, ssr_outcomes, zeros));
  if (p.shade) {
    TRY(session.make("colour", Format::f32x4, hiz_ssr_colour_texels(p), input.colour));
    if (hiz_ssr_colour_levels(p) > 1)
      TRY(session.levels(hiz_ssr_colours(p), "colour", "pyramid of colour", [&](int l) { return hiz_ssr_colour_offset(p, l); }));
    TRY(session.make("radiance", Format::f32x4, pixels));
    if (p.fallback) TRY(session.make("fallback", Format::f32x4, pixels, input.fallback));
    if (p.factor) {
      SplitSumParams table;
      table.size = p.split_sum_size;
      TRY(session.make("specular", Format::f32x4, pixels, input.specular));
      TRY(session.make("split_sum", Format::f32x2, static_cast<std::size_t>(table.size) * static_cast<std::size_t>(table.size)));
      TRY(session.run(plan(table, context.profile()), "split sum"));
    }
  }
  TRY(session.run(plan(p, context.profile()), "hiz_ssr"));
  TRY(session.read("hits", 4 * rays, out.hits));
  TRY(session.read("paths", 4 * rays, out.paths));
  if (stochastic) TRY(session.read("directions", 4 * rays, out.directions));
  if (p.count) TRY(session.read("counters", ssr_outcomes, out.counters));
  if (p.shade) TRY(session.read("radiance", 4 * pixels, out.radiance));
  return out;
}

HizSsrParams screen_params(const GBuffer& g, const Camera& camera) {
  HizSsrParams p;
  p.width = g.width;
  p.height = g.height;
  set_field(p, camera.fov * std::numbers::pi / 180);
  return p;
}

std::vector<float> screen_normals(const GBuffer& g, const Camera& camera) {
  const View view = view_of(camera);
  std::vector<float> normals;
  for (std::size_t i = 0; i < g.pixels(); ++i) {
    const glm::dvec3 n = g.at(g.normal, i);
    // What reflects nothing specularly is taken for too rough.
    const bool glossy = g.surface_at(i) && g.at(g.specular, i) != glm::dvec3(0);
    for (const double v : {glm::dot(n, view.right), glm::dot(n, view.up), glm::dot(n, view.back),
                           glossy ? static_cast<double>(g.roughness[i]) : 2.0})
      normals.push_back(static_cast<float>(v));
  }
  return normals;
}

std::vector<float> padded(std::span<const float> three, float fourth) {
  std::vector<float> four;
  for (std::size_t i = 0; i + 2 < three.size(); i += 3) four.insert(four.end(), {three[i], three[i + 1], three[i + 2], fourth});
  return four;
}

}  // namespace luxel::scene
