#include <luxel/voxelize.h>

#include <algorithm>

#include "host/check.h"
#include "host/planner.h"

namespace luxel {

std::vector<double> srgb_table();  // voxel_textures.cpp

namespace {

// kernels/math/voxel_grid.h
constexpr int triangle_words = 12, block = 64, brick = 8, brick_voxels = 512, counter_words = 16;
constexpr int count_blocks = 0, count_pieces = 1;
constexpr int span = 256;                     // bricks an invocation of voxelize_scan
constexpr std::uint32_t most_invocations = 1u << 18;  // of a launch that strides over a list

std::int64_t cells(const VoxelizeParams& p, int side) {
  const auto along = [&](int n) { return static_cast<std::int64_t>((n + side - 1) / side); };
  return along(p.width) * along(p.height) * along(p.depth);
}

// What the plan really uses for capacities that are given as 0.
struct Capacities {
  int blocks, pieces, bricks;
};
Capacities capacities(const VoxelizeParams& p) {
  const int most = static_cast<int>(std::min<std::int64_t>(4ll * p.triangles, 1 << 28));
  return {p.blocks > 0 ? p.blocks : std::max(p.triangles, 1), p.pieces > 0 ? p.pieces : std::max(most, 1),
          p.bricks > 0 ? p.bricks : static_cast<int>(cells(p, brick))};
}

// Accumulators of a voxel: weight, colour, opacity, normal, emission.
int words(const VoxelizeParams& p) {
  return p.merging == VoxelizeMerging::exact ? 4 + p.opacity + 3 * p.normal + 3 * p.emission : 1;
}

std::array<int, 3> last_of(const VoxelizeParams& p) {
  const std::array<int, 3> extent{p.width, p.height, p.depth};
  std::array<int, 3> last = p.last;
  for (std::size_t k = 0; k < 3; ++k)
    if (last[k] == -1) last[k] = extent[k] - 1;
  return last;
}

// First voxel of the grid that the passes work in, as triangles count them: bricks lie alike whatever the window.
std::array<int, 3> base_of(const VoxelizeParams& p) {
  std::array<int, 3> base{0, 0, 0};
  if (p.toroidal)
    for (std::size_t k = 0; k < 3; ++k) base[k] = p.window[k] - (p.window[k] % brick + brick) % brick;
  return base;
}

// That grid, and the region in it.
VoxelizeParams aligned(VoxelizeParams p) {
  p.last = last_of(p);
  if (!p.toroidal) return p;
  const std::array<int, 3> base = base_of(p);
  for (std::size_t k = 0; k < 3; ++k) {
    p.first[k] += p.window[k] - base[k];
    p.last[k] += p.window[k] - base[k];
  }
  p.width += brick;
  p.height += brick;
  p.depth += brick;
  return p;
}

// Parameters that several parts have: the grid, and the region of it.
Planner::Values grid_values(const VoxelizeParams& p) {
  const std::array<int, 3> last = last_of(p);
  return {{"width", p.width},      {"height", p.height},    {"depth", p.depth},
          {"first_x", p.first[0]}, {"first_y", p.first[1]}, {"first_z", p.first[2]},
          {"last_x", last[0]},     {"last_y", last[1]},     {"last_z", last[2]}};
}
Planner::Values base_values(const VoxelizeParams& p) {
  const std::array<int, 3> base = base_of(p);
  return {{"base_x", base[0]}, {"base_y", base[1]}, {"base_z", base[2]}};
}
std::array<std::uint32_t, 3> launch(std::int64_t items) {
  return {static_cast<std::uint32_t>(std::clamp<std::int64_t>(items, 1, most_invocations)), 1, 1};
}
constexpr std::array<std::uint32_t, 3> line{64, 1, 1};
int stride(std::array<std::uint32_t, 3> invocations) {
  return static_cast<int>((invocations[0] + line[0] - 1) / line[0] * line[0]);
}

}  // namespace

namespace {

Status check_window(const VoxelizeParams& p) {
  constexpr const char* fields[] = {"VoxelizeParams.width", "VoxelizeParams.height", "VoxelizeParams.depth"};
  const int extent[] = {p.width, p.height, p.depth};
  for (std::size_t k = 0; k < 3; ++k) {
    if (extent[k] % brick != 0 || extent[k] > 2040)
      return out_of_range(fields[k], extent[k], "multiples of 8 up to 2040 with toroidal");
    LUXEL_CHECK(check_range("VoxelizeParams.window", p.window[k], -8192, 8192 - extent[k]));
  }
  if (p.device_vertices) return out_of_range("VoxelizeParams.toroidal", "true", "false with device_vertices");
  if (p.fragments > 0) return out_of_range("VoxelizeParams.fragments", p.fragments, "0 with toroidal");
  return {};
}

}  // namespace

Status validate(const VoxelizeParams& p) {
  LUXEL_CHECK(check_range("VoxelizeParams.width", p.width, 1, 2048));
  LUXEL_CHECK(check_range("VoxelizeParams.height", p.height, 1, 2048));
  LUXEL_CHECK(check_range("VoxelizeParams.depth", p.depth, 1, 2048));
  if (p.toroidal) LUXEL_CHECK(check_window(p));
  if (p.over && p.toroidal) return out_of_range("VoxelizeParams.over", "true", "false with toroidal");
  const int extent[] = {p.width, p.height, p.depth};
  for (std::size_t k = 0; k < 3; ++k) {
    LUXEL_CHECK(check_range("VoxelizeParams.first", p.first[k], 0, extent[k] - 1));
    if (p.last[k] != -1) LUXEL_CHECK(check_range("VoxelizeParams.last", p.last[k], p.first[k], extent[k] - 1));
  }
  LUXEL_CHECK(check_range("VoxelizeParams.mode", static_cast<int>(p.mode), 0, 2));
  LUXEL_CHECK(check_range("VoxelizeParams.merging", static_cast<int>(p.merging), 0, 2));
  if (p.format != Format::f32x4 && p.format != Format::f16x4 && p.format != Format::unorm8x4)
    return out_of_range("VoxelizeParams.format", name(p.format), "f32x4, f16x4 or unorm8x4");
  if (p.merging != VoxelizeMerging::exact) {
    if (p.normal) return out_of_range("VoxelizeParams.normal", "true", "false unless merging is exact");
    if (p.emission) return out_of_range("VoxelizeParams.emission", "true", "false unless merging is exact");
  }
  if (p.merging == VoxelizeMerging::moving_average && p.opacity)
    return out_of_range("VoxelizeParams.opacity", "true", "false for moving_average, whose fourth channel counts");
  if (!(p.emission_max >= 1e-30 && p.emission_max <= 1e30))
    return out_of_range("VoxelizeParams.emission_max", p.emission_max, "1e-30..1e+30");
  LUXEL_CHECK(check_range("VoxelizeParams.triangles", p.triangles, 0, 1 << 27));
  LUXEL_CHECK(check_range("VoxelizeParams.materials", p.materials, 1, 1 << 24));
  LUXEL_CHECK(check_range("VoxelizeParams.blocks", p.blocks, 0, 1 << 28));
  LUXEL_CHECK(check_range("VoxelizeParams.pieces", p.pieces, 0, 1 << 28));
  LUXEL_CHECK(check_range("VoxelizeParams.bricks", p.bricks, 0, 1 << 24));
  LUXEL_CHECK(check_range("VoxelizeParams.fragments", p.fragments, 0, 1 << 28));
  LUXEL_CHECK(check_range("VoxelizeParams.texels", p.texels, 0, 1 << 28));
  LUXEL_CHECK(check_range("VoxelizeParams.vertices", p.vertices, 0, 1 << 28));
  for (const double o : p.origin) LUXEL_CHECK(check_range("VoxelizeParams.origin", o, -1e30, 1e30));
  LUXEL_CHECK(check_range("VoxelizeParams.voxel", p.voxel, 1e-30, 1e30));
  if (p.device_materials && !p.device_vertices)
    return out_of_range("VoxelizeParams.device_materials", "true", "false without device_vertices");
  if (static_cast<double>(p.width) * p.height * p.depth > 0x7fffffff)
    return out_of_range("VoxelizeParams.depth", p.depth, "width x height x depth of at most 2147483647");
  const std::int64_t bricks = capacities(aligned(p)).bricks;
  if (bricks * brick_voxels * words(p) > 0x7fffffff)
    return out_of_range("VoxelizeParams.bricks", p.bricks,
                        "at most " + std::to_string(0x7fffffff / (brick_voxels * words(p))) +
                            " (with these attributes); take what voxel_triangles() counts");
  return {};
}

namespace {

class Voxelization {
 public:
  Voxelization(const VoxelizeParams& params, const Profile& profile)
      : p_(aligned(params)),
        stored_{params.width, params.height, params.depth},
        profile_(profile),
        room_(capacities(p_)),
        words_(words(params)),
        planner_("voxelize") {}

