// Whatever fails while files are written: the old ones are whole, or the new ones are and nothing
// is said to have gone wrong.

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <optional>
#include <sstream>

#include "app/records/lab_files.h"
#include "app/window/config_file.h"
#include "renderer/adaptive/lab.h"
#include "renderer/files/exr.h"
#include "renderer/files/file_target.h"
#include "renderer/files/png.h"
#include "renderer/measure/reference/reference_render.h"
#include "renderer/scene/load_scene.h"
#include "tests/faults/fault_cases.h"
#include "ui/paper/chart_figure.h"

namespace quartet {
namespace {

namespace fs = std::filesystem;

/// The scene of all cases, loaded once and outside of them.
std::shared_ptr<const TraceScene> scene() {
  static const auto loaded =
      std::make_shared<const TraceScene>(load_scene(find_scene("cornell-box")));
  return loaded;
}

RenderSettings settings() {
  RenderSettings small = default_settings(scene()->scene());
  small.width = 8;
  small.height = 6;
  return small;
}

/// A kind of export: writes into a folder what depends on a number.
struct ExportKind {
  const char* name;
  std::function<std::function<void()>(const fs::path& folder, int number)> prepare;
  bool json = false;  ///< see in_a_child
  int stride = 1;     ///< see fail_each_call; all calls of StagedFiles have a test of their own
};

template <class Write>
void write_one(const fs::path& folder, const char* name, const Write& write) {
  StagedFiles files(folder);
  write(files.stage(name));
  files.commit();
}

ExrImage picture(int number) {
  ExrImage image(40, 30);
  for (const char* name : {"R", "G", "B", "Half"}) {
    image.add(name, std::vector<float>(1200, float(number)));
  }
  image.channels.back().half = true;
  image.attributes["number"] = std::to_string(number);
  return image;
}

ChartFigure figure_of(int number) {
  Chart chart;
  chart.title = "chart " + std::to_string(number);
  chart.x = linear_axis(0.0, 1.0, "time (s)", 5);
  chart.y = linear_axis(0.0, 2.0, "error", 5);
  chart.lines = {{"line", {200, 30, 30}, {{0.1, 0.2}, {0.9, 0.1 * number}}}};
  ChartFigure figure;
  figure.title = "figure";
  figure.charts = {chart};
  figure.footer = "a footer";
  return figure;
}

Snapshot snapshot_of(int number) {
  std::vector<LaneSettings> lane_settings{default_settings(EstimatorId::kl),
                                          default_settings(EstimatorId::uniform)};
  RenderSettings of = settings();
  of.seed = std::uint64_t(number);
  LabOptions options;
  options.threads = 1;
  Lab lab(sample_source(scene(), of), of.width, of.height, lane_settings, options);
  lab.run_pass();
  Snapshot snapshot;
  copy_lanes(lab, snapshot);
  snapshot.scene = scene();
  snapshot.settings = of;
  return snapshot;
}

std::vector<ExportKind> exports() {
  return {
      {"EXR",
       [](const fs::path& folder, int number) {
         return [folder, image = picture(number)] {
           write_one(folder, "a.exr", [&](const fs::path& path) { write_exr(path, image); });
         };
       }},
      {"PNG",
       [](const fs::path& folder, int number) {
         return [folder, image = DisplayImage(20, 10, {std::uint8_t(number), 2, 3, 255})] {
           write_one(folder, "a.png", [&](const fs::path& path) { write_png(path, image); });
         };
       }},
      {"charts",
       [](const fs::path& folder, int number) {
         return [folder, figure = figure_of(number)] {
           StagedFiles files(folder);
           write_chart_png(figure, files.stage("a.png"));
           write_chart_pdf(figure, files.stage("a.pdf"));
           write_chart_svg(figure, files.stage("a.svg"));
           files.commit();
         };
       },
       false, 4},
      {"settings",
       [](const fs::path& folder, int number) {
         LabState state = initial_state();
         state.dock.height = 100.0f + float(number);
         return [folder, state] { save_config(folder / "settings.json", state, {}); };
       },
       true},
      {"reference",
       [](const fs::path& folder, int number) {
         RenderSettings of = settings();
         of.seed = std::uint64_t(number);
         ReferenceRender render(scene(), of);
         render.add(2);
         return [folder, sums = render.sums()] {
           StagedFiles files(folder);
           write_exr(files.stage("a.exr"), exr_of(sums, "quartet"));
           files.commit([&] { return samples_in(folder / "a.exr", sums) <= sums.spp; });
         };
       }},
      {"lanes",
       [](const fs::path& folder, int number) {
         return [folder, snapshot = snapshot_of(number)] {
           StagedFiles files(folder);
           write_lab_files(files, snapshot, {}, "quartet", std::nullopt);
           files.commit();
         };
       },
       true, 13},
  };
}

std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    files[entry.path().filename().string()] = bytes_of(entry.path());
  }
  return files;
}

