#include "renderer/trace/surface.h"

#include "renderer/trace/frame.h"

namespace quartet {
namespace {

template <class T>
T interpolate(const std::vector<T>& values, glm::uvec3 triangle, const Hit& hit) {
  return (1.0f - hit.u - hit.v) * values[triangle.x] + hit.u * values[triangle.y] +
         hit.v * values[triangle.z];
}

float turns(float y, float x) {
  const float turn = std::atan2(y, x) * (0.5f / pi);
  return turn < 0.0f ? turn + 1.0f : turn;
}

glm::vec2 uv(const Mesh& mesh, glm::vec3, const Hit& hit) {
  return mesh.uvs.empty() ? glm::vec2(0.0f)
                          : interpolate(mesh.uvs, mesh.triangles[hit.primitive], hit);
}

glm::vec2 uv(const Sphere& sphere, glm::vec3 position, const Hit&) {
  const glm::vec3 local = glm::normalize(sphere.to_local * (position - sphere.center));
  return {turns(local.y, local.x), std::acos(glm::clamp(local.z, -1.0f, 1.0f)) / pi};
}

glm::vec2 uv(const Disk& disk, glm::vec3 position, const Hit&) {
  const glm::vec3 p = (position - disk.center) / disk.radius;
  const float x = glm::dot(p, disk.axis_u);
  const float y = glm::dot(p, glm::cross(disk.normal, disk.axis_u));
  return {std::sqrt(x * x + y * y), turns(y, x)};
}

void refine(const Mesh& mesh, const Hit& hit, Surface& surface) {
  if (mesh.normals.empty()) {
    return;
  }
  const glm::vec3 normal = interpolate(mesh.normals, mesh.triangles[hit.primitive], hit);
  const float length = glm::length(normal);
  if (length > 0.0f) {
    surface.shading_normal = normal / length;
  }
  if (glm::dot(surface.shading_normal, surface.normal) < 0.0f) {
    surface.shading_normal = -surface.shading_normal;
  }
}

void refine(const Sphere& sphere, const Hit&, Surface& surface) {
  // The distance along the ray is coarse beside the radius; the way from the centre is not.
  const glm::vec3 outward = glm::normalize(surface.position - sphere.center);
  surface.position = sphere.center + sphere.radius * outward;
  surface.normal = sphere.flip_normals ? -outward : outward;
  surface.shading_normal = surface.normal;
}

void refine(const Disk& disk, const Hit&, Surface& surface) {
  surface.normal = disk.normal;
  surface.shading_normal = disk.normal;
}

}  // namespace

glm::vec2 uv_at(const Shape& shape, glm::vec3 position, const Hit& hit) {
  return std::visit([&](const auto& geometry) { return uv(geometry, position, hit); },
                    shape.geometry);
}

bool needs_uv(const Scene& scene, const Shape& shape) {
  const Material& material = scene.materials[std::size_t(shape.material)];
  const auto textured = [](const Color& color) { return color.texture != Color::no_texture; };
  return textured(material.reflectance) || textured(material.transmittance) ||
         (shape.emits && textured(shape.radiance));
}

Surface surface_at(const Shape& shape, bool with_uv, const Ray& ray, const Hit& hit) {
  Surface surface;
  surface.position = ray.origin + hit.t * ray.direction;
  surface.normal = glm::normalize(hit.normal);
  surface.shading_normal = surface.normal;
  surface.shape = hit.shape;
  surface.primitive = hit.primitive;
  std::visit([&](const auto& geometry) { refine(geometry, hit, surface); }, shape.geometry);
  surface.uv = with_uv ? uv_at(shape, surface.position, hit) : glm::vec2(0.0f);
  return surface;
}

}  // namespace quartet
