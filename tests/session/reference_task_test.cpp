#include "renderer/session/reference_task.h"

#include <gtest/gtest.h>

#include <atomic>
#include <fstream>

#include "renderer/measure/reference/reference_cache.h"
#include "renderer/measure/reference/reference_render.h"
#include "renderer/scene/load_scene.h"
#include "tests/files/temp_folder.h"
#include "tests/wait_until.h"

namespace quartet {
namespace {

using test::wait_until;
using Activity = ReferenceStatus::Activity;

std::shared_ptr<const TraceScene> scene() {
  static const auto loaded =
      std::make_shared<const TraceScene>(load_scene(find_scene("cornell-checker")));
  return loaded;
}

ReferenceRequest request_for(std::uint64_t spp, std::filesystem::path file = {}) {
  ReferenceRequest request{scene(), default_settings(scene()->scene()), std::move(file), spp};
  request.settings.width = 24;
  request.settings.height = 16;
  return request;
}

RadianceImage rendered(std::uint32_t spp) {
  RenderSettings settings = request_for(0).settings;
  settings.seed = reference_seed;
  ReferenceRender render(scene(), settings);
  render.add(spp);
  return render.reference()->image;
}

/// What the task says in the end.
ReferenceStatus finished_reference(ReferenceTask& task, ReferenceRequest request) {
  const std::uint64_t number = task.submit(std::move(request));
  auto latest = task.latest();
  const bool answered = wait_until([&] {
    latest = task.latest();
    return latest->input == number && latest->output.activity == Activity::idle;
  });
  EXPECT_TRUE(answered) << "no answer";
  return answered ? latest->output : ReferenceStatus{};
}

bool never() {
  return false;
}

TEST(ReferenceTaskThreads, ComputesCachesAndGoesOn) {
  const TempFolder folder;
  const std::filesystem::path cache = folder / "cache";
  {
    ReferenceTask task(reference_work(cache, never));
    EXPECT_FALSE(finished_reference(task, request_for(0)).reference) << "the cache is empty";
    const ReferenceStatus computed = finished_reference(task, request_for(40));
    EXPECT_EQ(computed.error, "");
    ASSERT_TRUE(computed.reference);
    EXPECT_EQ(computed.reference->spp, 40u);
    EXPECT_EQ(computed.reference->image, rendered(40));
  }
  // Another run of the program finds it, and adds to it what is missing to the bit.
  ReferenceTask task(reference_work(cache, never));
  const ReferenceStatus found = finished_reference(task, request_for(0));
  ASSERT_TRUE(found.reference);
  EXPECT_EQ(found.reference->image, rendered(40));
  const ReferenceStatus more = finished_reference(task, request_for(64));
  ASSERT_TRUE(more.reference);
  EXPECT_EQ(more.reference->image, rendered(64));
  EXPECT_EQ(
      load_reference(cached_reference_path(cache, scene()->scene(), request_for(0).settings))->spp,
      64u);
}

TEST(ReferenceTaskThreads, AnotherViewHasNone) {
  ReferenceTask task(reference_work({}, never));
  ASSERT_TRUE(finished_reference(task, request_for(32)).reference);
  ReferenceRequest seed = request_for(0);
  seed.settings.seed = 5;
  seed.settings.integrator = IntegratorId::kajiya;
  seed.settings.sampler = SamplerId::independent;
  EXPECT_TRUE(finished_reference(task, seed).reference) << "the truth is the same";
  ReferenceRequest size = request_for(0);
  size.settings.width = 25;
  EXPECT_FALSE(finished_reference(task, size).reference);
  EXPECT_FALSE(finished_reference(task, {}).reference);
}

TEST(ReferenceTaskThreads, ARefusedFileLeavesTheReferenceOfBefore) {
  const TempFolder folder;
  ReferenceTask task(reference_work({}, never));
  const auto before = finished_reference(task, request_for(32)).reference;
  ASSERT_TRUE(before);
  ExrImage other(5, 4);
  other.add_radiance(RadianceImage(5, 4, glm::vec3(1.0f)));
  write_exr(folder / "other.exr", other);
  write_bytes_to(folder / "broken.exr", "no picture");
  for (const char* name : {"other.exr", "broken.exr", "missing.exr"}) {
    const ReferenceStatus refused = finished_reference(task, request_for(0, folder / name));
    EXPECT_NE(refused.error.find(name), std::string::npos) << refused.error;
    EXPECT_EQ(refused.reference, before);
  }
  EXPECT_NE(finished_reference(task, request_for(0, folder / "other.exr")).error.find("5x4"),
            std::string::npos);
  EXPECT_EQ(finished_reference(task, request_for(0)).error, "");
}

TEST(ReferenceTaskThreads, AnotherProgramsPictureIsAccepted) {
  const TempFolder folder;
  ExrImage picture(24, 16);
  picture.add_radiance(RadianceImage(24, 16, glm::vec3(0.5f)));
  write_exr(folder / "theirs.exr", picture);
  ReferenceTask task(reference_work({}, never));
  const ReferenceStatus loaded = finished_reference(task, request_for(0, folder / "theirs.exr"));
  EXPECT_EQ(loaded.error, "");
  ASSERT_TRUE(loaded.reference);
  EXPECT_FALSE(loaded.reference->ours());
}

TEST(ReferenceTaskThreads, GivesWayAndEndsAsIfItHadNot) {
  // Now and then, in the middle of a pass: it is given up, and nothing of it may stay.
  std::atomic<int> looks = 0;
  ReferenceTask task(reference_work({}, [&] { return ++looks % 50 == 0; }));
  const ReferenceStatus computed = finished_reference(task, request_for(34));
  ASSERT_TRUE(computed.reference);
  EXPECT_EQ(computed.reference->image, rendered(34));
  EXPECT_GT(looks, 34);
}

TEST(ReferenceTaskThreads, WaitsWhileSomebodyIsBusyAndStopsWhenAsked) {
  std::atomic<bool> busy = true;
  ReferenceTask task(reference_work({}, [&] { return busy.load(); }));
  task.submit(request_for(1u << 20));
  EXPECT_TRUE(wait_until([&] { return task.latest()->output.waits; }));
  EXPECT_TRUE(task.latest()->output.waits);
  EXPECT_EQ(task.latest()->output.spp, 0u);
  busy = false;
  ASSERT_TRUE(wait_until([&] { return task.latest()->output.reference != nullptr; }))
      << "the first ones are shown long before the end";
  const ReferenceStatus stopped = finished_reference(task, request_for(0));
  ASSERT_TRUE(stopped.reference);
  EXPECT_GE(stopped.reference->spp, 32u);
  EXPECT_LT(stopped.reference->spp, 1u << 20);
}

TEST(ReferenceTaskThreads, ADamagedFileOfTheCacheIsToldAndMadeAgain) {
  const TempFolder folder;
  const std::filesystem::path file =
      cached_reference_path(folder.path(), scene()->scene(), request_for(0).settings);
  write_bytes_to(file, "damaged");
  ReferenceTask task(reference_work(folder.path(), never));
  EXPECT_NE(finished_reference(task, request_for(0)).error.find(file.filename().string()),
            std::string::npos);
  const ReferenceStatus made = finished_reference(task, request_for(32));
  ASSERT_TRUE(made.reference);
  EXPECT_EQ(made.reference->image, rendered(32));
  EXPECT_EQ(load_reference(file)->spp, 32u);
}

TEST(ReferenceTaskThreads, ACacheThatHasMoreByNowKeepsIt) {
  const TempFolder folder;
  RenderSettings settings = request_for(0).settings;
  settings.seed = reference_seed;
  const std::filesystem::path file =
      cached_reference_path(folder.path(), scene()->scene(), settings);
  // Another program finishes first, while this one computes.
  ReferenceRender other(scene(), settings);
  other.add(100);
  std::atomic<bool> there = false;
  ReferenceTask task(reference_work(folder.path(), [&] {
    if (!there.exchange(true)) {
      write_exr(file, exr_of(other.sums(), "quartet"));
    }
    return false;
  }));
  const ReferenceStatus made = finished_reference(task, request_for(32));
  ASSERT_TRUE(made.reference);
  EXPECT_EQ(made.reference->spp, 32u);
  EXPECT_EQ(made.error, "");
  EXPECT_EQ(load_reference(file)->spp, 100u);
}

TEST(ReferenceTaskThreads, AFolderThatCannotBeWrittenIsNamed) {
  const TempFolder folder;
  write_bytes_to(folder / "file", "");
  ReferenceTask task(reference_work(folder / "file/cache", never));
  const ReferenceStatus computed = finished_reference(task, request_for(32));
  EXPECT_NE(computed.error.find("file/cache"), std::string::npos) << computed.error;
  EXPECT_TRUE(computed.reference) << "it can be used all the same";
}

}  // namespace
}  // namespace quartet
