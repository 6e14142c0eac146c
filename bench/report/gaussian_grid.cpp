// The frontier of gaussian_blur: which settings are measured on which scenes.
#include <algorithm>
#include <cmath>

#include "bench/report/gaussian.h"
#include "bench/report/limits.h"
#include "bench/scene/images.h"
#include "tests/cases/gaussian_blur_support.h"

namespace luxel::report {
namespace {

using Shared = std::shared_ptr<const Scene>;

class Grid {
 public:
  explicit Grid(Session& session) : session_(session), quick_(session.settings().quick) {}

  void add(BlurSetting s) {
    jobs_.push_back({label(s), [&session = session_, s] { return measure_blur(session, s); }});
  }

  void add(const Shared& scene, GaussianBlurParams p, double k, BlurMetric metric = BlurMetric::largest) {
    add({scene, p, k, metric});
  }

  // Every way to blur by one sigma, from coarse to fine.
  void ways(const Shared& scene, double sigma, const std::vector<double>& ks, Format format,
            BlurMetric metric = BlurMetric::largest) {
    for (const double k : ks) {
      const GaussianBlurParams separable = params_for(*scene, sigma, k, format);
      if (session_.is_cpu() && separable.radius > 96) continue;
      add(scene, separable, k, metric);
      // The same taps read otherwise, whose error is separable's, stand at one truncation. Interpolating in C++ costs many
      // times the reading of a texel.
      const bool read_otherwise = k == 3 && separable.radius <= (quick_ || session_.is_cpu() ? 12 : 24);
      if (read_otherwise) add(scene, params_for(*scene, sigma, k, format, GaussianVariant::sampler), k, metric);
      GaussianBlurParams image = separable;
      image.input = Input::image;
      if (read_otherwise && !quick_ && !session_.is_cpu()) add(scene, image, k, metric);
      const int most = session_.is_cpu() ? (quick_ ? 4 : 10) : (quick_ ? 6 : 12);
      if (separable.radius <= most && ((!quick_ && separable.radius <= 8) || k == 3))
        add(scene, params_for(*scene, sigma, k, format, GaussianVariant::direct), k, metric);
    }
  }

  // Variants whose cost does not grow with sigma, with the knobs that their error depends on, or as they are by default.
  void without_taps(const Shared& scene, double sigma, Format format, bool all_knobs, BlurMetric metric = BlurMetric::largest) {
    const bool few = quick_ || session_.is_cpu() || !all_knobs;
    for (int order = few ? 5 : 3; order <= 5; ++order) {
      GaussianBlurParams p = params_for(*scene, sigma, 0, format, GaussianVariant::recursive);
      p.order = order;
      add(scene, p, 0, metric);
    }
    for (int passes = few ? 3 : 1; passes <= (few ? 3 : 5); ++passes) {
      GaussianBlurParams p = params_for(*scene, sigma, 0, format, GaussianVariant::box);
      p.passes = passes;
      add(scene, p, 0, metric);
    }
    for (const PyramidFilter filter : {PyramidFilter::linear, PyramidFilter::cubic}) {
      GaussianBlurParams p = params_for(*scene, sigma, 0, format, GaussianVariant::pyramid);
      p.filter = filter;
      p.levels = -1;
      // A level less costs more and errs less, one more the other way round.
      const int chosen = effective_levels(p);
      for (int levels = std::max(1, chosen - (few ? 0 : 1)); levels <= chosen + (few ? 0 : 1); ++levels) {
        p.levels = levels;
        if (validate(p)) add(scene, p, 0, metric);
      }
    }
  }

  void copies(const Scene& scene) {
    add_copies(session_, jobs_, size_text(scene.width, scene.height), scene.width, scene.height);
  }

  std::vector<Job> take() { return std::move(jobs_); }

