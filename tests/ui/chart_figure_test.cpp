#include "ui/paper/chart_figure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "renderer/files/png.h"
#include "tests/files/temp_folder.h"
#include "ui/paper/chart_layout.h"

namespace quartet {
namespace {

constexpr Rgba8 red{200, 30, 30};
constexpr Rgba8 blue{20, 60, 200};
constexpr Rgba8 green{20, 140, 40};
constexpr Rgba8 pale{30, 160, 220, 90};
constexpr Rgba8 gray{90, 90, 90};

Chart pareto(std::string title) {
  Chart chart;
  chart.title = std::move(title);
  chart.x = log_axis(0.1, 40.0, "as-if-alone time (s)", 7);
  chart.y = log_axis(2e-5, 0.3, "relMSE (ratio)", 7);
  Line uniform{"uniform", gray, {}, Dash::dashed};
  Line kl{"√ Kullback–Leibler", red, {}, Dash::solid, true};
  Band spread{"5 % to 95 % of seeds", pale, {}, {}};
  for (double t = 0.1; t < 40.0; t *= 1.7) {
    uniform.points.emplace_back(t, 0.02 / t);
    kl.points.emplace_back(t, 0.005 / std::pow(t, 0.8));
    spread.lower.emplace_back(t, 0.003 / std::pow(t, 0.8));
    spread.upper.emplace_back(t, 0.009 / std::pow(t, 0.8));
  }
  chart.marks = {{"default threshold", blue, kl.points[3], MarkShape::diamond},
                 {"default threshold", blue, uniform.points[3], MarkShape::cross}};
  chart.lines = {uniform, kl};
  chart.bands = {spread};
  chart.levels = {{"noise floor of the reference", green, 7e-5}};
  return chart;
}

ChartFigure two_charts() {
  ChartFigure figure;
  figure.title = "cornell-checker · error against time";
  figure.lines = {"480x270 · 3 seeds · median, band from lowest to highest"};
  figure.charts = {pareto("error against time"), pareto("error against samples")};
  figure.footer = "quartet sweep cornell-checker --seeds 3 --out out";
  return figure;
}

/// Many lines that end near each other, one of them outside of its chart, with labels at their
/// ends.
ChartFigure labelled_ends() {
  ChartFigure figure = two_charts();
  figure.area_width = 300.0;
  figure.area_height = 260.0;
  for (Chart& chart : figure.charts) {
    for (int i = 0; i < 8; ++i) {
      Line line{"end " + std::to_string(i), blue, {{0.2, 0.01}, {20.0, 0.001 * (1.0 + 0.01 * i)}}};
      line.label_at_end = true;
      chart.lines.push_back(line);
    }
    chart.lines.back().points = {{0.05, 1e-6}};
    chart.lines.back().label = std::string(300, 'W');
  }
  return figure;
}

std::vector<ChartFigure> figures() {
  std::vector<ChartFigure> all{two_charts(), two_charts(), {}};
  all[1].columns = 1;
  all[1].charts[0].y = linear_axis(-3000.0, 12345678.0, std::string(300, 'W'), 5);
  for (int i = 0; i < 25; ++i) {
    all[1].charts[1].lines.push_back({"line " + std::to_string(i), red, {}});
  }
  all[1].charts[1].lines.push_back({std::string(400, 'M'), red, {}});
  all[1].title = std::string(500, 'M') + " \xff broken";
  all[1].footer = std::string(3000, 'x');
  all.push_back(two_charts());
  all.back().charts.push_back(pareto("error against rays"));
  all.push_back(labelled_ends());
  return all;
}

bool overlap(const Rect& a, const Rect& b) {
  return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

int count_color(const DisplayImage& page, const Rect& box, Rgba8 color) {
  int count = 0;
  for (int y = int(box.y); y < int(box.bottom()); ++y) {
    for (int x = int(box.x); x < int(box.right()); ++x) {
      count += page.at(x, y) == color;
    }
  }
  return count;
}

DisplayImage painted(const ChartFigure& figure, const TempFolder& folder) {
  write_chart_png(figure, folder / "chart.png");
  return read_png(folder / "chart.png");
}

TEST(ChartLayout, NoTextOrLegendCoversDataOrLeavesThePage) {
  for (const ChartFigure& figure : figures()) {
    const ChartLayout layout = lay_out(figure);
    std::vector<Rect> boxes;
    for (const PlacedText& text : layout.texts) boxes.push_back(text.box);
    for (const LegendEntry& entry : layout.legend) boxes.push_back(entry.box);
    for (const PlacedChart& chart : layout.charts) boxes.push_back(chart.area);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      EXPECT_GE(boxes[i].x, 5);
      EXPECT_GE(boxes[i].y, 5);
      EXPECT_LE(boxes[i].right(), layout.width - 5);
      EXPECT_LE(boxes[i].bottom(), layout.height - 5);
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_FALSE(overlap(boxes[i], boxes[j])) << i << ' ' << j;
      }
    }
  }
}

TEST(ChartLayout, TheLegendStandsInTheLastRowWhereThereIsRoom) {
  ChartFigure figure = two_charts();
  figure.charts.push_back(figure.charts.front());
  const ChartLayout layout = lay_out(figure);
  const Rect& last = layout.charts.back().area;
  ASSERT_FALSE(layout.legend.empty());
  for (const LegendEntry& entry : layout.legend) {
    EXPECT_GT(entry.box.x, last.right());
    EXPECT_GE(entry.box.y, last.y);
    EXPECT_LE(entry.box.bottom(), last.bottom());
  }
  figure.charts.pop_back();
  const ChartLayout full = lay_out(figure);
  EXPECT_GT(full.legend.front().box.y, full.charts.back().area.bottom());
}

TEST(ChartLayout, LabelsOfBothAxesAndALegendEntryALabelOnce) {
  const ChartFigure figure = two_charts();
  const ChartLayout layout = lay_out(figure);
  for (const char* text : {"as-if-alone time (s)", "relMSE (ratio)"}) {
    EXPECT_EQ(std::ranges::count(layout.texts, text, &PlacedText::text), 2) << text;
  }
  for (const char* text : {"uniform", "√ Kullback–Leibler", "default threshold",
                           "5 % to 95 % of seeds", "noise floor of the reference"}) {
    EXPECT_EQ(std::ranges::count(layout.texts, text, &PlacedText::text), 1) << text;
  }
  EXPECT_EQ(layout.legend.size(), 5u);
}

TEST(ChartLayout, LabelsAtEndsStandBesideTheChartInTheOrderOfTheEnds) {
  const ChartFigure figure = labelled_ends();
  const ChartLayout layout = lay_out(figure);
  ASSERT_EQ(layout.legend.size(), 5u) << "they are not in the legend";
  for (const PlacedChart& placed : layout.charts) {
    ASSERT_EQ(placed.end_labels.size(), 8u);
    for (std::size_t i = 0; i < placed.end_labels.size(); ++i) {
      const EndLabel& label = placed.end_labels[i];
      EXPECT_GT(label.sample.x, placed.area.right());
      EXPECT_GE(label.sample.y, placed.area.y);
      EXPECT_LE(label.sample.bottom(), placed.area.bottom() + 1e-9);
      if (i > 0) {
        EXPECT_GE(label.from.y, placed.end_labels[i - 1].from.y);
        EXPECT_GE(label.sample.y, placed.end_labels[i - 1].sample.bottom() - 1e-9);
      }
    }
    // The one that is not seen is joined to the corner where it left.
    EXPECT_EQ(placed.end_labels.back().from, glm::dvec2(placed.area.x, placed.area.bottom()));
    const EndLabel& seen = placed.end_labels.front();
    EXPECT_NEAR(seen.from.x, placed.x(20.0), 1e-9);
    EXPECT_NEAR(seen.from.y, placed.y(seen.line->points.back().y), 1e-9);
  }
}

TEST(ChartPng, LabelsAtEndsHaveAPieceOfTheirLineBeforeThem) {
  const TempFolder folder;
  ChartFigure figure = labelled_ends();
  for (Line& line : figure.charts[0].lines) {
    line.dots = true;
    line.shape = MarkShape::square;
  }
  const DisplayImage page = painted(figure, folder);
  const ChartLayout layout = lay_out(figure);
  for (const EndLabel& label : layout.charts[0].end_labels) {
    EXPECT_GT(count_color(page, label.sample, blue), 20);
  }
}

TEST(ChartLayout, NumbersStandAtTheirTicks) {
  const ChartFigure figure = two_charts();
  const ChartLayout layout = lay_out(figure);
  ASSERT_EQ(layout.charts.size(), 2u);
  EXPECT_GE(layout.charts[0].x_grid.size(), 3u);
  const PlacedChart& placed = layout.charts[0];
  for (const Tick& tick : placed.y_grid) {
    const auto beside = [&](const PlacedText& text) {
      const double middle = text.box.y + text.box.height / 2;
      return text.text == tick.label && text.box.right() < placed.area.x &&
             std::abs(middle - placed.y(tick.value)) < 1.0;
    };
    EXPECT_EQ(std::ranges::count_if(layout.texts, beside), 1) << tick.label;
  }
  for (const Tick& tick : placed.x_grid) {
    const auto below = [&](const PlacedText& text) {
      const double middle = text.box.x + text.box.width / 2;
      return text.text == tick.label && text.box.y > placed.area.bottom() &&
             std::abs(middle - placed.x(tick.value)) < 1.0;
    };
    EXPECT_EQ(std::ranges::count_if(layout.texts, below), 1) << tick.label;
  }
}

TEST(ChartPng, EveryKindOfDataIsThereWhereItShouldBe) {
  const TempFolder folder;
  const ChartFigure figure = two_charts();
  const DisplayImage page = painted(figure, folder);
  const ChartLayout layout = lay_out(figure);
  for (const PlacedChart& placed : layout.charts) {
    const Chart& chart = *placed.chart;
    // Lines: each point that was measured is a dot of the line's colour.
    for (const glm::dvec2& point : chart.lines[1].points) {
      const Rect around{placed.x(point.x) - 3, placed.y(point.y) - 3, 7, 7};
      const bool marked = point == chart.marks[0].at;
      EXPECT_GT(count_color(page, around, marked ? blue : red), 10);
    }
    // A dashed line has gaps, a solid one none.
    int dashes = 0;
    int samples = 0;
    for (double t = 0.15; t < 0.45; t *= 1.005) {
      const Rect here{std::round(placed.x(t)), placed.y(0.02 / t) - 2, 1, 4};
      dashes += count_color(page, here, gray) > 0 ? 1 : 0;
      ++samples;
    }
    EXPECT_GT(dashes, samples / 3);
    EXPECT_LT(dashes, samples * 9 / 10);
    // The band: neither paper nor line colour between line and upper bound.
    const Rect inside{placed.x(0.14) - 2, placed.y(0.0065 / std::pow(0.14, 0.8)) - 2, 4, 4};
    EXPECT_EQ(count_color(page, inside, Rgba8{255, 255, 255}), 0);
    // The level, from end to end.
    const double y = placed.y(7e-5);
    EXPECT_GT(count_color(page, {placed.area.x, y - 2, 60, 4}, green), 20);
    EXPECT_GT(count_color(page, {placed.area.right() - 60, y - 2, 60, 4}, green), 20);
  }
}

TEST(ChartPng, ABandIsBetweenItsCurvesAndNowhereElse) {
  const TempFolder folder;
  ChartFigure figure;
  Chart chart;
  chart.x = linear_axis(0, 4, "x", 3);
  chart.y = linear_axis(0, 10, "y", 3);
  // Bent upwards: what joins pieces with the first one would fill above it.
  chart.bands = {{"", red, {{0, 9}, {1, 1}, {2, 1}, {4, 8}}, {{0, 10}, {1, 2}, {2, 2}, {4, 9}}}};
  figure.charts = {chart};
  const DisplayImage page = painted(figure, folder);
  const ChartLayout layout = lay_out(figure);
  const PlacedChart& placed = layout.charts[0];
  const auto color_at = [&](double x, double y) {
    return page.at(int(placed.x(x)), int(placed.y(y)));
  };
  for (const double x : {0.5, 1.5, 3.0}) {
    const double low = x < 1 ? 9 - 8 * x : x < 2 ? 1 : 1 + 3.5 * (x - 2);
    EXPECT_EQ(color_at(x, low + 0.5), red) << x;
    EXPECT_NE(color_at(x, low + 1.3), red) << x;
    EXPECT_NE(color_at(x, low - 0.3), red) << x;
  }
}

TEST(ChartPng, DataStayInsideTheAxes) {
  const TempFolder folder;
  ChartFigure figure;
  Chart chart;
  chart.x = linear_axis(0, 1, "x", 3);
  chart.y = linear_axis(0, 1, "y", 3);
  chart.lines = {{"", red, {{-5, -5}, {5, 5}}}, {"", red, {{0.5, -9}, {0.5, 9}}}};
  chart.marks = {{"", red, {1.5, 0.5}, MarkShape::dot}};
  figure.charts = {chart};
  const DisplayImage page = painted(figure, folder);
  const Rect area = lay_out(figure).charts[0].area;
  const int inside = count_color(page, area, red);
  EXPECT_GT(inside, 500);
  EXPECT_EQ(count_color(page, {0, 0, double(page.width()), double(page.height())}, red), inside);
}

TEST(ChartPng, TheLegendShowsEachThingInItsColour) {
  const TempFolder folder;
  const ChartFigure figure = two_charts();
  const DisplayImage page = painted(figure, folder);
  const ChartLayout layout = lay_out(figure);
  const std::vector<Rgba8> colors{gray, red, blue, Rgba8{}, green};
  ASSERT_EQ(layout.legend.size(), colors.size());
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const Rect& box = layout.legend[i].box;
    const int paper = count_color(page, box, Rgba8{255, 255, 255});
    EXPECT_LT(paper, box.width * box.height - 20) << i;
    if (colors[i].a == 255 && colors[i] != Rgba8{}) {
      EXPECT_GT(count_color(page, box, colors[i]), 20) << i;
    }
  }
}

