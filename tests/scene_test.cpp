// Scenes: what is generated, what files give, and what broken files are told.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "bench/io/codecs.h"
#include "bench/scene/images.h"
#include "bench/scene/scene.h"

namespace luxel::scene {
namespace {

namespace fs = std::filesystem;

std::string data(const std::string& file) {
  const char* folder = std::getenv("LUXEL_DATA");
  return std::string(folder != nullptr ? folder : "../shared/data") + "/" + file;
}

#define NEED_DATA() \
  if (!fs::exists(data("README.md"))) GTEST_SKIP() << "no files in " << data("")

// A folder that goes with the test.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("luxel_scene_" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name, std::ios::binary) << text;
    return (path / name).string();
  }
};

std::string text_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream s;
  s << in.rdbuf();
  return s.str();
}

Scene must(const std::string& name) {
  auto scene = scene_from(name);
  EXPECT_TRUE(scene) << scene.status().message();
  return scene ? std::move(scene).value() : Scene{};
}

void expect_sound(const Scene& s) {
  ASSERT_FALSE(s.indices.empty());
  ASSERT_FALSE(s.materials.empty());
  ASSERT_EQ(s.triangle_materials.size(), s.indices.size());
  ASSERT_TRUE(s.uvs.empty() || s.uvs.size() == s.positions.size());
  for (const glm::uvec3 t : s.indices) ASSERT_LT(std::max({t.x, t.y, t.z}), s.positions.size());
  for (const std::uint32_t m : s.triangle_materials) ASSERT_LT(m, s.materials.size());
  for (const Material& m : s.materials) {
    EXPECT_LT(m.texture, static_cast<int>(s.textures.size()));
    for (int c = 0; c < 3; ++c) {
      EXPECT_GE(m.base_color[c], 0);
      EXPECT_LE(m.base_color[c], 1);
      EXPECT_GE(m.emission[c], 0);
    }
  }
  EXPECT_NE(s.camera.eye, s.camera.target);
  EXPECT_TRUE(s.emissive() || s.sun.irradiance != glm::dvec3(0) || !s.sky.dark());
}

// "one line, naming the file": what every refusal must be.
void expect_refused(const std::string& path) {
  const auto scene = scene_from(path);
  ASSERT_FALSE(scene) << path;
  EXPECT_EQ(scene.status().message().find('\n'), std::string::npos) << scene.status().message();
  EXPECT_NE(scene.status().message().find(fs::path(path).filename().string()), std::string::npos)
      << scene.status().message();
}

void expect_read_or_refused(const std::string& path) {
  const auto scene = scene_from(path);
  if (scene)
    expect_sound(scene.value());
  else
    EXPECT_EQ(scene.status().message().find('\n'), std::string::npos) << scene.status().message();
}

TEST(BuiltIn, EveryNameGivesASoundScene) {
  for (const auto name : built_in_names()) {
    SCOPED_TRACE(name);
    const Scene s = must(std::string(name));
    expect_sound(s);
    for (std::size_t i = 0; i < s.indices.size(); ++i) {
      ASSERT_TRUE(finite(s, i));
      const glm::uvec3 t = s.indices[i];
      EXPECT_GT(glm::length(glm::cross(s.positions[t.y] - s.positions[t.x], s.positions[t.z] - s.positions[t.x])), 0)
          << i;
    }
  }
}

TEST(BuiltIn, TheAtriumHasTheTrianglesThatWereAskedFor) {
  for (const int n : {5000, 5001, 7000, 12345, 50000, 131072, 500000}) {
    const Scene s = must("atrium:" + std::to_string(n));
    EXPECT_LE(s.indices.size(), static_cast<std::size_t>(n));
    EXPECT_GE(static_cast<double>(s.indices.size()), 0.9 * n);
  }
}

