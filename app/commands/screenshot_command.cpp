#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <thread>

#include "app/commands/commands.h"
#include "app/options/lane_option.h"
#include "app/options/number_option.h"
#include "app/options/reference_option.h"
#include "app/options/stop_options.h"
#include "app/options/usage_error.h"
#include "app/options/view_options.h"
#include "app/records/rejected_report.h"
#include "app/records/stop_report.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/progress.h"
#include "app/window/imgui_screen.h"
#include "app/window/lab_driver.h"
#include "app/window/offscreen.h"
#include "renderer/base/table.h"
#include "renderer/files/png.h"
#include "renderer/files/staged_files.h"
#include "renderer/measure/stop_conditions.h"
#include "ui/window/lab_layout.h"

namespace quartet {
namespace {

struct ScreenshotOptions {
  RunOptions run;
  LaneOptions lanes;
  ViewOptions view;
  StopOptions stop;
  ReferenceChoice reference;
  std::string window = "1600x1000";
  std::optional<float> scale;
  std::string layout = "columns";
  std::vector<std::string> views{"image", "heatmap"};
  std::string metric;  ///< empty: default_metric
  std::string output;
};

/// The window shows all lanes at one pass: the one where the last of them meets its end. Of
/// anything but a number of passes it is known only once the lanes are past it: then the window
/// scrubs back to it, as a user would.
class EndSeeker {
 public:
  EndSeeker(const StopConditions& stop, MetricId shown_metric, LabState& state)
      : stop_(stop), shown_metric_(shown_metric) {
    if (stop.passes && !stop.spp && !stop.seconds && !stop.error) {
      pass_ = stop.passes;
      state.playback.set_target(*stop.passes);
      return;
    }
    // No further than this before the reference is there.
    state.playback.set_target(1);
    if (stop.error) {
      state.request.lanes.metric = stop.error->metric;
    }
  }

  /// After each draw of the window.
  void look(LabDriver& driver) {
    LabState& state = driver.window().state();
    if (pass_) {
      return;
    }
    if (state.playback.target() == 1) {
      if (driver.settled()) {
        state.playback.set_target(Playback::no_end);
      }
      return;
    }
    std::uint32_t last = 1;
    for (const LaneSnapshot& lane : driver.snapshot()->lanes) {
      const std::optional<std::uint32_t> end = stop_.end_of(lane);
      if (!end) {
        return;
      }
      last = std::max(last, *end);
    }
    pass_ = last;
    state.playback.set_target(last);
    state.request.lanes.metric = shown_metric_;
  }

  bool found() const { return pass_.has_value(); }

  /// How far the hindmost lane is, in [0, 1].
  double progress(const Snapshot& snapshot) const {
    if (pass_) {
      return std::min(1.0, double(snapshot.pass) / double(*pass_));
    }
    double least = 1.0;
    for (const LaneSnapshot& lane : snapshot.lanes) {
      least = std::min(least, stop_.progress(lane));
    }
    return least;
  }

