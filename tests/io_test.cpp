// Files: round trips, real files against independent answers, malformed and mutated input.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <random>

#define STBI_ONLY_HDR
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>

#include "bench/io/codecs.h"
#include "bench/io/pixels.h"

namespace luxel::io {
namespace {

namespace fs = std::filesystem;

#if defined(__SANITIZE_ADDRESS__)
constexpr bool sanitized = true;  // freed memory is kept for a while
#elif defined(__has_feature)
constexpr bool sanitized = __has_feature(address_sanitizer);
#else
constexpr bool sanitized = false;
#endif

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float inf = std::numeric_limits<float>::infinity();

std::string data_folder() {
  const char* named = std::getenv("LUXEL_DATA");
  return named ? named : (fs::path(__FILE__).parent_path() / "../../shared/data").string();
}

#define NEED(file)                                                                          \
  if (!fs::exists(file)) GTEST_SKIP() << (file) << " is missing; set LUXEL_DATA to the test data"

std::string scratch_file(const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / "luxel_io_test";
  fs::create_directories(folder);
  return (folder / name).string();
}

Bytes bytes_of_text(std::string_view text) { return Bytes(text.begin(), text.end()); }

template <class T>
void put(Bytes& to, const T& value) {
  std::array<std::uint8_t, sizeof value> bytes;
  std::memcpy(bytes.data(), &value, sizeof value);
  for (const std::uint8_t b : bytes) to.push_back(b);
}

// Equal as numbers, NaN equal to NaN.
void expect_same(const std::vector<float>& a, const std::vector<float>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    ASSERT_TRUE(a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i])))
        << "at " << i << ": " << a[i] << " and " << b[i];
}

// A failure is one line: file, what is wrong, remedy.
void expect_clear(const Status& status, const std::string& file, const std::string& part) {
  ASSERT_FALSE(status.ok()) << part;
  EXPECT_NE(status.message().find(part), std::string::npos) << status.message();
  EXPECT_TRUE(status.message().starts_with(file + ": ")) << status.message();
  EXPECT_NE(status.message().find("; "), std::string::npos) << status.message();
  for (const char c : status.message()) EXPECT_TRUE(c >= 32 && c < 127) << status.message();
}

Image ramp(int width, int height, int channels) {
  Image image{width, height, channels, {}};
  for (int i = 0; i < width * height * channels; ++i) image.pixels.push_back(static_cast<float>(i) * 0.37f - 3.0f);
  return image;
}

// ---- NPY

Bytes npy(const std::string& header, std::size_t data_bytes, int major = 1) {
  Bytes b = bytes_of_text("\x93NUMPY");
  b.push_back(static_cast<std::uint8_t>(major));
  b.push_back(0);
  if (major == 1) put(b, static_cast<std::uint16_t>(header.size()));
  else put(b, static_cast<std::uint32_t>(header.size()));
  b.insert(b.end(), header.begin(), header.end());
  b.resize(b.size() + data_bytes, 7);
  return b;
}

TEST(Npy, KeepsEveryDtypeShapeAndBit) {
  for (const Dtype dtype : {Dtype::f4, Dtype::f8, Dtype::u1, Dtype::u2, Dtype::u4, Dtype::i4})
    for (const std::vector<std::size_t>& shape :
         std::vector<std::vector<std::size_t>>{{}, {5}, {2, 3}, {2, 3, 4}, {1, 2, 3, 4}, {0, 3}}) {
      Array array{shape, dtype, {}};
      for (std::size_t i = 0; i < array.elements() * bytes_of(dtype); ++i)
        array.data.push_back(static_cast<std::uint8_t>(i * 37));
      const std::string file = scratch_file("round.npy");
      ASSERT_TRUE(write_npy(file, array).ok());
      const Result<Array> back = read_npy(file);
      ASSERT_TRUE(back.ok()) << back.status().message();
      EXPECT_EQ(back.value().shape, shape);
      EXPECT_EQ(back.value().dtype, dtype);
      EXPECT_EQ(back.value().data, array.data);
      EXPECT_EQ((fs::file_size(file) - array.data.size()) % 64, 0u) << "data is aligned as NumPy does";
    }
}

TEST(Npy, ReadsVersion2AndOtherSpellings) {
  const auto v2 = decode_npy(npy("{'descr': '<u2', 'fortran_order': False, 'shape': (3,), }\n", 6, 2), "a.npy");
  ASSERT_TRUE(v2.ok()) << v2.status().message();
  EXPECT_EQ(to_float(v2.value()), std::vector<float>(3, 0x0707));
  EXPECT_TRUE(decode_npy(npy("{\"shape\":(2,2),\"fortran_order\":False,\"descr\":\"|u1\"}", 4), "a.npy").ok());
}

TEST(Npy, ConvertsToFloat) {
  const auto one = [](Dtype dtype, auto value) {
    Array a{{1}, dtype, {}};
    put(a.data, value);
    return to_float(a)[0];
  };
  EXPECT_EQ(one(Dtype::f4, 1.5f), 1.5f);
  EXPECT_EQ(one(Dtype::f8, 0.1), 0.1f);
  EXPECT_EQ(one(Dtype::u1, std::uint8_t{51}), 0.2f);
  EXPECT_EQ(one(Dtype::u2, std::uint16_t{65535}), 65535.0f);
  EXPECT_EQ(one(Dtype::u4, std::uint32_t{4294967295u}), 4294967296.0f);
  EXPECT_EQ(one(Dtype::i4, std::int32_t{-7}), -7.0f);
}

