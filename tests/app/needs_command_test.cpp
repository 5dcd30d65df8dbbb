#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "renderer/scene/load_scene.h"
#include "renderer/scene/scene_hash.h"
#include "tests/app/program.h"
#include "tests/files/temp_folder.h"
#include "tests/records/csv.h"

namespace quartet {
namespace {

class NeedsCommand : public testing::Test {
 protected:
  static std::vector<std::string> needs(const std::string& scene,
                                        const std::vector<std::string>& more) {
    std::vector<std::string> words{"needs", scene, "--size", "16x9", "--spp", "2", "--seeds", "3"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  TempFolder folder_;
};

TEST_F(NeedsCommand, WritesTheChartTheNumbersAndTheSmallestModel) {
  const auto result = run(needs("cornell-checker", {"--parts", "depth,lights,gloss", "--error",
                                                    "relmse=100", "--out", path("out")}));
  ASSERT_EQ(result.code, 0) << result.error;
  EXPECT_NE(result.out.find("The smallest model found: "), std::string::npos) << result.out;
  EXPECT_EQ(names_in(path("out")),
            (std::set<std::string>{"needs.csv", "needs.json", "needs.png", "needs.pdf", "needs.svg",
                                   "smallest.xml", "smallest-mesh-1.obj", "smallest-mesh-2.obj",
                                   "quartet-files.txt"}));
  // With such an error anything goes but the last light.
  const Scene scene = load_scene(path("out") + "/smallest.xml");
  EXPECT_EQ(scene.max_depth, 1);
  EXPECT_EQ(scene.width, 16);
  EXPECT_EQ(std::ranges::count(scene.shapes, true, &Shape::emits), 1);
  for (const Material& material : scene.materials) {
    EXPECT_EQ(material_name(material), "diffuse");
  }
  EXPECT_EQ(scene.shapes.size(), load_scene(find_scene("cornell-checker")).shapes.size());

  const auto record = nlohmann::json::parse(bytes_of(path("out") + "/needs.json"));
  EXPECT_EQ(record.at("limit"), 100.0);
  EXPECT_EQ(record.at("taken_out").size(), 1u + 1u + 2u);
  EXPECT_EQ(record.at("rows").size(), 1u + 2u + 2u);
  EXPECT_TRUE(record.at("smallest").at("error").contains("high"));
  EXPECT_TRUE(record.at("smallest").at("energy_error").contains("mean"));
}

TEST_F(NeedsCommand, PrintsTableJsonAndCsv) {
  const std::vector<std::string> more{"--parts", "next-event,textures,roulette", "--csv",
                                      path("n.csv")};
  const auto text = run(needs("cornell-checker", more));
  ASSERT_EQ(text.code, 0) << text.error;
  EXPECT_NE(text.out.find("texture of 'checker' → its mean"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("no next-event estimation: the same picture in the mean; takes "),
            std::string::npos)
      << text.out;
  EXPECT_NE(text.out.find("energy"), std::string::npos);
  auto words = needs("cornell-checker", more);
  words.emplace_back("--json");
  const auto json = run(words);
  ASSERT_EQ(json.code, 0) << json.error;
  EXPECT_EQ(nlohmann::json::parse(json.out).at("rows").size(), 3u);
  std::map<std::string, int> found;
  const auto rows = rows_of(bytes_of(path("n.csv")));
  for (std::size_t i = 1; i < rows.size(); ++i) {
    ASSERT_GE(rows[i].size(), 9u);
    ++found[rows[i][7]];
  }
  EXPECT_EQ(found["relmse_trimmed"], found["energy_error"]) << "one beside the other";
  EXPECT_GE(found["relmse_trimmed"], 3);
}

TEST_F(NeedsCommand, IsTheSameWithAnyNumberOfThreads) {
  std::vector<std::string> csv;
  for (const std::string threads : {"1", "2"}) {
    const std::string file = path(threads + ".csv");
    ASSERT_EQ(
        run(needs("cornell-box", {"--parts", "depth", "--csv", file, "--threads", threads})).code,
        0);
    std::string kept;
    for (const auto& row : rows_of(bytes_of(file))) {
      if (row[7] != "seconds" && row[7] != "seconds_ratio") {
        for (const std::string& field : row) {
          kept += field + ",";
        }
      }
    }
    csv.push_back(kept);
  }
  EXPECT_EQ(csv[0], csv[1]);
}

TEST_F(NeedsCommand, FailsIfTheWholeModelIsTooNoisy) {
  const auto result =
      run(needs("cornell-box", {"--error", "relmse=0.00001", "--out", path("never")}));
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(
      result.error.find("cannot be met: the whole model's own noise, of 3 seeds of 2 spp, is"),
      std::string::npos)
      << result.error;
  EXPECT_FALSE(std::filesystem::exists(path("never")));
}

TEST_F(NeedsCommand, RefusesWhatHasNoEffect) {
  expect_usage_error(needs("cornell-box", {"--parts", "lens"}), "'lens' has no effect");
  expect_usage_error(needs("cornell-box", {"--parts", "lights"}), "'lights' has no effect");
  expect_usage_error(needs("cornell-box", {"--parts", "walls"}), "unknown part 'walls'");
  expect_usage_error(needs("cornell-box", {"--integrator", "kajiya", "--parts", "next-event"}),
                     "'next-event' has no effect");
  expect_usage_error(needs("synthetic:bernoulli", {}), "draws its samples");
  expect_usage_error(needs("cornell-box", {"--error", "psnr=40"}), "--error: noise cannot");
  expect_usage_error(needs("cornell-box", {"--error", "0.1"}), "--error");
  expect_usage_error(needs("cornell-box", {"--error", "mse=1", "--metric", "mse"}), "--metric");
  expect_usage_error({"needs", "cornell-box", "--seeds", "2"}, "--seeds");
}

}  // namespace
}  // namespace quartet
