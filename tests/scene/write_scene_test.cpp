#include "renderer/scene/write_scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/scene/hasher.h"
#include "renderer/scene/scene_hash.h"
#include "renderer/scene/xml/number.h"
#include "renderer/trace/integrator.h"
#include "tests/scene/scene_text.h"
#include "tests/trace/bits.h"

namespace quartet {
namespace {

using namespace test;

Scene read_back(const Scene& scene) {
  const TemporaryFolder folder;
  const std::vector<SceneFile> files = scene_files(scene, "written");
  for (const SceneFile& file : files) {
    folder.write(file.name, file.text);
  }
  return load_scene(folder.path() / files.front().name);
}

std::vector<glm::vec3> picture_of(const Scene& scene) {
  const TraceScene traced(scene);
  RenderSettings settings = default_settings(scene);
  settings.width = 40;
  settings.height = 30;
  const CameraRays camera(settings.camera, settings.width, settings.height);
  std::vector<glm::vec3> picture(std::size_t(settings.width * settings.height), glm::vec3(0.0f));
  std::vector<SampleJob> jobs;
  jobs.reserve(picture.size());
  for (int i = 0; i < settings.width * settings.height; ++i) {
    jobs.push_back({i % settings.width, i / settings.width, 0, {&picture[std::size_t(i)], 1}});
  }
  integrator(settings.integrator).trace_jobs(traced, settings, camera, jobs);
  return picture;
}

/// A hash of it, in which what is 0 but for rounding is 0: where a wall begins at 278 − 278, its
/// corner may stand 10⁻¹⁴ beside it, on either side, and no picture shows that.
std::uint64_t state_of(Shape shape) {
  if (Mesh* mesh = std::get_if<Mesh>(&shape.geometry)) {
    for (glm::vec3& position : mesh->positions) {
      for (int c = 0; c < 3; ++c) {
        position[c] = std::abs(position[c]) < 1e-12f ? 0.0f : position[c];
      }
    }
  }
  Hasher hasher;
  hasher.add(shape);
  return hasher.state();
}

void expect_same(const Scene& scene, const Scene& written) {
  EXPECT_TRUE(written.camera == scene.camera);
  EXPECT_EQ(written.width, scene.width);
  EXPECT_EQ(written.height, scene.height);
  EXPECT_EQ(written.max_depth, scene.max_depth);
  EXPECT_TRUE(written.warnings.empty()) << written.warnings.front();
  ASSERT_EQ(written.shapes.size(), scene.shapes.size());
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    EXPECT_EQ(written.shapes[i].id, scene.shapes[i].id);
    EXPECT_EQ(written.shapes[i].geometry.index(), scene.shapes[i].geometry.index());
  }
  const std::vector<glm::vec3> before = picture_of(scene);
  const std::vector<glm::vec3> after = picture_of(written);
  std::size_t different = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    different += bits(before[i]) != bits(after[i]);
  }
  EXPECT_EQ(different, 0u);
}

TEST(WriteScene, BuiltinScenesAreReadBackAsTheyWere) {
  for (const std::string& name : builtin_scenes()) {
    SCOPED_TRACE(name);
    const Scene scene = load_scene(find_scene(name));
    const Scene written = read_back(scene);
    expect_same(scene, written);
    for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
      EXPECT_EQ(state_of(written.shapes[i]), state_of(scene.shapes[i])) << scene.shapes[i].id;
    }
    ASSERT_EQ(written.materials.size(), scene.materials.size());
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
      EXPECT_EQ(written.materials[i].id, scene.materials[i].id);
      EXPECT_EQ(material_text(written.textures, written.materials[i]),
                material_text(scene.textures, scene.materials[i]));
    }
  }
}

