#include "renderer/scene/limits.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cmath>

#include "renderer/base/cancel.h"
#include "renderer/base/excerpt.h"
#include "tests/scene/scene_text.h"

namespace quartet::test {
namespace {

// What a scene file can ask for is limited, and each limit names itself, with the line.

std::string repeated(std::string_view text, int count) {
  std::string result;
  for (int i = 0; i < count; ++i) result += text;
  return result;
}

std::string transformed(std::string_view shape, std::string_view operations) {
  return std::string("<shape type=\"")
      .append(shape)
      .append("\"><transform name=\"to_world\">")
      .append(operations)
      .append("</transform></shape>");
}

TEST(Limits, ShapesOfEveryKindAreNeitherTooFarNorTooSmall) {
  for (const std::string shape : {"rectangle", "cube", "sphere", "disk"}) {
    SCOPED_TRACE(shape);
    for (const std::string good : {R"(<scale value="1e-10"/>)", R"(<scale value="1e9"/>)",
                                   R"(<scale value="1e5"/><translate x="9e8"/>)"}) {
      EXPECT_NO_THROW(load_body(transformed(shape, good)));
    }
    expect_message(error_of(transformed(shape, R"(<scale value="2e9"/>)")), 2,
                   "each coordinate must be from -1000000000 to 1000000000");
    expect_message(error_of(transformed(shape, R"(<scale value="1e20"/><scale value="1e20"/>)")), 2,
                   "each coordinate must be from");
    expect_message(error_of(transformed(shape, R"(<translate z="3e18"/>)")), 2,
                   "each coordinate must be from");
    expect_message(error_of(transformed(shape, R"(<scale value="1e-11"/>)")), 2,
                   "must be at least 1e-10");
    expect_message(error_of(transformed(shape, R"(<scale value="1e-30"/>)")), 2,
                   "must be at least 1e-10");
    expect_message(error_of(transformed(shape, R"(<scale value="1e-3"/><translate y="5e4"/>)")), 2,
                   "which can be at most 65536 times as large");
  }
}

TEST(Limits, OperandsOfTransformsAreFiniteAndNotTooLarge) {
  for (const std::string operation :
       {R"(<scale value="1e31"/>)", R"(<translate x="-1e300"/>)", R"(<rotate y="1" angle="nan"/>)",
        R"(<scale value="0x10"/>)", R"(<translate x="+-1"/>)",
        R"(<lookat origin="0 0 inf" target="0 0 0"/>)",
        R"(<matrix value="1 0 0 0 1 0 0 0 1e400"/>)"}) {
    expect_message(error_of(transformed("cube", operation)), 2, "expected finite numbers");
  }
}

std::string seen(std::string_view type, std::string_view content) {
  return std::string("<scene version=\"3.0.0\">\n<sensor type=\"")
      .append(type)
      .append("\">")
      .append(content)
      .append("</sensor>")
      .append(sky)
      .append("</scene>");
}

TEST(Limits, CamerasOfSceneFiles) {
  const std::string fov = R"(<float name="fov" value="40"/>)";
  const auto at = [&](std::string_view place) {
    return seen("perspective", std::string(fov)
                                   .append(R"(<transform name="to_world">)")
                                   .append(place)
                                   .append("</transform>"));
  };
  EXPECT_NO_THROW(load_text(at(R"(<translate x="1e9"/>)")));
  for (const std::string place : {R"(<translate x="1.1e9"/>)", R"(<translate z="-2e18"/>)",
                                  R"(<lookat origin="0 1e20 0" target="1 0 0"/>)"}) {
    expect_message(error_of_text(at(place)), 2, "sensor 'perspective': origin is (");
  }
  for (const std::string angle : {"0.001", "179.95", "1e-30"}) {
    expect_message(
        error_of_text(seen("perspective", "<float name=\"fov\" value=\"" + angle + "\"/>")), 2,
        "must be between 0.01 and 179.9");
  }
  expect_message(
      error_of_text(seen("perspective", R"(<string name="focal_length" value="1e-9mm"/>)")), 2,
      "must be between 0.01 and 179.9");
  const auto lens = [&](std::string_view radius, std::string_view distance) {
    return seen("thinlens", fov + "<float name=\"aperture_radius\" value=\"" + std::string(radius) +
                                "\"/><float name=\"focus_distance\" value=\"" +
                                std::string(distance) + "\"/>");
  };
  expect_message(error_of_text(lens("1e30", "1")), 2, "aperture_radius is 1e+30, must be from 0");
  expect_message(error_of_text(lens("1", "1e30")), 2,
                 "focus_distance is 1e+30, must be from 1e-10");
  expect_message(error_of_text(lens("1", "1e-30")), 2,
                 "focus_distance is 1e-30, must be from 1e-10");
}

TEST(Limits, CamerasOfWhoeverElse) {
  const Camera good;
  EXPECT_EQ(camera_fault(good), "");
  const float nan = std::nanf("");
  const auto fault = [&](auto change) {
    Camera camera = good;
    change(camera);
    return camera_fault(camera);
  };
  EXPECT_EQ(fault([](Camera& c) { c.origin = {1e9f, -1e9f, 0.0f}; }), "");
  EXPECT_NE(fault([&](Camera& c) { c.origin.y = nan; }), "");
  EXPECT_NE(fault([](Camera& c) { c.origin.z = -2e9f; }), "");
  EXPECT_NE(fault([&](Camera& c) { c.up.x = nan; }), "");
  EXPECT_NE(fault([](Camera& c) { c.up *= 1.1f; }), "");
  EXPECT_NE(fault([](Camera& c) { c.up = c.right; }).find("right angles"), std::string::npos);
  EXPECT_NE(fault([&](Camera& c) { c.fov = nan; }), "");
  EXPECT_NE(fault([](Camera& c) { c.fov = 180.0f; }), "");
  EXPECT_NE(fault([&](Camera& c) { c.aperture_radius = nan; }), "");
  EXPECT_NE(fault([](Camera& c) { c.aperture_radius = -1.0f; }), "");
  EXPECT_NE(fault([](Camera& c) { c.focus_distance = 0.0f; }), "");
}

TEST(Limits, Pictures) {
  EXPECT_EQ(picture_size_fault(1, 65536), "");
  EXPECT_EQ(picture_size_fault(16384, 16384), "");
  EXPECT_NE(picture_size_fault(0, 1), "");
  EXPECT_NE(picture_size_fault(65537, 1).find("from 1 to 65536"), std::string::npos);
  EXPECT_NE(picture_size_fault(16385, 16384).find("at most 268435456 pixels"), std::string::npos);
  expect_message(
      error_of_text(seen("perspective",
                         "<float name=\"fov\" value=\"40\"/>\n<film type=\"hdrfilm\"><integer "
                         "name=\"width\" value=\"2147483647\"/></film>")),
      3, "a picture of 2147483647 x 576 pixels");
}

TEST(Limits, LightsAreNeitherTooBrightNorTooDim) {
  const auto area = [](std::string_view value) {
    return std::string(R"(<shape type="sphere"><emitter type="area"><rgb name="radiance" value=")")
        .append(value)
        .append(R"("/></emitter></shape>)");
  };
  const auto point = [](std::string_view value) {
    return std::string(R"(<emitter type="point"><rgb name="intensity" value=")")
        .append(value)
        .append(R"("/></emitter>)");
  };
  for (const std::string good : {"1e-18", "1e18", "1 1e-30 0"}) {
    EXPECT_NO_THROW(load_body(area(good)));
  }
  EXPECT_NO_THROW(load_body(point("1e-30")));
  EXPECT_NO_THROW(load_body(point("1e30")));
  expect_message(error_of(area("1e19")), 2, "at most 1e+18 is possible");
  expect_message(error_of(area("1e-19")), 2, "at least 1e-18");
  expect_message(error_of(area("1e39")), 2, "expected finite numbers");
  expect_message(error_of(point("0 2e30 0")), 2, "at most 1e+30 is possible");
  expect_message(error_of(point("1e-31")), 2, "at least 1e-30");
  expect_message(error_of(R"(<emitter type="point"><point name="position" x="1e30"/></emitter>)"),
                 2, "each coordinate must be from");
  expect_message(error_of(R"(<emitter type="point"><point name="position" x="1e39"/></emitter>)"),
                 2, "expected finite numbers from -1e+30 to 1e+30");
  expect_message(error_of(R"(<emitter type="point"><transform name="to_world">
                             <translate y="2e9"/></transform></emitter>)"),
                 2, "each coordinate must be from");
}

TEST(Limits, Materials) {
  const auto error = [](std::string_view type, std::string_view property) {
    return error_of(std::string("<shape type=\"cube\"><bsdf type=\"")
                        .append(type)
                        .append("\">")
                        .append(property)
                        .append("</bsdf></shape>"));
  };
  expect_message(error("diffuse", R"(<rgb name="reflectance" value="1001"/>)"), 2,
                 "at most 1000 is possible");
  expect_message(error("conductor", R"(<rgb name="eta" value="1e5"/>)"), 2,
                 "at most 10000 is possible");
  expect_message(error("conductor", R"(<rgb name="k" value="1e20"/>)"), 2,
                 "at most 10000 is possible");
  expect_message(error("roughconductor", R"(<float name="alpha" value="1e20"/>)"), 2,
                 "at most 100 is possible");
  expect_message(error("dielectric", R"(<float name="int_ior" value="1e-30"/>)"), 2,
                 "must be from 0.01 to 100");
  expect_message(error("dielectric", R"(<float name="int_ior" value="50"/>
                                        <float name="ext_ior" value="0.1"/>)"),
                 2, "int_ior over ext_ior");
  expect_message(error("diffuse", R"(<texture type="checkerboard" name="reflectance">
      <transform name="to_uv"><scale value="1e20"/></transform></texture>)"),
                 2, "at most 1000000 is possible");
}

TEST(Limits, ElementsDoNotStandTooDeep) {
  const auto nested = [](int depth) {
    return repeated("<bsdf type=\"diffuse\">", depth) + repeated("</bsdf>", depth);
  };
  EXPECT_NO_THROW(load_body(nested(256)));
  expect_message(error_of(nested(257)), 2, "more than 256 elements deep");
  expect_message(error_of(nested(100'000)), 2, "more than 256 elements deep");
}

TEST(Limits, ReferencesInACircleAreErrorsOfEveryKind) {
  expect_message(error_of(R"(<integrator type="aov" id="a"><ref id="a"/></integrator>)"), 2,
                 "refers to itself");
  expect_message(error_of(R"(<integrator type="aov" id="a"><ref id="b"/></integrator>
<integrator type="aov" id="b"><ref id="a"/></integrator>)"),
                 2, "refers to itself");
  expect_message(error_of(R"(<bsdf type="twosided" id="a"><ref id="a"/></bsdf>
<shape type="cube"><ref id="a"/></shape>)"),
                 2, "refers to itself");
  expect_message(error_of(R"(<texture type="checkerboard" id="a"><ref name="color0" id="a"/>
</texture><shape type="cube"><bsdf type="diffuse"><ref name="reflectance" id="a"/></bsdf></shape>)"),
                 2, "refers to itself");
}

/// Elements of which each refers to the next, `times` times.
std::string chain(std::string_view before, std::string_view after, int length, int times) {
  std::string text;
  for (int i = 0; i < length; ++i) {
    text.append(before).append(" id=\"n").append(std::to_string(i)).append("\">");
    for (int k = 0; i + 1 < length && k < times; ++k) {
      text +=
          "<ref name=\"color" + std::to_string(k) + "\" id=\"n" + std::to_string(i + 1) + "\"/>";
    }
    text.append(after);
  }
  return text;
}

TEST(Limits, ReferencesInPairsDoNotMultiply) {
  // Each of 60 leads to the next twice: 2^60 ways.
  EXPECT_NO_THROW(load_body(chain("<integrator type=\"aov\"", "</integrator>", 60, 2)));
  const std::string board =
      "<shape type=\"cube\"><bsdf type=\"diffuse\"><ref name=\"reflectance\" "
      "id=\"n0\"/></bsdf></shape>";
  EXPECT_NO_THROW(load_body(chain("<texture type=\"checkerboard\"", "</texture>", 60, 2) + board));
}

TEST(Limits, ReferencesDoNotLeadOnWithoutEnd) {
  const std::string end = "<bsdf type=\"diffuse\"/></bsdf>";
  expect_message(error_of(chain("<integrator type=\"aov\"", "</integrator>", 300, 1)), 2,
                 "more than 256 times");
  expect_message(error_of(chain("<bsdf type=\"twosided\"", end, 300, 1) +
                          "<shape type=\"cube\"><ref id=\"n0\"/></shape>"),
                 2, "more than 256 times");
}

TEST(Limits, ManyReferencesToMuchAreTooMany) {
  // 3000 shapes that share a light of 3000 properties would read nine million.
  const std::string light = "<emitter type=\"area\" id=\"l\">" +
                            repeated("<float name=\"sampling_weight\" value=\"1\"/>", 3000) +
                            "</emitter>";
  expect_message(error_of(light + repeated("<shape type=\"sphere\"><ref id=\"l\"/></shape>", 3000)),
                 2, "lead to more than 8000000 elements");
}

TEST(Limits, ParametersDoNotGrow) {
  std::string bomb = "<default name=\"a0\" value=\"" + std::string(16, 'x') + "\"/>\n";
  for (int i = 1; i < 10; ++i) {
    bomb += "<default name=\"a" + std::to_string(i) + "\" value=\"" +
            repeated("$a" + std::to_string(i - 1), 16) + "\"/>\n";
  }
  expect_message(error_of(bomb), 6, "a value with '$a3' in it grows beyond 65536 bytes");
  // Each value is small enough, all together are not.
  const std::string large = "<default name=\"a\" value=\"" + std::string(60'000, 'x') + "\"/>\n";
  expect_message(error_of(large + repeated("<bsdf type=\"$a\"/>\n", 300)), 282,
                 "more than 16777216 bytes together");
}

TEST(Limits, ManyParametersAreFoundFast) {
  // Looked for one after the other, they would take 400 million comparisons.
  std::string text;
  for (int i = 0; i < 20'000; ++i) {
    text += "<default name=\"p" + std::to_string(i) + "\" value=\"1\"/><bsdf id=\"b$p" +
            std::to_string(i) + "-" + std::to_string(i) + "\"/>";
  }
  EXPECT_NO_THROW(load_body(text));
  expect_message(error_of("<default name=\"" + std::string(65, 'n') + "\" value=\"1\"/>"), 2,
                 "has 65 bytes, at most 64 are possible");
}

TEST(Limits, ManyChildrenTakeLinearTimeAndWarnAThousandTimes) {
  std::string text = "<shape type=\"cube\">\n";
  for (int i = 0; i < 50'000; ++i) {
    text += "<float name=\"p" + std::to_string(i) + "\" value=\"1\"/>\n";
  }
  const Scene scene = load_body(text + "</shape>");
  ASSERT_EQ(scene.warnings.size(), most_warnings + 1);
  expect_message(scene.warnings.back(), 1003, "more than 1000 warnings, the rest is not shown");
}

TEST(Limits, ElementsAreCounted) {
  const std::string error = error_of(repeated("<a/>", 1'000'001));
  EXPECT_NE(error.find("elements, at most 1000000 are possible"), std::string::npos) << error;
}

TEST(Limits, ListsOfNamesAreCut) {
  std::string text;
  for (int i = 0; i < 3000; ++i) text += "<bsdf id=\"m" + std::to_string(i) + "\"/>";
  expect_message(error_of(text + "\n<shape type=\"cube\"><ref id=\"none\"/></shape>"), 3,
                 " and 2980 more)");
}

TEST(SceneMessages, ShowTheBeginningOfWhatIsLong) {
  EXPECT_EQ(excerpt("plain, grün and \x1b[31m"), "plain, grün and \\x1b[31m");
  EXPECT_EQ(excerpt(std::string(100, 'x')), std::string(80, 'x') + "... (20 bytes more)");
  EXPECT_EQ(excerpt("ab\xc3\xbc", 3), "ab... (2 bytes more)") << "not in the middle of a letter";
}

TEST(SceneMessages, AreOneSafeLine) {
  const std::string steer = "\x1b]0;x\x07&#27;[2J&#10;\xc2\x9b";
  const auto expect_safe = [](const std::string& message) {
    for (const char c : message) {
      EXPECT_FALSE(static_cast<unsigned char>(c) < 0x20 || c == 0x7f) << message;
    }
    EXPECT_EQ(message.find("\xc2\x9b"), std::string::npos) << message;
    EXPECT_NE(message.find("\\x1b"), std::string::npos) << message;
  };
  for (const std::string& body :
       {"<shape type=\"cube\"><ref id=\"" + steer + "\"/></shape>",
        "<shape type=\"sphere\"><float name=\"radius\" value=\"" + steer + "\"/></shape>",
        "<shape type=\"cube\"><transform name=\"to_world\"><scale value=\"" + steer +
            "\"/></transform></shape>",
        fmt::format("<bsdf id=\"{0}\"/><bsdf id=\"{0}\"/>", steer)}) {
    expect_safe(error_of(body));
  }
  const Scene scene =
      load_body("<shape type=\"" + steer + "\"/><shape type=\"cube\" id=\"" + steer +
                "\"/><shape type=\"cube\"><string name=\"" + steer + "\" value=\"\"/></shape>");
  ASSERT_EQ(scene.warnings.size(), 2u);
  expect_safe(scene.warnings[0]);
  expect_safe(scene.warnings[1]);
  expect_safe(scene.shapes.at(0).id);
}

TEST(SceneFile, PipesDevicesAndOtherEncodingsAreErrors) {
  const TemporaryFolder folder;
  const std::filesystem::path pipe = folder.path() / "pipe.xml";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::filesystem::path& path : {pipe, std::filesystem::path("/dev/zero")}) {
    try {
      load_scene(path);
      ADD_FAILURE() << path;
    } catch (const SceneError& error) {
      EXPECT_NE(std::string(error.what()).find("a regular file would be right"), std::string::npos)
          << error.what();
    }
  }
  const std::string body =
      "<shape type=\"obj\"><string name=\"filename\" value=\"" + pipe.string() + "\"/></shape>";
  expect_message(error_of(body), 2, "a regular file would be right");
  expect_message(error_of_text(std::string("<scene version=\"3.0.0\">\n\0</scene>", 33)), 2,
                 "expected XML in UTF-8");
  EXPECT_NO_THROW(load_text("\xef\xbb\xbf" + scene_text("")));
}

TEST(SceneFile, CanBeCancelledWhileItIsRead) {
  const TemporaryFolder folder;
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(load_scene(folder.write("scene.xml", scene_text("")), {}, stop.get_token()),
               Cancelled);
}

TEST(SceneLimits, PointLightsThatFewSamplesChooseAreNamed) {
  const auto warnings = [](std::string_view other) {
    return load_body(
               std::string(R"(<emitter type="point"><rgb name="intensity" value="1"/></emitter>
<emitter type="point"><rgb name="intensity" value=")") +
               std::string(other) + R"("/></emitter>)")
        .warnings;
  };
  EXPECT_TRUE(warnings("60000").empty());
  ASSERT_EQ(warnings("70000").size(), 1u);
  EXPECT_NE(warnings("70000")[0].find("scene.xml:2: a point light with 1.4e-05 of the power"),
            std::string::npos)
      << warnings("70000")[0];
}

}  // namespace
}  // namespace quartet::test