TEST(ChartFiles, BeginAsTheirFormatsDoAndAreTheSameTwice) {
  const TempFolder folder;
  const ChartFigure figure = two_charts();
  for (const auto write : {write_chart_png, write_chart_pdf}) {
    write(figure, folder / "a");
    write(figure, folder / "b");
    EXPECT_EQ(bytes_of(folder / "a"), bytes_of(folder / "b"));
  }
  EXPECT_TRUE(bytes_of(folder / "a").starts_with("%PDF-"));
  write_chart_png(figure, folder / "a");
  EXPECT_TRUE(bytes_of(folder / "a").starts_with("\x89PNG"));
  write_chart_svg(figure, folder / "a");
  const std::string svg = bytes_of(folder / "a");
  EXPECT_TRUE(svg.starts_with("<?xml"));
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST(ChartFiles, AFullDiskAndAMissingFolderAreErrors) {
  for (const auto write : {write_chart_png, write_chart_pdf, write_chart_svg}) {
    EXPECT_EQ(error_of([&] { write(two_charts(), "/dev/full"); }),
              "cannot write /dev/full: No space left on device");
    EXPECT_EQ(error_of([&] { write(two_charts(), "/nowhere/a"); }),
              "cannot write /nowhere/a: No such file or directory");
  }
}

}  // namespace
}  // namespace quartet
