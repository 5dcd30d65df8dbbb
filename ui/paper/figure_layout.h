#pragma once

#include <string>
#include <vector>

#include "ui/paper/figure.h"

namespace quartet {

/// In pixels of the PNG, from the top left.
struct Rect {
  double x = 0, y = 0, width = 0, height = 0;
  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

struct TextStyle {
  double size;  ///< of the em, in pixels
  bool bold = false;
  double gray = 0.1;  ///< 0 is black
};

struct PlacedText {
  std::string text;
  Rect box;  ///< its width is the advance; its height a line's
  double baseline;
  TextStyle style;
};

struct PlacedImage {
  const DisplayImage* image;
  Rect box;  ///< whole pixels; a whole multiple of the image
};

struct PlacedColors {
  ColorMapId color_map;
  Rect box;
};

struct PlacedFill {
  Rgba8 color;
  Rect box;
};

/// What is where: all that a painter needs. It refers to the figure, which must outlive it.
struct FigureLayout {
  double width = 0, height = 0;
  double line_size = 0;  ///< size of the panels' lines of text
  std::vector<PlacedImage> images;
  std::vector<PlacedText> titles;  ///< of the panels
  std::vector<PlacedText> texts;   ///< all other text
  std::vector<PlacedColors> bars;
  std::vector<PlacedFill> fills;  ///< tick marks, swatches
};

FigureLayout lay_out(const Figure& figure);
FigureLayout lay_out(const Figure&& gone) = delete;

}  // namespace quartet
