#include <array>

#include "tests/scene/scene_text.h"

namespace quartet::test {
namespace {

using Rows = std::array<std::array<float, 4>, 3>;

/// The matrix of a <transform>, read off a cube that it places: the centre is the mean of the
/// corners, and each column is half the difference of two opposite faces.
Rows matrix_of(std::string_view operations) {
  const Scene scene = load_body(std::string(R"(<shape type="cube"><transform name="to_world">)")
                                    .append(operations)
                                    .append("</transform></shape>"));
  EXPECT_TRUE(scene.warnings.empty());
  const Mesh& placed = mesh_of(scene);
  const Scene reference = load_body(R"(<shape type="cube"/>)");
  const Mesh& unit = mesh_of(reference);
  Rows rows{};
  for (int row = 0; row < 3; ++row) {
    std::array<float, 4>& r = rows[std::size_t(row)];
    for (std::size_t i = 0; i < placed.positions.size(); ++i) {
      for (int column = 0; column < 3; ++column) {
        r[std::size_t(column)] += placed.positions[i][row] * unit.positions[i][column] / 24.0f;
      }
      r[3] += placed.positions[i][row] / 24.0f;
    }
  }
  return rows;
}

void expect_rows(std::string_view operations, const Rows& expected) {
  const Rows rows = matrix_of(operations);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      EXPECT_NEAR(rows[i][j], expected[i][j], 2e-5f) << operations << " at " << i << ", " << j;
    }
  }
}

TEST(Transform, TranslateForms) {
  const Rows expected = {{{1, 0, 0, 2}, {0, 1, 0, -3}, {0, 0, 1, 4.5f}}};
  expect_rows(R"(<translate x="2" y="-3" z="4.5"/>)", expected);
  expect_rows(R"(<translate value="2 -3 4.5"/>)", expected);
  expect_rows(R"(<translate value="2, -3,4.5"/>)", expected);
  expect_rows(R"(<translate y="7"/>)", {{{1, 0, 0, 0}, {0, 1, 0, 7}, {0, 0, 1, 0}}});
}

TEST(Transform, ScaleForms) {
  expect_rows(R"(<scale x="2" y="3" z="4"/>)", {{{2, 0, 0, 0}, {0, 3, 0, 0}, {0, 0, 4, 0}}});
  expect_rows(R"(<scale value="2 3 4"/>)", {{{2, 0, 0, 0}, {0, 3, 0, 0}, {0, 0, 4, 0}}});
  expect_rows(R"(<scale value="2.5"/>)", {{{2.5f, 0, 0, 0}, {0, 2.5f, 0, 0}, {0, 0, 2.5f, 0}}});
  expect_rows(R"(<scale y="-2"/>)", {{{1, 0, 0, 0}, {0, -2, 0, 0}, {0, 0, 1, 0}}});
}

TEST(Transform, RotateForms) {
  expect_rows(R"(<rotate x="1" angle="90"/>)", {{{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}}});
  expect_rows(R"(<rotate y="3" angle="90"/>)", {{{0, 0, 1, 0}, {0, 1, 0, 0}, {-1, 0, 0, 0}}});
  expect_rows(R"(<rotate value="0, 0, 1" angle="90"/>)",
              {{{0, -1, 0, 0}, {1, 0, 0, 0}, {0, 0, 1, 0}}});
  // A third of a turn about the diagonal moves x to y, y to z and z to x.
  expect_rows(R"(<rotate value="1" angle="120"/>)", {{{0, 0, 1, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}}});
}

TEST(Transform, MatrixIsRowByRow) {
  expect_rows(R"(<matrix value="1 2 0 5  0 1 0 6  3 0 2 7  0 0 0 1"/>)",
              {{{1, 2, 0, 5}, {0, 1, 0, 6}, {3, 0, 2, 7}}});
  expect_rows(R"(<matrix value="1,2,0 0,1,0 3,0,2"/>)",
              {{{1, 2, 0, 0}, {0, 1, 0, 0}, {3, 0, 2, 0}}});
}

TEST(Transform, LookatPutsZToTheTargetAndXToTheLeft) {
  expect_rows(R"(<lookat origin="1, 2, 3" target="1, 2, 8" up="0, 1, 0"/>)",
              {{{1, 0, 0, 1}, {0, 1, 0, 2}, {0, 0, 1, 3}}});
  // Along +x: left is cross(up, view) = -z.
  expect_rows(R"(<lookat origin="0 0 0" target="5 0 0" up="0 2 0"/>)",
              {{{0, 0, 1, 0}, {0, 1, 0, 0}, {-1, 0, 0, 0}}});
  // up need not be at right angles to the view.
  expect_rows(R"(<lookat origin="0 0 0" target="0 0 1" up="0 1 1"/>)",
              {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}});
}

TEST(Transform, FirstOperationIsAppliedFirst) {
  expect_rows(R"(<scale value="2"/><translate x="10"/>)",
              {{{2, 0, 0, 10}, {0, 2, 0, 0}, {0, 0, 2, 0}}});
  expect_rows(R"(<translate x="10"/><scale value="2"/>)",
              {{{2, 0, 0, 20}, {0, 2, 0, 0}, {0, 0, 2, 0}}});
  expect_rows(R"(<translate x="1"/><rotate z="1" angle="90"/><scale y="3"/>)",
              {{{0, -1, 0, 0}, {3, 0, 0, 3}, {0, 0, 1, 0}}});
}

TEST(Transform, Errors) {
  const auto error = [](std::string_view operation) {
    return error_of(std::string("<shape type=\"cube\"><transform name=\"to_world\">\n")
                        .append(operation)
                        .append("</transform></shape>"));
  };
  expect_message(error(R"(<translate x="abc"/>)"), 3, "'abc', expected finite numbers");
  expect_message(error(R"(<translate x="1 2"/>)"), 3, "expected one number");
  expect_message(error(R"(<translate x="nan"/>)"), 3, "expected finite numbers");
  expect_message(error(R"(<scale value="1 2"/>)"), 3, "holds 2 numbers, expected 3");
  expect_message(error(R"(<scale value="1" x="2"/>)"), 3, "both value and x");
  expect_message(error(R"(<rotate angle="90"/>)"), 3, "no axis");
  expect_message(error(R"(<rotate x="1"/>)"), 3, "needs one angle");
  expect_message(error(R"(<matrix value="1 2 3"/>)"), 3, "holds 3 numbers, expected 16 or 9");
  expect_message(error(R"(<shear x="1"/>)"), 3, "expected translate, scale, rotate, lookat");
  expect_message(error(R"(<lookat origin="0 0 0" target="0 1 0" up="0 1 0"/>)"), 3, "up vector");
  expect_message(error(R"(<lookat origin="0 0 0" target="0 0 0" up="0 1 0"/>)"), 3, "its origin");
  expect_message(error(R"(<scale x="0"/>)"), 2, "cannot be inverted");
  expect_message(error(R"(<matrix value="1 1 0 0 1 1 0 0 0 0 1 0 0 0 0 1"/>)"), 2,
                 "cannot be inverted");
  expect_message(error(R"(<matrix value="1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1"/>)"), 2, "not affine");
}

}  // namespace
}  // namespace quartet::test
