#include <cmath>

#include "tests/scene/scene_text.h"

namespace quartet::test {
namespace {

std::string with_bsdf(std::string_view bsdf) {
  return std::string("<shape type=\"cube\">\n").append(bsdf).append("</shape>");
}

Material material_of(const Scene& scene) {
  return scene.materials.at(std::size_t(scene.shapes.at(0).material));
}

glm::vec3 albedo_of(const Scene& scene) {
  return kind_of<Diffuse>(scene, scene.shapes.at(0)).reflectance.value;
}

template <class Kind>
Kind material(std::string_view bsdf) {
  const Scene scene = load_body(with_bsdf(bsdf));
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
  return kind_of<Kind>(scene, scene.shapes.at(0));
}

TEST(Material, DefaultIsDiffuseHalf) {
  const Scene scene = load_body("<shape type=\"cube\"/><shape type=\"cube\"/>");
  EXPECT_EQ(scene.materials.size(), 1u);
  EXPECT_EQ(albedo_of(scene), glm::vec3(0.5f));
  EXPECT_FALSE(material_of(scene).two_sided);
}

TEST(Material, ColorForms) {
  const auto reflectance = [](std::string_view slot) {
    return material<Diffuse>(std::string(R"(<bsdf type="diffuse">)").append(slot).append("</bsdf>"))
        .reflectance.value;
  };
  EXPECT_EQ(reflectance(R"(<rgb name="reflectance" value="0.1, 0.2, 0.3"/>)"),
            glm::vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(reflectance(R"(<rgb name="reflectance" value="0.1 0.2	0.3"/>)"),
            glm::vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(reflectance(R"(<rgb name="reflectance" value="0.25"/>)"), glm::vec3(0.25f));
  EXPECT_EQ(reflectance(R"(<spectrum name="reflectance" value="0.25"/>)"), glm::vec3(0.25f));
  EXPECT_EQ(reflectance(R"(<float name="reflectance" value="0.25"/>)"), glm::vec3(0.25f));
  // IEC 61966-2-1: code 188 of 255 is linear 0.502886, 0x80 is 0.215861, code 10 of 255 is linear
  // part: 10 / 255 / 12.92.
  expect_near(reflectance(R"(<rgb name="reflectance" value="#bc800a"/>)"),
              {0.502886f, 0.215861f, 10.0f / 255.0f / 12.92f}, 1e-5f);
}

TEST(Material, SpectrumByWavelengthBecomesItsMeanWithAWarning) {
  const Scene scene = load_body(with_bsdf(
      R"(<bsdf type="diffuse"><spectrum name="reflectance" value="400:0.2, 700:0.4"/></bsdf>)"));
  expect_near(albedo_of(scene), glm::vec3(0.3f));
  expect_one_warning(scene, 3, "by wavelength becomes grey");
}

TEST(Material, ReflectanceRange) {
  const auto body = [](std::string_view value) {
    return with_bsdf(std::string(R"(<bsdf type="diffuse"><rgb name="reflectance" value=")")
                         .append(value)
                         .append("\"/></bsdf>"));
  };
  expect_message(error_of(body("0.5 -0.1 0.5")), 3, "reflectance of bsdf 'diffuse' is negative");
  expect_message(error_of(body("abc")), 3, "'abc', expected finite numbers");
  expect_message(error_of(body("0.5 0.5")), 3, "expected 1 or 3 numbers or #rrggbb");
  expect_message(error_of(body("#12345")), 3, "expected finite numbers");
  expect_message(error_of(body("inf")), 3, "expected finite numbers");
  expect_message(error_of(body("1e39")), 3, "expected finite numbers");
  const Scene scene = load_body(body("1.5"));
  expect_one_warning(scene, 3, "above 1");
  EXPECT_EQ(albedo_of(scene), glm::vec3(1.5f));
}

TEST(Material, ConductorDefaultsToAPerfectMirror) {
  const Metal mirror = material<Conductor>(R"(<bsdf type="conductor"/>)").metal;
  EXPECT_EQ(mirror.eta, glm::vec3(0.0f));
  EXPECT_EQ(mirror.k, glm::vec3(1.0f));
  EXPECT_EQ(mirror.reflectance.value, glm::vec3(1.0f));
}

TEST(Material, ConductorByNameAndByNumbers) {
  const Metal copper =
      material<Conductor>(R"(<bsdf type="conductor"><string name="material" value="Cu"/></bsdf>)")
          .metal;
  expect_near(copper.eta, {0.200438f, 0.924033f, 1.10221f});
  expect_near(copper.k, {3.91295f, 2.45285f, 2.14219f});
  for (const std::string name : {"Ag", "Al", "Au", "Cr", "W", "none"}) {
    material<Conductor>(R"(<bsdf type="conductor"><string name="material" value=")" + name +
                        "\"/></bsdf>");
  }
  const Metal numbers =
      material<Conductor>(R"(<bsdf type="conductor"><rgb name="eta" value="1, 2, 3"/>
    <spectrum name="k" value="4"/><rgb name="specular_reflectance" value="0.3"/></bsdf>)")
          .metal;
  EXPECT_EQ(numbers.eta, glm::vec3(1, 2, 3));
  EXPECT_EQ(numbers.k, glm::vec3(4.0f));
  EXPECT_EQ(numbers.reflectance.value, glm::vec3(0.3f));
  expect_message(error_of(with_bsdf(
                     R"(<bsdf type="conductor"><string name="material" value="Gold"/></bsdf>)")),
                 3, "no metal is named 'Gold' (known: none, a-C, Ag, Al, Au");
  expect_message(error_of(with_bsdf(R"(<bsdf type="conductor"><rgb name="eta" value="1"/>
      <string name="material" value="Au"/></bsdf>)")),
                 3, "both material and eta or k");
}

TEST(Material, RoughConductorIsGgx) {
  const auto metal =
      material<RoughConductor>(R"(<bsdf type="roughconductor"><float name="alpha" value="0.3"/>
    <string name="distribution" value="ggx"/><boolean name="sample_visible" value="true"/></bsdf>)");
  EXPECT_FLOAT_EQ(metal.alpha, 0.3f);
}

TEST(Material, OtherLobesBecomeGgxWithAWarning) {
  const Scene beckmann = load_body(with_bsdf(R"(<bsdf type="roughconductor"/>)"));
  expect_one_warning(beckmann, 3, "'beckmann' becomes ggx");
  EXPECT_FLOAT_EQ(kind_of<RoughConductor>(beckmann, beckmann.shapes[0]).alpha, 0.1f);
  const Scene brushed = load_body(with_bsdf(R"(<bsdf type="roughconductor">
    <string name="distribution" value="ggx"/>
    <float name="alpha_u" value="0.1"/><float name="alpha_v" value="0.4"/></bsdf>)"));
  expect_one_warning(brushed, 3, "geometric mean");
  EXPECT_FLOAT_EQ(kind_of<RoughConductor>(brushed, brushed.shapes[0]).alpha, 0.2f);
  expect_message(
      error_of(with_bsdf(R"(<bsdf type="roughconductor"><float name="alpha" value="-1"/></bsdf>)")),
      3, "alpha of bsdf 'roughconductor' is negative");
}

TEST(Material, DielectricByNameAndNumber) {
  EXPECT_FLOAT_EQ(material<Dielectric>(R"(<bsdf type="dielectric"/>)").ior, 1.5046f / 1.000277f);
  const auto glass =
      material<Dielectric>(R"(<bsdf type="dielectric"><float name="int_ior" value="1.517"/>
    <float name="ext_ior" value="1"/><rgb name="specular_transmittance" value="0.9"/></bsdf>)");
  EXPECT_FLOAT_EQ(glass.ior, 1.517f);
  EXPECT_EQ(glass.transmittance.value, glm::vec3(0.9f));
  EXPECT_EQ(glass.reflectance.value, glm::vec3(1.0f));
  EXPECT_FLOAT_EQ(
      material<Dielectric>(R"(<bsdf type="dielectric"><string name="int_ior" value="Diamond"/>
    <string name="ext_ior" value="water"/></bsdf>)")
          .ior,
      2.419f / 1.333f);
  const auto body = [](std::string_view value) {
    return with_bsdf(std::string("<bsdf type=\"dielectric\">").append(value).append("</bsdf>"));
  };
  expect_message(error_of(body(R"(<string name="int_ior" value="jelly"/>)")), 3,
                 "expected a number or one of vacuum");
  expect_message(error_of(body(R"(<float name="int_ior" value="0"/>)")), 3, "must be above 0");
  expect_message(error_of(body(R"(<rgb name="int_ior" value="1"/>)")), 3,
                 "is a <rgb>, expected <float> or <string>");
}

TEST(Material, TwoSided) {
  const Scene scene = load_body(with_bsdf(R"(<bsdf type="twosided" id="both">
    <bsdf type="diffuse"><rgb name="reflectance" value="0.1"/></bsdf></bsdf>)"));
  EXPECT_TRUE(material_of(scene).two_sided);
  EXPECT_EQ(material_of(scene).id, "both");
  EXPECT_EQ(albedo_of(scene), glm::vec3(0.1f));
  EXPECT_EQ(scene.materials.size(), 1u);
  EXPECT_TRUE(scene.warnings.empty());
  const Scene two = load_body(with_bsdf(R"(<bsdf type="twosided"><bsdf type="diffuse"/>
    <bsdf type="conductor"/></bsdf>)"));
  expect_one_warning(two, 3, "the first one is used for both sides");
  EXPECT_TRUE(std::holds_alternative<Diffuse>(material_of(two).kind));
  expect_message(error_of(with_bsdf(R"(<bsdf type="twosided"><bsdf type="dielectric"/></bsdf>)")),
                 3, "twosided' around a dielectric");
  expect_message(error_of(with_bsdf(R"(<bsdf type="twosided"/>)")), 3, "holds no bsdf");
}

TEST(Material, UnknownTypeBecomesDiffuseHalf) {
  const Scene scene = load_body(with_bsdf(
      R"(<bsdf type="hair"><rgb name="reflectance" value="0.9"/><bsdf type="diffuse"/></bsdf>)"));
  expect_one_warning(scene, 3, "bsdf 'hair' is not known and becomes diffuse 0.5");
  EXPECT_EQ(albedo_of(scene), glm::vec3(0.5f));
}

TEST(Material, ReferencesWorkBeforeAndAfterTheDefinitionAndShareTheMaterial) {
  const Scene scene = load_body(R"(<shape type="cube"><ref id="paint"/></shape>
<bsdf type="diffuse" id="paint"><rgb name="reflectance" value="0.2"/></bsdf>
<shape type="cube"><ref id="paint"/></shape>
<shape type="cube"><bsdf type="twosided"><ref id="paint"/></bsdf></shape>)");
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.shapes[0].material, scene.shapes[1].material);
  EXPECT_EQ(albedo_of(scene), glm::vec3(0.2f));
  EXPECT_FALSE(material_of(scene).two_sided);
  EXPECT_TRUE(scene.materials[std::size_t(scene.shapes[2].material)].two_sided);
}

TEST(Material, ReferenceErrors) {
  expect_message(error_of(R"(<bsdf type="diffuse" id="a"/><bsdf type="diffuse" id="b"/>
<shape type="cube"><ref id="c"/></shape>)"),
                 3, "nothing has the id 'c' (ids: a, b)");
  expect_message(error_of(R"(<bsdf type="diffuse" id="a"/>
<bsdf type="diffuse" id="a"/>)"),
                 3, "id 'a' is already used in line 2");
  expect_message(error_of(R"(<bsdf type="twosided" id="a"><ref id="a"/></bsdf>
<shape type="cube"><ref id="a"/></shape>)"),
                 2, "refers to itself");
  expect_message(error_of(R"(<bsdf type="twosided" id="a"><ref id="b"/></bsdf>
<bsdf type="twosided" id="b"><ref id="a"/></bsdf>
<shape type="cube"><ref id="a"/></shape>)"),
                 2, "refers to itself");
}

TEST(Texture, CheckerboardOnAnyColorSlot) {
  const Scene scene = load_body(R"(<texture type="checkerboard" id="board">
<rgb name="color0" value="0.1"/><rgb name="color1" value="0.9"/>
<transform name="to_uv"><scale x="4" y="2"/><translate x="0.25"/></transform></texture>
<shape type="cube"><bsdf type="diffuse"><ref name="reflectance" id="board"/></bsdf></shape>
<shape type="cube"><bsdf type="conductor"><ref name="specular_reflectance" id="board"/></bsdf></shape>
<shape type="cube"><bsdf type="dielectric">
<texture name="specular_transmittance" type="checkerboard"/></bsdf></shape>)");
  EXPECT_TRUE(scene.warnings.empty());
  ASSERT_EQ(scene.textures.size(), 2u);
  EXPECT_EQ(kind_of<Diffuse>(scene, scene.shapes[0]).reflectance.texture, 0);
  EXPECT_EQ(kind_of<Conductor>(scene, scene.shapes[1]).metal.reflectance.texture, 0);
  EXPECT_EQ(kind_of<Dielectric>(scene, scene.shapes[2]).transmittance.texture, 1);
  const auto& board = std::get<Checkerboard>(scene.textures[0]);
  EXPECT_EQ(board.color0, glm::vec3(0.1f));
  EXPECT_EQ(board.color1, glm::vec3(0.9f));
  EXPECT_EQ(board.to_uv * glm::vec3(1, 1, 1), glm::vec3(4.25f, 2.0f, 1.0f));
  const auto& plain = std::get<Checkerboard>(scene.textures[1]);
  EXPECT_EQ(plain.color0, glm::vec3(0.4f));
  EXPECT_EQ(plain.color1, glm::vec3(0.2f));
}

TEST(Texture, UvTransformAsThreeByThreeMatrix) {
  const Scene scene = load_body(with_bsdf(R"(<bsdf type="diffuse">
<texture name="reflectance" type="checkerboard"><transform name="to_uv">
<matrix value="3 0 0.5  0 2 0.25  0 0 1"/></transform></texture></bsdf>)"));
  EXPECT_EQ(std::get<Checkerboard>(scene.textures[0]).to_uv * glm::vec3(1, 1, 1),
            glm::vec3(3.5f, 2.25f, 1.0f));
}

TEST(Texture, WhereOnlyOneValueCanBeUsedItBecomesTheMean) {
  const Scene scene = load_body(with_bsdf(R"(<bsdf type="conductor">
<texture name="eta" type="checkerboard"/></bsdf>)"));
  expect_one_warning(scene, 3, "the texture on eta of bsdf 'conductor' becomes the mean");
  expect_near(kind_of<Conductor>(scene, scene.shapes[0]).metal.eta, glm::vec3(0.3f));
}

TEST(Texture, ErrorsAndUnknownTypes) {
  const Scene scene = load_body(with_bsdf(R"(<bsdf type="diffuse">
<texture name="reflectance" type="clouds"/></bsdf>)"));
  expect_one_warning(scene, 4, "texture 'clouds' is not known and becomes grey 0.5");
  expect_message(error_of(with_bsdf(R"(<bsdf type="diffuse" id="d">
<ref name="reflectance" id="d"/></bsdf>)")),
                 4, "refers to a <bsdf>, expected a <texture>");
  expect_message(error_of(with_bsdf(R"(<bsdf type="diffuse">
<texture name="reflectance" type="checkerboard" id="t"><ref name="color0" id="t"/></texture></bsdf>)")),
                 4, "refers to itself");
  expect_message(error_of(with_bsdf(R"(<bsdf type="diffuse">
<texture name="reflectance" type="checkerboard"><rgb name="color1" value="-1"/></texture></bsdf>)")),
                 4, "negative");
}

}  // namespace
}  // namespace quartet::test
