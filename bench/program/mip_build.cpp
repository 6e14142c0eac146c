#include <algorithm>
#include <cstring>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <luxel/mip_build.h>

#include "bench/io/image.h"
#include "bench/io/pixels.h"
#include "commands.h"
#include "common.h"

namespace luxel::program {
namespace {

struct Arguments {
  std::string in, out, device, variant, format, sizes, ratio, samples, input;
  std::vector<std::string> directions;
  int levels = 0;
};

// The finest level: values in [z][y][x][c].
struct Grid {
  std::array<int, 3> extent{1, 1, 1};  // x, y, z
  int channels = 1;
  bool volume = false;
  std::vector<float> values;
};

Result<Grid> read_grid(const std::string& path) {
  const std::string kind = std::filesystem::path(path).extension().string();
  if (kind != ".npy" && kind != ".NPY") {
    Result<io::Image> image = io::read_image(path);
    if (!image) return image.status();
    io::Image& i = image.value();
    return Grid{{i.width, i.height, 1}, i.channels, false, std::move(i.pixels)};
  }
  const Result<io::Array> array = io::read_npy(path);
  if (!array) return array.status();
  const std::vector<std::size_t>& shape = array.value().shape;
  const auto refuse = [&](const std::string& what) {
    return Status(Code::io, fmt::format("{}: {}; reshape it to [y][x], [y][x][c] or [z][y][x][c]", path, what));
  };
  if (shape.size() < 2 || shape.size() > 4)
    return refuse(fmt::format("has {} dimensions, expected 2 to 4", shape.size()));
  const std::size_t channels = shape.size() == 2 ? 1 : shape.back();
  if (channels < 1 || channels > 4)
    return refuse(fmt::format("has {} channels (its last dimension), expected 1..4", channels));
  Grid grid;
  grid.volume = shape.size() == 4;
  grid.channels = static_cast<int>(channels);
  for (std::size_t axis = 0; axis < (grid.volume ? 3u : 2u); ++axis) {
    const std::size_t n = shape[(grid.volume ? 2 : 1) - axis];
    if (n < 1 || n > io::largest_side)
      return refuse(fmt::format("has an extent of {}, expected 1..{}", n, io::largest_side));
    grid.extent[axis] = static_cast<int>(n);
  }
  grid.values = io::to_float(array.value());
  return grid;
}

MipVariant variant_of(const std::string& name) {
  const std::vector<Variant>& all = kernel("mip_build").variants;
  const auto found = std::find_if(all.begin(), all.end(), [&](const Variant& v) { return v.name == name; });
  constexpr MipVariant variants[] = {MipVariant::isotropic, MipVariant::anisotropic, MipVariant::gaussian3,
                                     MipVariant::min,       MipVariant::max,         MipVariant::minmax,
                                     MipVariant::moments};
  return variants[found - all.begin()];
}

bool one_channel(MipVariant v) { return v == MipVariant::min || v == MipVariant::max; }
bool two_channels(MipVariant v) { return v == MipVariant::minmax || v == MipVariant::moments; }

MipBuildParams parameters(const Arguments& a, const Grid& grid) {
  MipBuildParams p;
  p.width = grid.extent[0];
  p.height = grid.extent[1];
  p.depth = grid.extent[2];
  p.levels = a.levels;
  p.variant = variant_of(a.variant);
  p.format = storage_format(a.format, two_channels(p.variant) ? 2 : grid.channels);
  if (two_channels(p.variant) && a.format == "f16") p.format = Format::f16x2;
  p.input = a.input == "image" ? Input::image : Input::buffer;
  p.pairs = two_channels(p.variant) && grid.channels == 2;
  p.sizes = a.sizes == "ceil" ? MipSizes::ceil : MipSizes::floor;
  p.ratio = a.ratio == "16" ? 16 : 2;
  p.samples = a.samples == "vertices" ? MipSamples::vertices : MipSamples::cells;
  if (!a.directions.empty()) {
    p.directions = 0;
    for (int d = 0; d < 6; ++d)
      for (const std::string& name : a.directions)
        if (mip_level_name(0, d).ends_with(name)) p.directions |= 1u << d;
  }
  p.count = p.format != Format::unorm8x4;
  return p;
}

Status check_channels(const Arguments& a, const MipBuildParams& p, const Grid& grid) {
  const char* expected = p.variant == MipVariant::anisotropic && grid.channels != 4
                             ? "4 (premultiplied colour and opacity)"
                         : one_channel(p.variant) && grid.channels != 1 ? "1"
                         : two_channels(p.variant) && grid.channels > 2 ? "1, or 2 for pairs"
                                                                        : nullptr;
  if (expected == nullptr) return {};
  return Status(Code::invalid_argument,
                fmt::format("{} has {} channels; expected {} for variant {}: save the channels you need as .npy", a.in,
                            grid.channels, expected, a.variant));
}

Status write_level(const std::string& folder, const std::string& name, const Grid& like,
                   const std::array<int, 3>& extent, int channels, const std::vector<float>& values) {
  std::vector<std::size_t> shape;
  for (int axis = like.volume ? 2 : 1; axis >= 0; --axis)
    shape.push_back(static_cast<std::size_t>(extent[static_cast<std::size_t>(axis)]));
  if (like.volume || channels > 1) shape.push_back(static_cast<std::size_t>(channels));
  return io::write_npy((std::filesystem::path(folder) / (name + ".npy")).string(),
                       io::make_array(std::move(shape), values));
}

// What the plan counted in the finest level.
std::string counts_text(const std::vector<std::uint8_t>& bytes) {
  std::array<std::uint32_t, 3> counts{};
  std::memcpy(counts.data(), bytes.data(), sizeof counts);
  std::string text;
  if (counts[0] > 0) text += fmt::format("; {} texels without opacity lost a colour that was not finite", counts[0]);
  if (counts[1] > 0) text += fmt::format("; {} texels with NaN", counts[1]);
  if (counts[2] > 0) text += fmt::format("; {} texels with infinities", counts[2]);
  return text;
}

int run(const Arguments& a) {
  Result<Grid> read = read_grid(a.in);
  if (!read) return complain(read.status(), true);
  const Grid& grid = read.value();
  const MipBuildParams p = parameters(a, grid);
  if (Status s = check_channels(a, p, grid); !s) return complain(s);
  if (Status s = validate(p); !s) return complain(s);

  const auto opened = open_device(a.device);
  if (!opened) return complain(opened.status());
  Context& context = *opened.value();
  const Result<Plan> plan = luxel::plan(p, context.profile());
  if (!plan) return complain(plan.status());

  // A fourth channel that is not in the file is opacity 1, so that no colour counts as hidden.
  const Format finest = plan.value().resources.front().format;
  ResourceData data{{mip_level_name(0), io::pack(grid.values, grid.channels, finest, context.real64(), 1.0f)}};
  const std::vector<float> stored = io::unpack(data[mip_level_name(0)], finest, context.real64(), grid.channels);
  if (p.count) data["counters"].assign(16, 0);
  Times times;
  if (Status s = run_plan(context, plan.value(), data, times); !s) return complain(s.message(), failed);

  if (Status s = write_level(a.out, mip_level_name(0), grid, grid.extent, grid.channels, stored); !s)
    return complain(s);
  const int channels = two_channels(p.variant) ? 2 : grid.channels;
  const int levels = mip_levels(p);
  for (int level = 1; level <= levels; ++level)
    for (int direction = 0; direction < 6; ++direction) {
      const bool directional = p.variant == MipVariant::anisotropic;
      if (directional ? (p.directions >> direction & 1) == 0 : direction > 0) continue;
      const std::string name = mip_level_name(level, directional ? direction : -1);
      const std::vector<float> values = io::unpack(data[name], p.format, context.real64(), channels);
      if (Status s = write_level(a.out, name, grid, mip_extent(p, level), channels, values); !s) return complain(s);
    }

  // Counting is not part of the work that is timed.
  const std::vector<Pass>& passes = plan.value().passes;
  if (times.passes.size() == passes.size())
    for (std::size_t i = 0; i < passes.size(); ++i)
      if (passes[i].label == "mip_build count") times.passes[i] = 0;
  fmt::print("mip_build {} {} {}x{}x{}, {} levels on {}: {}; wrote {}{}\n", a.variant, name(p.format), p.width,
             p.height, p.depth, levels, context.info().id, time_text(times), a.out,
             p.count ? counts_text(data["counters"]) : "");
  return done;
}

}  // namespace

void add_mip_build(CLI::App& app, int& exit_status) {
  const Kernel& k = kernel("mip_build");
  CLI::App* command = app.add_subcommand("mip_build", "make the coarser levels of an image or a volume");
  auto a = std::make_shared<Arguments>();
  command
      ->add_option("--in", a->in,
                   "finest level: .npy of shape [y][x], [y][x][c] or [z][y][x][c] with 1..4 channels, or an .exr, "
                   ".hdr or .png image")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("-o,--out", a->out,
                   "folder for level_0.npy (the finest, as stored), level_1.npy, ...; anisotropic: "
                   "level_1_px.npy, level_1_nx.npy, ... for each direction; float32")
      ->required()
      ->type_name("DIR");
  add_variant(*command, k, a->variant);
  for (const auto& [name, value] : {std::pair{"--format", &a->format}, {"--sizes", &a->sizes}, {"--ratio", &a->ratio},
                                    {"--samples", &a->samples}, {"--input", &a->input}})
    add_choice(*command, k, name, *value);
  add_choices(*command, k, "--directions", a->directions);
  add_number(*command, k, "--levels", a->levels);
  add_device_option(*command, a->device);
  command->footer(
      "Colour is premultiplied by opacity, the fourth channel. Levels that are in the folder already are replaced;\n"
      "files of an earlier run with more levels stay.");
  command->callback([a, &exit_status] { exit_status = run(*a); });
}

}  // namespace luxel::program
