#include <cmath>
#include <limits>

#include "tests/scene/scene_text.h"

namespace quartet::test {
namespace {

/// A scene file with this in it, and a light.
std::string lit(std::string_view body) {
  return std::string("<scene version=\"3.0.0\">\n").append(body).append(sky).append("</scene>");
}

std::string sensor_text(std::string_view type, std::string_view content) {
  return lit(std::string("<sensor type=\"")
                 .append(type)
                 .append("\">\n")
                 .append(content)
                 .append("</sensor>"));
}

Scene load_sensor(std::string_view type, std::string_view content) {
  return load_text(sensor_text(type, content));
}

constexpr std::string_view fov = R"(<float name="fov" value="40"/>)";

TEST(Sensor, LooksAlongZWithXToTheLeft) {
  const Camera camera = load_sensor("perspective", fov).camera;
  expect_near(camera.right, {-1, 0, 0});
  expect_near(camera.up, {0, 1, 0});
  expect_near(camera.forward, {0, 0, 1});
  EXPECT_EQ(camera.fov, 40.0f);
  EXPECT_EQ(camera.fov_axis, FovAxis::x);
  EXPECT_EQ(camera.aperture_radius, 0.0f);
}

TEST(Sensor, ScaleMirrorsButNeverStretches) {
  const Scene scene = load_sensor("perspective", std::string(fov) + R"(<transform name="to_world">
    <scale x="-5" y="2"/><lookat origin="1 2 3" target="1 2 9" up="0 1 0"/></transform>)");
  expect_near(scene.camera.origin, {1, 2, 3});
  expect_near(scene.camera.right, {1, 0, 0});
  expect_near(scene.camera.up, {0, 1, 0});
  expect_near(scene.camera.forward, {0, 0, 1});
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(Sensor, FovAxes) {
  const auto axis = [](std::string_view name) {
    return load_sensor("perspective", std::string(fov) + "<string name=\"fov_axis\" value=\"" +
                                          std::string(name) + "\"/>")
        .camera.fov_axis;
  };
  EXPECT_EQ(axis("x"), FovAxis::x);
  EXPECT_EQ(axis("y"), FovAxis::y);
  EXPECT_EQ(axis("diagonal"), FovAxis::diagonal);
  EXPECT_EQ(axis("smaller"), FovAxis::smaller);
  EXPECT_EQ(axis("larger"), FovAxis::larger);
}

TEST(Sensor, FocalLengthIsThatOf35mmFilm) {
  // A 35 mm frame is 36 × 24, its diagonal 43.267; 2 atan(43.267 / 100) = 46.793 degrees.
  const Camera camera = load_sensor("perspective", "").camera;
  EXPECT_NEAR(camera.fov, 46.793f, 1e-3f);
  EXPECT_EQ(camera.fov_axis, FovAxis::diagonal);
  const Camera wide =
      load_sensor("perspective", R"(<string name="focal_length" value="21.63331mm"/>)").camera;
  EXPECT_NEAR(wide.fov, 90.0f, 1e-3f);
}

TEST(Sensor, Thinlens) {
  const Camera camera =
      load_sensor("thinlens", std::string(fov) + R"(<float name="aperture_radius" value="0.5"/>
        <float name="focus_distance" value="7"/>)")
          .camera;
  EXPECT_EQ(camera.aperture_radius, 0.5f);
  EXPECT_EQ(camera.focus_distance, 7.0f);
  EXPECT_EQ(camera.fov, 40.0f);
}

TEST(Sensor, FilmAndSampler) {
  const Scene scene = load_sensor("perspective", std::string(fov) + R"(
    <sampler type="independent"><integer name="sample_count" value="16"/></sampler>
    <film type="hdrfilm"><integer name="width" value="320"/><integer name="height" value="200"/>
    <string name="pixel_format" value="rgb"/><rfilter type="box"/></film>
    <float name="near_clip" value="0.1"/><float name="far_clip" value="100"/>)");
  EXPECT_EQ(scene.width, 320);
  EXPECT_EQ(scene.height, 200);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(Sensor, Warnings) {
  expect_one_warning(
      load_sensor("perspective", std::string(fov) + "<film type=\"hdrfilm\">\n"
                                                    "<rfilter type=\"gaussian\"/></film>"),
      4, "'gaussian' becomes the box filter");
  expect_one_warning(
      load_sensor("perspective",
                  std::string(fov) + R"(<float name="principal_point_offset_x" value="0.1"/>)"),
      2, "principal_point_offset_x is left out");
  const Scene two = load_text(lit(std::string(sensor) + "\n" + std::string(sensor)));
  expect_one_warning(two, 3, "second sensor is left out");
  expect_one_warning(
      load_sensor("perspective", std::string(fov) + "<film type=\"hdrfilm\">\n"
                                                    "<integer name=\"crop_width\" value=\"3\"/>"
                                                    "</film>"),
      4, "property 'crop_width' of film 'hdrfilm'");
}

TEST(Sensor, Errors) {
  const auto error = [](std::string_view type, std::string_view content) {
    return error_of_text(sensor_text(type, content));
  };
  for (const std::string value : {"0", "-10", "180", "200"}) {
    expect_message(error("perspective", "<float name=\"fov\" value=\"" + value + "\"/>"), 2,
                   "must be between 0.01 and 179.9");
  }
  expect_message(error("perspective", R"(<float name="fov" value="abc"/>)"), 3,
                 "fov of sensor 'perspective' is 'abc', expected a finite number");
  expect_message(error("perspective", R"(<string name="fov" value="40"/>)"), 3,
                 "is a <string>, expected <float> or <integer>");
  expect_message(error("perspective", std::string(fov) + R"(<string name="fov_axis" value="z"/>)"),
                 2, "expected x, y, diagonal, smaller or larger");
  expect_message(
      error("perspective", std::string(fov) + R"(<string name="focal_length" value="50mm"/>)"), 2,
      "both fov and focal_length");
  expect_message(error("perspective", R"(<string name="focal_length" value="mm"/>)"), 2,
                 "focal_length is 'mm'");
  expect_message(error("perspective", std::string(fov) + R"(<transform name="to_world">
    <matrix value="1 0.5 0 0 1 0 0 0 1"/></transform>)"),
                 2, "shears");
  expect_message(error("perspective", R"(<film type="hdrfilm">
    <integer name="width" value="0"/></film>)"),
                 3, "a picture of 0 x 576 pixels, each side must be from 1 to 65536");
  expect_message(error("perspective", R"(<film type="hdrfilm">
<integer name="height" value="1.5"/></film>)"),
                 4, "'1.5', expected a whole number");
  expect_message(error("thinlens", fov), 2, "no aperture_radius");
  expect_message(error("thinlens", R"(<float name="aperture_radius" value="-1"/>)"), 2,
                 "aperture_radius is -1, must be from 0 to");
  expect_message(error("thinlens", R"(<float name="aperture_radius" value="1"/>
<float name="focus_distance" value="0"/>)"),
                 4, "focus_distance of sensor 'thinlens' is 0, must be above 0");
  expect_message(error("fisheye", ""), 2, "expected perspective or thinlens");
}

TEST(Integrator, Depth) {
  const auto depth = [](std::string_view value) {
    return load_body(std::string(R"(<integrator type="path"><integer name="max_depth" value=")")
                         .append(value)
                         .append("\"/></integrator>"))
        .max_depth;
  };
  EXPECT_EQ(depth("-1"), std::numeric_limits<int>::max());
  EXPECT_EQ(depth("1"), 1);
  EXPECT_EQ(depth("12"), 12);
  EXPECT_EQ(load_body("").max_depth, std::numeric_limits<int>::max());
  for (const std::string value : {"0", "-2"}) {
    expect_message(error_of("<integrator type=\"path\">\n<integer name=\"max_depth\" value=\"" +
                            value + "\"/></integrator>"),
                   2, "expected -1 (no limit) or at least 1");
  }
}

TEST(Integrator, OtherTypesOnlyWarn) {
  const Scene scene = load_body(R"(<integrator type="aov"><integrator type="path">
<integer name="max_depth" value="4"/><integer name="rr_depth" value="3"/></integrator></integrator>)");
  EXPECT_EQ(scene.max_depth, 4);
  expect_one_warning(scene, 2, "integrator 'aov' becomes a path tracer");
}

}  // namespace
}  // namespace quartet::test
