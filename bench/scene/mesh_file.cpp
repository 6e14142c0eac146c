// Scenes from files, by assimp.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <new>
#include <numbers>
#include <csignal>
#include <cerrno>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <assimp/GltfMaterial.h>
#include <assimp/Importer.hpp>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "bench/io/codecs.h"
#include "bench/scene/mesh_texture.h"

namespace luxel::scene {
namespace {

namespace fs = std::filesystem;

// Points and lines stay in the list and are passed over; v = 0 goes to the first row, as in glTF.
constexpr unsigned steps = aiProcess_Triangulate | aiProcess_FlipUVs;

std::string one_line(std::string text) {
  std::replace_if(text.begin(), text.end(), [](unsigned char c) { return c < 32 || c == 127; }, ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

#if defined(__SANITIZE_ADDRESS__)
constexpr bool memory_can_be_limited = false;  // the sanitizer reserves most of the address space
#else
constexpr bool memory_can_be_limited = true;
#endif

// Bytes that a file may be read into: a hundredfold, and room for small ones.
std::uintmax_t memory_for(std::uintmax_t bytes) { return (std::uintmax_t{1} << 30) + 100 * bytes; }

void limit_memory(std::uintmax_t more) {
  std::ifstream status("/proc/self/statm");
  std::uintmax_t pages = 0;
  rlimit limit{};
  if (!memory_can_be_limited || !(status >> pages) || getrlimit(RLIMIT_AS, &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, pages * static_cast<std::uintmax_t>(sysconf(_SC_PAGESIZE)) + more);
  setrlimit(RLIMIT_AS, &limit);
}

// Damaged files make the mesh library run for ever, take all memory, or crash. So a child process reads the file first.
// Returns what is wrong; empty where the child came through.
std::string probe(const std::string& path, std::uintmax_t bytes) {
  int ends[2];
  if (pipe(ends) != 0) return {};
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGALRM, SIG_DFL);
    alarm(10 + static_cast<unsigned>(std::min<std::uintmax_t>(bytes >> 20, 3600)));
    limit_memory(memory_for(bytes));
    std::string wrong;
    try {
      Assimp::Importer importer;
      if (importer.ReadFile(path, steps) == nullptr)
        wrong = std::string("is not a mesh that assimp reads (") + importer.GetErrorString() + ")";
    } catch (const std::bad_alloc&) {
      wrong = "takes more memory than a mesh of its size should";
    } catch (...) {
      wrong = "is not a mesh that assimp reads";
    }
    wrong.resize(std::min<std::size_t>(wrong.size(), 1000));
    _exit(write(ends[1], wrong.data(), wrong.size()) == static_cast<ssize_t>(wrong.size()) ? 0 : 1);
  }
  close(ends[1]);
  std::string wrong;
  char buffer[1024];
  for (ssize_t n = 0; child > 0 && ((n = read(ends[0], buffer, sizeof(buffer))) > 0 || (n < 0 && errno == EINTR));)
    if (n > 0) wrong.append(buffer, static_cast<std::size_t>(n));
  close(ends[0]);
  if (child < 0) return {};  // no process to be had: the library is trusted
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFSIGNALED(status)) return wrong;
  return WTERMSIG(status) == SIGALRM ? "keeps the mesh library busy for too long" : "makes the mesh library crash";
}

// assimp looks for the end of a PLY file's header for ever.
bool has_whole_header(const std::string& path, std::string extension) {
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension != ".ply") return true;
  std::string start(1 << 16, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(in.gcount()));
  return start.find("end_header\n") != std::string::npos || start.find("end_header\r") != std::string::npos;
}

glm::dvec3 rgb(const aiColor3D& c) { return {c.r, c.g, c.b}; }

class Reader {
 public:
  Reader(const aiScene& from, const std::string& path) : from_(from), folder_(fs::path(path).parent_path()) {
    scene.name = fs::path(path).filename().string();
    const std::string extension = fs::path(path).extension().string();
    gltf_ = extension.starts_with(".gl") || extension.starts_with(".GL");
  }

  Scene scene;

