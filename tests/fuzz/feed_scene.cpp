#include <algorithm>
#include <array>
#include <memory>

#include "renderer/scene/load_scene.h"
#include "renderer/trace/integrator.h"
#include "renderer/trace/trace_scene.h"
#include "tests/fuzz/feed.h"
#include "tests/fuzz/mesh_promises.h"

namespace quartet {
namespace {

/// A pyramid that scenes can name, with uvs and without normals.
constexpr std::string_view mesh_text =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 1\nvt 0 0\nvt 1 0\nvt 1 1\n"
    "f 1/1 2/2 3/3 4/1\nf 1/1 2/2 5/3\nf 2/1 3/2 5/3\nf 3/1 4/2 5/3\nf 4/1 1/2 5/3\n";

/// "name=value" in each line.
SceneParameters parameters_of(std::string_view text) {
  SceneParameters parameters;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (const std::size_t equals = line.find('='); equals != 0 && equals < line.size()) {
      parameters[std::string(line.substr(0, equals))] = line.substr(equals + 1);
    }
  }
  return parameters;
}

void promise_color(const Scene& scene, const Color& color) {
  promise(color.texture == Color::no_texture ||
              (color.texture >= 0 && std::size_t(color.texture) < scene.textures.size()),
          "a colour has a texture that is not there");
  promise_finite(color.value, "a colour");
}

void promise_geometry(const Sphere& sphere) {
  promise_finite(sphere.center, "a sphere's centre");
  promise_finite({sphere.radius}, "a sphere's radius");
  promise(sphere.radius > 0.0f, "a sphere has no size");
}

void promise_geometry(const Disk& disk) {
  promise_finite(disk.center, "a disk's centre");
  promise_finite(disk.normal, "a disk's normal");
  promise_finite({disk.radius}, "a disk's radius");
  promise(disk.radius > 0.0f, "a disk has no size");
}

void promise_geometry(const Mesh& mesh) {
  promise(!mesh.triangles.empty(), "a mesh has no triangles");
  promise_mesh(mesh);
}

void promise_numbers(const Diffuse&) {
}

void promise_numbers(const Metal& metal) {
  promise_finite(metal.eta, "an index of refraction");
  promise_finite(metal.k, "an extinction");
}

void promise_numbers(const Conductor& conductor) {
  promise_numbers(conductor.metal);
}

void promise_numbers(const RoughConductor& conductor) {
  promise_numbers(conductor.metal);
  promise_finite({conductor.alpha}, "a roughness");
}

void promise_numbers(const Dielectric& dielectric) {
  promise_finite({dielectric.ior}, "an index of refraction");
}

void promise_numbers(const PointLight& light) {
  promise_finite(light.position, "a light's place");
  promise_finite(light.intensity, "a light's intensity");
}

void promise_numbers(const ConstantEnvironment& environment) {
  promise_finite(environment.radiance, "the environment");
}

void promise_camera(const Camera& camera) {
  promise_finite(camera.origin, "the camera's place");
  for (const glm::vec3 axis : {camera.right, camera.up, camera.forward}) {
    promise(std::abs(glm::length(axis) - 1.0f) < 1e-3f, "an axis of the camera is not of length 1");
  }
  promise_finite({camera.fov, camera.aperture_radius, camera.focus_distance}, "the camera");
  promise(camera.fov > 0.0f && camera.fov < 180.0f, "the field of view is none");
}

void promise_scene(const Scene& scene) {
  promise(scene.width > 0 && scene.height > 0, "the picture has no pixels");
  promise(scene.max_depth >= 1, "paths have no segments");
  promise_camera(scene.camera);
  std::visit([](const auto& kind) { promise_numbers(kind); }, scene.environment);
  for (const Shape& shape : scene.shapes) {
    promise(shape.material >= 0 && std::size_t(shape.material) < scene.materials.size(),
            "a shape has a material that is not there");
    promise_color(scene, shape.radiance);
    std::visit([](const auto& geometry) { promise_geometry(geometry); }, shape.geometry);
  }
  for (const Material& material : scene.materials) {
    std::visit(
        [&](const auto& kind) {
          for (const Color& color : kind.colors()) promise_color(scene, color);
          promise_numbers(kind);
        },
        material.kind);
  }
  for (const DeltaLight& light : scene.delta_lights) {
    std::visit([](const auto& kind) { promise_numbers(kind); }, light);
  }
  for (const std::string& warning : scene.warnings) {
    promise_message(warning, "scene.xml:");
  }
}

/// What was loaded must be possible to render: eight samples of a pixel.
void trace_a_pixel(const TraceScene& scene) {
  RenderSettings settings = default_settings(scene.scene());
  settings.max_depth = std::min(settings.max_depth, 4);
  const CameraRays camera(settings.camera, settings.width, settings.height);
  std::array<glm::vec3, 8> radiance;
  integrator(IntegratorId::mis)
      .trace(scene, settings, camera, settings.width / 2, settings.height / 2, 0, radiance);
}

}  // namespace

/// The input is a scene file and, behind a byte of 0, the parameters that it is loaded with.
/// A mesh that it can name, mesh.obj, lies beside it.
void feed_scene(std::string_view input) {
  static const std::filesystem::path mesh = scratch_file("mesh.obj", mesh_text);
  const std::string_view text = input.substr(0, input.find('\0'));
  const SceneParameters parameters =
      parameters_of(input.substr(std::min(text.size() + 1, input.size())));
  const std::filesystem::path path = scratch_file("scene.xml", text);
  Scene scene;
  if (succeeds<SceneError>("scene.xml", [&] { scene = load_scene(path, parameters); })) {
    promise_scene(scene);
    trace_a_pixel(TraceScene(std::move(scene)));
  }
}

}  // namespace quartet

QUARTET_FUZZ_ENTRY(quartet::feed_scene)