TEST(Npy, RefusesMalformedInput) {
  const auto head = [](const char* descr, const char* order, const char* shape) {
    return std::string("{'descr': ") + descr + ", 'fortran_order': " + order + ", 'shape': " + shape + ", }\n";
  };
  const std::string good = head("'<f4'", "False", "(2, 3)");
  Bytes later = npy(good, 24);
  later[6] = 3;
  Bytes long_header = npy(good, 24);
  long_header[9] = 255;
  Bytes huge_header = npy(good, 24, 2);
  huge_header[11] = 255;
  const std::vector<std::pair<Bytes, std::string>> table{
      {{}, "is not an NPY file"},
      {bytes_of_text("hello, this is text"), "is not an NPY file"},
      {bytes_of_text("\x93NUMPY"), "ends within the NPY header"},
      {later, "has NPY version 3.0; expected 1.0 or 2.0"},
      {long_header, "ends within the NPY header"},
      {huge_header, "ends within the NPY header"},
      {npy(good, 23), "holds 23 bytes of data; its shape (2, 3) of f4 needs 24"},
      {npy(good, 0), "holds 0 bytes of data"},
      {npy(good, 25), "holds 25 bytes of data"},
      {npy(head("'<f4'", "True", "(2, 3)"), 24), "Fortran order"},
      {npy(head("'>f4'", "False", "(2, 3)"), 24), "has dtype >f4 (big-endian); expected f4, f8, u1, u2, u4 or i4"},
      {npy(head("'|O'", "False", "(2, 3)"), 24), "has dtype |O"},
      {npy(head("'<f2'", "False", "(2, 3)"), 12), "has dtype <f2"},
      {npy(head("'<c8'", "False", "(2, 3)"), 48), "has dtype <c8"},
      {npy(head("'<i8'", "False", "(2, 3)"), 48), "has dtype <i8"},
      {npy(head("'|f4'", "False", "(2, 3)"), 24), "has dtype |f4"},
      {npy(head("'<U4'", "False", "(2, 3)"), 24), "has dtype <U4"},
      {npy(head("[('a', '<f4'), ('b', '<f4')]", "False", "(3,)"), 24), "structured"},
      {npy(head("[('a', '<f4'", "False", "(3,)"), 24), "malformed NPY header"},
      {npy(head("'<f4'", "False", "(-2, 3)"), 24), "malformed NPY header"},
      {npy(head("'<f4'", "False", "(2, 3"), 24), "malformed NPY header"},
      {npy(head("'<f4'", "False", "2"), 8), "malformed NPY header"},
      {npy(head("'<f4'", "Maybe", "(2, 3)"), 24), "malformed NPY header"},
      {npy(head("'<f4", "False", "(2, 3)"), 24), "malformed NPY header"},
      {npy("{'descr': '<f4', 'shape': (2, 3), }", 24), "malformed NPY header"},
      {npy("{'descr': '<f4', 'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }", 24), "malformed NPY header"},
      {npy(good + "x", 24), "malformed NPY header"},
      {npy("", 24), "malformed NPY header"},
      {npy(std::string(200, '\n'), 24), "malformed NPY header"},
      {npy(head("'<f4'", "False", "(4294967296, 4294967296)"), 24), "impossible shape"},
      {npy(head("'<f4'", "False", "(99999999999999999999999, 1)"), 24), "impossible shape"},
      {npy(head("'<f4'", "False", "(0, 99999999999999999999999)"), 0), "impossible shape"},
      {npy(head("'<f8'", "False", "(2305843009213693952,)"), 0), "impossible shape"},
      {npy(head("'<f4'", "False", "(1000000000000,)"), 24), "needs 4000000000000"},
      {npy(head("'<u1'", "False",
                ("(" +
                 [] {
                   std::string s;
                   for (int i = 0; i < 40; ++i) s += "1, ";
                   return s;
                 }() +
                 ")")
                    .c_str()),
           1),
       "malformed NPY header"},
  };
  for (const auto& [bytes, part] : table) expect_clear(decode_npy(bytes, "x.npy").status(), "x.npy", part);
}

TEST(Npy, WritingRefusesShapesThatDoNotFitTheData) {
  const std::string file = scratch_file("refused.npy");
  fs::remove(file);
  EXPECT_EQ(write_npy(file, Array{{2, 2}, Dtype::f4, Bytes(15)}).code(), Code::invalid_argument);
  EXPECT_EQ(write_npy(file, Array{{std::size_t{1} << 62, 4}, Dtype::f4, {}}).code(), Code::invalid_argument);
  EXPECT_EQ(write_npy(file, Array{std::vector<std::size_t>(33, 1), Dtype::u1, Bytes(1)}).code(),
            Code::invalid_argument);
  EXPECT_FALSE(fs::exists(file));
}

// ---- EXR

struct ExrChannel {
  std::string name;
  int type = 2;  // 0 uint, 1 half, 2 float
  int sampling = 1;
};

// Value of a channel, exact as half, float and uint.
float exr_value(std::size_t channel, int x, int y) {
  return static_cast<float>(channel * 100 + std::size_t(y) * 10 + std::size_t(x));
}

void attribute(Bytes& to, std::string_view name, std::string_view type, const Bytes& data) {
  to.insert(to.end(), name.begin(), name.end());
  to.push_back(0);
  to.insert(to.end(), type.begin(), type.end());
  to.push_back(0);
  put(to, static_cast<std::int32_t>(data.size()));
  to.insert(to.end(), data.begin(), data.end());
}

template <class... T>
Bytes packed(T... values) {
  Bytes b;
  (put(b, values), ...);
  return b;
}

constexpr int window_x = -2, window_y = 4;  // data windows need not start at 0

Bytes exr_header(const std::vector<ExrChannel>& channels, int width, int height, const std::string& part) {
  Bytes list, h;
  for (const ExrChannel& c : channels) {
    list.insert(list.end(), c.name.begin(), c.name.end());
    list.push_back(0);
    for (const std::int32_t v : {c.type, 0, c.sampling, c.sampling}) put(list, v);
  }
  list.push_back(0);
  const Bytes window = packed(window_x, window_y, window_x + width - 1, window_y + height - 1);
  attribute(h, "channels", "chlist", list);
  attribute(h, "compression", "compression", {0});
  attribute(h, "dataWindow", "box2i", window);
  attribute(h, "displayWindow", "box2i", packed(0, 0, 9, 9));
  attribute(h, "lineOrder", "lineOrder", {0});
  attribute(h, "pixelAspectRatio", "float", packed(1.0f));
  attribute(h, "screenWindowCenter", "v2f", packed(0.0f, 0.0f));
  attribute(h, "screenWindowWidth", "float", packed(1.0f));
  if (!part.empty()) {
    attribute(h, "name", "string", bytes_of_text(part));
    attribute(h, "type", "string", bytes_of_text("scanlineimage"));
    attribute(h, "chunkCount", "int", packed(height));
  }
  h.push_back(0);
  return h;
}