  Status read() {
    for (unsigned i = 0; i < from_.mNumMaterials; ++i) scene.materials.push_back(material(*from_.mMaterials[i]));
    if (scene.materials.empty()) scene.materials.push_back({.name = "plain"});
    bool any_uvs = false;
    for (unsigned i = 0; i < from_.mNumMeshes; ++i) any_uvs = any_uvs || from_.mMeshes[i]->HasTextureCoords(0);
    with_uvs_ = any_uvs && scene.textured();
    if (from_.mRootNode == nullptr) return Status(Code::io, "holds no scene");
    // A stack of our own: a file may nest nodes as deep as it likes.
    std::vector<std::pair<const aiNode*, glm::dmat4>> open{{from_.mRootNode, glm::dmat4(1)}};
    while (!open.empty()) {
      const auto [node, parent] = open.back();
      open.pop_back();
      const glm::dmat4 transform = parent * matrix(node->mTransformation);
      for (unsigned i = 0; i < node->mNumMeshes; ++i)
        if (Status s = mesh(*from_.mMeshes[node->mMeshes[i]], transform); !s) return s;
      if (from_.mNumCameras > 0 && node->mName == from_.mCameras[0]->mName) camera(*from_.mCameras[0], transform);
      for (unsigned i = node->mNumChildren; i-- > 0;) open.push_back({node->mChildren[i], transform});
    }
    if (scene.indices.empty()) return Status(Code::io, "holds no triangles");
    if (!has_camera_) scene.camera = outside(bounds(scene));
    if (!scene.emissive()) {
      scene.sun = {glm::normalize(glm::dvec3(0.35, 1.0, 0.3)), glm::dvec3(10)};
      scene.sky.radiance = glm::dvec3(1);
    }
    return {};
  }

 private:
  const aiScene& from_;
  fs::path folder_;
  bool gltf_ = false, with_uvs_ = false, has_camera_ = false, told_of_colors_ = false;
  std::map<std::string, int> known_textures_;

  static glm::dmat4 matrix(const aiMatrix4x4& m) {
    return glm::transpose(glm::dmat4(m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4,
                                     m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4));
  }

  Status mesh(const aiMesh& from, const glm::dmat4& transform) {
    const std::size_t first = scene.positions.size();
    if (first + from.mNumVertices > 0xffffffffu) return Status(Code::io, "holds more than 2^32 vertices");
    if (from.HasVertexColors(0) && !told_of_colors_) scene.notes.push_back("colours of vertices are not used");
    told_of_colors_ = told_of_colors_ || from.HasVertexColors(0);
    const bool moved = transform != glm::dmat4(1);
    for (unsigned i = 0; i < from.mNumVertices; ++i) {
      const aiVector3D v = from.mVertices[i];
      const glm::dvec3 p(v.x, v.y, v.z);
      scene.positions.push_back(moved ? glm::dvec3(transform * glm::dvec4(p, 1)) : p);
      if (with_uvs_)
        scene.uvs.push_back(from.HasTextureCoords(0)
                                ? glm::dvec2(from.mTextureCoords[0][i].x, from.mTextureCoords[0][i].y)
                                : glm::dvec2(0));
    }
    for (unsigned i = 0; i < from.mNumFaces; ++i) {
      const aiFace& f = from.mFaces[i];
      if (f.mNumIndices != 3) continue;
      if (std::max({f.mIndices[0], f.mIndices[1], f.mIndices[2]}) >= from.mNumVertices)
        return Status(Code::io, fmt::format("has a face with a vertex that does not exist (face {} of a mesh)", i));
      const auto base = static_cast<std::uint32_t>(first);
      scene.indices.push_back({base + f.mIndices[0], base + f.mIndices[1], base + f.mIndices[2]});
      scene.triangle_materials.push_back(
          std::min<std::uint32_t>(from.mMaterialIndex, static_cast<std::uint32_t>(scene.materials.size() - 1)));
    }
    return {};
  }

