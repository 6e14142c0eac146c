#include "bench/scene/rays.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <embree3/rtcore.h>

namespace luxel::scene {

struct Rays::State {
  const Scene* scene = nullptr;
  RTCDevice device = nullptr;
  RTCScene tree = nullptr;
  glm::dvec3 middle{0};
  double offset = 0;
  std::vector<std::uint32_t> triangles;  // of the scene, by Embree's number

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (tree != nullptr) rtcReleaseScene(tree);
    if (device != nullptr) rtcReleaseDevice(device);
  }
};

namespace {

bool has_area(const Scene& scene, std::size_t triangle) {
  const glm::uvec3 t = scene.indices[triangle];
  const glm::dvec3 a = scene.positions[t.x];
  return glm::cross(scene.positions[t.y] - a, scene.positions[t.z] - a) != glm::dvec3(0);
}

// Embree asks for each surface that a ray meets.
void pass_holes(const RTCFilterFunctionNArguments* args, const Scene& scene,
                const std::vector<std::uint32_t>& triangles) {
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const unsigned primitive = RTCHitN_primID(args->hit, args->N, i);
    const double u = RTCHitN_u(args->hit, args->N, i), v = RTCHitN_v(args->hit, args->N, i);
    if (scene.surface(triangles[primitive], u, v).alpha < 0.5) args->valid[i] = 0;
  }
}

RTCRay ray_of(glm::dvec3 origin, glm::dvec3 direction, double reach) {
  RTCRay ray{};
  ray.org_x = static_cast<float>(origin.x), ray.org_y = static_cast<float>(origin.y),
  ray.org_z = static_cast<float>(origin.z);
  ray.dir_x = static_cast<float>(direction.x), ray.dir_y = static_cast<float>(direction.y),
  ray.dir_z = static_cast<float>(direction.z);
  ray.tnear = 0;
  ray.tfar = static_cast<float>(reach);
  ray.mask = ~0u;
  return ray;
}

}  // namespace

Result<Rays> Rays::make(const Scene& scene) {
  auto state = std::make_shared<State>();
  state->scene = &scene;
  state->device = rtcNewDevice(nullptr);
  if (state->device == nullptr) return Status(Code::internal, "Embree does not start on this machine");
  state->tree = rtcNewScene(state->device);
  rtcSetSceneFlags(state->tree, RTC_SCENE_FLAG_ROBUST);
  const Bounds box = bounds(scene);
  state->middle = (box.low + box.high) * 0.5;
  const glm::dvec3 largest = glm::max(glm::abs(box.low), glm::abs(box.high));
  state->offset = std::ldexp(std::max({largest.x, largest.y, largest.z}), -18);

  bool holes = false;
  for (std::size_t i = 0; i < scene.indices.size(); ++i) {
    if (!finite(scene, i) || !has_area(scene, i)) continue;
    state->triangles.push_back(static_cast<std::uint32_t>(i));
    holes = holes || scene.material_of(i).alpha_mode != AlphaMode::opaque;
  }
  const std::size_t count = state->triangles.size();
  if (count > 0) {
    RTCGeometry geometry = rtcNewGeometry(state->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                 12, scene.positions.size()));
    auto* indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, count));
    if (vertices == nullptr || indices == nullptr) {
      rtcReleaseGeometry(geometry);
      return Status(Code::out_of_memory, "the scene does not fit into memory; use a smaller one");
    }
    for (std::size_t i = 0; i < scene.positions.size(); ++i)
      for (int k = 0; k < 3; ++k) vertices[3 * i + k] = static_cast<float>(scene.positions[i][k] - state->middle[k]);
    for (std::size_t i = 0; i < count; ++i)
      for (int k = 0; k < 3; ++k) indices[3 * i + k] = scene.indices[state->triangles[i]][k];
    if (holes) {
      const auto filter = [](const RTCFilterFunctionNArguments* args) {
        const auto* s = static_cast<const State*>(args->geometryUserPtr);
        pass_holes(args, *s->scene, s->triangles);
      };
      rtcSetGeometryUserData(geometry, state.get());
      rtcSetGeometryIntersectFilterFunction(geometry, filter);
      rtcSetGeometryOccludedFilterFunction(geometry, filter);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(state->tree, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(state->tree);
  if (const RTCError error = rtcGetDeviceError(state->device); error != RTC_ERROR_NONE)
    return Status(error == RTC_ERROR_OUT_OF_MEMORY ? Code::out_of_memory : Code::internal,
                  "Embree cannot build a tree of the scene; use a smaller one");
  return Rays(std::move(state));
}

const Scene& Rays::scene() const { return *state_->scene; }

double Rays::offset() const { return state_->offset; }

std::optional<Hit> Rays::first(glm::dvec3 origin, glm::dvec3 direction, double reach) const {
  RTCRayHit query{ray_of(origin - state_->middle, direction, reach), {}};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(state_->tree, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

  Hit hit;
  hit.triangle = state_->triangles[query.hit.primID];
  const Scene& scene = *state_->scene;
  const glm::uvec3 t = scene.indices[hit.triangle];
  const glm::dvec3 a = scene.positions[t.x], e1 = scene.positions[t.y] - a, e2 = scene.positions[t.z] - a;
  const glm::dvec3 n = glm::cross(e1, e2);
  hit.b1 = query.hit.u, hit.b2 = query.hit.v, hit.distance = query.ray.tfar;
  // Moeller and Trumbore 1997, in double, where the ray is not too flat for it.
  const glm::dvec3 p = glm::cross(direction, e2);
  const double det = glm::dot(e1, p);
  if (std::abs(det) > 1e-9 * glm::length(n) * glm::length(direction)) {
    const glm::dvec3 s = origin - a, q = glm::cross(s, e1);
    const double u = glm::dot(s, p) / det, v = glm::dot(direction, q) / det;
    // Embree's answer stands where rounding decides which triangle is hit, and the point stays within this one.
    hit.b1 = std::clamp(u, 0.0, 1.0);
    hit.b2 = std::clamp(v, 0.0, 1.0 - hit.b1);
    hit.distance = glm::dot(e2, q) / det;
  }
  hit.position = a + hit.b1 * e1 + hit.b2 * e2;
  hit.normal = glm::normalize(glm::dot(n, direction) > 0 ? -n : n);
  return hit;
}

bool Rays::blocked(glm::dvec3 origin, glm::dvec3 direction, double reach) const {
  RTCRay ray = ray_of(origin - state_->middle, direction, reach);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(state_->tree, &context, &ray);
  return ray.tfar < 0;
}

}  // namespace luxel::scene