// An uncompressed OpenEXR file written by the book (OpenEXR file layout): one part for each list of channels.
Bytes exr(const std::vector<std::vector<ExrChannel>>& parts, int width, int height) {
  const bool many = parts.size() > 1;
  Bytes file = packed(std::int32_t{20000630}, std::int32_t{2 | (many ? 0x1000 : 0)});
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const Bytes h = exr_header(parts[p], width, height, many ? "part" + std::to_string(p) : "");
    file.insert(file.end(), h.begin(), h.end());
  }
  if (many) file.push_back(0);
  std::vector<Bytes> chunks;
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (int y = 0; y < height; ++y) {
      Bytes line;
      for (std::size_t c = 0; c < parts[p].size(); ++c)
        for (int x = 0; x < width; ++x) {
          const float v = exr_value(c, x, y);
          if (parts[p][c].type == 0) put(line, static_cast<std::uint32_t>(v));
          if (parts[p][c].type == 2) put(line, v);
          if (parts[p][c].type == 1) {
            const Bytes half = pack(std::vector<float>{v}, 1, Format::f16x2, false);
            line.insert(line.end(), half.begin(), half.begin() + 2);
          }
        }
      Bytes chunk;
      if (many) put(chunk, static_cast<std::int32_t>(p));
      put(chunk, static_cast<std::int32_t>(window_y + y));
      put(chunk, static_cast<std::int32_t>(line.size()));
      chunk.insert(chunk.end(), line.begin(), line.end());
      chunks.push_back(std::move(chunk));
    }
  std::uint64_t offset = file.size() + 8 * chunks.size();
  for (const Bytes& chunk : chunks) {
    put(file, offset);
    offset += chunk.size();
  }
  for (const Bytes& chunk : chunks) file.insert(file.end(), chunk.begin(), chunk.end());
  return file;
}

TEST(Exr, TakesTheSensibleChannels) {
  struct Case {
    std::vector<std::vector<ExrChannel>> parts;
    std::vector<std::size_t> wanted;  // indices into the list of the part that is read; names there are in file order
  };
  const std::vector<Case> cases{
      {{{{"B"}, {"G"}, {"R"}}}, {2, 1, 0}},
      {{{{"A", 1}, {"B", 1}, {"G", 1}, {"R", 1}}}, {3, 2, 1, 0}},
      {{{{"A", 1}, {"B", 2}, {"G", 0}, {"R", 1}, {"Z", 2}}}, {3, 2, 1, 0}},
      {{{{"Y", 1}}}, {0}},
      {{{{"A"}, {"Y"}}}, {1, 0}},
      {{{{"Z"}}}, {0}},
      {{{{"depth"}}}, {0}},
      {{{{"X"}, {"Y"}, {"Z"}}}, {0, 1, 2}},
      {{{{"U"}, {"V"}}}, {0, 1}},
      {{{{"id", 0}}}, {0}},
      {{{{"B"}, {"G"}, {"R"}, {"a.B"}, {"a.G"}, {"a.R"}}}, {2, 1, 0}},
      {{{{"View.Combined.A"}, {"View.Combined.B"}, {"View.Combined.G"}, {"View.Combined.R"}, {"View.Depth.Z"}}},
       {3, 2, 1, 0}},
      {{{{"a.Z"}, {"b.B"}, {"b.G"}, {"b.R"}}}, {3, 2, 1}},
      {{{{"a.Z"}, {"b.Y"}}}, {0}},
      {{{{"B"}, {"G"}, {"R"}}, {{"Z"}}}, {2, 1, 0}},
      {{{{"Z"}}, {{"B"}, {"G"}, {"R"}}}, {0}},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.parts[0].back().name);
    const auto read = decode_exr(exr(c.parts, 5, 3), "x.exr");
    ASSERT_TRUE(read.ok()) << read.status().message();
    ASSERT_EQ(read.value().width, 5);
    ASSERT_EQ(read.value().height, 3);
    ASSERT_EQ(read.value().channels, static_cast<int>(c.wanted.size()));
    std::vector<float> wanted;
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 5; ++x)
        for (const std::size_t channel : c.wanted) wanted.push_back(exr_value(channel, x, y));
    expect_same(read.value().pixels, wanted);
  }
}

TEST(Exr, KeepsEveryFloat) {
  for (int channels = 1; channels <= 4; ++channels) {
    Image image = ramp(13, 7, channels);
    const std::vector<float> special{nan, inf, -inf, 0.0f, -0.0f, 1e-45f, 3.4e38f, 65505.0f};
    std::copy(special.begin(), special.end(), image.pixels.begin());
    const std::string file = scratch_file("round.exr");
    ASSERT_TRUE(write_image(file, image).ok());
    const auto back = read_image(file);
    ASSERT_TRUE(back.ok()) << back.status().message();
    EXPECT_EQ(back.value().width, 13);
    EXPECT_EQ(back.value().height, 7);
    ASSERT_EQ(back.value().channels, channels);
    expect_same(back.value().pixels, image.pixels);
  }
}

