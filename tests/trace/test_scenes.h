#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/scene/load_scene.h"
#include "renderer/scene/scene.h"
#include "renderer/trace/integrator.h"
#include "tests/trace/statistics.h"

namespace quartet::test {

/// A parallelogram whose front is on the side of cross(edge1, edge2).
inline Mesh parallelogram(glm::vec3 corner, glm::vec3 edge1, glm::vec3 edge2) {
  Mesh mesh;
  mesh.positions = {corner, corner + edge1, corner + edge1 + edge2, corner + edge2};
  mesh.uvs = {{0.0f, 0.0f}, {1.0f, 0.0f}, {1.0f, 1.0f}, {0.0f, 1.0f}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.parallelogram = true;
  return mesh;
}

inline int add_material(Scene& scene, Material material) {
  scene.materials.push_back(std::move(material));
  return int(scene.materials.size()) - 1;
}

inline Material diffuse(float albedo) {
  Material material;
  material.kind = Diffuse{{glm::vec3(albedo)}};
  return material;
}

template <class Geometry>
Shape& add_shape(Scene& scene, Geometry geometry, Material material) {
  Shape shape;
  shape.geometry = std::move(geometry);
  shape.material = add_material(scene, std::move(material));
  scene.shapes.push_back(std::move(shape));
  return scene.shapes.back();
}

/// The same, with the first texture of the scene.
inline Material textured_diffuse() {
  Material material;
  material.kind = Diffuse{{.texture = 0}};
  return material;
}

/// A metal that reflects everything.
inline Material perfect_mirror() {
  Material material;
  material.kind = Conductor{};
  return material;
}

inline Material glass(float ior) {
  Material material;
  material.kind = Dielectric{.ior = ior};
  return material;
}

/// A black shape that emits the same radiance in all three channels.
template <class Geometry>
Shape& add_light(Scene& scene, Geometry geometry, float radiance) {
  Shape& shape = add_shape(scene, std::move(geometry), diffuse(0.0f));
  shape.emits = true;
  shape.radiance.value = glm::vec3(radiance);
  return shape;
}

/// A pinhole that sees next to nothing but the point ahead: at 0.01 degrees all rays are one.
inline Camera pinhole(glm::vec3 origin, glm::vec3 target, glm::vec3 up, float fov = 0.01f) {
  Camera camera;
  camera.origin = origin;
  camera.forward = glm::normalize(target - origin);
  camera.right = glm::normalize(glm::cross(camera.forward, up));
  camera.up = glm::cross(camera.right, camera.forward);
  camera.fov = fov;
  return camera;
}

/// Mean and spread of the green channel over `batches` batches of `batch` samples. Samples of one
/// pixel are stratified, so that they are not independent; batches with seeds of their own are.
inline Moments measure(const TraceScene& scene, RenderSettings settings, int x, int y, int batches,
                       int batch) {
  const CameraRays camera(settings.camera, settings.width, settings.height);
  std::vector<glm::vec3> samples(std::size_t(batch), glm::vec3(0.0f));
  Moments moments;
  for (int i = 0; i < batches; ++i) {
    integrator(settings.integrator).trace(scene, settings, camera, x, y, 0, samples);
    double sum = 0.0;
    for (const glm::vec3& sample : samples) {
      sum += double(sample.y);
    }
    moments.add(sum / batch);
    ++settings.seed;
  }
  return moments;
}

/// A scene file written for one test.
inline Scene scene_from_xml(std::string_view body) {
  const std::string name =
      std::string("quartet_") + testing::UnitTest::GetInstance()->current_test_info()->name();
  const std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) / (name + std::to_string(getpid()) + ".xml");
  std::ofstream(path) << "<scene version=\"3.0.0\">" << body << "</scene>";
  Scene scene;
  try {
    scene = load_scene(path);
  } catch (...) {
    std::filesystem::remove(path);
    throw;
  }
  std::filesystem::remove(path);
  return scene;
}

}  // namespace quartet::test
