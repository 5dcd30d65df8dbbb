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

namespace quartet {
namespace {

void check(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
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

void set_ray(const Ray& ray, RTCRay& r) {
  r.org_x = ray.origin.x;
  r.org_y = ray.origin.y;
  r.org_z = ray.origin.z;
  r.tnear = 0.0f;
  r.dir_x = ray.direction.x;
  r.dir_y = ray.direction.y;
  r.dir_z = ray.direction.z;
  r.time = 0.0f;
  r.tfar = ray.t_max;
  r.mask = ~0u;
  r.id = 0;
  r.flags = 0;
}

}  // namespace

void Accel::Release::operator()(RTCSceneTy* scene) const {
  rtcReleaseScene(scene);
}

Accel::Accel(const Scene& scene) {
  // The scene holds a reference of its own to the device.
  const std::unique_ptr<std::remove_pointer_t<RTCDevice>, decltype(&rtcReleaseDevice)> device(
      rtcNewDevice(nullptr), rtcReleaseDevice);
  check(device.get());
  scene_.reset(rtcNewScene(device.get()));
  rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_HIGH);
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    RTCGeometry geometry =
        std::visit([&](const auto& shape) { return make_geometry(device.get(), shape); },
                   scene.shapes[i].geometry);
    rtcSetGeometryMask(geometry, ~0u);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene_.get(), geometry, unsigned(i));
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(scene_.get());
  check(device.get());
  if (!scene.shapes.empty()) {
    RTCBounds bounds;
    rtcGetSceneBounds(scene_.get(), &bounds);
    bounds_min_ = {bounds.lower_x, bounds.lower_y, bounds.lower_z};
    bounds_max_ = {bounds.upper_x, bounds.upper_y, bounds.upper_z};
  }
}

bool Accel::closest_hit(const Ray& ray, Hit& hit) const {
  RTCRayHit query;
  set_ray(ray, query.ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect1(scene_.get(), &query);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_.get(), &context, &query);
#endif
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
    return false;
  }
  hit.t = query.ray.tfar;
  hit.normal = {query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z};
  hit.u = query.hit.u;
  hit.v = query.hit.v;
  hit.shape = query.hit.geomID;
  hit.primitive = query.hit.primID;
  return true;
}

bool Accel::occluded(const Ray& ray) const {
  RTCRay query;
  set_ray(ray, query);
#if RTC_VERSION_MAJOR >= 4
  rtcOccluded1(scene_.get(), &query);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_.get(), &context, &query);
#endif
  return query.tfar < 0.0f;
}

}  // namespace quartet