TEST(Exr, RefusesMalformedInput) {
  const Bytes good = exr({{{"B"}, {"G"}, {"R"}}}, 5, 3);
  const auto find = [&](std::string_view name) {
    return static_cast<std::size_t>(std::search(good.begin(), good.end(), name.begin(), name.end()) - good.begin()) +
           name.size();
  };
  const auto with = [&](std::size_t at, std::int32_t value) {
    Bytes b = good;
    std::memcpy(&b[at], &value, 4);
    return b;
  };
  const auto cut = [&](std::size_t length) {
    return Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length));
  };
  const std::size_t window = find("dataWindow") + 1 + 6 + 4;  // past the type and the size
  const std::size_t chunk = good.size() - 3 * (8 + 60);  // the first of three; the table of offsets ends there
  const auto zip_cut = [](std::size_t bytes) {
    Bytes b = encode_exr(ramp(20, 40, 3), "x.exr").value();
    b.resize(b.size() - bytes);
    return b;
  };
  const auto compressed = [&](std::uint8_t how) {
    Bytes b = good;
    b[find("compression") + 1 + 12 + 4] = how;
    return b;
  };
  Bytes tall_piz = compressed(4);
  tall_piz[window + 13] = 0x70;  // 28 thousand rows
  Bytes deep = good;
  deep[5] = 8;
  const std::vector<std::pair<Bytes, std::string>> table{
      {{}, "is not an OpenEXR file"},
      {bytes_of_text("v/1"), "is not an OpenEXR file"},
      {bytes_of_text("\x89PNG\r\n\x1a\n"), "is not an OpenEXR file"},
      {cut(4), "ends within the OpenEXR header"},
      {cut(60), "ends within the OpenEXR header"},
      {cut(good.size() - 1), "is damaged in row 2 of 3"},
      {cut(good.size() - 60), "is damaged in row 2 of 3"},
      {compressed(42), "has OpenEXR compression 42; expected 0..9"},
      {zip_cut(1), "is damaged in row 32 of 40"},
      {zip_cut(200), "is damaged in row 32 of 40"},
      {tall_piz, "is damaged in row"},
      {with(4, 3), "has OpenEXR version 3"},
      {with(find("displayWindow") + 1 + 6, 17), "has an OpenEXR attribute of 17 bytes"},
      {with(find("channels") + 1 + 7, 30), "malformed list of channels"},
      {with(find("channels") + 1 + 7, 0x7fffffff), "ends within the OpenEXR header"},
      {with(find("channels") + 1 + 7, -1), "ends within the OpenEXR header"},
      {with(window + 8, 0x7fffffff), "has a data window of"},
      {with(window, 0x7fffffff), "has a data window of"},
      {with(window + 8, 60000), "is damaged in row 0 of 3"},
      {deep, "holds only deep data"},
      {with(chunk + 4, 59), "is damaged in row 0 of 3"},
      {with(chunk - 24, 1000000), "is damaged in row 0 of 3"},
      {with(chunk - 20, -1), "is damaged in row 0 of 3"},
      {exr({{{"BY", 1}, {"RY", 1}, {"Y", 1}}}, 4, 4), "has the channels BY RY Y; expected R G B"},
      {exr({{{"B"}, {"G"}}}, 4, 4), "has the channels B G"},
      {exr({{{"a", 2}, {"b", 2}, {"c", 2}}}, 4, 4), "has the channels a b c"},
      {exr({{}}, 4, 4), "Missing or empty channel list"},
      {exr({{{"Y", 2, 2}}}, 4, 4), "subsampled channel Y"},
      {exr({{{"Y", 7}}}, 4, 4), "is damaged in row 0 of 4"},
  };
  for (std::size_t i = 0; i < table.size(); ++i) {
    SCOPED_TRACE(i);
    expect_clear(decode_exr(table[i].first, "x.exr").status(), "x.exr", table[i].second);
  }
  Bytes wide = with(window + 8, 65535 + window_x - 1);
  const std::int32_t bottom = 65535 + window_y - 1;
  std::memcpy(&wide[window + 12], &bottom, 4);
  expect_clear(decode_exr(wide, "x.exr").status(), "x.exr", "holds too few bytes for 65535x65535 pixels");
}

// ---- HDR

TEST(Hdr, RoundTripIsWithinOneStepOfTheMantissa) {
  for (const int width : {3, 8, 200}) {
    for (const int channels : {1, 3, 4}) {
      Image image{width, 5, channels, {}};
      for (int i = 0; i < width * 5; ++i)
        for (int c = 0; c < channels; ++c)
          image.pixels.push_back(c == 3 ? 1.0f
                                        : std::exp2(static_cast<float>((i * 7 + c) % 40 - 20)) *
                                              (1.0f + 0.01f * static_cast<float>(i % 50)));
      const std::string file = scratch_file("round.hdr");
      WriteReport report;
      ASSERT_TRUE(write_image(file, image, &report).ok());
      EXPECT_EQ(report.not_finite + report.out_of_range, 0u);
      const auto back = read_image(file);
      ASSERT_TRUE(back.ok()) << back.status().message();
      ASSERT_EQ(back.value().channels, 3);
      for (std::size_t p = 0; p < back.value().pixels.size() / 3; ++p) {
        const std::size_t n = static_cast<std::size_t>(channels);
        float largest = 0;
        for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, image.pixels[p * n + c % n]);
        for (std::size_t c = 0; c < 3; ++c) {
          const float wanted = image.pixels[p * n + (n == 1 ? 0 : c)];
          EXPECT_NEAR(back.value().pixels[p * 3 + c], wanted, largest / 128);  // the stored mantissa is 128..255
        }
      }
      ASSERT_TRUE(write_image(file, back.value()).ok());  // what was stored once is stored without loss
      expect_same(read_image(file).value().pixels, back.value().pixels);
    }
  }
}

TEST(Hdr, CountsWhatItCannotHold) {
  const Image image{2, 2, 3, {nan, 1, 1, inf, -inf, 1, -2, 1, 1, 3.4e38f, 0, 0}};
  const std::string file = scratch_file("clamped.hdr");
  WriteReport report;
  ASSERT_TRUE(write_image(file, image, &report).ok());
  EXPECT_EQ(report.not_finite, 3u);
  EXPECT_EQ(report.out_of_range, 2u);
  const auto back = read_image(file);
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(back.value().pixels[0], 0.0f);
  EXPECT_EQ(back.value().pixels[3], 255.0f / 256.0f * 0x1p127f);
  EXPECT_EQ(back.value().pixels[4], 0.0f);
  EXPECT_EQ(back.value().pixels[6], 0.0f);
  EXPECT_EQ(back.value().pixels[9], 255.0f / 256.0f * 0x1p127f);
  EXPECT_EQ(write_image(file, Image{1, 1, 2, {1, 1}}).code(), Code::invalid_argument);
  EXPECT_EQ(write_image(file, Image{1, 1, 4, {1, 1, 1, 0.5f}}).code(), Code::invalid_argument);
}

TEST(Hdr, ReadsOldRunsAndFlatPixels) {
  const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 300\n";
  Bytes file = bytes_of_text(head);
  const Bytes one{128, 64, 0, 129};  // (1, 0.5, 0)
  const auto add = [&](const Bytes& b) { file.insert(file.end(), b.begin(), b.end()); };
  add(one); add({1, 1, 1, 43}); add({1, 1, 1, 1});      // 1 + 43 + 256 pixels
  for (int x = 0; x < 300; ++x) add(one);
  const auto read = decode_hdr(file, "x.hdr");
  ASSERT_TRUE(read.ok()) << read.status().message();
  for (std::size_t p = 0; p < 600; ++p) {
    ASSERT_EQ(read.value().pixels[3 * p], 1.0f);
    ASSERT_EQ(read.value().pixels[3 * p + 1], 0.5f);
    ASSERT_EQ(read.value().pixels[3 * p + 2], 0.0f);
  }
}