 private:
  Session& session_;
  bool quick_;
  std::vector<Job> jobs_;
};

// An image just large enough for the truth's kernel: nothing of the response is cut off.
Shared impulse_for(double sigma) {
  const int reach = static_cast<int>(std::ceil(8.3 * sigma)) + 1, side = 2 * reach + 1;
  return std::make_shared<Scene>(
      Scene{"impulse (generated)", side, side, 1, scene::impulse(side, side, 1, reach, reach)});
}

}  // namespace

std::vector<Job> gaussian_grid(Session& session, const std::vector<Shared>& files) {
  const bool quick = session.settings().quick;
  const Settings& wanted = session.settings();
  const std::vector<double> sigmas =
      wanted.sigma > 0 ? std::vector<double>{wanted.sigma} : quick ? std::vector<double>{1, 4, 16} : std::vector<double>{0.5, 1, 2, 4, 8, 12, 16, 32};
  // All knobs at three sigmas, whose curves the others repeat: each setting compiles programs of its own.
  const auto thorough = [&](double sigma) { return wanted.sigma > 0 || sigma == 1 || sigma == 4 || sigma == 16; };
  const std::vector<double> ks = quick ? std::vector<double>{2, 3, 4} : std::vector<double>{1, 2, 3, 4, 5, 6};
  const std::vector<double> some_ks = quick ? std::vector<double>{3} : std::vector<double>{2, 3, 4, 5};
  Grid grid(session);
  const Shared small = std::make_shared<Scene>(landscape(quick ? 256 : 512, quick ? 256 : 512));
  const Shared main = wanted.width > 0 ? std::make_shared<Scene>(landscape(wanted.width, wanted.height)) : files.empty() ? small : files.front();

  for (const double sigma : sigmas) {
    grid.ways(main, sigma, (quick && sigma != 4 && wanted.sigma == 0) || !thorough(sigma) ? some_ks : ks, Format::f32x4);
    if (!quick || sigma >= 4 || wanted.sigma > 0) grid.without_taps(main, sigma, Format::f32x4, thorough(sigma));
  }
  if (wanted.sigma > 0) return grid.take();  // the rest is of other sigmas
  // Where taps are many, only so many as the coarser variants' errors ask for.
  if (!quick && !session.is_cpu())
    for (const double sigma : {64.0, 100.0}) {
      for (const double k : sigma < 100 ? std::vector{2.0, 3.0, 4.0} : std::vector{3.0}) grid.add(main, params_for(*main, sigma, k), k);
      grid.without_taps(main, sigma, Format::f32x4, false);
    }
  grid.copies(*main);
  for (std::size_t i = files.empty() ? files.size() : 1; i < files.size(); ++i)
    for (const double k : some_ks) grid.add(files[i], params_for(*files[i], quick ? 4 : 8, k), k);
  for (const double sigma : quick ? std::vector<double>{4} : std::vector<double>{1, 4, 16}) {
    const Shared impulse = impulse_for(sigma);
    if (quick)
      for (const GaussianVariant variant : {GaussianVariant::recursive, GaussianVariant::box})
        grid.add(impulse, params_for(*impulse, sigma, 0, Format::f32x1, variant), 0, BlurMetric::half_l1);
    else
      grid.without_taps(impulse, sigma, Format::f32x1, sigma == 4, BlurMetric::half_l1);
    for (const double k : some_ks) {
      grid.add(impulse, params_for(*impulse, sigma, k, Format::f32x1), k, BlurMetric::half_l1);
      if (!quick && !session.is_cpu() && k == 3 && sigma <= 12)
        grid.add(impulse, params_for(*impulse, sigma, k, Format::f32x1, GaussianVariant::sampler), k,
                 BlurMetric::half_l1);
    }
  }
  const Shared edge = std::make_shared<Scene>(Scene{"step (generated)", 256, 64, 1, scene::step_edge(256, 64, 1, 128)});
  for (const double k : some_ks) grid.add(edge, params_for(*edge, 4, k, Format::f32x1), k);

  // Formats, borders and options at one sigma.
  for (const Format format : cases::pixel_formats)
    if (!quick) grid.without_taps(small, 4, format, false);
  const std::vector<Format> formats_at_4 = quick ? std::vector{Format::unorm8x4}
                                                 : std::vector(std::begin(cases::pixel_formats), std::end(cases::pixel_formats));
  for (const Format format : formats_at_4)
    for (const double k : quick ? std::vector<double>{3} : std::vector<double>{2, 3, 4})
      for (const GaussianVariant variant : {GaussianVariant::separable, GaussianVariant::sampler})
        if (variant == GaussianVariant::separable || (k == 3 && !(quick || session.is_cpu())))
          grid.add(small, params_for(*small, 4, k, format, variant), k);
  for (const Border border : {Border::mirror, Border::wrap, Border::zero}) {
    if (quick) continue;
    GaussianBlurParams p = params_for(*small, 4, 3);
    p.border = border;
    grid.add(small, p, 3);
    for (const GaussianVariant variant : {GaussianVariant::recursive, GaussianVariant::box, GaussianVariant::pyramid}) {
      GaussianBlurParams other = params_for(*small, 4, 3, Format::f32x4, variant);
      other.border = border;
      if (!quick) grid.add(small, other, 0);
    }
  }
  for (bool GaussianBlurParams::*const option : {&GaussianBlurParams::difference, &GaussianBlurParams::keep_alpha}) {
    if (quick && option == &GaussianBlurParams::keep_alpha) continue;  // what it saves is measured
    GaussianBlurParams p = params_for(*small, 4, 3);
    p.*option = true;
    grid.add(small, p, 3);
  }
  for (const Format format : {Format::f16x4, Format::unorm8x4}) {
    if (quick) continue;  // what it saves is measured
    GaussianBlurParams p = params_for(*small, 4, 6, format);
    grid.add(small, p, 6);
    p.drop_taps = true;
    grid.add(small, p, 6);
  }
  grid.copies(*small);

  // The size that the peers are compared at: 25 taps.
  const Shared full_hd = std::make_shared<Scene>(landscape(1920, 1080));
  std::vector<Format> formats{Format::f32x1};
  if (!session.is_cpu()) formats.insert(formats.begin(), Format::f32x4);
  if (!session.is_cpu() && !quick) formats.insert(formats.end(), {Format::f16x4, Format::unorm8x4});
  for (const Format format : formats) grid.add(full_hd, params_for(*full_hd, 4, 3, format), 3);
  GaussianBlurParams image = params_for(*full_hd, 4, 3);
  image.input = Input::image;
  if (!session.is_cpu()) grid.add(full_hd, image, 3);
  // Not where a sampler is a program that takes seconds for it.
  if (!session.is_cpu() && !quick && session.context().profile().name != "pocl")
    grid.add(full_hd, params_for(*full_hd, 4, 3, Format::f32x4, GaussianVariant::sampler), 3);
  grid.copies(*full_hd);
  return grid.take();
}

}  // namespace luxel::report