/// The files are those of one set, if they are one.
void expect_consistent(const fs::path& folder) {
  const fs::path list = folder / StagedFiles::set_list_name;
  if (!fs::exists(list)) {
    return;
  }
  std::istringstream lines(bytes_of(list));
  std::string line;
  while (std::getline(lines, line)) {
    const std::size_t name = line.rfind(' ') + 1;
    if (fs::exists(folder / line.substr(name))) {
      EXPECT_EQ(checksum_text(folder / line.substr(name)), line.substr(0, name - 1)) << line;
    }
  }
}

/// A folder with the old files of an export, and the work that would replace them.
struct ExportCase {
  explicit ExportCase(const ExportKind& kind) {
    kind.prepare(out, 2)();
    old = contents(out);
    work = kind.prepare(out, 3);
  }

  void judge(const test::FaultOutcome& outcome) {
    const auto now = contents(out);
    if (outcome.error == "terminated" || outcome.error == "done without") {
      { const StagedFiles next(out); }  // removes what is left
      old = contents(out);
      EXPECT_EQ(old.size(), now.size() - (outcome.error == "terminated" && now.size() > 1 ? 1 : 0));
      expect_consistent(out);
    } else if (outcome.error.empty()) {
      EXPECT_EQ(now.size(), old.size());
      for (const auto& [name, bytes] : old) {
        if (name == "a.exr" || name == "panels.json" || name == "settings.json") {
          EXPECT_NE(now.at(name), bytes) << name;
        }
      }
      expect_consistent(out);
      old = now;
    } else {
      EXPECT_TRUE(now == old) << "the old files are not as they were";
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1)
        << "something was left beside the folder";
  }

  TempFolder folder;
  fs::path out = folder / "out";
  std::map<std::string, std::string> old;
  std::function<void()> work;
};

class ExportFaults : public testing::TestWithParam<std::size_t> {
 protected:
  ExportKind kind_ = exports()[GetParam()];
  ExportCase case_ = ExportCase(kind_);
  // What is written turns between two states, so that new and old always differ.
  std::array<std::function<void()>, 2> works_{case_.work, kind_.prepare(case_.out, 2)};
  std::size_t next_ = 0;

  void work() { works_[next_](); }
  void judge(const test::FaultOutcome& outcome) {
    case_.judge(outcome);
    next_ = outcome.error.empty() ? 1 - next_ : next_;
  }
};

TEST_P(ExportFaults, AnyCallThatFailsLeavesOldOrNew) {
  test::fail_each_call([&] { work(); }, kind_.stride,
                       [&](const test::FaultOutcome& outcome) { judge(outcome); });
}

TEST_P(ExportFaults, AnyAllocationThatFailsLeavesOldOrNew) {
  if (std::string(kind_.name) == "lanes") {
    return;  // all its kinds of files but JSON stand for themselves; and see in_a_child
  }
  test::fail_each_allocation([&] { work(); }, kind_.stride, kind_.json,
                             [&](const test::FaultOutcome& outcome) { judge(outcome); });
}

INSTANTIATE_TEST_SUITE_P(All, ExportFaults, testing::Range(std::size_t(0), exports().size()),
                         [](const auto& test) { return std::string(exports()[test.param].name); });

}  // namespace
}  // namespace quartet
