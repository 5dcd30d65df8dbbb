#include <algorithm>
#include <array>
#include <cmath>

#include "tests/scene/scene_text.h"

namespace quartet::test {
namespace {

TEST(BuiltinScenes, AreFoundByAnyOfTheirNames) {
  const std::vector<std::string> names = builtin_scenes();
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  for (const std::string name : {"cornell-box", "cornell-checker", "failures/rare-light", "furnace",
                                 "thin-lens", "veach-plates"}) {
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
    const auto path = std::filesystem::path(QUARTET_SCENES_DIR) / (name + ".xml");
    EXPECT_EQ(find_scene(name), path);
    EXPECT_TRUE(std::filesystem::equivalent(find_scene("scenes/" + name + ".xml"), path));
    EXPECT_EQ(find_scene(path.string()), path);
  }
  try {
    find_scene("cornel-box");
    ADD_FAILURE();
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("cornel-box: no such scene"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("cornell-box, cornell-checker"), std::string::npos);
  }
}

TEST(BuiltinScenes, AFileOfThatNameComesFirst) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.write("furnace", scene_text(""));
  EXPECT_EQ(find_scene(path.string()), path);
  EXPECT_THROW(find_scene(folder.path().string()), SceneError);
}

TEST(BuiltinScenes, LoadWithoutWarningsAndSayWhatTheyAreFor) {
  for (const std::string& name : builtin_scenes()) {
    const Scene scene = open_scene(name);
    EXPECT_EQ(scene.name, name);
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    for (const Shape& shape : scene.shapes) EXPECT_FALSE(shape.id.empty()) << name;
    std::ifstream file(find_scene(name));
    std::string line;
    std::getline(file, line);
    std::getline(file, line);
    EXPECT_TRUE(line.starts_with("<!-- ")) << name;
  }
}

/// Camera space of a point: x and y in the picture, in units of the tangent of the angle.
glm::vec2 project(const Camera& camera, const glm::vec3& point) {
  const glm::vec3 d = point - camera.origin;
  const float z = glm::dot(d, camera.forward);
  return {glm::dot(d, camera.right) / z, glm::dot(d, camera.up) / z};
}

glm::vec3 checker_color(const Checkerboard& board, const glm::vec2& uv) {
  const glm::vec3 t = board.to_uv * glm::vec3(uv, 1.0f);
  const bool u = t.x - std::floor(t.x) > 0.5f;
  const bool v = t.y - std::floor(t.y) > 0.5f;
  return u == v ? board.color0 : board.color1;
}

TEST(CornellChecker, CameraHasXToTheRight) {
  const Scene scene = load_scene(find_scene("cornell-checker"));
  expect_near(scene.camera.origin, {278, 273, -800}, 1e-4f);
  expect_near(scene.camera.right, {1, 0, 0});
  expect_near(scene.camera.up, {0, 1, 0});
  expect_near(scene.camera.forward, {0, 0, 1});
  EXPECT_EQ(scene.camera.fov_axis, FovAxis::y);
  EXPECT_NEAR(std::tan(glm::radians(0.5f * scene.camera.fov)), 1.0f / 3.0f, 1e-6f);
  EXPECT_EQ(scene.camera.aperture_radius, 0.0f);
  EXPECT_EQ(scene.width, 960);
  EXPECT_EQ(scene.height, 540);
  EXPECT_FALSE(shines(scene.environment));
  // The glass ball stands on the right, the mirror ball on the left.
  EXPECT_GT(project(scene.camera, {400, 150, 250}).x, 0.0f);
  EXPECT_LT(project(scene.camera, {185, 225, 168.5f}).x, 0.0f);
}

TEST(CornellChecker, SquaresOf70StartDarkInTheLowerLeftOfThePicture) {
  const Scene scene = load_scene(find_scene("cornell-checker"));
  const Shape& wall = shape_of(scene, "back-wall");
  const Mesh& mesh = std::get<Mesh>(wall.geometry);
  const int texture = kind_of<Diffuse>(scene, wall).reflectance.texture;
  const auto& board = std::get<Checkerboard>(scene.textures.at(std::size_t(texture)));
  expect_near(front(mesh), {0, 0, -1});

  // uv is affine on the parallelogram: corner 0, and the edges to corners 1 and 3.
  const glm::vec3 edge1 = mesh.positions[1] - mesh.positions[0];
  const glm::vec3 edge3 = mesh.positions[3] - mesh.positions[0];
  const auto color_at = [&](float x, float y) {
    const glm::vec3 d = glm::vec3(x, y, 559.2f) - mesh.positions[0];
    const float a = glm::dot(d, edge1) / glm::dot(edge1, edge1);
    const float b = glm::dot(d, edge3) / glm::dot(edge3, edge3);
    return checker_color(
        board, mesh.uvs[0] + a * (mesh.uvs[1] - mesh.uvs[0]) + b * (mesh.uvs[3] - mesh.uvs[0]));
  };
  for (int column = 0; column < 8; ++column) {
    for (int row = 0; row < 8; ++row) {
      const float expected = (column + row) % 2 == 0 ? 0.353f : 0.706f;
      // Just inside the square's corners, so that its edges are where they should be.
      for (const float x : {0.1f, 69.9f}) {
        for (const float y : {0.1f, 69.9f}) {
          const glm::vec2 p(70.0f * float(column) + x, 70.0f * float(row) + y);
          if (p.x > 556.0f || p.y > 548.8f) continue;
          EXPECT_EQ(color_at(p.x, p.y), glm::vec3(expected)) << p.x << ", " << p.y;
        }
      }
    }
  }
  const glm::vec2 corner = project(scene.camera, {0, 0, 559.2f});
  EXPECT_LT(corner.x, 0.0f);
  EXPECT_LT(corner.y, 0.0f);
}

struct Wall {
  std::string_view id;
  glm::vec3 low, high, front, reflectance;
};

TEST(CornellChecker, WallsBoxAndLightsAreWhereTheReportHasThem) {
  const Scene scene = load_scene(find_scene("cornell-checker"));
  const glm::vec3 white(0.706f);
  const glm::vec3 black(0.0f);
  const std::array walls = {
      Wall{"floor", {0, 0, 0}, {556, 0, 559.2f}, {0, 1, 0}, white},
      Wall{"ceiling", {0, 548.8f, 0}, {556, 548.8f, 559.2f}, {0, -1, 0}, white},
      Wall{"back-wall", {0, 0, 559.2f}, {556, 548.8f, 559.2f}, {0, 0, -1}, black},
      Wall{"green-wall", {0, 0, 0}, {0, 548.8f, 559.2f}, {1, 0, 0}, {0.05f, 0.706f, 0.05f}},
      Wall{"red-wall", {556, 0, 0}, {556, 548.8f, 559.2f}, {-1, 0, 0}, {0.706f, 0.05f, 0.05f}},
      Wall{"light", {213, 548.8f, 227}, {343, 548.8f, 332}, {0, -1, 0}, black},
      Wall{"light-behind", {228, 223, -810}, {328, 323, -810}, {0, 0, 1}, black},
  };
  for (const Wall& wall : walls) {
    SCOPED_TRACE(wall.id);
    const Shape& shape = shape_of(scene, wall.id);
    const Mesh& mesh = std::get<Mesh>(shape.geometry);
    glm::vec3 low(1e9f);
    glm::vec3 high(-1e9f);
    for (const glm::vec3& p : mesh.positions) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    expect_near(low, wall.low, 1e-4f);
    expect_near(high, wall.high, 1e-4f);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) expect_near(front(mesh, i), wall.front);
    const Color& reflectance = kind_of<Diffuse>(scene, shape).reflectance;
    if (!reflectance.is_textured()) {
      EXPECT_EQ(reflectance.value, wall.reflectance);
    }
    const bool is_light = wall.id.starts_with("light");
    EXPECT_EQ(shape.emits, is_light);
    if (is_light) {
      EXPECT_EQ(shape.radiance.value, glm::vec3(60.0f));
    }
  }
}

