#include "bench/emit/kernels.h"

#include <luxel/bilateral.h>
#include <luxel/cone_trace.h>
#include <luxel/discontinuity_mask.h>
#include <luxel/gaussian_blur.h>
#include <luxel/hiz_ssr.h>
#include <luxel/light_propagation.h>
#include <luxel/lpv_inject.h>
#include <luxel/lpv_sample.h>
#include <luxel/mip_build.h>
#include <luxel/octahedral_map.h>
#include <luxel/outlier_clamp.h>
#include <luxel/probe_build.h>
#include <luxel/probe_irradiance.h>
#include <luxel/probe_shade.h>
#include <luxel/probe_trace.h>
#include <luxel/variance.h>
#include <luxel/voxel_inject.h>
#include <luxel/voxelize.h>

#include "bench/emit/fields.h"

namespace luxel::emit {

#define NAMES(type, ...) \
  template <> struct Names<type> { static constexpr auto of = std::to_array<std::string_view>({__VA_ARGS__}); };
NAMES(Border, "clamp", "mirror", "wrap", "zero")
NAMES(GaussianVariant, "separable", "direct", "sampler", "recursive", "box", "pyramid")
NAMES(PyramidFilter, "linear", "cubic")
NAMES(BilateralVariant, "direct", "separable", "atrous", "grid", "discontinuity")
NAMES(RangeTerm, "off", "self", "guide")
NAMES(RangeNorm, "l2", "l1")
NAMES(FilterWindow, "square", "circle")
NAMES(DepthTerm, "off", "plane", "svgf")
NAMES(ConeVariant, "isotropic", "anisotropic")
NAMES(SsrVariant, "hiz", "dda", "linear", "stochastic")
NAMES(SsrDepth, "linear", "standard", "reversed")
NAMES(LpvLobes, "linear", "clamp", "shrink", "rescale")
NAMES(LpvBorder, "open", "periodic")
NAMES(MipVariant, "isotropic", "anisotropic", "gaussian3", "min", "max", "minmax", "moments")
NAMES(MipSizes, "floor", "ceil")
NAMES(MipSamples, "cells", "vertices")
NAMES(OctahedralCode, "snorm8", "snorm16", "r11g11b10")
NAMES(OutlierVariant, "mean", "median")
NAMES(ProbeRadiance, "f32x4", "f16x4", "r11g11b10")
NAMES(ProbeDistance, "f32", "f16")
NAMES(ProbeNormal, "none", "snorm8", "snorm16")
NAMES(ProbeSource, "texels", "equirect", "cube")
NAMES(ProbeFacing, "all", "cosine", "smooth")
NAMES(ProbeHidden, "unfiltered", "dark")
NAMES(ProbeOrder, "plus3", "farthest")
NAMES(VarianceVariant, "spatial", "temporal")
NAMES(VoxelizeMode, "conservative", "thin", "dilated")
NAMES(VoxelizeMerging, "exact", "moving_average", "last_write")
#undef NAMES

namespace {

// What a user wrote, in an error of one line.
std::string printable(std::string text) {
  for (char& c : text) c = c >= 32 && c < 127 ? c : '?';
  return text;
}

template <class Params>
Kernel make(std::string name, std::string folder, std::string variant, std::vector<std::string> sizes, std::vector<int> size,
            Params start, std::vector<Field<Params>> fields, std::function<void(Params&)> complete = {}) {
  Kernel kernel{std::move(name), std::move(folder), std::move(variant), "default", std::move(sizes), std::move(size), {}, {}};
  for (const auto& f : fields) {
    kernel.fields.emplace_back(f.name, f.takes);
    if (f.name == kernel.variant) kernel.standard = f.value(start);
  }
  kernel.plan = [name = kernel.name, start, fields, complete](const Settings& settings, const Profile& profile) -> Result<Plan> {
    Params p = start;
    for (const auto& [key, value] : settings) {
      const Field<Params>* found = nullptr;
      for (const auto& f : fields)
        if (f.name == key) found = &f;
      if (!found) {
        std::string all;
        for (const auto& f : fields) all += (all.empty() ? "" : ", ") + f.name;
        return Status(Code::invalid_argument, name + " has no option " + printable(key) + "; expected one of " + all);
      }
      if (!found->set(p, value))
        return Status(Code::invalid_argument, name + " option " + key + " is " + printable(value) + "; expected " + found->takes);
    }
    if (complete) complete(p);
    return plan(p, profile);
  };
  return kernel;
}

// In a list of fields: the field of that name of P.
#define F(member) field<P>(#member, [](P& p) -> auto& { return p.member; })
#define A(name, member) field<P>(name, [](P& p) -> auto& { return p.member; })
// The parts of a triple, each a size of its own.
#define XYZ(prefix, member) A(prefix "_x", member[0]), A(prefix "_y", member[1]), A(prefix "_z", member[2]), A(prefix, member)
#define PROBE_GRID A("count", grid.count), A("origin", grid.origin), A("spacing", grid.spacing), A("placed", grid.placed)
#define PROBE_MAPS A("size", maps.size), A("ratio", maps.ratio), A("radiance_format", maps.radiance), \
    A("distance_format", maps.distance), A("normals", maps.normal)

Kernel gaussian_blur() {
  using P = GaussianBlurParams;
  P p;
  p.sigma = 4;
  return make<P>("gaussian_blur", "gaussian_blur", "variant", {"width", "height"}, {1920, 1080}, p,
                 {F(width), F(height), F(src_stride), F(dst_stride), F(sigma), F(radius), F(order), F(passes), F(levels),
                  F(filter), F(border), F(variant), F(format), F(input), F(difference), F(keep_alpha), F(drop_taps)},
                 [](P& q) { if (q.variant == GaussianVariant::sampler) q.input = Input::image; });
}

Kernel bilateral() {
  using P = BilateralParams;
  return make<P>("bilateral", "bilateral", "variant", {"width", "height"}, {1920, 1080}, {},
                 {F(width), F(height), F(src_stride), F(dst_stride), F(variant), F(sigma_space), F(radius), F(step), F(window),
                  F(adaptive), F(low), F(high), F(levels), F(taps), F(range), F(sigma_range), F(range_norm), F(guide_format),
                  F(depth), F(sigma_depth), F(footprint), F(normal), F(sigma_normal), F(normal_format), F(luminance),
                  F(sigma_luminance), F(epsilon), F(variance_target), F(carry_variance), F(flat), F(border), F(format), F(alpha),
                  F(count)},
                 [](P& q) { if (q.variant == BilateralVariant::discontinuity) q.range = RangeTerm::off; });
}

Kernel bilateral_upsample() {
  using P = BilateralUpsampleParams;
  return make<P>("bilateral_upsample", "bilateral", "", {"width", "height"}, {1920, 1080}, {},
                 {F(width), F(height), F(ratio), F(nearest_depth), F(sigma_depth), F(footprint), F(normal), F(sigma_normal),
                  F(least), F(format)});
}

Kernel discontinuity_mask() {
  using P = DiscontinuityMaskParams;
  return make<P>("discontinuity_mask", "discontinuity_mask", "", {"width", "height"}, {1920, 1080}, {},
                 {F(width), F(height), F(depth_threshold), F(normal), F(normal_threshold), F(normal_format)});
}

Kernel variance() {
  using P = VarianceParams;
  return make<P>("variance", "variance", "variant", {"width", "height"}, {1920, 1080}, {},
                 {F(width), F(height), F(src_stride), F(variant), F(radius), F(alpha), F(shortest), F(format)});
}

Kernel outlier_clamp() {
  using P = OutlierClampParams;
  return make<P>("outlier_clamp", "outlier_clamp", "variant", {"width", "height"}, {1920, 1080}, {},
                 {F(width), F(height), F(src_stride), F(dst_stride), F(variant), F(radius), F(k), F(format), F(count)});
}

Kernel mip_build() {
  using P = MipBuildParams;
  return make<P>("mip_build", "mip_build", "variant", {"width", "height", "depth"}, {128, 128, 128}, {},
                 {F(width), F(height), F(depth), F(levels), F(variant), F(format), F(input), F(pairs), F(sizes), F(ratio),
                  F(samples), F(directions), F(count)},
                 [](P& q) {  // the only formats that bounds and moments have
                   const bool one = q.variant == MipVariant::min || q.variant == MipVariant::max;
                   const bool two = q.variant == MipVariant::minmax || q.variant == MipVariant::moments;
                   if (q.format == Format::f32x4 && one) q.format = Format::f32x1;
                   if (q.format == Format::f32x4 && two) q.format = Format::f32x2;
                   if (one || two) q.depth = 1;
                 });
}

Kernel voxelize() {
  using P = VoxelizeParams;
  P p;
  p.triangles = 100000;
  return make<P>("voxelize", "voxelize", "merging", {"width", "height", "depth"}, {128, 128, 128}, p,
                 {F(width), F(height), F(depth), F(first), F(last), F(toroidal), F(window), F(touched_only), F(over), F(mode),
                  F(merging), F(format), F(opacity), F(normal), F(emission), F(emission_max), F(triangles), F(materials),
                  F(blocks), F(pieces), F(bricks), F(fragments), F(texels), F(device_vertices), F(device_materials),
                  F(vertices), F(origin), F(voxel)});
}

Kernel voxel_inject() {
  using P = VoxelInjectParams;
  P p;
  p.lights = 1;
  p.bricks = 4096;
  return make<P>("voxel_inject", "voxelize", "", {"width", "height", "depth"}, {128, 128, 128}, p,
                 {F(width), F(height), F(depth), F(toroidal), F(window), F(format), F(bricks), F(lights), F(map_width),
                  F(map_height), F(irradiance_max), F(emission), F(clear), F(voxel), F(normal_offset), F(two_sided), F(scale),
                  F(count)});
}

Kernel cone_trace() {
  using P = ConeTraceParams;
  P p;
  p.extent = {128, 128, 128};
  return make<P>("cone_trace", "cone_trace", "variant", {"width", "height"}, {1920, 1080}, p,
                 {F(width), F(height), XYZ("extent", extent), F(levels), F(variant), F(format), F(input), F(origin), F(voxel),
                  F(pattern_x), F(pattern_y), F(footprint), F(specular_footprint), F(step_scale), F(normal_offset), F(start),
                  F(max_distance), F(rotate), F(seed), F(gamma), F(environment), F(sky_size), F(sky_levels), F(sky_aperture),
                  F(error), F(radiance_max), F(max_steps), F(radiance), F(occlusion), F(specular), F(skip_empty), F(count)});
}

Kernel hiz_ssr() {
  using P = HizSsrParams;
  return make<P>("hiz_ssr", "hiz_ssr", "variant", {"width", "height"}, {1920, 1080}, {},
                 {F(width), F(height), F(variant), F(depth), F(near_plane), F(far_plane), F(focal_x), F(focal_y), F(centre_x),
                  F(centre_y), F(rays), F(levels), F(start_level), F(max_steps), F(steps), F(refinements), F(thickness),
                  F(max_distance), F(bias), F(cutoff), F(fade_edge), F(fade_distance), F(fade_thickness), F(fade_back),
                  F(count), F(rays_per_pixel), F(half_resolution), F(reuse), F(seed), F(shade), F(colour_levels),
                  F(prefilter), F(environment), F(fallback), F(factor), F(split_sum_size)},
                 [](P& q) {  // a vertical field of 60 degrees where none is given
                   if (q.focal_x == 0 && q.focal_y == 0) set_field(q, 1.0471975511965976);
                   if (q.variant == SsrVariant::linear && q.max_distance == 0) q.max_distance = 10;
                 });
}

Kernel hiz_ssr_split_sum() {
  using P = SplitSumParams;
  return make<P>("hiz_ssr_split_sum", "hiz_ssr", "", {"size"}, {32}, {}, {F(size), F(samples)});
}

Kernel lpv_propagate() {
  using P = LpvPropagateParams;
  return make<P>("lpv_propagate", "light_propagation", "lobes", {"extent_x", "extent_y", "extent_z"}, {32, 32, 32}, {},
                 {XYZ("extent", grid.extent), F(bands), F(channels), F(format), F(iterations), F(lobes), F(border), F(geometry),
                  F(continued), F(geometry_format), F(keep_injected), F(active), F(error), F(travelling)});
}

Kernel lpv_inject() {
  using P = LpvInjectParams;
  P p;
  p.lights = 65536;
  return make<P>("lpv_inject", "light_propagation", "", {"extent_x", "extent_y", "extent_z"}, {32, 32, 32}, p,
                 {XYZ("extent", grid.extent), A("origin", grid.origin), A("cell", grid.cell), F(lights), F(bands), F(channels),
                  F(format), F(flux_max), F(offset), F(per_area), F(count)});
}

Kernel lpv_inject_geometry() {
  using P = LpvInjectGeometryParams;
  P p;
  p.surfels = {65536, 0, 0, 0};
  return make<P>("lpv_inject_geometry", "light_propagation", "", {"extent_x", "extent_y", "extent_z"}, {32, 32, 32}, p,
                 {XYZ("extent", grid.extent), A("origin", grid.origin), A("cell", grid.cell), F(surfels), F(format),
                  F(area_max), F(offset), F(two_sided), F(keep), F(count)});
}

Kernel lpv_sample() {
  using P = LpvSampleParams;
  P p;
  p.grids.resize(1);
  p.grids[0].extent = {32, 32, 32};
  return make<P>("lpv_sample", "light_propagation", "", {"receivers"}, {2073600}, p,
                 {F(receivers), XYZ("extent", grids[0].extent), A("origin", grids[0].origin), A("cell", grids[0].cell), F(bands),
                  F(channels), F(format), F(offset), F(damping), F(blend), F(gain), F(glossy_steps), F(per_area), F(count)});
}

Kernel lpv_filter() {
  using P = LpvFilterParams;
  return make<P>("lpv_filter", "light_propagation", "", {"extent_x", "extent_y", "extent_z"}, {32, 32, 32}, {},
                 {XYZ("extent", grid.extent), F(bands), F(channels), F(format), F(weight)});
}

Kernel octahedral_map() {
  using P = OctahedralMapParams;
  return make<P>("octahedral_map", "octahedral_march", "code", {"count"}, {65536}, {}, {F(count), F(code), F(decode)});
}

Kernel probe_build() {
  using P = ProbeBuildParams;
  return make<P>("probe_build", "octahedral_march", "source", {"probes"}, {8}, {},
                 {F(probes), PROBE_MAPS, F(source), F(width), F(height), F(samples), F(planar), F(unit), F(radiance), F(distance)},
                 [](P& q) {
                   if (q.source != ProbeSource::texels && q.width == 0) q.width = q.source == ProbeSource::cube ? 256 : 1024;
                   if (q.source != ProbeSource::texels && q.height == 0) q.height = q.source == ProbeSource::cube ? q.width : 512;
                 });
}

Kernel probe_minimum() {
  using P = ProbeMinimumParams;
  return make<P>("probe_minimum", "octahedral_march", "", {"probes"}, {8}, {}, {F(probes), PROBE_MAPS});
}

Kernel probe_trace() {
  using P = ProbeTraceParams;
  P p;
  p.grid.count = {4, 4, 4};
  return make<P>("probe_trace", "octahedral_march", "", {"rays"}, {2073600}, p,
                 {F(rays), PROBE_GRID, PROBE_MAPS, F(probe), F(tries), F(order), F(max_steps), F(thickness), F(slope), F(bias),
                  F(count)},
                 [](P& q) { if (q.maps.normal == ProbeNormal::none && q.thickness == 0.5) q.thickness = 2, q.bias = 1; });
}

Kernel probe_fetch() {
  using P = ProbeFetchParams;
  P p;
  p.probes = 64;
  return make<P>("probe_fetch", "octahedral_march", "", {"rays"}, {2073600}, p,
                 {F(rays), F(probes), PROBE_MAPS, F(environment)});
}

Kernel probe_irradiance() {
  using P = ProbeIrradianceParams;
  P p;
  p.grid.count = {4, 4, 4};
  return make<P>("probe_irradiance", "octahedral_march", "", {}, {}, p,
                 {PROBE_GRID, PROBE_MAPS, F(listed), F(samples), F(irradiance_size), F(moments_size), F(power), F(max_distance),
                  F(irradiance_format), F(moments_format), F(previous), F(hysteresis)});
}

Kernel probe_shade() {
  using P = ProbeShadeParams;
  P p;
  p.grid.count = {4, 4, 4};
  return make<P>("probe_shade", "octahedral_march", "", {"width", "height"}, {1920, 1080}, p,
                 {F(width), F(height), PROBE_GRID, F(irradiance_size), F(moments_size), F(irradiance_format), F(visibility),
                  F(sharpen), F(least_visibility), F(hidden), F(footprint), F(facing), F(least_facing), F(normal_bias),
                  F(count)});
}

}  // namespace

const std::vector<Kernel>& kernels() {
  static const std::vector<Kernel> all{
      gaussian_blur(), bilateral(), bilateral_upsample(), variance(), outlier_clamp(), discontinuity_mask(), mip_build(),
      voxelize(), voxel_inject(), cone_trace(), hiz_ssr(), hiz_ssr_split_sum(), octahedral_map(), probe_build(),
      probe_minimum(), probe_trace(), probe_fetch(), probe_irradiance(), probe_shade(), lpv_inject(), lpv_inject_geometry(),
      lpv_propagate(), lpv_sample(), lpv_filter()};
  return all;
}

Settings sized(const Kernel& kernel, const std::vector<int>& size) {
  Settings settings;
  for (std::size_t i = 0; i < kernel.sizes.size(); ++i)
    settings.emplace_back(kernel.sizes[i], std::to_string(i < size.size() ? size[i] : 1));
  return settings;
}

}  // namespace luxel::emit