  Result<Plan> plan() && {
    const std::size_t bricks = static_cast<std::size_t>(cells(p_, brick));
    const std::size_t sums = static_cast<std::size_t>(room_.bricks) * brick_voxels * static_cast<std::size_t>(words_);
    const bool exact = p_.merging == VoxelizeMerging::exact;
    const std::size_t triangles = static_cast<std::size_t>(p_.triangles);
    if (p_.device_vertices) {
      positions_ = resource("positions", Format::f32x1, static_cast<std::size_t>(p_.vertices) * 3, false);
      indices_ = resource("indices", Format::u32, triangles * 3, false);
      if (p_.device_materials) chosen_ = resource("triangle_materials", Format::u32, triangles, false);
      triangles_ = planner_.scratch(Format::u32, std::max<std::size_t>(triangles, 1) * triangle_words);
    } else {
      triangles_ = resource("triangles", Format::u32, triangles * triangle_words, false);
    }
    materials_ = resource("materials", Format::f32x4, static_cast<std::size_t>(p_.materials) * 2, false);
    if (p_.texels > 0) {
      if (p_.device_vertices) {
        vertex_uvs_ = resource("uvs", Format::f32x1, static_cast<std::size_t>(p_.vertices) * 2, false);
        uvs_ = planner_.scratch(Format::f32x1, std::max<std::size_t>(triangles, 1) * 6);
      } else {
        uvs_ = resource("uvs", Format::f32x1, triangles * 6, false);
      }
      textures_ = resource("texture_table", Format::u32, static_cast<std::size_t>(p_.materials) * 8, false);
      texels_ = resource("texels", Format::u32, static_cast<std::size_t>(p_.texels), false);
      const std::vector<double> table = srgb_table();
      std::vector<double> rounded;
      for (const double v : table) rounded.push_back(static_cast<float>(v));
      srgb_ = planner_.table(rounded, table);
    }
    const std::size_t voxels = static_cast<std::size_t>(stored_[0]) * stored_[1] * stored_[2];
    colour_ = resource("colour", p_.format, voxels, true);
    if (p_.normal) normal_ = resource("normal", p_.format, voxels, true);
    if (p_.emission) emission_ = resource("emission", p_.format, voxels, true);
    if (p_.over) {
      under_[0] = resource("under_colour", p_.format, voxels, false);
      if (p_.normal) under_[1] = resource("under_normal", p_.format, voxels, false);
      if (p_.emission) under_[2] = resource("under_emission", p_.format, voxels, false);
      left_ = resource("left_bricks", Format::u32, static_cast<std::size_t>(room_.bricks), false);
      left_counters_ = resource("left_counters", Format::u32, counter_words, false);
    }
    list_ = resource("bricks", Format::u32, static_cast<std::size_t>(room_.bricks), true);
    if (p_.fragments > 0)
      fragments_ = resource("fragments", Format::u32, static_cast<std::size_t>(p_.fragments) * 4, true);
    counters_ = resource("counters", Format::u32, counter_words, true);
    slots_ = planner_.scratch(Format::u32, bricks);
    spans_ = planner_.scratch(Format::u32, (bricks + span - 1) / span);
    pieces_ = planner_.scratch(Format::u32, static_cast<std::size_t>(room_.pieces) * 2);
    sums_ = planner_.scratch(Format::u32, sums);
    carries_ = planner_.scratch(Format::u32, exact ? sums : 1);
    if (p_.over) {
      restore(under_[0], colour_);
      if (p_.normal) restore(under_[1], normal_);
      if (p_.emission) restore(under_[2], emission_);
    }
    clear();
    if (p_.device_vertices) round();
    refine();
    number();
    merge();
    resolve();
    return std::move(planner_).finish();
  }