TEST(Hdr, RefusesMalformedInput) {
  const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
  const auto text = [&](const std::string& rest) { return bytes_of_text(head + rest); };
  const std::vector<std::pair<Bytes, std::string>> table{
      {{}, "is not a Radiance HDR file"},
      {bytes_of_text("\x89PNG\n"), "is not a Radiance HDR file"},
      {bytes_of_text("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n"), "ends within the HDR header"},
      {bytes_of_text("#?RADIANCE\n\n-Y 1 +X 1\n1234"), "is not in the format 32-bit_rle_rgbe"},
      {bytes_of_text("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n1234"), "is not in the format 32-bit_rle_rgbe"},
      {text(""), "ends within the HDR header"},
      {text("+Y 1 +X 1\n1234"), "has no resolution line"},
      {text("-Y 1 +X 1 \n1234"), "has no resolution line"},
      {text("-Y 0 +X 1\n1234"), "is 1x0 pixels; expected 1..65535"},
      {text("-Y 1 +X -5\n1234"), "is -5x1 pixels; expected 1..65535"},
      {text("-Y 1 +X 65536\n1234"), "expected 1..65535"},
      {text("-Y 1 +X 99999999999999999999\n1234"), "has no resolution line"},
      {text("-Y 1 +X 2\n1234123"), "truncated or damaged in row 0 of 1"},
      {text("-Y 2 +X 1\n1234"), "truncated or damaged in row 1 of 2"},
      {text("-Y 1 +X 8\n"), "truncated or damaged in row 0"},
      {text(std::string("-Y 1 +X 8\n\2\2\0\x8\x88", 15)), "truncated or damaged"},
      {text(std::string("-Y 1 +X 8\n\2\2\0\x9\x88\1\x88\1\x88\1\x88\1", 22)), "truncated or damaged"},  // another width
      {text(std::string("-Y 1 +X 8\n\2\2\0\x8\0\0\0\0\0\0\0\0\0\0\0\0", 26)), "truncated or damaged"},  // empty pieces
      {text(std::string("-Y 1 +X 8\n\2\2\0\x8\x89\1\x88\1\x88\1\x88\1", 22)),
       "truncated or damaged"},                                   // leaves the line
      {text("-Y 1 +X 4\n\1\1\1\3aaaa"), "truncated or damaged"},  // repeats nothing
      {text("-Y 1 +X 4\naaaa\1\1\1\4"), "truncated or damaged"},
  };
  for (const auto& [bytes, part] : table) expect_clear(decode_hdr(bytes, "x.hdr").status(), "x.hdr", part);
}

// ---- PNG

TEST(Png, RoundsHalfToEvenAndClamps) {
  // 0.3f * 255 and 0.7f * 255 are 76.5 and 178.5 in float, 0.1f and 0.5f give 25.5 and 127.5.
  const std::vector<float> values{0.0f, 1.0f, 0.3f, 0.7f, 0.1f, 0.5f, -1.0f, 2.0f, nan, inf, -inf, -0.0f};
  const std::vector<int> wanted{0, 255, 76, 178, 26, 128, 0, 255, 0, 255, 0, 0};
  const std::string file = scratch_file("rounded.png");
  WriteReport report;
  ASSERT_TRUE(write_image(file, Image{4, 3, 1, values}, &report).ok());
  EXPECT_EQ(report.not_finite, 1u);
  EXPECT_EQ(report.out_of_range, 4u);
  const auto back = read_image(file);
  ASSERT_TRUE(back.ok()) << back.status().message();
  for (std::size_t i = 0; i < wanted.size(); ++i)
    EXPECT_EQ(back.value().pixels[i], static_cast<float>(wanted[i]) / 255.0f) << values[i];
}

TEST(Png, KeepsEveryByteInEveryChannelCount) {
  for (int channels = 1; channels <= 4; ++channels) {
    Image image{16, 16, channels, {}};
    for (int i = 0; i < 256 * channels; ++i) image.pixels.push_back(static_cast<float>(i * 5 % 256) / 255.0f);
    const std::string file = scratch_file("round.png");
    ASSERT_TRUE(write_image(file, image).ok());
    const auto back = read_image(file);
    ASSERT_TRUE(back.ok()) << back.status().message();
    ASSERT_EQ(back.value().channels, channels);
    expect_same(back.value().pixels, image.pixels);
  }
}

std::uint32_t crc32(const std::uint8_t* data, std::size_t count) {
  std::uint32_t crc = ~0u;
  for (std::size_t i = 0; i < count; ++i) {
    crc ^= data[i];
    for (int k = 0; k < 8; ++k) crc = crc >> 1 ^ (0xedb88320u & (0u - (crc & 1)));
  }
  return ~crc;
}

Bytes png_chunk(std::string_view type, const Bytes& data) {
  const auto big = [](Bytes& b, std::uint32_t v) {
    for (int s = 24; s >= 0; s -= 8) b.push_back(static_cast<std::uint8_t>(v >> s));
  };
  Bytes b;
  big(b, static_cast<std::uint32_t>(data.size()));
  b.insert(b.end(), type.begin(), type.end());
  b.insert(b.end(), data.begin(), data.end());
  big(b, crc32(&b[4], b.size() - 4));
  return b;
}

Bytes png(std::initializer_list<Bytes> chunks) {
  Bytes b = bytes_of_text("\x89PNG\r\n\x1a\n");
  for (const Bytes& c : chunks) b.insert(b.end(), c.begin(), c.end());
  return b;
}

Bytes png_header(std::uint8_t width_high, std::uint8_t width, std::uint8_t height_high, std::uint8_t height,
                 std::uint8_t depth, std::uint8_t kind) {
  return png_chunk("IHDR", {0, 0, width_high, width, 0, 0, height_high, height, depth, kind, 0, 0, 0});
}

// Zlib data of one stored block.
Bytes stored(const Bytes& raw) {
  Bytes b{0x78, 0x01, 0x01};
  const auto n = static_cast<std::uint16_t>(raw.size());
  put(b, n);
  put(b, static_cast<std::uint16_t>(~n));
  b.insert(b.end(), raw.begin(), raw.end());
  std::uint32_t s1 = 1, s2 = 0;
  for (const std::uint8_t r : raw) s2 = (s2 + (s1 = (s1 + r) % 65521)) % 65521;
  for (const std::uint32_t s : {s2, s1}) {
    b.push_back(static_cast<std::uint8_t>(s >> 8));
    b.push_back(static_cast<std::uint8_t>(s));
  }
  return b;
}

