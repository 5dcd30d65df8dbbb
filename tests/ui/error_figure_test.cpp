#include "ui/paper/error_figure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace quartet {
namespace {

/// A mean squared error of `error` in each of 100 × 10 pixels, against black.
RadianceImage even_error(float error) {
  return RadianceImage(100, 10, glm::vec3(std::sqrt(error)));
}

TEST(ErrorFigure, SaysTheMetricAndWhereTheErrorIs) {
  const Metric& mse = metric(MetricId::mse);
  RadianceImage test = even_error(0.25f);
  std::fill_n(test.pixels().begin(), 500, glm::vec3(0.0f));  // the upper half is right
  const Figure figure = error_figure(test, RadianceImage(100, 10), mse, "title", "footer");
  EXPECT_EQ(figure.title, "title");
  EXPECT_EQ(figure.footer, "footer");
  ASSERT_EQ(figure.panels.size(), 1u);
  const FigurePanel& panel = figure.panels[0];
  EXPECT_EQ(panel.title, "MSE 0.125 radiance²");
  EXPECT_TRUE(panel.lines.empty());
  ASSERT_TRUE(panel.bar);
  EXPECT_EQ(panel.bar->scale, (ColorScale{0.0, 0.25, ColorMapId::viridis}));
  EXPECT_EQ(panel.bar->label, mse.map_quantity);
  EXPECT_EQ(panel.image.at(3, 4), sample(ColorMapId::viridis, 0.0f));
  EXPECT_EQ(panel.image.at(3, 5), sample(ColorMapId::viridis, 1.0f));
}

// The scale ends at the error that all but a thousandth of the pixels stay below.
TEST(ErrorFigure, TellsOfPixelsAboveItsScale) {
  RadianceImage test = even_error(0.25f);
  test.at(7, 2) = glm::vec3(2.0f);
  const Figure figure =
      error_figure(test, RadianceImage(100, 10), metric(MetricId::mse), "title", "footer");
  const FigurePanel& panel = figure.panels[0];
  EXPECT_EQ(panel.bar->scale, (ColorScale{0.0, 0.25, ColorMapId::viridis}));
  EXPECT_EQ(panel.lines, (std::vector<std::string>{"1 pixels above the scale, up to 4"}));
}

TEST(ErrorFigure, IsLogarithmicWhereErrorsSpanDecades) {
  RadianceImage test = even_error(0.01f);
  for (int x = 0; x < 50; ++x) {
    test.at(x, 0) = glm::vec3(1.0f);
  }
  const Figure figure =
      error_figure(test, RadianceImage(100, 10), metric(MetricId::mse), "title", "footer");
  const ColorScale& scale = figure.panels[0].bar->scale;
  EXPECT_EQ(scale, (ColorScale{1e-4, 1.0, ColorMapId::viridis, Spacing::logarithmic}));
  EXPECT_EQ(figure.panels[0].image.at(70, 5), sample(ColorMapId::viridis, 0.5f));
}

}  // namespace
}  // namespace quartet