 private:
  Slot resource(const char* name, Format format, std::size_t count, bool written) {
    Resource r{name};
    r.format = format;
    r.bytes = std::max<std::size_t>(count, 1) * bytes_per_pixel(format);
    r.written = written;
    return planner_.resource(r);
  }

  void restore(Slot under, Slot dst) {
    const auto rows = launch(std::int64_t{room_.bricks} * brick * brick);
    planner_.pass("voxelize_restore", name(p_.format), "voxelize restore", rows, line,
                  {{"width", p_.width},
                   {"height", p_.height},
                   {"depth", p_.depth},
                   {"capacity", room_.bricks},
                   {"stride", stride(rows)}},
                  {}, {{"left_bricks", left_}, {"left_counters", left_counters_}, {"under", under}, {"dst", dst}});
    planner_.cost(0, 2.0 * room_.bricks * brick_voxels * static_cast<double>(bytes_per_pixel(p_.format)));
  }

  void clear() {
    const int bricks = static_cast<int>(cells(p_, brick));
    const auto invocations = launch(bricks / 64 + 16);
    planner_.pass("voxelize_clear", "u32", "voxelize clear", invocations, line,
                  {{"bricks", bricks}, {"stride", stride(invocations)}}, {},
                  {{"counters", counters_}, {"slots", slots_}});
    planner_.cost(0, 4.0 * bricks);
  }

