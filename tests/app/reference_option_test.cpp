#include "app/options/reference_option.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>

#include "renderer/files/exr.h"
#include "renderer/files/staged_files.h"
#include "renderer/measure/reference/reference_cache.h"
#include "renderer/measure/reference/reference_render.h"
#include "renderer/scene/load_scene.h"
#include "tests/app/program.h"
#include "tests/files/temp_folder.h"

namespace quartet {
namespace {

/// The cache folder of the process, for the life of a test.
class ReferenceFor : public testing::Test {
 protected:
  ReferenceFor() {
    const char* const value = std::getenv("XDG_CACHE_HOME");
    old_ = value ? std::optional<std::string>(value) : std::nullopt;
    use_cache(folder_.path().string());
    run_.scene = std::make_shared<const TraceScene>(load_scene(find_scene("cornell-box")));
    run_.settings = default_settings(run_.scene->scene());
    run_.settings.width = 20;
    run_.settings.height = 15;
  }
  ~ReferenceFor() override {
    if (old_) {
      use_cache(*old_);
    } else {
      unsetenv("XDG_CACHE_HOME");
    }
  }

  static void use_cache(const std::string& path) { setenv("XDG_CACHE_HOME", path.c_str(), 1); }

  std::filesystem::path references() const { return folder_ / "quartet" / "references"; }

  /// Made without any cache.
  RadianceImage fresh(std::uint32_t spp) const {
    RenderSettings settings = run_.settings;
    settings.seed = reference_seed;
    ReferenceRender render(run_.scene, settings);
    render.add(spp);
    return render.reference()->image;
  }

  /// What a call says on stderr.
  std::string error_output(const std::function<void()>& call) const {
    testing::internal::CaptureStderr();
    call();
    return testing::internal::GetCapturedStderr();
  }

  TempFolder folder_;
  quartet::Run run_;

 private:
  std::optional<std::string> old_;
};

TEST_F(ReferenceFor, IsMadeOnceAndThenReadFromItsFile) {
  const auto made = reference_for(run_, 6, "quartet");
  EXPECT_EQ(made->spp, 6u);
  EXPECT_EQ(made->image, fresh(6));
  ASSERT_EQ(names_in(references()).size(), 1u);
  const std::filesystem::path file = references() / *names_in(references()).begin();
  // If it is read, what stands in the file comes back.
  std::optional<ReferenceSums> sums = sums_of(read_exr(file), file);
  ASSERT_TRUE(sums.has_value());
  sums->halves[0].sums[0] = glm::dvec3(600.0);
  sums->halves[1].sums[0] = glm::dvec3(0.0);
  write_exr(file, exr_of(*sums, "quartet"));
  EXPECT_EQ(reference_for(run_, 6, "quartet")->image.at(0, 0), glm::vec3(100.0f));
}

TEST_F(ReferenceFor, GoesOnFromFewerSamplesToTheBit) {
  reference_for(run_, 4, "quartet");
  EXPECT_EQ(reference_for(run_, 10, "quartet")->image, fresh(10));
  EXPECT_EQ(names_in(references()).size(), 2u);
  // More than are wanted are of no use: the same command gives the same numbers.
  EXPECT_EQ(reference_for(run_, 6, "quartet")->image, fresh(6));
}

TEST_F(ReferenceFor, TakesThatOfTheWindowWhereItHelps) {
  RenderSettings settings = run_.settings;
  settings.seed = reference_seed;
  ReferenceRender window(run_.scene, settings);
  window.add(5);
  const std::filesystem::path path =
      cached_reference_path(reference_cache_folder(), run_.scene->scene(), settings);
  StagedFiles files(path.parent_path());
  write_exr(files.stage(path.filename().string()), exr_of(window.sums(), "quartet"));
  files.commit();
  EXPECT_EQ(reference_for(run_, 5, "quartet")->image, fresh(5));
  EXPECT_EQ(names_in(references()).size(), 1u) << "nothing was made";
  EXPECT_EQ(reference_for(run_, 8, "quartet")->image, fresh(8));
}

TEST_F(ReferenceFor, WithoutAUsableCacheSaysSoAndIsRight) {
  reference_for(run_, 4, "quartet");
  const std::filesystem::path file = references() / *names_in(references()).begin();
  write_bytes_to(file, "damaged");
  std::shared_ptr<const Reference> reference;
  std::string said = error_output([&] { reference = reference_for(run_, 4, "quartet"); });
  EXPECT_EQ(reference->image, fresh(4));
  EXPECT_NE(said.find(file.string()), std::string::npos) << said;
  EXPECT_EQ(error_output([&] { reference_for(run_, 4, "quartet"); }), "") << "mended";

  write_bytes_to(folder_ / "file", "");
  use_cache((folder_ / "file").string());
  said = error_output([&] { reference = reference_for(run_, 4, "quartet"); });
  EXPECT_EQ(reference->image, fresh(4));
  EXPECT_NE(said.find("not cached"), std::string::npos) << said;
}

TEST_F(ReferenceFor, RefusesARunOfItsOwnRandomNumbers) {
  run_.settings.seed = reference_seed;
  EXPECT_NE(error_of([&] { reference_for(run_, 4, "quartet"); }).find("same random numbers"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(references()));
}

}  // namespace
}  // namespace quartet