TEST(WriteScene, EveryKindIsReadBackAsItWas) {
  const Scene scene = load_text(R"(<scene version="3.0.0">
    <integrator type="path"><integer name="max_depth" value="7"/></integrator>
    <sensor type="thinlens">
      <float name="fov" value="38.123"/><string name="fov_axis" value="diagonal"/>
      <float name="aperture_radius" value="0.1"/><float name="focus_distance" value="6.7"/>
      <transform name="to_world">
        <lookat origin="1.3, 2.1, 7.7" target="0.1, 0.3, 0.2" up="0.1, 1, 0.05"/>
      </transform>
      <film type="hdrfilm"><integer name="width" value="64"/><integer name="height" value="48"/></film>
    </sensor>
    <emitter type="constant"><rgb name="radiance" value="0.1, 0.2, 0.3"/></emitter>
    <emitter type="point"><point name="position" x="1.1" y="3.3" z="2.7"/>
      <rgb name="intensity" value="5, 4, 3"/></emitter>
    <texture type="checkerboard" id="board">
      <rgb name="color0" value="0.1, 0.2, 0.7"/><rgb name="color1" value="0.8"/>
      <transform name="to_uv"><scale x="3.3" y="1.7"/><rotate z="1" angle="33"/>
        <translate x="0.21" y="0.4"/></transform>
    </texture>
    <bsdf type="twosided" id="both"><bsdf type="diffuse">
      <ref name="reflectance" id="board"/></bsdf></bsdf>
    <bsdf type="roughconductor" id="gold"><string name="material" value="Au"/>
      <string name="distribution" value="ggx"/><float name="alpha" value="0.23"/></bsdf>
    <shape type="rectangle" id="floor"><transform name="to_world">
      <scale x="4.1" y="3.7"/><rotate x="1" y="0.13" angle="-89"/></transform><ref id="both"/></shape>
    <shape type="rectangle" id="lamp"><boolean name="flip_normals" value="true"/>
      <transform name="to_world"><scale x="0.7" y="0.4"/><rotate x="1" z="0.3" angle="-81"/>
        <translate x="0.33" y="2.9" z="-0.4"/></transform>
      <emitter type="area"><ref name="radiance" id="board"/></emitter></shape>
    <shape type="disk" id="disk"><transform name="to_world">
      <scale value="0.77"/><rotate x="0.3" y="1" z="0.2" angle="37"/>
      <translate x="-1.2" y="0.9" z="0.3"/></transform><ref id="both"/></shape>
    <shape type="sphere" id="ball"><float name="radius" value="0.63"/>
      <transform name="to_world"><rotate x="0.4" y="1" z="0.7" angle="61"/>
        <translate x="1.2" y="0.7" z="0.6"/></transform><ref id="both"/></shape>
    <shape type="sphere" id="glass"><point name="center" x="0.1" y="0.6" z="1.2"/>
      <float name="radius" value="0.37"/><bsdf type="dielectric">
      <rgb name="specular_transmittance" value="0.9, 0.95, 1"/></bsdf></shape>
    <shape type="cube" id="cube"><transform name="to_world">
      <scale x="-0.4" y="0.3" z="0.3"/><rotate y="1" angle="17"/>
      <translate x="-0.4" y="0.4" z="1.1"/></transform><ref id="gold"/></shape>
    <shape type="cube" id="mirror"><transform name="to_world">
      <scale x="0.2" y="0.3" z="0.4"/><translate x="2" y="0.4" z="-0.7"/></transform>
      <bsdf type="conductor"/></shape>
  </scene>)");
  ASSERT_TRUE(scene.warnings.empty()) << scene.warnings.front();
  expect_same(scene, read_back(scene));
}

TEST(WriteScene, SmoothMeshesKeepTheirNormals) {
  const TemporaryFolder folder;
  // A tent of odd angles, without normals of its own: the reader computes them.
  folder.write("tent.obj",
               "v 0 0 0\nv 1.3 0.1 0.2\nv 0.9 1.2 0.4\nv -0.2 1.1 -0.1\nv 0.5 0.6 0.77\n"
               "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.5 0.5\n"
               "f 1/1 2/2 5/5\nf 2/2 3/3 5/5\nf 3/3 4/4 5/5\nf 4/4 1/1 5/5\n");
  const Scene scene =
      load_scene(folder.write("scene.xml", scene_text(R"(<shape type="obj" id="tent">
    <string name="filename" value="tent.obj"/>
    <transform name="to_world"><rotate y="1" angle="17"/><translate z="-4" y="-0.5"/></transform>
  </shape>)")));
  const Mesh& mesh = mesh_of(scene);
  ASSERT_FALSE(mesh.normals.empty());
  const Scene written = read_back(scene);
  EXPECT_EQ(scene_hash(written), scene_hash(scene));
  expect_same(scene, written);
}

TEST(WriteScene, NamesMeshesAfterTheScene) {
  const Scene scene = load_scene(find_scene("cornell-checker"));
  const std::vector<SceneFile> files = scene_files(scene, "small");
  ASSERT_EQ(files.size(), 3u);
  EXPECT_EQ(files[0].name, "small.xml");
  EXPECT_EQ(files[1].name, "small-mesh-1.obj");
  EXPECT_NE(files[0].text.find("small-mesh-1.obj"), std::string::npos);
}

TEST(WriteScene, ExactTextIsReadBack) {
  for (const float value :
       {0.1f, 1.0f / 3.0f, 1e-30f, 3.4e38f, -0.0f, 16777216.0f, 7.038531e-26f}) {
    const auto read = parse_float(exact_text(value));
    ASSERT_TRUE(read) << exact_text(value);
    EXPECT_EQ(bits(glm::vec3(*read)), bits(glm::vec3(value))) << exact_text(value);
  }
  EXPECT_EQ(exact_text(0.1f), "0.1");
}

}  // namespace
}  // namespace quartet