  void round() {
    const auto invocations = launch(p_.triangles);
    const auto rest = [&](std::size_t k) { return p_.origin[k] - static_cast<float>(p_.origin[k]); };
    std::vector<std::pair<std::string_view, Slot>> slots{
        {"positions", positions_}, {"indices", indices_}, {"records", triangles_}, {"counters", counters_}};
    if (p_.device_materials) slots.emplace_back("material_list", chosen_);
    if (p_.texels > 0) slots.insert(slots.end(), {{"vertex_uvs", vertex_uvs_}, {"record_uvs", uvs_}});
    const char* const module = p_.texels > 0 ? p_.device_materials ? "textured_materials" : "textured"
                                             : p_.device_materials ? "materials" : "plain";
    planner_.pass("voxelize_round", module, "voxelize round vertices", invocations, line,
                  {{"triangles", p_.triangles},
                   {"vertices", p_.vertices},
                   {"origin_x", static_cast<float>(p_.origin[0])},
                   {"origin_y", static_cast<float>(p_.origin[1])},
                   {"origin_z", static_cast<float>(p_.origin[2])},
                   {"rest_x", rest(0)},
                   {"rest_y", rest(1)},
                   {"rest_z", rest(2)},
                   {"scale", 65536 / p_.voxel},
                   {"width", p_.width},
                   {"height", p_.height},
                   {"depth", p_.depth},
                   {"stride", stride(invocations)}},
                  {}, slots);
    planner_.cost(0, (p_.texels > 0 ? 20.0 : 12.0) * p_.vertices + (p_.texels > 0 ? 84.0 : 60.0) * p_.triangles);
  }

  // Triangles to blocks to bricks; straight to bricks where a grid has few.
  void refine() {
    const auto roots = launch(p_.triangles);
    const bool twice = cells(p_, block) > 1;
    const Planner::Values from_triangles = grid_values(p_) + base_values(p_) + Planner::Values{
        {"parents", p_.triangles},
        {"capacity", twice ? room_.blocks : room_.pieces},
        {"counter", twice ? count_blocks : count_pieces},
        {"stride", stride(roots)}};
    std::vector<std::pair<std::string_view, Slot>> slots{{"triangles", triangles_}, {"counters", counters_}};
    planner_.cost(0, 48.0 * p_.triangles + 8.0 * room_.pieces);
    if (!twice) {
      slots.insert(slots.end(), {{"pieces", pieces_}, {"slots", slots_}});
      planner_.pass("voxelize_refine", "root_bricks", "voxelize bricks of triangles", roots, line, from_triangles,
                    {{"SIDE", brick}}, slots);
      return;
    }
    const Slot blocks = planner_.scratch(Format::u32, static_cast<std::size_t>(room_.blocks) * 2);
    std::vector<std::pair<std::string_view, Slot>> first = slots, second = slots;
    first.emplace_back("pieces", blocks);
    planner_.pass("voxelize_refine", "root_blocks", "voxelize blocks of triangles", roots, line, from_triangles,
                  {{"SIDE", block}}, first);
    const auto parents = launch(room_.blocks);
    const Planner::Values from_blocks = grid_values(p_) + base_values(p_) + Planner::Values{{"parents", room_.blocks},
                                                                          {"capacity", room_.pieces},
                                                                          {"counter", count_pieces},
                                                                          {"stride", stride(parents)}};
    second.insert(second.end(), {{"parent_list", blocks}, {"pieces", pieces_}, {"slots", slots_}});
    planner_.pass("voxelize_refine", "bricks", "voxelize bricks of blocks", parents, line, from_blocks,
                  {{"PARENT", block}, {"SIDE", brick}}, second);
    planner_.cost(0, 16.0 * room_.blocks);
  }

