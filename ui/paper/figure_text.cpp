#include "ui/paper/figure_text.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace quartet {

namespace {

/// The length of the UTF-8 character at the front of `text`, or 0 if there is none (RFC 3629).
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const unsigned first = byte(0);
  const std::size_t length = first < 0x80                     ? 1
                             : first >= 0xC2 && first <= 0xDF ? 2
                             : first >= 0xE0 && first <= 0xEF ? 3
                             : first >= 0xF0 && first <= 0xF4 ? 4
                                                              : 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0u) != 0x80u) {
      return 0;
    }
  }
  // Overlong forms, surrogates, and code points past U+10FFFF.
  const unsigned second = byte(1);
  if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
      (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F)) {
    return 0;
  }
  return length;
}

/// Without spaces and separators at the end, where a line was broken.
std::string trimmed(std::string line) {
  constexpr std::string_view dot = " ·";
  while (line.ends_with(' ') || line.ends_with(dot)) {
    line.resize(line.size() - (line.ends_with(' ') ? 1 : dot.size()));
  }
  return line;
}

}  // namespace

std::string clean_text(std::string_view text) {
  std::string clean;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0) {
      clean += "\uFFFD";
    } else if (length == 1 && (static_cast<unsigned char>(text[0]) < 0x20 || text[0] == 0x7F)) {
      clean += ' ';
    } else {
      clean += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return clean;
}

void select_font(cairo_t* cairo, const TextStyle& style) {
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(cairo, options);
  cairo_font_options_destroy(options);
  cairo_set_font_size(cairo, style.size);
  cairo_select_font_face(cairo, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
}

TextMeasure::TextMeasure() {
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1);
  cairo_ = cairo_create(surface);
  cairo_surface_destroy(surface);
}

TextMeasure::~TextMeasure() {
  cairo_destroy(cairo_);
}

double TextMeasure::width(const std::string& text, const TextStyle& style) const {
  select_font(cairo_, style);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_, text.c_str(), &extents);
  return std::max(extents.x_advance, extents.x_bearing + extents.width);
}

std::string TextMeasure::ellipsize(const std::string& text, const TextStyle& style,
                                   double max_width) const {
  const auto cut_at = [&](std::size_t end) { return trimmed(text.substr(0, end)) + "…"; };
  std::size_t fits = 0;
  for (std::size_t end = 0; end < text.size();) {
    end += std::max<std::size_t>(character_length(std::string_view(text).substr(end)), 1);
    if (width(cut_at(end), style) > max_width) {
      break;
    }
    fits = end;
  }
  return cut_at(fits);
}

std::vector<std::string> TextMeasure::wrap(const std::string& text, const TextStyle& style,
                                           double max_width, int max_lines) const {
  std::vector<std::string> lines;
  std::string rest = clean_text(text);
  while (!trimmed(rest).empty()) {
    if (width(rest, style) <= max_width) {
      lines.push_back(rest);
      break;
    }
    if (int(lines.size()) + 1 == max_lines) {
      lines.push_back(ellipsize(rest, style, max_width));
      break;
    }
    std::size_t end = std::string::npos;
    for (std::size_t space = rest.find(' ', 1); space != std::string::npos;
         space = rest.find(' ', space + 1)) {
      if (width(trimmed(rest.substr(0, space)), style) > max_width) {
        break;
      }
      end = space;
    }
    if (end == std::string::npos) {
      // Not even the first word fits: it stands alone, cut.
      end = std::min(rest.find(' ', 1), rest.size());
      lines.push_back(ellipsize(rest.substr(0, end), style, max_width));
    } else {
      lines.push_back(trimmed(rest.substr(0, end)));
    }
    rest = end < rest.size() ? rest.substr(end + 1) : "";
    // A separator that would begin the next line is dropped as well.
    if (rest.starts_with("· ")) {
      rest.erase(0, std::string_view("· ").size());
    }
  }
  return lines;
}

}  // namespace quartet