TEST(CornellChecker, TheCeilingLeavesOutExactlyItsLight) {
  const Scene scene = load_scene(find_scene("cornell-checker"));
  const auto area = [&](std::string_view id) {
    const Mesh& mesh = std::get<Mesh>(shape_of(scene, id).geometry);
    double sum = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
      sum += 0.5 * double(glm::length(glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                                 mesh.positions[t.z] - mesh.positions[t.x])));
    }
    return sum;
  };
  EXPECT_NEAR(area("ceiling"), 556.0 * 559.2 - 130.0 * 105.0, 0.5);
  EXPECT_NEAR(area("light"), 130.0 * 105.0, 0.01);
}

TEST(CornellChecker, BoxAndBalls) {
  const Scene scene = load_scene(find_scene("cornell-checker"));
  const Mesh& box = std::get<Mesh>(shape_of(scene, "box").geometry);
  for (const glm::vec2 top : {glm::vec2(82, 225), {240, 272}, {288, 112}, {130, 65}}) {
    for (const float y : {0.0f, 165.0f}) {
      EXPECT_NE(std::find(box.positions.begin(), box.positions.end(), glm::vec3(top.x, y, top.y)),
                box.positions.end());
    }
  }
  EXPECT_EQ(box.positions.size(), 8u);
  ASSERT_EQ(box.triangles.size(), 10u);
  const glm::vec3 middle(185, 82.5f, 168.5f);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_GT(glm::dot(front(box, i), box.positions[box.triangles[i].x] - middle), 0.0f);
  }
  const Shape& glass = shape_of(scene, "glass-ball");
  expect_near(std::get<Sphere>(glass.geometry).center, {400, 150, 250});
  EXPECT_EQ(std::get<Sphere>(glass.geometry).radius, 100.0f);
  EXPECT_FLOAT_EQ(kind_of<Dielectric>(scene, glass).ior, 1.517f);
  const Shape& mirror = shape_of(scene, "mirror-ball");
  expect_near(std::get<Sphere>(mirror.geometry).center, {185, 225, 168.5f});
  EXPECT_EQ(std::get<Sphere>(mirror.geometry).radius, 60.0f);
  const Metal& metal = kind_of<Conductor>(scene, mirror).metal;
  EXPECT_EQ(metal.eta, glm::vec3(0.0f));
  EXPECT_EQ(metal.reflectance.value, glm::vec3(1.0f));
}