  void number() {
    const int bricks = static_cast<int>(cells(p_, brick));
    const std::array<std::uint32_t, 3> spans{static_cast<std::uint32_t>((bricks + span - 1) / span), 1, 1};
    planner_.pass("voxelize_scan", "u32", "voxelize count bricks", spans, line, {{"bricks", bricks}}, {},
                  {{"slots", slots_}, {"sums", spans_}});
    planner_.pass("voxelize_slots", "u32", "voxelize number bricks", spans, line,
                  {{"bricks", bricks}, {"capacity", room_.bricks}}, {},
                  {{"sums", spans_}, {"slots", slots_}, {"brick_list", list_}, {"counters", counters_}});
    planner_.rounds(spans[0] + span);
    planner_.cost(0, 12.0 * bricks);
  }

  void merge() {
    const auto voxels = launch(static_cast<std::int64_t>(room_.bricks) * brick_voxels / 32 * words_);
    const bool exact = p_.merging == VoxelizeMerging::exact;
    planner_.pass("voxelize_zero", exact ? "exact" : "packed", "voxelize zero", voxels, line,
                  {{"capacity", room_.bricks}, {"words", words_}, {"stride", stride(voxels)}}, {},
                  exact ? std::vector<std::pair<std::string_view, Slot>>{{"counters", counters_},
                                                                         {"sums", sums_},
                                                                         {"carries", carries_}}
                        : std::vector<std::pair<std::string_view, Slot>>{{"counters", counters_}, {"sums", sums_}});
    const auto pieces = launch(room_.pieces);
    std::vector<std::pair<std::string_view, Slot>> slots{
        {"triangles", triangles_}, {"materials", materials_}, {"pieces", pieces_},  {"slots", slots_},
        {"counters", counters_},   {"sums", sums_},           {"carries", carries_}};
    if (p_.fragments > 0) slots.emplace_back("fragment_list", fragments_);
    if (p_.texels > 0)
      slots.insert(slots.end(), {{"uvs", uvs_}, {"texture_table", textures_}, {"texels", texels_}, {"srgb", srgb_}});
    const char* const module = p_.texels > 0 ? p_.fragments > 0 ? "textured_list" : "textured"
                                             : p_.fragments > 0 ? "list" : "plain";
    planner_.pass("voxelize", module, "voxelize", pieces, line,
                  grid_values(p_) + base_values(p_) + Planner::Values{{"materials", p_.materials},
                                                    {"capacity", room_.pieces},
                                                    {"fragments", p_.fragments},
                                                    {"emission_unit", emission_unit()},
                                                    {"stride", stride(pieces)}},
                  {{"MODE", static_cast<int>(p_.mode)},
                   {"MERGE", static_cast<int>(p_.merging)},
                   {"OPACITY", exact && p_.opacity},
                   {"NORMAL", p_.normal},
                   {"EMISSION", p_.emission}},
                  slots);
    const double touched = static_cast<double>(room_.bricks) * brick_voxels * words_;
    planner_.cost(0, 8.0 * room_.pieces + 48.0 * p_.triangles + (exact ? 2 : 1) * 3 * 4.0 * touched);
  }

