#pragma once

#include <cairo.h>

#include <string>
#include <string_view>
#include <vector>

#include "ui/paper/figure_layout.h"

namespace quartet {

/// Valid UTF-8 on one line: bytes that are not UTF-8 become U+FFFD, control characters a space.
std::string clean_text(std::string_view text);

/// Selects DejaVu Sans: it has all of σ ≤ → × √ χ², and Debian's Cairo brings it along, so that a
/// figure looks the same on every machine. Metrics are unhinted, so that PNG and PDF agree.
void select_font(cairo_t* cairo, const TextStyle& style);

/// Measures text without a picture.
class TextMeasure {
 public:
  TextMeasure();
  ~TextMeasure();
  TextMeasure(const TextMeasure&) = delete;
  TextMeasure& operator=(const TextMeasure&) = delete;

  double width(const std::string& text, const TextStyle& style) const;

  /// The text in at most max_lines lines, none wider than `width`: broken at spaces, and cut with
  /// an ellipsis where even that does not fit. No lines for an empty text.
  std::vector<std::string> wrap(const std::string& text, const TextStyle& style, double width,
                                int max_lines) const;

 private:
  /// The longest beginning of `text` that fits together with an ellipsis.
  std::string ellipsize(const std::string& text, const TextStyle& style, double width) const;

  cairo_t* cairo_;
};

}  // namespace quartet