TEST(CornellBox, RedIsLeftAndGreenRight) {
  const Scene scene = load_scene(find_scene("cornell-box"));
  EXPECT_EQ(scene.width, scene.height);
  EXPECT_GT(kind_of<Diffuse>(scene, shape_of(scene, "left-wall")).reflectance.value.x, 0.6f);
  EXPECT_LT(project(scene.camera, {552, 270, 280}).x, 0.0f);
  EXPECT_GT(project(scene.camera, {0, 270, 280}).x, 0.0f);
  EXPECT_NEAR(std::tan(glm::radians(0.5f * scene.camera.fov)), 12.5f / 35.0f, 1e-6f);
  const glm::vec3 middle(278, 274, 280);
  for (const std::string_view id : {"floor-and-back", "left-wall", "right-wall", "ceiling"}) {
    const Mesh& mesh = std::get<Mesh>(shape_of(scene, id).geometry);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      EXPECT_GT(glm::dot(front(mesh, i), middle - mesh.positions[mesh.triangles[i].x]), 0.0f) << id;
    }
  }
}

TEST(Furnace, AlbedoIsAParameter) {
  const auto scene = [](const SceneParameters& parameters) {
    return load_scene(find_scene("furnace"), parameters);
  };
  const auto albedo = [&](const SceneParameters& parameters) {
    const Scene furnace = scene(parameters);
    return kind_of<Diffuse>(furnace, furnace.shapes[0]).reflectance.value;
  };
  EXPECT_EQ(albedo({}), glm::vec3(0.5f));
  EXPECT_EQ(albedo({{"albedo", "0.8"}}), glm::vec3(0.8f));
  EXPECT_TRUE(std::get<Sphere>(scene({}).shapes[0].geometry).flip_normals);
  EXPECT_TRUE(scene({}).shapes[0].emits);
}

TEST(VeachPlates, EachPlateMirrorsTheRowOfLightsToTheCamera) {
  const Scene scene = load_scene(find_scene("veach-plates"));
  float alpha = 0.0f;
  for (const std::string_view id :
       {"plate-smooth", "plate-glossy", "plate-rough", "plate-rougher"}) {
    const Shape& plate = shape_of(scene, id);
    const Mesh& mesh = std::get<Mesh>(plate.geometry);
    const glm::vec3 center = 0.5f * (mesh.positions[0] + mesh.positions[2]);
    const glm::vec3 view = glm::normalize(center - scene.camera.origin);
    const glm::vec3 reflected = glm::reflect(view, front(mesh));
    expect_near(reflected, glm::normalize(glm::vec3(0.0f, 5.2f, -2.2f) - center), 1e-4f);
    const auto& material = kind_of<RoughConductor>(scene, plate);
    EXPECT_GT(material.alpha, alpha);
    alpha = material.alpha;
  }
  for (const std::string_view id : {"light-tiny", "light-small", "light-medium", "light-large"}) {
    const Shape& light = shape_of(scene, id);
    const float radius = std::get<Sphere>(light.geometry).radius;
    EXPECT_NEAR(light.radiance.value.x * radius * radius, 1.62f, 1e-4f);
  }
}

TEST(ThinLens, FocusesOnTheFrontOfTheMiddleSphere) {
  const Scene scene = load_scene(find_scene("thin-lens"));
  const auto& middle = std::get<Sphere>(shape_of(scene, "sphere-middle").geometry);
  EXPECT_GT(scene.camera.aperture_radius, 0.0f);
  EXPECT_NEAR(scene.camera.focus_distance,
              glm::length(middle.center - scene.camera.origin) - middle.radius, 0.02f);
  EXPECT_EQ(load_scene(find_scene("thin-lens"), {{"aperture", "0"}}).camera.aperture_radius, 0.0f);
}

}  // namespace
}  // namespace quartet::test
