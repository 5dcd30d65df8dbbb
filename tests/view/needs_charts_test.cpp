#include "renderer/view/needs_charts.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace quartet {
namespace {

NeedsRow charted_row(PartId part, const std::string& label, double error, Need need) {
  NeedsRow row;
  row.simplification = {part, label, {}};
  row.measured.error = {error, error / 2.0, error * 2.0};
  row.rays_ratio = 0.5;
  row.seconds_ratio = 0.25;
  row.need = need;
  return row;
}

NeedsResult charted_result() {
  NeedsResult result;
  result.limit = 0.1;
  result.rows = {charted_row(PartId::depth, "depth 1", 1.0, Need::needed),
                 charted_row(PartId::depth, "depth 2", -1e-9, Need::not_needed),
                 charted_row(PartId::gloss, "'ball' dielectric → diffuse", 0.1, Need::undecided)};
  return result;
}

TEST(NeedsCharts, ShowEveryRowInsideOfTheirAxes) {
  const std::vector<Chart> charts = needs_charts(charted_result(), {});
  ASSERT_EQ(charts.size(), 2u);
  for (const Chart& chart : charts) {
    ASSERT_EQ(chart.marks.size(), 3u);
    for (const PointMark& mark : chart.marks) {
      EXPECT_GE(axis_position(chart.y, mark.at.y), 0.0);
      EXPECT_LE(axis_position(chart.y, mark.at.y), 1.0);
      EXPECT_GT(axis_position(chart.x, mark.at.x), 0.0);
      EXPECT_LT(axis_position(chart.x, mark.at.x), 1.0);
    }
    EXPECT_EQ(chart.marks[0].shape, MarkShape::diamond);
    EXPECT_EQ(chart.marks[1].shape, MarkShape::dot);
    EXPECT_EQ(chart.marks[1].at.y, chart.y.min) << "what is not above 0 stands on the edge";
    EXPECT_EQ(chart.marks[2].shape, MarkShape::cross);
    EXPECT_EQ(chart.marks[2].label, "'ball' dielectric → diffuse");
    ASSERT_EQ(chart.levels.size(), 1u);
    EXPECT_EQ(chart.levels[0].value, 0.1);
    const auto depth =
        std::ranges::find(chart.lines, std::string("depth"), [](const Line& l) { return l.label; });
    ASSERT_NE(depth, chart.lines.end());
    EXPECT_EQ(depth->points.size(), 2u);
    EXPECT_EQ(chart.texts.front().text, "1");
  }
  EXPECT_EQ(charts[0].marks[0].at.x, 0.5);
  EXPECT_EQ(charts[1].marks[0].at.x, 0.25);
}

TEST(NeedsCharts, AreThereWithoutNoiseToo) {
  NeedsResult result = charted_result();
  result.limit = 0.0;
  for (NeedsRow& row : result.rows) {
    row.measured.error = {};
  }
  for (const Chart& chart : needs_charts(result, {})) {
    EXPECT_TRUE(chart.levels.empty());
    EXPECT_GT(chart.y.min, 0.0);
    EXPECT_LT(chart.y.min, chart.y.max);
  }
  EXPECT_TRUE(needs_charts({}, {}).empty());
}

}  // namespace
}  // namespace quartet