TEST(BuiltIn, TheFurnaceIsClosed) {
  const Scene s = must("furnace");
  const auto key = [](glm::dvec3 p) { return std::array<double, 3>{p.x, p.y, p.z}; };
  std::map<std::pair<std::array<double, 3>, std::array<double, 3>>, int> edges;
  for (const glm::uvec3 t : s.indices)
    for (int i = 0; i < 3; ++i) {
      const auto a = key(s.positions[t[i]]), b = key(s.positions[t[(i + 1) % 3]]);
      edges[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  for (const auto& [edge, balance] : edges) EXPECT_EQ(balance, 0);
}

TEST(BuiltIn, UnknownNamesAreRefused) {
  EXPECT_EQ(scene_from("cornel").status().code(), Code::invalid_argument);
  EXPECT_NE(scene_from("cornel").status().message().find("cornell, two_rooms, furnace, atrium, pillars, curtain"), std::string::npos);
  for (const char* name :
       {"atrium:4999", "atrium:500001", "atrium:", "atrium:9e3", "atrium:-7", "cornell:3", "atrium:99999999999999"})
    EXPECT_EQ(scene_from(name).status().code(), Code::invalid_argument) << name;
}

TEST(Texture, SamplesBilinearlyInLinearLightAndWraps) {
  Texture t{"t", 2, 1, true, {0, 0, 0, 255, 255, 255, 188, 0}};
  const glm::dvec4 left = t.sample({0.25, 0.5}), right = t.sample({0.75, 0.5}), middle = t.sample({0.5, 0.5});
  EXPECT_DOUBLE_EQ(left.r, 0);
  EXPECT_DOUBLE_EQ(right.r, 1);
  EXPECT_NEAR(right.b, 0.5029, 1e-4);  // sRGB code 188
  EXPECT_DOUBLE_EQ(middle.r, 0.5);     // of linear values; sRGB codes would give 0.21
  EXPECT_DOUBLE_EQ(middle.a, 0.5);     // alpha is linear
  EXPECT_NEAR(t.sample({-1.25, 7.5}).r, right.r, 1e-12);
  EXPECT_NEAR(t.sample({1e6 + 0.25, 0}).r, left.r, 1e-9);
  EXPECT_DOUBLE_EQ(t.sample({NAN, 0}).r, 0);
}

TEST(Sky, LooksUpTheDirection) {
  Sky sky{glm::dvec3(2), 4, 2, {}};
  for (int i = 0; i < 8; ++i) sky.image.insert(sky.image.end(), 3, static_cast<float>(i));
  const double h = std::sqrt(0.5);
  EXPECT_EQ(sky.toward({0.5, h, 0.5}).x, 2 * 2);     // p = 45 degrees: column 2, upper row
  EXPECT_EQ(sky.toward({-0.5, h, -0.5}).x, 2 * 0);   // p = -135 degrees: column 0
  EXPECT_EQ(sky.toward({0.5, -h, -0.5}).x, 2 * 5);   // lower row, column 1
  EXPECT_EQ((Sky{{1, 2, 3}, 0, 0, {}}.toward({0, 1, 0})), glm::dvec3(1, 2, 3));
}

TEST(MeshFile, MissingAndBrokenFilesAreRefusedInOneLine) {
  const Folder f;
  expect_refused((f.path / "missing.obj").string());
  fs::create_directories(f.path / "folder.obj");
  expect_refused((f.path / "folder.obj").string());
  expect_refused(f.write("empty.obj", ""));
  expect_refused(f.write("text.glb", "this is no mesh"));
  expect_refused(f.write("text.ply", "this is no mesh"));
  expect_refused(f.write("mesh.xyzzy", "v 0 0 0\n"));
  expect_refused(f.write("none", "v 0 0 0\n"));
  expect_refused(f.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"));
  expect_refused(f.write("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"));
  expect_refused(f.write("loop.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
      "nodes":[{"children":[1]},{"children":[0]}]})"));
}

TEST(MeshFile, ObjMaterialsAreRead) {
  const Folder f;
  f.write("m.mtl",
          "newmtl lamp\nKd 0.1 0.2 0.3\nKe 5 6 7\nnewmtl gloss\nKd 0.4 0.4 0.4\nKs 1 1 1\nNs 126\nmap_Kd gone.png\n");
  const Scene s =
      must(f.write("m.obj",
                   "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.25\nvt 0 0\nvt 1 1\nusemtl lamp\nf 1 2 3\n"
                   "usemtl gloss\nf 1/1 2/2 3/2 4/1\n"));
  expect_sound(s);
  ASSERT_EQ(s.indices.size(), 3u);
  const Material& lamp = s.material_of(0);
  EXPECT_LT(glm::length(lamp.base_color - glm::dvec3(0.1, 0.2, 0.3)), 1e-7);
  EXPECT_LT(glm::length(lamp.emission - glm::dvec3(5, 6, 7)), 1e-6);
  EXPECT_EQ(lamp.specular, 0);
  const Material& gloss = s.material_of(2);
  EXPECT_EQ(gloss.specular, 0.04);
  EXPECT_NEAR(gloss.roughness, std::pow(2.0 / 128, 0.25), 1e-6);
  EXPECT_EQ(gloss.texture, -1);
  ASSERT_EQ(s.notes.size(), 1u);
  EXPECT_NE(s.notes[0].find("gone.png"), std::string::npos);
  EXPECT_TRUE(s.sun.irradiance == glm::dvec3(0)) << "the lamp is the light";
  const Bounds b = bounds(s);
  EXPECT_EQ(b.low, glm::dvec3(0));
  EXPECT_EQ(b.high, glm::dvec3(1, 1, 0.25));
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
  static const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto at = [&](std::size_t k) { return k < bytes.size() ? std::uint32_t{bytes[k]} : 0u; };
    const std::uint32_t v = at(i) << 16 | at(i + 1) << 8 | at(i + 2);
    for (int k = 0; k < 4; ++k)
      text += i + static_cast<std::size_t>(k) <= bytes.size() ? digits[v >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

// Two triangles in a node that is moved by (10, 0, 0) and doubled; a 2 x 2 texture with one hole; a camera.
std::string small_gltf() {
  io::Image picture{2, 2, 4, {1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1, 1, 1, 1, 0}};
  io::WriteReport ignored;
  const auto png = io::encode_png(picture, "t.png", ignored);
  std::vector<std::uint8_t> bin(4 * (12 + 8) + 12);
  const float vertices[20] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 1, 1, 1, 1, 0, 0, 0};
  const std::uint16_t faces[6] = {0, 1, 2, 0, 2, 3};
  std::memcpy(bin.data(), vertices, sizeof(vertices));
  std::memcpy(bin.data() + sizeof(vertices), faces, sizeof(faces));
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
"nodes":[{"mesh":0,"translation":[10,0,0],"scale":[2,2,2]},{"camera":0,"translation":[0,0,5]}],
"cameras":[{"type":"perspective","perspective":{"yfov":0.8,"znear":0.1,"aspectRatio":1.6}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":0}]}],
"materials":[{"name":"leaf","alphaMode":"MASK","alphaCutoff":0.25,"emissiveFactor":[0,0.5,0],
"pbrMetallicRoughness":{"baseColorFactor":[0.5,1,1,1],"baseColorTexture":{"index":0},"metallicFactor":0.25,"roughnessFactor":0.5}}],
"textures":[{"source":0}],"images":[{"uri":"data:image/png;base64,)" +
         base64(png.value()) + R"("}],
"buffers":[{"byteLength":)" +
         std::to_string(bin.size()) + R"(,"uri":"data:application/octet-stream;base64,)" + base64(bin) + R"("}],
"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32},{"buffer":0,"byteOffset":80,"byteLength":12}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},{"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}]})";
}

TEST(MeshFile, GltfTexturesMasksAndCamerasAreRead) {
  const Folder f;
  const Scene s = must(f.write("small.gltf", small_gltf()));
  expect_sound(s);
  EXPECT_TRUE(s.notes.empty());
  ASSERT_EQ(s.indices.size(), 2u);
  EXPECT_EQ(bounds(s).low, glm::dvec3(10, 0, 0));
  EXPECT_EQ(bounds(s).high, glm::dvec3(12, 2, 0));
  const Material& m = s.material_of(0);
  EXPECT_EQ(m.alpha_mode, AlphaMode::mask);
  EXPECT_NEAR(m.alpha_cutoff, 0.25, 1e-7);
  EXPECT_NEAR(m.roughness, 0.5, 1e-7);
  EXPECT_NEAR(m.emission.g, 0.5, 1e-7);
  ASSERT_EQ(s.textures.size(), 1u);
  EXPECT_NEAR(s.camera.eye.z, 5, 1e-6);
  EXPECT_LT(s.camera.target.z, 5);
  EXPECT_NEAR(s.camera.fov, 0.8 * 180 / 3.14159265358979, 1e-4);
  // glTF's v = 0 is the picture's top row: vertex 0 has uv (0, 1), bottom left; vertex 2 has (1, 0), top right.
  const auto at = [&](double u, double v) {  // u, v over the square, v upwards
    return u >= v ? s.surface(0, u - v, v) : s.surface(1, u, v - u);
  };
  const Surface red = at(0.25, 0.75), blue = at(0.25, 0.25), hole = at(0.75, 0.25);
  EXPECT_NEAR(red.base_color.r, 0.5, 1e-6);
  EXPECT_NEAR(red.base_color.g, 0, 1e-6);
  EXPECT_NEAR(blue.base_color.b, 1, 1e-6);
  EXPECT_EQ(red.alpha, 1);
  EXPECT_EQ(hole.alpha, 0);
  EXPECT_NEAR(blue.albedo.b, 0.75, 1e-6);
  EXPECT_NEAR(blue.specular.b, 0.04 * 0.75 + 0.25, 1e-6);
}

// Row 0 of a texture is v = 0 in a scene; in an OBJ file v = 0 is the picture's bottom row.
TEST(MeshFile, ObjTexturesAreTheRightWayUp) {
  const Folder f;
  io::WriteReport ignored;
  const auto png = io::encode_png({1, 2, 3, {1, 0, 0, 0, 0, 1}}, "t.png", ignored);  // red over blue
  f.write("t.png", std::string(png.value().begin(), png.value().end()));
  f.write("t.mtl", "newmtl m\nKd 1 1 1\nmap_Kd t.png\n");
  const Scene s = must(
      f.write("t.obj", "mtllib t.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0.25\nvt 0 0.75\nf 1/1 2/1 3/2\n"));
  ASSERT_TRUE(s.notes.empty()) << s.notes[0];
  EXPECT_NEAR(s.surface(0, 0, 0).base_color.b, 1, 1e-6);
  EXPECT_NEAR(s.surface(0, 0, 1).base_color.r, 1, 1e-6);
}

TEST(MeshFile, CutAndAlteredFilesAreReadOrRefused) {
  const Folder f;
  const std::string whole = small_gltf();
  for (std::size_t i = 1; i <= 12; ++i)
    expect_read_or_refused(f.write("cut.gltf", whole.substr(0, whole.size() * i / 13)));
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  expect_sound(must(f.write("whole.ply", ply)));
  for (std::size_t i = 1; i <= 12; ++i) expect_read_or_refused(f.write("cut.ply", ply.substr(0, ply.size() * i / 13)));
  for (std::uint32_t seed = 0; seed < 24; ++seed) {
    SCOPED_TRACE(seed);
    std::string altered = seed % 2 == 0 ? whole : ply;
    for (std::uint32_t k = 0; k < 4; ++k)
      altered[hash(seed * 8 + k) % altered.size()] = static_cast<char>(32 + hash(seed * 8 + k + 4) % 95);
    expect_read_or_refused(f.write(seed % 2 == 0 ? "altered.gltf" : "altered.ply", altered));
  }
}

TEST(MeshFile, EveryAdversarialMeshIsReadOrRefused) {
  NEED_DATA();
  int read = 0, files = 0;
  for (const auto& entry : fs::directory_iterator(data("meshes_adversarial"))) {
    SCOPED_TRACE(entry.path().filename());
    if (entry.path().extension() != ".obj" && entry.path().extension() != ".ply") continue;
    ++files;
    expect_read_or_refused(entry.path().string());
    read += scene_from(entry.path().string()) ? 1 : 0;
  }
  EXPECT_GE(files, 19);
  EXPECT_GE(read, 15);
}

TEST(MeshFile, TheBunnyHasItsTriangles) {
  NEED_DATA();
  const Scene s = must(data("stanford_bunny/stanford-bunny.obj"));
  EXPECT_EQ(s.indices.size(), 69451u);
  expect_sound(s);
}

TEST(MeshFile, SponzaHasItsTrianglesAndColours) {
  NEED_DATA();
  const Scene s = must(data("crytek_sponza/sponza.glb"));
  EXPECT_EQ(s.indices.size(), 262267u);
  expect_sound(s);
  std::ifstream table(data("crytek_sponza/materials.csv"));
  std::string line;
  std::getline(table, line);
  std::size_t row = 0;
  for (; std::getline(table, line); ++row) {
    std::vector<std::string> cells;
    std::stringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    ASSERT_LT(row, s.materials.size());
    EXPECT_EQ(s.materials[row].name, cells[1]);
    const glm::dvec3 wanted(std::stod(cells[3]), std::stod(cells[4]), std::stod(cells[5]));
    EXPECT_LT(glm::length(s.materials[row].base_color - wanted), 1e-5) << line;
    EXPECT_EQ(std::count(s.triangle_materials.begin(), s.triangle_materials.end(), row), std::stol(cells[7])) << line;
  }
  EXPECT_EQ(row, 25u);
}

// assimp looks for the end of this header for ever: the child process that reads first is ended in time.
TEST(MeshFileFull, WhatHangsTheMeshLibraryIsRefused) {
  const Folder f;
  expect_refused(f.write("endless.ply", "ply\nformat ascii 1.0\ncomment end_header\nelement vertex 3\nprop"));
}

TEST(MeshFileFull, CutSponzaIsRefused) {
  NEED_DATA();
  const Folder f;
  const std::string whole = text_of(data("crytek_sponza/sponza.glb"));
  for (const std::size_t n : {20ul, 500ul, 9000ul, 100000ul, whole.size() / 2, whole.size() - 1})
    expect_read_or_refused(f.write("cut.glb", whole.substr(0, n)));
}

}  // namespace
}  // namespace luxel::scene