TEST(Png, ReadsSixteenBitsPalettesAndBits) {
  const Bytes end = png_chunk("IEND", {});
  const auto wide = decode_png(
      png({png_header(0, 2, 0, 1, 16, 0), png_chunk("IDAT", stored({0, 0x12, 0x34, 0xff, 0xff})), end}), "x.png");
  ASSERT_TRUE(wide.ok()) << wide.status().message();
  EXPECT_EQ(wide.value().pixels, (std::vector<float>{static_cast<float>(0x1234) / 65535.0f, 1.0f}));
  const auto palette = decode_png(png({png_header(0, 2, 0, 1, 8, 3), png_chunk("PLTE", {255, 0, 51, 0, 255, 0}),
                                       png_chunk("IDAT", stored({0, 1, 0})), end}), "x.png");
  ASSERT_TRUE(palette.ok()) << palette.status().message();
  EXPECT_EQ(palette.value().pixels, (std::vector<float>{0, 1, 0, 1, 0, 0.2f}));
  const auto bits = decode_png(png({png_header(0, 3, 0, 1, 1, 0), png_chunk("IDAT", stored({0, 0xa0})), end}), "x.png");
  ASSERT_TRUE(bits.ok()) << bits.status().message();
  EXPECT_EQ(bits.value().pixels, (std::vector<float>{1, 0, 1}));
}

TEST(Png, RefusesMalformedInput) {
  const Bytes end = png_chunk("IEND", {});
  const Bytes header = png_header(0, 2, 0, 1, 8, 0);
  const Bytes pixels = png_chunk("IDAT", stored({0, 1, 2}));
  const Bytes good = png({header, pixels, end});
  ASSERT_TRUE(decode_png(good, "x.png").ok());
  Bytes flipped = good;
  flipped[20] ^= 1;
  const auto cut = [&](std::size_t n) { return Bytes(good.begin(), good.end() - static_cast<std::ptrdiff_t>(n)); };
  const std::vector<std::pair<Bytes, std::string>> table{
      {{}, "is not a PNG file"},
      {bytes_of_text("GIF89a, not what it says"), "is not a PNG file"},
      {cut(1), "ends within the PNG data"},
      {cut(12), "ends within the PNG data"},
      {cut(good.size() - 8), "ends within the PNG data"},
      {flipped, "wrong checksum in the PNG chunk at byte 8"},
      {png({pixels, header, end}), "does not begin with a PNG header"},
      {png({png_header(0, 0, 0, 1, 8, 0), pixels, end}), "is 0x1 pixels; expected 1..65535"},
      {png({png_chunk("IHDR", {0, 1, 0, 0, 0, 0, 0, 1, 8, 0, 0, 0, 0}), pixels, end}), "is 65536x1 pixels"},
      {png({png_header(255, 255, 0, 1, 8, 0), pixels, end}), "holds too few bytes for its size"},
      {png({png_header(255, 255, 255, 255, 8, 0), pixels, end}), "exceeds 1 GiB"},
      {png({png_header(0, 9, 0, 1, 8, 0), pixels, end}), "cannot be decoded"},
      {png({png_header(0, 2, 0, 1, 7, 0), pixels, end}), "cannot be decoded"},
      {png({png_header(0, 2, 0, 1, 8, 3), pixels, end}), "cannot be decoded"},
      {png({header, png_chunk("IDAT", {1, 2, 3, 4, 5, 6, 7, 8}), end}), "cannot be decoded"},
      {png({header, end}), "holds too few bytes"},
  };
  for (const auto& [bytes, part] : table) expect_clear(decode_png(bytes, "x.png").status(), "x.png", part);
}

// ---- All of them

TEST(Image, NpyIsHeightWidthAndChannels) {
  const std::string file = scratch_file("image.npy");
  ASSERT_TRUE(write_image(file, ramp(3, 2, 1)).ok());
  EXPECT_EQ(read_npy(file).value().shape, (std::vector<std::size_t>{2, 3}));
  for (int channels = 1; channels <= 4; ++channels) {
    const Image image = ramp(3, 2, channels);
    ASSERT_TRUE(write_npy(file, make_array({2, 3, static_cast<std::size_t>(channels)}, image.pixels)).ok());
    const auto back = read_image(file);
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(back.value().width, 3);
    EXPECT_EQ(back.value().height, 2);
    ASSERT_EQ(back.value().channels, channels);
    expect_same(back.value().pixels, image.pixels);
  }
  for (const auto& [shape, part] :
       std::vector<std::pair<std::vector<std::size_t>, std::string>>{{{6}, "has 1 dimensions"},
                                                                     {{}, "has 0 dimensions"},
                                                                     {{1, 1, 1, 1}, "has 4 dimensions"},
                                                                     {{0, 3}, "is 3x0 pixels"},
                                                                     {{1, 65536}, "is 65536x1 pixels"},
                                                                     {{1, 1, 5}, "has 5 channels"},
                                                                     {{1, 1, 0}, "has 0 channels"}}) {
    Array array{shape, Dtype::u1, {}};
    array.data.resize(array.elements());
    ASSERT_TRUE(write_npy(file, array).ok());
    expect_clear(read_image(file).status(), file, part);
  }
}

TEST(Image, ErrorsNameFileAndRemedy) {
  const Image image = ramp(2, 2, 1);
  for (const char* path : {"a.jpg", "a", "a.", "folder.exr/a", ".png"}) {
    const Status s = write_image(path, image);
    EXPECT_EQ(s.code(), Code::invalid_argument);
    expect_clear(s, path, "expected .exr, .hdr, .png or .npy");
    EXPECT_FALSE(fs::exists(path));
    expect_clear(read_image(path).status(), path, "expected .exr, .hdr, .png or .npy");
  }
  EXPECT_TRUE(check_image_path("PHOTO.EXR").ok());
  expect_clear(read_image("/nowhere/a.exr").status(), "/nowhere/a.exr", "does not exist");
  const std::string folder = scratch_file("folder.exr");
  fs::create_directories(folder);
  expect_clear(read_image(folder).status(), folder, "is not a file");
  expect_clear(write_image(folder, image), folder, "cannot be written");
  const std::string file = scratch_file("file.npy");
  ASSERT_TRUE(write_image(file, image).ok());
  const std::string below = file + "/a.npy";
  EXPECT_EQ(write_image(below, image).code(), Code::io);
  EXPECT_EQ(write_image(file, Image{2, 2, 1, {1, 2, 3}}).code(), Code::invalid_argument);
  EXPECT_EQ(write_image(file, Image{0, 2, 1, {}}).code(), Code::invalid_argument);
  EXPECT_EQ(write_image(file, Image{1, 1, 5, {1, 2, 3, 4, 5}}).code(), Code::invalid_argument);
  ASSERT_TRUE(read_image(file).ok()) << "refused writes leave the old file";
}

