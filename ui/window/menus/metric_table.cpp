#include "ui/window/menus/metric_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "renderer/adaptive/effort.h"
#include "renderer/measure/energy.h"
#include "renderer/measure/metrics.h"
#include "ui/widgets/imgui_compat.h"
#include "ui/widgets/widgets.h"

namespace quartet {
namespace {

/// Three digits that count; a dash for what is not known.
std::string metric_text(double value) {
  return std::isnan(value) ? "–" : fmt::format("{:.3g}", value);
}

std::size_t row_index(MetricId key) {
  return std::size_t(&metric(key) - metrics().data());
}

/// A line of the table: a lane, or uniform sampling.
struct TableRow {
  std::string name;
  ImU32 color;
  const LaneSnapshot* lane;
  const MetricValues* values;  ///< null while they are not known
  std::optional<double> times_uniform;
};

std::vector<TableRow> lines_of(const LabFrame& frame) {
  const Snapshot& snapshot = *frame.snapshot;
  // What is known of an older picture would be wrong of this one.
  const bool current =
      frame.evaluation.snapshot && frame.evaluation.snapshot->number == snapshot.number;
  std::vector<TableRow> lines;
  for (std::size_t i = 0; i < snapshot.lanes.size(); ++i) {
    const LaneSnapshot& lane = snapshot.lanes[i];
    lines.push_back({fmt::format("{}  {}", i + 1, estimator(lane.settings.estimator).label),
                     estimator_color(lane.settings.estimator), &lane,
                     current ? &frame.evaluation.lanes[i] : nullptr,
                     times_uniform(snapshot, i, frame.state.dock.effort)});
  }
  if (snapshot.baseline) {
    lines.push_back({"uniform", palette::dim, &*snapshot.baseline,
                     current ? &frame.evaluation.baseline : nullptr, std::nullopt});
  }
  return lines;
}

/// The metric of the curves is known for every pass; the others follow once the lanes rest.
double value_of(const LabFrame& frame, const TableRow& line, const Metric& row) {
  if (row.key == frame.snapshot->metric && !line.lane->history.empty()) {
    return line.lane->history.back().truth.error;
  }
  return line.values && !line.values->empty() ? (*line.values)[row_index(row.key)] : std::nan("");
}

/// The chosen one, those that are asked for most, the rest.
std::vector<const Metric*> metrics_by_interest(MetricId chosen) {
  std::vector<const Metric*> order{&metric(chosen)};
  const auto add = [&](const Metric& row) {
    if (std::ranges::find(order, &row) == order.end()) {
      order.push_back(&row);
    }
  };
  add(metric(default_metric));
  add(metric(MetricId::relmse));
  add(metric(MetricId::flip));
  std::ranges::for_each(metrics(), add);
  return order;
}

std::string seconds_text(double seconds) {
  return seconds < 0.1 ? fmt::format("{:.1f} ms", 1e3 * seconds) : fmt::format("{:.2f} s", seconds);
}

std::string all_metrics_text(const LabFrame& frame, const TableRow& line) {
  std::string text = line.name;
  if (!line.lane->history.empty()) {
    text += fmt::format("\nenergy: {}", energy_text(line.lane->history.back().truth.energy));
  }
  for (const Metric& row : metrics()) {
    text += fmt::format("\n{}: {}{}{}", row.label, metric_text(value_of(frame, line, row)),
                        row.unit.empty() ? "" : " ", row.unit);
    if (const auto floor = noise_floor(frame, row.key)) {
      text += fmt::format("   (the reference's own noise: {})", metric_text(*floor));
    }
  }
  return text;
}

struct Column {
  std::string title;
  std::string tip;
  float width;
  std::vector<std::string> cells;
};

std::vector<Column> columns_of(const LabFrame& frame, const std::vector<TableRow>& lines,
                               float room) {
  const Ui& ui = frame.ui;
  const float gap = ui.px(14.0f);
  const auto column = [&](const std::string& title, const std::string& tip, const auto& cell) {
    Column made{title, tip, std::max(text_width(ui.small, title), ui.px(44.0f)), {}};
    for (const TableRow& line : lines) {
      made.cells.push_back(cell(line));
      made.width = std::max(made.width, text_width(ui.small, made.cells.back()));
    }
    made.width += gap;
    return made;
  };
  std::vector<Column> columns;
  const double pixels = double(frame.snapshot->pixels());
  columns.push_back(column("spp", "Samples per pixel, mean", [&](const TableRow& line) {
    return line.lane->history.empty()
               ? std::string("–")
               : fmt::format("{:.1f}", double(line.lane->history.back().samples) / pixels);
  }));
  columns.push_back(
      column("seconds", "What the lane would have taken alone", [&](const TableRow& line) {
        return line.lane->history.empty() ? std::string("–")
                                          : seconds_text(line.lane->history.back().seconds);
      }));
  columns.push_back(column(
      "energy",
      "Mean luminance over that of the reference, less 1. A lane that is too dark may have lost "
      "its brightest samples, which most metrics take for a gain.",
      [&](const TableRow& line) {
        return line.lane->history.empty() ? std::string("–")
                                          : energy_text(line.lane->history.back().truth.energy);
      }));
  const std::string chosen(metric(frame.snapshot->metric).label);
  const Column last = column(
      "× uniform",
      fmt::format("{} of uniform sampling at the same effort ({}), divided by this lane's: above 1 "
                  "the lane gains, if its energy is right.",
                  chosen, effort_row(frame.state.dock.effort).label),
      [&](const TableRow& line) {
        return line.times_uniform ? fmt::format("{:.2f}", *line.times_uniform) : std::string("–");
      });
  room -= last.width;
  for (const Column& made : columns) {
    room -= made.width;
  }
  for (const Metric* row : metrics_by_interest(frame.snapshot->metric)) {
    Column made =
        column(std::string(row->label), std::string(row->definition),
               [&](const TableRow& line) { return metric_text(value_of(frame, line, *row)); });
    if (made.width > room) {
      break;
    }
    room -= made.width;
    columns.push_back(std::move(made));
  }
  columns.push_back(last);
  return columns;
}

}  // namespace

std::optional<double> noise_floor(const LabFrame& frame, MetricId key) {
  const MetricValues& floors = frame.evaluation.noise_floor;
  if (floors.empty() || frame.evaluation.reference != frame.reference.reference ||
      std::isnan(floors[row_index(key)])) {
    return std::nullopt;
  }
  return floors[row_index(key)];
}

void draw_metric_table(LabFrame& frame, const ScreenRect& box) {
  if (!frame.snapshot || frame.snapshot->pass == 0) {
    return;
  }
  Ui& ui = frame.ui;
  const std::vector<TableRow> lines = lines_of(frame);
  const float line_height =
      std::min(font_size(ui.small) + ui.px(10.0f), box.height / float(lines.size() + 1));
  float name_width = 0.0f;
  for (const TableRow& line : lines) {
    name_width = std::max(name_width, text_width(ui.small, line.name));
  }
  name_width += ui.px(12.0f);
  const std::vector<Column> columns = columns_of(frame, lines, box.width - name_width);
  const auto text_y = [&](std::size_t row) {
    return box.y + line_height * float(row) + 0.5f * (line_height - font_size(ui.small));
  };
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const float top = box.y + line_height * float(i + 1);
    list.AddLine({box.x, top}, {box.right(), top}, palette::line);
    list.AddRectFilled({box.x, top + ui.px(4.0f)},
                       {box.x + ui.px(3.0f), top + line_height - ui.px(4.0f)}, lines[i].color);
    text_at(ui.small, box.x + ui.px(9.0f), text_y(i + 1), palette::text, lines[i].name);
    ImGui::SetCursorScreenPos({box.x, top});
    invisible_button(fmt::format("table.row{}", i), {box.width, line_height});
    ui.mark(fmt::format("table.row{}", i));
    tooltip(ui, all_metrics_text(frame, lines[i]));
  }
  // The last column at the right edge, the others follow each other from the names on.
  float right = box.x + name_width;
  const float spare = std::max(
      0.0f, box.width - name_width - [&] {
        float sum = 0.0f;
        for (const Column& column : columns) {
          sum += column.width;
        }
        return sum;
      }());
  for (const Column& column : columns) {
    right += column.width + spare / float(columns.size());
    ImGui::SetCursorScreenPos({right - column.width, box.y});
    invisible_button(column.title, {column.width, line_height});
    ui.mark("table." + column.title);
    tooltip(ui, column.tip);
    text_left_of(ui.small, right, text_y(0), palette::dim, column.title);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      text_left_of(ui.small, right, text_y(i + 1), palette::text, column.cells[i]);
    }
  }
}

}  // namespace quartet
