#include "app/window/scene_loader.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "renderer/base/cancel.h"
#include "renderer/scene/synthetic.h"
#include "tests/wait_until.h"

namespace quartet {
namespace {

using test::wait_until;

std::shared_ptr<const TraceScene> some_scene() {
  return std::make_shared<const TraceScene>(synthetic_scene(synthetics().front()));
}

/// Whatever is called "endless" is loaded until it is cancelled.
struct EndlessScenes {
  std::atomic<int> begun = 0;
  std::atomic<int> cancelled = 0;

  SceneLoader::Open open() {
    return [this](const SceneLoader::Order& order, const std::stop_token& stop) {
      while (order.scene == "endless") {
        begun += begun == cancelled ? 1 : 0;
        if (stop.stop_requested()) {
          ++cancelled;
          throw Cancelled();
        }
        std::this_thread::yield();
      }
      return some_scene();
    };
  }
};

std::optional<SceneLoader::Result> result_of(SceneLoader& loader) {
  std::optional<SceneLoader::Result> result;
  EXPECT_TRUE(wait_until([&] {
    result = loader.poll();
    return result.has_value();
  }));
  return result;
}

TEST(SceneLoaderThreads, GivesAResultOnce) {
  std::atomic<int> woken = 0;
  SceneLoader loader([&] { ++woken; });
  EXPECT_FALSE(loader.busy());
  loader.load("synthetic:" + std::string(synthetics().front().id));
  EXPECT_TRUE(loader.busy());
  const auto result = result_of(loader);
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->scene);
  EXPECT_EQ(result->error, "");
  EXPECT_FALSE(loader.busy());
  EXPECT_FALSE(loader.poll());
  EXPECT_EQ(woken, 1);
}

TEST(SceneLoaderThreads, SaysWhatIsWrong) {
  SceneLoader loader([] {});
  loader.load("no-such-scene");
  const auto result = result_of(loader);
  ASSERT_TRUE(result);
  EXPECT_FALSE(result->scene);
  EXPECT_NE(result->error.find("no-such-scene"), std::string::npos) << result->error;
  EXPECT_EQ(result->asked, "no-such-scene");
}

TEST(SceneLoaderThreads, ANewerSceneEndsTheLoadingOfTheOneBefore) {
  EndlessScenes scenes;
  SceneLoader loader([] {}, scenes.open());
  loader.load("endless");
  ASSERT_TRUE(wait_until([&] { return scenes.begun == 1; }));
  loader.load("short");
  const auto result = result_of(loader);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->asked, "short");
  EXPECT_EQ(scenes.cancelled, 1);
}

TEST(SceneLoaderThreads, CanBeCancelledAndGoesOnAfterwards) {
  EndlessScenes scenes;
  SceneLoader loader([] {}, scenes.open());
  loader.load("endless");
  ASSERT_TRUE(wait_until([&] { return scenes.begun == 1; }));
  loader.cancel();
  EXPECT_FALSE(loader.busy());
  ASSERT_TRUE(wait_until([&] { return scenes.cancelled == 1; }));
  EXPECT_FALSE(loader.poll());
  loader.load("short");
  EXPECT_TRUE(result_of(loader)->scene);
}

TEST(SceneLoaderThreads, EndsInTheMiddleOfLoading) {
  EndlessScenes scenes;
  {
    SceneLoader loader([] {}, scenes.open());
    loader.load("endless");
    ASSERT_TRUE(wait_until([&] { return scenes.begun == 1; }));
  }
  EXPECT_EQ(scenes.cancelled, 1);
}

TEST(SceneLoaderThreads, MemoryThatIsMissingIsAnErrorThatNamesTheScene) {
  SceneLoader loader(
      [] {},
      [](const SceneLoader::Order&, const std::stop_token&) -> std::shared_ptr<const TraceScene> {
        throw std::bad_alloc();
      });
  loader.load("huge.xml");
  EXPECT_EQ(result_of(loader)->error, "huge.xml: there is not enough memory for it");
}

}  // namespace
}  // namespace quartet
