// SPDX-License-Identifier: Apache-2.0
// Tasks of a session while it computes the caches of indirect light.
#include "interactive/interactive_session.h"

#include <condition_variable>
#include <thread>

#include "interactive/loop_support.h"

namespace oriel::interactive {
namespace {

class InteractiveSessionTest : public LoopTest {
 protected:
  void SetUp() override {
    // Gather points that take long enough for a few tasks.
    std::string scene = editable_scene();
    const std::string path = "\"indirect\" \"path\"";
    scene.replace(scene.find(path), path.size(),
                  "finalgather on finalgather accuracy 20000 .05 .01");
    write("scene.mi", scene);
  }
  std::unique_ptr<InteractiveSession> opened() {
    auto session = std::make_unique<InteractiveSession>(
        source(), LoopSettings(), SessionCallbacks{{}, [this] { changed(); }});
    session->post([](RenderLoop& loop) {
      loop.set_view(small_view());
      EXPECT_TRUE(loop.read());
    });
    return session;
  }
  template <class Condition>
  void wait(const Condition& is_true) {
    std::unique_lock lock(mutex_);
    while (!is_true()) wake_.wait_for(lock, std::chrono::milliseconds(5));
  }
  void changed() { wake_.notify_all(); }
  void wait_for_caches(const InteractiveSession& session) {
    wait([&] { return session.status().progress.stage != nullptr; });
  }

  std::mutex mutex_;
  std::condition_variable wake_;
};

TEST_F(InteractiveSessionTest, TasksThatChangeNothingLeaveCachesAlone) {
  RenderLoop alone(source(), LoopSettings(), {});
  alone.set_view(small_view());
  ASSERT_TRUE(alone.read());
  finish(alone);

  const auto session = opened();
  wait_for_caches(*session);
  std::atomic<int> reads = 0, beside = 0;
  for (int i = 0; i < 3; ++i)
    session->post(
        [&](RenderLoop& loop) {
          beside += loop.computes_caches();
          ++reads;
          changed();
        },
        TaskKind::Reads);
  session->set_paused(true);
  std::atomic<bool> waited = false;
  bool complete = false;
  session->post(
      [&](RenderLoop& loop) {
        complete = loop.session() && loop.session()->can_save() && !loop.computes_caches();
        waited = true;
        changed();
      },
      TaskKind::Waits);
  session->set_paused(false);
  wait([&] { return waited.load(); });
  EXPECT_EQ(reads, 3);
  EXPECT_EQ(beside, 3) << "they run while the caches are computed";
  EXPECT_TRUE(complete) << "the caches were not interrupted";

  wait([&] { return session->status().state == LoopState::Converged; });
  std::vector<float> picture;
  std::atomic<bool> copied = false;
  session->post([&](RenderLoop& loop) {
    picture = beauty(loop);
    copied = true;
    changed();
  });
  wait([&] { return copied.load(); });
  EXPECT_EQ(picture, beauty(alone));
}

TEST_F(InteractiveSessionTest, TasksThatChangeSomethingInterruptCaches) {
  const auto session = opened();
  wait_for_caches(*session);
  std::atomic<bool> ran = false;
  bool complete = true;
  session->post([&](RenderLoop& loop) {
    complete = loop.session() && loop.session()->can_save();
    loop.set_edits({"floor_mtl.diffuse=.2 .2 .6"});
    ran = true;
    changed();
  });
  wait([&] { return ran.load(); });
  EXPECT_FALSE(complete);
}

}  // namespace
}  // namespace oriel::interactive