TEST(Image, WritesIntoMissingFolders) {
  const std::string folder = scratch_file("new");
  fs::remove_all(folder);
  ASSERT_TRUE(write_image(folder + "/deep/a.exr", ramp(2, 2, 3)).ok());
  EXPECT_TRUE(read_image(folder + "/deep/a.exr").ok());
}

TEST(Pixels, PackAndUnpack) {
  EXPECT_EQ(format_for(Format::f32x1, 1), Format::f32x1);
  EXPECT_EQ(format_for(Format::f32x1, 2), Format::f32x2);
  EXPECT_EQ(format_for(Format::f32x1, 3), Format::f32x4);
  EXPECT_EQ(format_for(Format::f16x4, 1), Format::f16x4);
  const std::vector<float> rgb{0.25f, 0.5f, 1.0f, 65504.0f, -3.0f, 0.0f};
  const Bytes padded = pack(rgb, 3, Format::f32x4, false, 9.0f);
  EXPECT_EQ(unpack(padded, Format::f32x4, false, 4),
            (std::vector<float>{0.25f, 0.5f, 1.0f, 9.0f, 65504.0f, -3.0f, 0.0f, 9.0f}));
  for (const Format format : {Format::f32x4, Format::f16x4})
    for (const bool real64 : {false, true}) {
      const Bytes data = pack(rgb, 3, format, real64);
      EXPECT_EQ(data.size(), 2 * (real64 ? 32 : bytes_per_pixel(format)));
      EXPECT_EQ(unpack(data, format, real64, 3), rgb);
    }
  const std::vector<float> hard{65519.0f, 1e30f, -inf, 0x1p-25f, 0x1.000002p-25f, 1.0f + 0x1p-11f, 1.0f + 3 * 0x1p-11f,
                                nan};
  const std::vector<float> half = unpack(pack(hard, 4, Format::f16x4, false), Format::f16x4, false, 4);
  EXPECT_EQ(std::vector<float>(half.begin(), half.end() - 1),
            (std::vector<float>{65504.0f, 65504.0f, -65504.0f, 0.0f, 0x1p-24f, 1.0f, 1.0f + 0x1p-9f}));
  EXPECT_TRUE(std::isnan(half.back()));
  EXPECT_EQ(pack(std::vector<float>{0.3f, -1.0f, 2.0f, nan}, 4, Format::unorm8x4, false), (Bytes{76, 0, 255, 0}));
  EXPECT_EQ(unpack(pack(std::vector<float>{3.0f}, 1, Format::u32, false), Format::u32, false, 1),
            std::vector<float>{3.0f});
}

struct Codec {
  const char* name;
  Bytes good;
  std::function<Status(const Bytes&)> decode;  // checks what was read
};

Status checked(const Result<Image>& read) {
  if (!read) return read.status();
  const Image& image = read.value();
  EXPECT_TRUE(image.width >= 1 && image.width <= largest_side) << image.width;
  EXPECT_TRUE(image.height >= 1 && image.height <= largest_side) << image.height;
  EXPECT_TRUE(image.channels >= 1 && image.channels <= 4);
  EXPECT_EQ(image.pixels.size(), std::size_t(image.width) * std::size_t(image.height) * std::size_t(image.channels));
  return {};
}

// Makes every chunk's checksum right again, so that what lies behind the check is reached too.
void repair_checksums(Bytes& b) {
  for (std::size_t at = 8; at + 12 <= b.size();) {
    const std::size_t n =
        std::size_t{b[at]} << 24 | std::size_t{b[at + 1]} << 16 | std::size_t{b[at + 2]} << 8 | b[at + 3];
    if (n > b.size() - at - 12) return;
    const std::uint32_t crc = crc32(&b[at + 4], n + 4);
    for (std::size_t i = 0; i < 4; ++i) b[at + 8 + n + i] = static_cast<std::uint8_t>(crc >> (24 - 8 * i));
    at += 12 + n;
  }
}

std::vector<Codec> codecs() {
  const auto exr_of = [](const Bytes& b) { return checked(decode_exr(b, "x.exr")); };
  const auto hdr_of = [](const Bytes& b) { return checked(decode_hdr(b, "x.hdr")); };
  const auto png_of = [](const Bytes& b) { return checked(decode_png(b, "x.png")); };
  WriteReport report;
  Image image = ramp(20, 9, 3);
  for (float& v : image.pixels) v = std::abs(v) * 0.01f;
  std::vector<Codec> all{
      {"exr plain", exr({{{"B"}, {"G", 1}, {"R", 0}}}, 7, 5), exr_of},
      {"exr parts", exr({{{"B"}, {"G", 1}, {"R", 0}}, {{"Z"}}}, 7, 5), exr_of},
      {"exr zip", encode_exr(image, "x.exr").value(), exr_of},
      {"hdr", encode_hdr(image, "x.hdr", report).value(), hdr_of},
      {"png", encode_png(image, "x.png", report).value(), png_of},
      {"png repaired", encode_png(image, "x.png", report).value(),
       [png_of](const Bytes& b) { Bytes c = b; repair_checksums(c); return png_of(c); }},
      {"npy", encode_npy(make_array({9, 20, 3}, image.pixels)),
       [](const Bytes& b) {
         const auto read = decode_npy(b, "x.npy");
         if (!read) return read.status();
         EXPECT_EQ(read.value().data.size(), read.value().elements() * bytes_of(read.value().dtype));
         const auto as_image = image_from_array(read.value(), "x.npy");
         return as_image ? checked(as_image) : as_image.status();
       }},
  };
  for (const char* piz : {"flow", "noisy"}) {  // other compressions, where there is data
    const auto file = read_bytes(data_folder() + "/gbuffer_mitsuba_denoiser/" + piz + ".exr");
    if (file) all.push_back({piz, file.value(), exr_of});
  }
  return all;
}

long peak_kib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

