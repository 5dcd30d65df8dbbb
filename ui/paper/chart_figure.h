#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/files/staged_files.h"
#include "renderer/view/chart.h"

namespace quartet {

/// Charts for a report, on paper: in rows from the top left, all of one size, with one legend for
/// all: where the last row has room, else below. A line whose label stands at its end is not in it.
/// Text is UTF-8.
struct ChartFigure {
  std::string title;
  std::vector<std::string> lines;  ///< below the title
  std::vector<Chart> charts;
  int columns = 2;
  double area_width = 640.0;  ///< of a chart between its axes, in pixels of the PNG
  double area_height = 470.0;
  std::string footer;  ///< settings, command line
};

/// Painted from one layout, through the same files as a Figure, with its guarantees. The legend and
/// all text stand beside the data, never on them. Colours should be readable on white.
void write_chart_png(const ChartFigure& figure, const std::filesystem::path& path);
void write_chart_pdf(const ChartFigure& figure, const std::filesystem::path& path);
void write_chart_svg(const ChartFigure& figure, const std::filesystem::path& path);
/// As `name`.png, .pdf and .svg.
void write_chart_files(StagedFiles& files, const std::string& name, const ChartFigure& figure);

}  // namespace quartet
