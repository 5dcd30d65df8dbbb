#include "renderer/trace/accel.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <fmt/format.h>

#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "renderer/base/cancel.h"

namespace quartet {
namespace {

void check(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_CANCELLED) {
    throw Cancelled();
  }
  if (error != RTC_ERROR_NONE) {
    throw std::runtime_error(
        fmt::format("Embree: cannot build the scene (error {}{})", int(error),
                    error == RTC_ERROR_OUT_OF_MEMORY ? ", out of memory" : ""));
  }
}

/// Embree may refuse a buffer when memory is short, and says so on the device.
template <class T>
T* new_buffer(RTCDevice device, RTCGeometry geometry, RTCBufferType type, RTCFormat format,
              std::size_t count) {
  void* data = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), count);
  check(device);
  return static_cast<T*>(data);
}

RTCGeometry make_geometry(RTCDevice device, const Mesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = new_buffer<glm::vec3>(device, geometry, RTC_BUFFER_TYPE_VERTEX,
                                         RTC_FORMAT_FLOAT3, mesh.positions.size());
  std::memcpy(vertices, mesh.positions.data(), mesh.positions.size() * sizeof(glm::vec3));
  auto* indices = new_buffer<glm::uvec3>(device, geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3,
                                         mesh.triangles.size());
  std::memcpy(indices, mesh.triangles.data(), mesh.triangles.size() * sizeof(glm::uvec3));
  return geometry;
}

RTCGeometry make_geometry(RTCDevice device, const Sphere& sphere) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
  auto* point =
      new_buffer<glm::vec4>(device, geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, 1);
  *point = glm::vec4(sphere.center, sphere.radius);
  return geometry;
}

RTCGeometry make_geometry(RTCDevice device, const Disk& disk) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT);
  auto* point =
      new_buffer<glm::vec4>(device, geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, 1);
  *point = glm::vec4(disk.center, disk.radius);
  auto* normal =
      new_buffer<glm::vec3>(device, geometry, RTC_BUFFER_TYPE_NORMAL, RTC_FORMAT_FLOAT3, 1);
  *normal = disk.normal;
  return geometry;
}

void store(float* to, Float8 values) {
  _mm256_store_ps(to, __m256(values));
}
void store(void* to, Int8 values) {
  _mm256_store_si256(static_cast<__m256i*>(to), __m256i(values));
}
Float8 load(const float* from) {
  return Float8(_mm256_load_ps(from));
}
Word8 load(const unsigned* from) {
  return Word8(_mm256_load_si256(reinterpret_cast<const __m256i*>(from)));
}

void set_rays(const Ray8& rays, RTCRay8& r) {
  store(r.org_x, rays.origin.x);
  store(r.org_y, rays.origin.y);
  store(r.org_z, rays.origin.z);
  store(r.tnear, Float8{});
  store(r.dir_x, rays.direction.x);
  store(r.dir_y, rays.direction.y);
  store(r.dir_z, rays.direction.z);
  store(r.time, Float8{});
  store(r.tfar, rays.t_max);
  store(r.mask, ~Int8{});
  store(r.id, Int8{});
  store(r.flags, Int8{});
}

/// The rays that Embree takes: where it was built with assertions it ends the program for one that
/// is not finite or begins too far out. No scene or camera within its limits (scene/limits.h) makes
/// such a ray; one that comes all the same meets nothing.
Mask8 traceable(const Ray8& rays) {
  constexpr float too_far = 1e18f;
  // One sum, which is not below the limit as soon as one part is not.
  const Float8 sum = abs(rays.origin.x) + abs(rays.origin.y) + abs(rays.origin.z) +
                     abs(rays.direction.x) + abs(rays.direction.y) + abs(rays.direction.z);
  return (sum < too_far) & (rays.t_max >= 0.0f);
}