 private:
  StopConditions stop_;
  MetricId shown_metric_;
  std::optional<std::uint32_t> pass_;
};

/// "--views image or reference".
std::string views_that_need(bool ViewNeeds::*setting) {
  std::string text = "--views ";
  const char* separator = "";
  for (const ViewRow& row : views()) {
    if (row.needs.*setting) {
      text += fmt::format("{}{}", separator, row.id);
      separator = " or ";
    }
  }
  return text;
}

/// Throws UsageError for an option that no picture that is shown depends on, and for a view that
/// would be empty.
void check_views(const ScreenshotOptions& options, std::size_t lanes) {
  const auto shows = [&](bool ViewNeeds::*setting) {
    return std::ranges::any_of(options.views,
                               [&](const std::string& id) { return find_view(id).needs.*setting; });
  };
  const auto need = [](std::string_view option, bool given, bool used, std::string_view what) {
    if (given && !used) {
      throw UsageError(fmt::format("{} has no effect: it is for {}", option, what));
    }
  };
  const bool radiance = shows(&ViewNeeds::tone_map);
  const std::string of_radiance = views_that_need(&ViewNeeds::tone_map);
  const bool truth = !options.reference.empty();
  need("--heat", !options.view.heat.empty(), shows(&ViewNeeds::heat_range),
       views_that_need(&ViewNeeds::heat_range));
  need("--tone-map", !options.view.tone_map.empty(), radiance, of_radiance);
  need("--exposure", options.view.exposure.has_value(), radiance, of_radiance);
  need("--metric", !options.metric.empty(), truth, "the errors against --reference");
  for (const std::string& id : options.views) {
    const ViewNeeds& needs = find_view(id).needs;
    const std::string option = fmt::format("--views {}", id);
    need(option, needs.reference, truth, "what --reference names");
    need(option, needs.other_lane, lanes > 1, "two lanes or more");
  }
}

PictureSize window_size(const ScreenshotOptions& options) {
  constexpr int most_side = 16384;  // of a texture, with the software rasteriser
  const PictureSize size = parse_size("--size", options.window);
  if (size.width > most_side || size.height > most_side) {
    throw UsageError(
        fmt::format("--size: a window of {0} cannot be drawn; at most {1}x{1} would be "
                    "right",
                    options.window, most_side));
  }
  return size;
}

std::vector<LaneSettings> shown_lanes(const ScreenshotOptions& options,
                                      const StopConditions& stop) {
  std::vector<LaneSettings> lane_settings =
      settings_of_lanes(options.lanes, options.run.lane_settings, stop);
  if (lane_settings.size() > lane_count) {
    throw UsageError(fmt::format(
        "{}: {} lanes are more than the {} that the window has; quartet "
        "figure takes any number",
        options.lanes.lanes.empty() ? "--estimators" : "--lane", lane_settings.size(), lane_count));
  }
  return lane_settings;
}

LabState state_of(const ScreenshotOptions& options, const Run& run,
                  std::vector<LaneSettings> lane_settings) {
  LabState state = initial_state();
  set_scene(state, run.scene);
  state.scene = options.run.scene;
  state.request.store.settings = run.settings;
  state.request.lanes.settings = std::move(lane_settings);
  state.request.store.memory = run.lab.memory;
  state.request.store.threads = run.lab.threads;
  state.view = view_settings(options.view);
  state.layout = find_layout(options.layout).key;
  state.ui_scale = options.scale.value_or(0.0f);
  if (!options.metric.empty()) {
    state.request.lanes.metric = find_metric(options.metric).key;
  }
  if (!options.reference.empty()) {
    state.dock.open = true;
  }
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    for (std::size_t slot = 0; slot < 2; ++slot) {
      const std::string& id = options.views[std::min(slot, options.views.size() - 1)];
      // The lanes are compared with the first, and that one with the second.
      state.slots[lane][slot] = {find_view(id).key, std::size_t(lane == 0 ? 1 : 0)};
    }
  }
  return state;
}

void run_screenshot(const ScreenshotOptions& options) {
  const std::filesystem::path output = options.output;
  if (output.extension() != ".png") {
    throw UsageError(fmt::format("-o: '{}' is no .png", options.output));
  }
  const PictureSize size = window_size(options);
  const StopConditions stop = stop_conditions(options.stop, !options.reference.empty());
  std::vector<LaneSettings> lane_settings = shown_lanes(options, stop);
  check_views(options, lane_settings.size());
  const Run run = prepare_run(options.run, lane_settings.size());
  check_rays(stop, run.scene->scene());
  LabState state = state_of(options, run, std::move(lane_settings));
  // Throws if it is unfit.
  truth_for(state.request.lanes.settings, reference_at(options.reference, run));
  StagedFiles files(output.parent_path(), {output.filename().string()});
  EndSeeker end(or_passes(stop), state.request.lanes.metric, state);
  Offscreen offscreen(size.width, size.height);
  ImguiScreen screen;
  ImGui::GetIO().DisplaySize = {float(size.width), float(size.height)};
  ImGui::GetIO().MousePos = {-1.0f, -1.0f};
  LabDriver driver(std::move(state), offscreen.gl(), [] {});
  if (!options.reference.empty()) {
    driver.load_reference(options.reference.path, options.reference.layer);
  }
  const auto draw = [&] {
    ImGui::GetIO().DeltaTime = 1.0f / 60.0f;
    driver.begin_frame(screen, natural_scale(size.width, size.height));
    driver.draw(0.0);
    screen.end_frame(offscreen.gl(), size.width, size.height);
  };
  draw();
  const Interrupt interrupt;
  Progress progress("rendering");
  while (!end.found() || !driver.settled()) {
    if (interrupt.token().stop_requested()) {
      throw Interrupted();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    draw();
    if (driver.snapshot()) {
      end.look(driver);
      progress.update(end.progress(*driver.snapshot()),
                      fmt::format("pass {}", driver.snapshot()->pass));
    }
    if (const std::string error = driver.error(); !error.empty()) {
      throw std::runtime_error(error);
    }
  }
  // The slider of passes ends where the lanes do, though they have been further.
  driver.window().state().playback.forget();
  // What is idle says so, and what is laid out by its own size is in its place.
  for (int i = 0; i < 3; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(40));
    draw();
  }
  files.finish([&] { write_png(files.stage(output.filename().string()), offscreen.read()); });
  tell_if_short(*driver.snapshot(), stop);
  report_rejected(*driver.snapshot(), options.run);
  tell_if_partial(driver.partial(), options.run);
}

}  // namespace

void add_screenshot_command(CLI::App& app, const Program&) {
  CLI::App* command =
      app.add_subcommand("screenshot", "The lab window as a PNG, drawn without a display");
  const auto options = std::make_shared<ScreenshotOptions>();
  add_run_options(*command, options->run, "--render-size");
  add_lane_options(*command, options->lanes);
  add_view_options(*command, options->view);
  add_stop_options(*command, options->stop);
  add_reference_option(*command, options->reference);
  command->add_option("--size", options->window, "Of the window")
      ->type_name("WxH")
      ->capture_default_str();
  add_number(*command, "--scale", options->scale, ui_scale_range,
             "Of text and controls; what suits the size if not given");
  command->add_option("--layout", options->layout, "columns, grid or large")->capture_default_str();
  command
      ->add_option("--views", options->views,
                   "What the two pictures of each lane show: " + row_ids(views()))
      ->delimiter(',')
      ->expected(1, 2)
      ->capture_default_str();
  command->add_option("--metric", options->metric,
                      fmt::format("Of the dock's chart, with --reference; {} if not given: {}",
                                  metric(default_metric).id, row_ids(metrics())));
  command->add_option("-o,--output", options->output, "A .png")->required();
  command->footer(
      "All lanes are shown at the pass where the last of them meets its end.\n"
      "Examples:\n"
      "  quartet screenshot cornell-checker --passes 15 --size 1600x1000 -o lab.png\n"
      "  quartet screenshot veach-plates --views error,difference --layout grid -o plates.png");
  command->callback([options] { run_screenshot(*options); });
}

}  // namespace quartet