  Material material(const aiMaterial& from) {
    Material m;
    m.name = from.GetName().C_Str();
    aiColor4D base;
    aiColor3D color, gloss;
    float number = 0;
    aiString text;
    if (from.Get(AI_MATKEY_BASE_COLOR, base) == aiReturn_SUCCESS) {
      m.base_color = {base.r, base.g, base.b};
      m.alpha = base.a;
    } else if (from.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS) {
      m.base_color = rgb(color);
      if (from.Get(AI_MATKEY_OPACITY, number) == aiReturn_SUCCESS) m.alpha = number;
      if (m.alpha < 1) m.alpha_mode = AlphaMode::blend;
    }
    if (from.Get(AI_MATKEY_COLOR_EMISSIVE, color) == aiReturn_SUCCESS) m.emission = rgb(color);
    if (from.Get(AI_MATKEY_EMISSIVE_INTENSITY, number) == aiReturn_SUCCESS) m.emission *= number;
    if (from.Get(AI_MATKEY_ROUGHNESS_FACTOR, number) == aiReturn_SUCCESS) {
      m.roughness = number;
      m.specular = 0.04;
      if (from.Get(AI_MATKEY_METALLIC_FACTOR, number) == aiReturn_SUCCESS) m.metallic = number;
    } else if (from.Get(AI_MATKEY_SHININESS, number) == aiReturn_SUCCESS && number > 1 &&
               from.Get(AI_MATKEY_COLOR_SPECULAR, gloss) == aiReturn_SUCCESS && gloss.r + gloss.g + gloss.b > 0) {
      // Phong's exponent n is about GGX with alpha^2 = 2 / (n + 2) (Walter et al. 2007, section 5.2, for Beckmann).
      m.roughness = std::pow(2 / (number + 2.0), 0.25);
      m.specular = 0.04;
    }
    if (gltf_ && from.Get(AI_MATKEY_GLTF_ALPHAMODE, text) == aiReturn_SUCCESS) {
      m.alpha_mode = text == aiString("MASK")    ? AlphaMode::mask
                     : text == aiString("BLEND") ? AlphaMode::blend
                                                 : AlphaMode::opaque;
      if (from.Get(AI_MATKEY_GLTF_ALPHACUTOFF, number) == aiReturn_SUCCESS) m.alpha_cutoff = number;
    }
    for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE})
      if (m.texture < 0 && from.GetTexture(type, 0, &text) == aiReturn_SUCCESS) m.texture = texture(text.C_Str());
    if (from.GetTextureCount(aiTextureType_EMISSIVE) > 0)
      scene.notes.push_back(fmt::format("material {}: its emission texture is not used", m.name));
    // Formats without a mode of their own put masks into the texture's alpha.
    if (m.texture >= 0 && !gltf_ && m.alpha_mode == AlphaMode::opaque &&
        has_holes(scene.textures[static_cast<std::size_t>(m.texture)]))
      m.alpha_mode = AlphaMode::mask;
    sanitize(m);
    return m;
  }

  static bool has_holes(const Texture& t) {
    for (std::size_t i = 3; i < t.rgba.size(); i += 4)
      if (t.rgba[i] < 128) return true;
    return false;
  }

  // Into the documented ranges, whatever the file says.
  void sanitize(Material& m) {
    const Material was = m;
    const auto unit = [](double v, double fallback) { return std::isfinite(v) ? std::clamp(v, 0.0, 1.0) : fallback; };
    for (int i = 0; i < 3; ++i) {
      m.base_color[i] = unit(m.base_color[i], 0.5);
      m.emission[i] = std::isfinite(m.emission[i]) ? std::max(m.emission[i], 0.0) : 0.0;
    }
    m.alpha = unit(m.alpha, 1);
    m.roughness = unit(m.roughness, 1);
    m.metallic = unit(m.metallic, 0);
    m.alpha_cutoff = unit(m.alpha_cutoff, 0.5);
    if (m.base_color != was.base_color || m.emission != was.emission)
      scene.notes.push_back(fmt::format("material {}: colours out of range were clamped", m.name));
  }

  int texture(const std::string& name) {
    if (const auto found = known_textures_.find(name); found != known_textures_.end()) return found->second;
    Result<Texture> read = load_texture(name);
    int& index = known_textures_[name];
    if (!read) {
      scene.notes.push_back(one_line(fmt::format("texture {}; its plain colour is used", read.status().message())));
      return index = -1;
    }
    scene.textures.push_back(std::move(read).value());
    return index = static_cast<int>(scene.textures.size() - 1);
  }

  Result<Texture> load_texture(const std::string& name) const {
    if (const aiTexture* inside = from_.GetEmbeddedTexture(name.c_str())) {
      if (inside->mHeight == 0)
        return decode_texture({reinterpret_cast<const std::uint8_t*>(inside->pcData), inside->mWidth}, name);
      Texture t{name, static_cast<int>(inside->mWidth), static_cast<int>(inside->mHeight), true, {}};
      for (std::size_t i = 0; i < std::size_t{inside->mWidth} * inside->mHeight; ++i) {
        const aiTexel& c = inside->pcData[i];
        t.rgba.insert(t.rgba.end(), {c.r, c.g, c.b, c.a});
      }
      return t;
    }
    std::string file = name;
    std::replace(file.begin(), file.end(), '\\', '/');
    return read_texture((folder_ / file).string());
  }

  void camera(const aiCamera& from, const glm::dmat4& node) {
    // Of a glTF file assimp repeats the node's position in the camera, and multiplies angles by the aspect.
    const glm::dvec3 at = gltf_ ? glm::dvec3(0) : glm::dvec3(from.mPosition.x, from.mPosition.y, from.mPosition.z);
    const glm::dvec3 look(from.mLookAt.x, from.mLookAt.y, from.mLookAt.z);
    const double aspect = from.mAspect > 0 ? from.mAspect : 1, horizontal = from.mHorizontalFOV;
    Camera c;
    c.eye = glm::dvec3(node * glm::dvec4(at, 1));
    c.target = c.eye + glm::dvec3(node * glm::dvec4(look, 0));
    c.fov = (gltf_ ? horizontal / aspect : 2 * std::atan(std::tan(horizontal / 2) / aspect)) * 180 / std::numbers::pi;
    has_camera_ = std::isfinite(c.eye.x + c.eye.y + c.eye.z + c.target.x + c.target.y + c.target.z) &&
                  c.eye != c.target && c.fov > 0 && c.fov < 180;
    if (has_camera_) scene.camera = c;
  }

  // From the front, above and beside, the ball around the box in view.
  static Camera outside(const Bounds& box) {
    Camera c;
    c.fov = 45;
    c.target = (box.low + box.high) * 0.5;
    const double radius = std::max(glm::length(box.high - box.low) / 2, 1e-6);
    c.eye = c.target + glm::normalize(glm::dvec3(0.5, 0.4, 1)) * (radius / std::sin(c.fov * std::numbers::pi / 360));
    return c;
  }
};

}  // namespace