/// Called by Embree now and then while it builds; false ends that.
bool goes_on(void* stop, double /*done*/) {
  return !static_cast<const std::stop_token*>(stop)->stop_requested();
}

/// One ray alone in a packet.
constexpr Mask8 first_lane{-1};
Ray8 packet_of(const Ray& ray) {
  return {splat(ray.origin), splat(ray.direction), splat(ray.t_max)};
}

}  // namespace

void Accel::Release::operator()(RTCSceneTy* scene) const {
  rtcReleaseScene(scene);
}

Accel::Accel(const Scene& scene, const std::stop_token& stop) {
  // The scene holds a reference of its own to the device.
  const std::unique_ptr<std::remove_pointer_t<RTCDevice>, decltype(&rtcReleaseDevice)> device(
      rtcNewDevice(nullptr), rtcReleaseDevice);
  check(device.get());
  scene_.reset(rtcNewScene(device.get()));
  rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_HIGH);
  std::stop_token asked = stop;
  rtcSetSceneProgressMonitorFunction(scene_.get(), goes_on, &asked);
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    check_cancelled(stop);
    RTCGeometry geometry =
        std::visit([&](const auto& shape) { return make_geometry(device.get(), shape); },
                   scene.shapes[i].geometry);
    rtcSetGeometryMask(geometry, ~0u);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene_.get(), geometry, unsigned(i));
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(scene_.get());
  check_cancelled(stop);
  check(device.get());
  rtcSetSceneProgressMonitorFunction(scene_.get(), nullptr, nullptr);
  if (!scene.shapes.empty()) {
    RTCBounds bounds;
    rtcGetSceneBounds(scene_.get(), &bounds);
    bounds_min_ = {bounds.lower_x, bounds.lower_y, bounds.lower_z};
    bounds_max_ = {bounds.upper_x, bounds.upper_y, bounds.upper_z};
  }
}

Hit8 Accel::closest_hit(const Ray8& rays, Mask8 active) const {
  active &= traceable(rays);
  RTCRayHit8 query;
  set_rays(rays, query.ray);
  store(query.hit.geomID, ~Int8{});  // RTC_INVALID_GEOMETRY_ID
  store(query.hit.instID[0], ~Int8{});
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect8(reinterpret_cast<const int*>(&active), scene_.get(), &query);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect8(reinterpret_cast<const int*>(&active), scene_.get(), &context, &query);
#endif
  const Word8 shape = load(query.hit.geomID);
  return {.met = active & (shape != RTC_INVALID_GEOMETRY_ID),
          .t = load(query.ray.tfar),
          .u = load(query.hit.u),
          .v = load(query.hit.v),
          .shape = shape,
          .primitive = load(query.hit.primID)};
}

Mask8 Accel::occluded(const Ray8& rays, Mask8 active) const {
  active &= traceable(rays);
  // Eight together Embree traverses as one packet, with boxes that round otherwise: a ray along the
  // very edge of a wall may then miss it. Fewer it traverses one by one.
  constexpr Mask8 half{-1, -1, -1, -1};
  if (lane_bits(~active) == 0) {
    return occluded(rays, half) | occluded(rays, ~half);
  }
  RTCRay8 query;
  set_rays(rays, query);
#if RTC_VERSION_MAJOR >= 4
  rtcOccluded8(reinterpret_cast<const int*>(&active), scene_.get(), &query);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded8(reinterpret_cast<const int*>(&active), scene_.get(), &context, &query);
#endif
  return active & (load(query.tfar) < 0.0f);
}

bool Accel::closest_hit(const Ray& ray, Hit& hit) const {
  const Hit8 hits = closest_hit(packet_of(ray), first_lane);
  hit = {hits.t[0], hits.u[0], hits.v[0], hits.shape[0], hits.primitive[0]};
  return any(hits.met);
}

bool Accel::occluded(const Ray& ray) const {
  return any(occluded(packet_of(ray), first_lane));
}

}  // namespace quartet
