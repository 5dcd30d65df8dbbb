// What the window exports, and whether the command line beside it makes the same.

#include "app/window/lab_export.h"

#include <gtest/gtest.h>

#include <sstream>

#include "app/options/lane_option.h"
#include "renderer/base/cancel.h"
#include "renderer/files/exr.h"
#include "renderer/files/png.h"
#include "tests/app/program.h"
#include "tests/files/temp_folder.h"
#include "tests/ui/lab_hand.h"

namespace quartet {
namespace {

/// By the dialog, into this folder.
void save(LabHand& hand, const std::filesystem::path& folder) {
  hand.state().export_form.folder = folder.string();
  hand.key('s');
  hand.frames(3);
  hand.click("export.save");
  hand.settle();
  ASSERT_EQ(hand.window().message().kind, Message::Kind::notice) << hand.window().message().text;
}

/// Without "quartet".
std::vector<std::string> words_of(const std::filesystem::path& command) {
  std::istringstream text(bytes_of(command));
  std::string word;
  text >> word;
  EXPECT_EQ(word, "quartet");
  std::vector<std::string> words;
  while (text >> word) {
    words.push_back(word);
  }
  return words;
}

/// The last lane is one that looks at the truth.
void compute_and_use_reference(LabHand& hand, std::uint64_t spp) {
  hand.state().reference_form.spp = spp;
  hand.key('d');
  hand.click("dock.compute");
  hand.settle();
  ASSERT_TRUE(hand.state().request.lanes.reference);
  hand.choose("lane3.estimator", "oracle");
  hand.settle();
}

TEST(LabWindowExport, SaysWhereAndHowToRepeatIt) {
  const TempFolder folder;
  LabHand hand;
  hand.drag("lane1.threshold0", 12.0f);
  hand.settle();
  hand.state().export_form.folder = (folder / "out").string();
  hand.key('s');
  hand.frames(3);
  hand.click("export.save");
  hand.settle();
  ASSERT_EQ(hand.window().message().kind, Message::Kind::notice) << hand.window().message().text;
  for (const char* name : {"images.png", "images.pdf", "heatmaps.png", "kl.exr", "command.txt"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / "out" / name)) << name;
  }
  const std::string command = bytes_of(folder / "out" / "command.txt");
  EXPECT_NE(command.find("--size 96x54"), std::string::npos) << command;
  EXPECT_NE(command.find("--passes 5"), std::string::npos) << command;
}

TEST(LabWindowExport, PicturesAreAsTheyAreShownAndTheCommandRepeatsThem) {
  const TempFolder folder;
  const std::filesystem::path out = folder / "out";
  LabHand hand;
  hand.state().view.exposure = 1.5f;
  hand.state().view.tone_map = ToneMap::filmic;
  hand.state().view.heat = HeatRange::report;
  hand.frames(3);
  save(hand, out);
  const std::string command = bytes_of(out / "command.txt");
  EXPECT_NE(command.find(" --exposure=1.5 "), std::string::npos) << command;
  EXPECT_NE(command.find(" --tone-map filmic "), std::string::npos) << command;
  EXPECT_NE(command.find(" --heat report "), std::string::npos) << command;
  write_png(folder / "shown.png",
            draw_view(hand.snapshot(), 1, ViewKind::image, hand.state().view).image);
  write_png(folder / "heat.png",
            draw_view(hand.snapshot(), 1, ViewKind::heatmap, hand.state().view).image);
  EXPECT_EQ(bytes_of(out / "kl.png"), bytes_of(folder / "shown.png"));
  EXPECT_EQ(bytes_of(out / "kl-heatmap.png"), bytes_of(folder / "heat.png"));
  std::filesystem::remove(out / "kl.png");
  const Result again = run(words_of(out / "command.txt"));
  ASSERT_EQ(again.code, 0) << again.error;
  EXPECT_EQ(bytes_of(out / "kl.png"), bytes_of(folder / "shown.png"));
}

TEST(ReproducingCommand, SaysAllThatIsNotAsItComes) {
  Snapshot snapshot;
  snapshot.scene = std::make_shared<const TraceScene>(load_scene(find_scene("cornell-checker")));
  snapshot.settings = default_settings(snapshot.scene->scene());
  snapshot.settings.width = 96;
  snapshot.settings.height = 54;
  snapshot.settings.seed = 7;
  snapshot.pass = 13;
  snapshot.lanes.resize(2);
  snapshot.lanes[0].settings = default_settings(EstimatorId::kl);
  snapshot.lanes[1].settings = default_settings(EstimatorId::uniform);
  const std::string plain =
      "quartet figure cornell-checker --passes 13 --size 96x54 --seed 7 --integrator mis "
      "--sampler sobol";
  const std::string lanes = " --lane " + lane_text(snapshot.lanes[0].settings) + " --lane " +
                            lane_text(snapshot.lanes[1].settings);
  EXPECT_EQ(reproducing_command(snapshot, {}, "cornell-checker", "out", {}),
            plain + lanes + " --out out");
  snapshot.settings.max_depth = 4;
  snapshot.settings.camera.origin = {1, 2, 3};
  snapshot.settings.camera.right = {4, 5, 6};
  snapshot.settings.camera.up = {7, 8, 9};
  snapshot.settings.camera.forward = {10, 11, 12};
  ViewSettings view;
  view.exposure = -2.25f;
  view.tone_map = ToneMap::reinhard;
  view.heat = HeatRange::report;
  EXPECT_EQ(reproducing_command(snapshot, view, "cornell-checker", "out", "ref.exr"),
            plain + " --max-depth 4 --camera=1,2,3,4,5,6,7,8,9,10,11,12" + lanes +
                " --reference ref.exr --heat report --tone-map reinhard --exposure=-2.25"
                " --out out");
}

TEST(LabWindowExport, ALaneThatLooksAtTheTruthComesWithTheFileOfIt) {
  const TempFolder folder;
  const std::filesystem::path out = folder / "out";
  LabHand hand(1600, 1000, folder / "cache");
  compute_and_use_reference(hand, 64);
  save(hand, out);
  EXPECT_EQ(hand.window().message().text.find("--reference"), std::string::npos)
      << hand.window().message().text;
  const std::vector<std::string> words = words_of(out / "command.txt");
  // More samples in the cache do not change what was exported.
  hand.state().reference_form.spp = 96;
  hand.click("reference");
  hand.click("reference.compute");
  hand.settle();

  const ExrImage exported = read_exr(out / "oracle.exr");
  std::filesystem::remove(out / "oracle.exr");
  const Result again = run(words);
  ASSERT_EQ(again.code, 0) << again.error;
  const ExrImage repeated = read_exr(out / "oracle.exr");
  ASSERT_NE(exported.find("SquaredError"), nullptr);
  for (const char* channel : {"R", "SampleCount", "Error.oracle", "SquaredError"}) {
    ASSERT_NE(repeated.find(channel), nullptr) << channel;
    EXPECT_EQ(exported.find(channel)->pixels, repeated.find(channel)->pixels) << channel;
  }
}

TEST(LabWindowExport, SaysThatAReferenceIsInNoFile) {
  const TempFolder folder;
  LabHand hand;  // without a cache
  compute_and_use_reference(hand, 64);
  save(hand, folder / "out");
  const std::string& said = hand.window().message().text;
  EXPECT_NE(said.find("needs --reference"), std::string::npos) << said;
  const std::string command = bytes_of(folder / "out" / "command.txt");
  EXPECT_EQ(command.find(" --reference"), command.rfind(" --reference"));
  EXPECT_NE(command.find("\n# command.txt needs --reference"), std::string::npos) << command;
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / "reference.exr"));
}

TEST(LabWindowExport, GoesWhereATildeSays) {
  const TempFolder folder;
  const std::string before = std::getenv("HOME") ? std::getenv("HOME") : "";
  setenv("HOME", folder.path().c_str(), 1);
  LabHand hand;
  save(hand, "~/figs");
  setenv("HOME", before.c_str(), 1);
  EXPECT_TRUE(std::filesystem::exists(folder / "figs/command.txt"));
  EXPECT_FALSE(std::filesystem::exists("~"));
}

TEST(LabWindowExport, ThatIsCancelledLeavesNothing) {
  const TempFolder folder;
  LabHand hand;
  ExportForm form;
  form.folder = (folder / "out").string();
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(export_lab(hand.snapshot(), {}, form, "cornell-checker", nullptr, stop.get_token()),
               Cancelled);
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

}  // namespace
}  // namespace quartet