Result<Scene> read_mesh(const std::string& path) try {
  const auto refuse = [&](const std::string& what, const std::string& remedy) {
    return io::failure(one_line(path), one_line(what), remedy);
  };
  Assimp::Importer importer;
  const std::string extension = fs::path(path).extension().string();
  std::error_code error;
  if (!fs::exists(path, error))
    return extension.empty() ? built_in(path).status() : refuse("does not exist", "check the name");
  if (!fs::is_regular_file(path, error)) return refuse("is not a file", "name a file");
  if (access(path.c_str(), R_OK) != 0) return refuse("cannot be read", "check its permissions");
  if (extension.empty() || !importer.IsExtensionSupported(extension))
    return refuse(extension.empty() ? "has no extension" : fmt::format("has the unknown extension {}", extension),
                  "expected .obj, .ply, .gltf, .glb or another that assimp reads");
  const std::uintmax_t bytes = fs::file_size(path, error);
  if (error || bytes == 0) return refuse("is empty", io::damaged);
  if (!has_whole_header(path, extension)) return refuse("ends within the PLY header", io::damaged);
  if (const std::string wrong = probe(path, bytes); !wrong.empty()) return refuse(wrong, io::damaged);
  const aiScene* scene = importer.ReadFile(path, steps);
  if (scene == nullptr)
    return refuse(fmt::format("is not a mesh that assimp reads ({})", importer.GetErrorString()), io::damaged);
  Reader reader(*scene, path);
  if (Status s = reader.read(); !s) return refuse(s.message(), "export it again, with triangles");
  return std::move(reader.scene);
} catch (const std::bad_alloc&) {
  return Status(Code::out_of_memory, path + ": does not fit into memory; use a smaller file");
}

Result<Scene> scene_from(const std::string& name) {
  const std::string word = name.substr(0, name.find(':'));
  const auto names = built_in_names();
  if (std::find(names.begin(), names.end(), word) != names.end()) return built_in(name);
  return read_mesh(name);
}

}  // namespace luxel::scene
