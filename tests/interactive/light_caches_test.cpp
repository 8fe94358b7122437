// SPDX-License-Identifier: Apache-2.0
// What is computed before the full-size picture: when, what is shown meanwhile, and what keeps it.
#include <algorithm>

#include "interactive/loop_support.h"

namespace oriel::interactive {
namespace {

/// A loop that stores its pictures and counts the computations of caches.
class CountedLoop {
 public:
  CountedLoop(const SceneSource& source, const ViewSettings& view)
      : loop_(source, LoopSettings(),
              [this](const auto& picture) { pictures_.push_back(picture); }) {
    loop_.on_caches_end([this] { ++computations_; });
    loop_.set_view(view);
    EXPECT_TRUE(loop_.read());
  }
  RenderLoop& loop() { return loop_; }
  int computations() const { return computations_; }
  /// Those since the last call.
  std::vector<std::shared_ptr<const Picture>> take_pictures() {
    return std::exchange(pictures_, {});
  }

 private:
  int computations_ = 0;
  std::vector<std::shared_ptr<const Picture>> pictures_;
  RenderLoop loop_;
};

class LightCachesTest : public LoopTest {
 protected:
  void write_scene(const std::string& options) {
    std::string scene = editable_scene();
    const std::string path = "\"indirect\" \"path\"";
    scene.replace(scene.find(path), path.size(), options);
    write("scene.mi", scene);
  }
  std::vector<float> fresh(const ViewSettings& view, const std::vector<std::string>& edits) const {
    RenderLoop loop(source(), LoopSettings(), {});
    loop.set_view(view);
    EXPECT_TRUE(loop.read());
    loop.set_edits(edits);
    finish(loop);
    return beauty(loop);
  }
};

constexpr const char* kGathers = "finalgather on finalgather accuracy 200 1 .1";
constexpr const char* kTraces = "\"indirect\" \"path\"";

/// Number of pictures that are drafts of full size, which come before all others of that size.
std::size_t full_size_drafts(const std::vector<std::shared_ptr<const Picture>>& pictures) {
  const auto is_full = [](const auto& p) { return p->divider == 1; };
  const auto is_draft = [&](const auto& p) { return is_full(p) && p->preview; };
  const auto first = std::find_if(pictures.begin(), pictures.end(), is_full);
  const auto end = std::find_if_not(first, pictures.end(), is_draft);
  EXPECT_TRUE(std::none_of(end, pictures.end(), is_draft));
  return static_cast<std::size_t>(end - first);
}

TEST_F(LightCachesTest, ADraftOfFullSizeComesBeforeCaches) {
  write_scene(kGathers);
  CountedLoop counted(source(), small_view());
  finish(counted.loop());
  const auto pictures = counted.take_pictures();
  EXPECT_GE(full_size_drafts(pictures), 1u);
  // The picture never gets fewer samples.
  std::uint32_t samples = 0;
  for (const auto& picture : pictures) {
    if (picture->divider > 1) continue;
    EXPECT_GE(picture->samples, samples);
    samples = picture->samples;
  }
  EXPECT_FALSE(pictures.back()->preview);
}

TEST_F(LightCachesTest, PathsThatLearnNothingHaveNoDraftOfFullSize) {
  CountedLoop counted(source(), small_view());
  finish(counted.loop());
  EXPECT_EQ(full_size_drafts(counted.take_pictures()), 0u);
}

TEST_F(LightCachesTest, PathsThatLearnHaveADraftOfFullSize) {
  ViewSettings view = small_view();
  view.budget.samples = 180;  // of 48 x 32 pixels: more than 2^18 paths
  CountedLoop counted(source(), view);
  finish(counted.loop());
  EXPECT_GE(full_size_drafts(counted.take_pictures()), 1u);
}

TEST_F(LightCachesTest, ChangesOfTheFilmAloneKeepCaches) {
  for (const char* options : {kGathers, kTraces}) {
    write_scene(options);
    ViewSettings view = small_view();
    if (options == kTraces) view.budget.samples = 700;
    CountedLoop counted(source(), view);
    finish(counted.loop());
    EXPECT_EQ(counted.computations(), 1) << options;
    view.layers = {"beauty", "normal", "depth"};
    counted.loop().set_view(view);
    finish(counted.loop());
    EXPECT_EQ(counted.computations(), 1) << options;
    EXPECT_EQ(beauty(counted.loop()), fresh(view, {})) << options;
    // An interruption before the full-size picture does not lose them.
    view.layers = {"beauty", "normal"};
    counted.loop().set_view(view);
    counted.loop().run(true);
    view.layers = {"beauty"};
    counted.loop().set_view(view);
    finish(counted.loop());
    EXPECT_EQ(counted.computations(), 1) << options;
    // What they depend on computes them again.
    const std::string edit = "floor_mtl.diffuse=.2 .2 .6";
    counted.loop().set_edits({edit});
    finish(counted.loop());
    EXPECT_EQ(counted.computations(), 2) << options;
    EXPECT_EQ(beauty(counted.loop()), fresh(view, {edit})) << options;
    counted.loop().set_edits({edit});
    finish(counted.loop());
    EXPECT_EQ(counted.computations(), 2) << "the same edits";
    view.budget.samples = *view.budget.samples + 1;
    counted.loop().set_view(view);
    finish(counted.loop());
    EXPECT_EQ(counted.computations(), 3) << "they depend on the number of paths";
    EXPECT_EQ(beauty(counted.loop()), fresh(view, {edit})) << options;
  }
}

TEST_F(LightCachesTest, AnotherWindowComputesCachesAgain) {
  write_scene(kGathers);
  ViewSettings view = small_view();
  CountedLoop counted(source(), view);
  finish(counted.loop());
  view.region = {4, 4, 40, 20};
  counted.loop().set_view(view);
  finish(counted.loop());
  EXPECT_EQ(counted.computations(), 2);
  EXPECT_EQ(beauty(counted.loop()), fresh(view, {}));
}

}  // namespace
}  // namespace oriel::interactive