  void resolve() {
    const bool exact = p_.merging == VoxelizeMerging::exact;
    resolve(colour_, exact ? 0 : 3, exact && p_.opacity ? 4 : 0);
    if (p_.normal) resolve(normal_, 1, 4 + p_.opacity);
    if (p_.emission) resolve(emission_, 2, 4 + p_.opacity + 3 * p_.normal);
  }
  void resolve(Slot to, int of, int at) {
    constexpr const char* labels[] = {"voxelize means", "voxelize normals", "voxelize emission", "voxelize unpack"};
    const std::array<int, 3> last = last_of(p_);
    std::array<std::uint32_t, 3> invocations{static_cast<std::uint32_t>(last[0] / brick - p_.first[0] / brick + 1),
                                             static_cast<std::uint32_t>(last[1] - p_.first[1] + 1),
                                             static_cast<std::uint32_t>(last[2] - p_.first[2] + 1)};
    const bool listed = p_.touched_only || p_.over;
    if (listed) invocations = launch(std::int64_t{room_.bricks} * brick * brick);
    std::vector<std::pair<std::string_view, Slot>> slots{{"slots", slots_},       {"sums", sums_}, {"carries", carries_},
                                                         {"counters", counters_}, {"dst", to},     {"brick_list", list_}};
    if (p_.over) slots.emplace_back("under", under_[of % 3]);
    planner_.pass("voxelize_resolve", std::string(p_.over ? "over_" : "") + name(p_.format), labels[of], invocations,
                  listed ? line : profile_.voxels.workgroup,
                  grid_values(p_) + Planner::Values{{"stored_x", stored_[0]},
                                                    {"stored_y", stored_[1]},
                                                    {"stored_z", stored_[2]},
                                                    {"turn_x", turn(0)},
                                                    {"turn_y", turn(1)},
                                                    {"turn_z", turn(2)},
                                                    {"words", words_},
                                                    {"at", at},
                                                    {"emission_unit", emission_unit()},
                                                    {"capacity", room_.bricks},
                                                    {"stride", stride(invocations)},
                                                    {"opacity", p_.opacity}},
                  {{"OF", of}, {"TOUCHED", listed}}, slots);
    if (listed) {
      planner_.cost(0, static_cast<double>(room_.bricks) * brick_voxels * static_cast<double>(bytes_per_pixel(p_.format)));
      return;
    }
    double voxels = 1;
    for (std::size_t k = 0; k < 3; ++k) voxels *= last[k] - p_.first[k] + 1;
    planner_.cost(0, voxels * static_cast<double>(bytes_per_pixel(p_.format)));
  }

  double emission_unit() const { return p_.emission_max / 16384; }

  // Where the grid's first voxel lies in the volumes.
  int turn(std::size_t axis) const {
    const int n = stored_[axis];
    return (base_of(p_)[axis] % n + n) % n;
  }

  const VoxelizeParams p_;
  const std::array<int, 3> stored_;
  const Profile& profile_;
  const Capacities room_;
  const int words_;
  Planner planner_;
  Slot positions_, indices_, chosen_, vertex_uvs_, uvs_, textures_, texels_, srgb_;
  Slot triangles_, materials_, colour_, normal_, emission_, list_, fragments_, counters_;
  std::array<Slot, 3> under_;
  Slot left_, left_counters_;
  Slot slots_, spans_, pieces_, sums_, carries_;
};

}  // namespace

Result<Plan> plan(const VoxelizeParams& p, const Profile& profile) {
  LUXEL_CHECK(validate(p));
  return Voxelization(p, profile).plan();
}

VoxelizeParams voxelize_params(const VoxelGrid& grid, const VoxelTriangles& triangles) {
  VoxelizeParams p;
  p.width = grid.width;
  p.height = grid.height;
  p.depth = grid.depth;
  p.triangles = static_cast<int>(triangles.count);
  p.blocks = static_cast<int>(std::max<std::size_t>(triangles.blocks, 1));
  p.pieces = static_cast<int>(std::max<std::size_t>(triangles.pieces, 1));
  p.bricks = triangles.count > 0 ? static_cast<int>(triangles.bricks) : 1;
  p.origin = grid.origin;
  p.voxel = grid.voxel;
  return p;
}

}  // namespace luxel