// Changed bytes, cuts, repeats and insertions: an error or a consistent image, in bounded memory.
void mutate(int rounds) {
  std::mt19937 random(20240521);
  const auto below = [&](std::size_t n) { return random() % n; };
  const long before = peak_kib();
  for (const Codec& codec : codecs()) {
    ASSERT_TRUE(codec.decode(codec.good).ok()) << codec.name << ": " << codec.decode(codec.good).message();
    SCOPED_TRACE(codec.name);
    int refused = 0;
    for (int round = 0; round < rounds; ++round) {
      Bytes b = codec.good;
      const std::size_t reach = round % 2 ? b.size() : std::min<std::size_t>(b.size(), 400);  // headers twice as often
      switch (round % 5) {
        case 0: case 1: case 2:
          for (std::size_t n = 1 + below(6); n > 0; --n) b[below(reach)] = static_cast<std::uint8_t>(random());
          break;
        case 3: b.resize(below(b.size())); break;
        default: {
          const std::size_t at = below(reach);
          b.insert(b.begin() + static_cast<std::ptrdiff_t>(at), 1 + below(9), static_cast<std::uint8_t>(random()));
        }
      }
      const Status s = codec.decode(b);
      if (s) continue;
      ++refused;
      ASSERT_TRUE(s.code() == Code::io || s.code() == Code::out_of_memory) << s.message();
      ASSERT_EQ(s.message().find_first_of("\n\r\t"), std::string::npos) << s.message();
    }
    EXPECT_GT(refused, rounds / 8) << codec.name;
  }
  if (!sanitized) {
    EXPECT_LT(peak_kib() - before, 200 * 1024) << "KiB more than before";
  }
}

TEST(Image, SurvivesMutations) { mutate(1500); }

TEST(ImageFull, SurvivesManyMutations) { mutate(60000); }

// ---- Real files

// Where the crop lies in the image: the one place whose first row matches.
bool find_crop(const Image& image, const std::function<float(int, int, int)>& crop, int size, int& x0, int& y0) {
  const auto at = [&](int x, int y, int c) {
    return image.pixels[(std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * std::size_t(image.channels) +
                        std::size_t(c)];
  };
  for (y0 = 0; y0 + size <= image.height; ++y0)
    for (x0 = 0; x0 + size <= image.width; ++x0) {
      bool same = true;
      for (int y = 0; y < size && same; ++y)
        for (int x = 0; x < size && same; ++x)
          for (int c = 0; c < std::min(3, image.channels) && same; ++c) same = at(x0 + x, y0 + y, c) == crop(x, y, c);
      if (same) return true;
    }
  return false;
}

TEST(RealFiles, ExrHoldsTheCropThatOpenCvRead) {
  const std::string exr_file = data_folder() + "/photos/CandleGlass.exr",
                    npy_file = data_folder() + "/opencv_ref/in_candle.npy";
  NEED(exr_file);
  NEED(npy_file);
  const auto photo = read_image(exr_file);
  const auto crop = read_image(npy_file);
  ASSERT_TRUE(photo.ok()) << photo.status().message();
  ASSERT_TRUE(crop.ok()) << crop.status().message();
  EXPECT_EQ(photo.value().width, 1000);
  EXPECT_EQ(photo.value().height, 810);
  EXPECT_EQ(photo.value().channels, 4);
  ASSERT_EQ(crop.value().channels, 3);
  int x0 = 0, y0 = 0;
  const auto bgr = [&](int x, int y, int c) { return crop.value().pixels[std::size_t((y * 256 + x) * 3 + 2 - c)]; };
  EXPECT_TRUE(find_crop(photo.value(), bgr, 256, x0, y0));
}

TEST(RealFiles, PngHoldsTheCropThatOpenCvRead) {
  const std::string png_file = data_folder() + "/photos/camera.png",
                    npy_file = data_folder() + "/opencv_ref/in_camera.npy";
  NEED(png_file);
  NEED(npy_file);
  const auto photo = read_image(png_file);
  const auto crop = read_npy(npy_file);
  ASSERT_TRUE(photo.ok()) << photo.status().message();
  ASSERT_TRUE(crop.ok()) << crop.status().message();
  EXPECT_EQ(photo.value().width, 512);
  EXPECT_EQ(photo.value().channels, 1);
  ASSERT_EQ(crop.value().dtype, Dtype::u1);
  int x0 = 0, y0 = 0;
  const auto grey = [&](int x, int y, int) {
    return static_cast<float>(crop.value().data[std::size_t(y * 256 + x)]) / 255.0f;
  };
  EXPECT_TRUE(find_crop(photo.value(), grey, 256, x0, y0));
}

TEST(RealFiles, HdrEqualsStb) {
  for (const char* name : {"spruit_sunrise_1k", "vestibule_1k"}) {
    const std::string file = data_folder() + "/hdri/" + name + ".hdr";
    NEED(file);
    const auto sky = read_image(file);
    ASSERT_TRUE(sky.ok()) << sky.status().message();
    int width = 0, height = 0, channels = 0;
    float* stb = stbi_loadf(file.c_str(), &width, &height, &channels, 3);
    ASSERT_NE(stb, nullptr);
    EXPECT_EQ(sky.value().width, width);
    EXPECT_EQ(sky.value().height, height);
    expect_same(sky.value().pixels, std::vector<float>(stb, stb + std::size_t(width) * std::size_t(height) * 3));
    stbi_image_free(stb);
    EXPECT_GT(*std::max_element(sky.value().pixels.begin(), sky.value().pixels.end()), 1.0f);
  }
}

TEST(RealFiles, EveryImageIsReadAndKeptByExrAndNpy) {
  const std::string folder = data_folder();
  NEED(folder);
  int read = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string kind = entry.path().extension().string();
    if (kind != ".exr" && kind != ".hdr" && kind != ".png") continue;
    const auto image = read_image(entry.path().string());
    ASSERT_TRUE(image.ok()) << image.status().message();
    ++read;
    for (const char* name : {"kept.exr", "kept.npy"}) {
      ASSERT_TRUE(write_image(scratch_file(name), image.value()).ok());
      const auto back = read_image(scratch_file(name));
      ASSERT_TRUE(back.ok()) << back.status().message();
      ASSERT_EQ(back.value().channels, image.value().channels);
      expect_same(back.value().pixels, image.value().pixels);
    }
  }
  EXPECT_GE(read, 30);
}

}  // namespace
}  // namespace luxel::io
