// SPDX-License-Identifier: Apache-2.0
#include "interactive/tile_order.h"

#include <chrono>
#include <numeric>
#include <thread>

#include "base/parallel.h"
#include "interactive/loop_support.h"

namespace oriel::interactive {
namespace {

using std::vector;

TEST(TileOrder, TilesNearThePixelComeFirst) {
  const TileGrid grid(64, 48);  // 4 x 3 tiles
  std::vector<int> all(static_cast<std::size_t>(grid.count()));
  std::iota(all.begin(), all.end(), 0);
  const std::vector<int> order = tiles_near(Vec2(60, 40), grid, all);
  EXPECT_EQ(order.front(), 11) << "the last tile contains the pixel";
  EXPECT_EQ(order.back(), 0);
  EXPECT_TRUE(std::is_permutation(order.begin(), order.end(), all.begin(), all.end()));
  EXPECT_EQ(tiles_near(Vec2(32, 24), grid, {0, 3, 8, 11}), (std::vector{0, 3, 8, 11}))
      << "all are at the same distance";
}

TEST(TileOrder, TilesStartInTheGivenOrder) {
  const ThreadLimit one(1);
  const std::vector<int> tiles = {5, 3, 9, 1, 7};
  std::vector<int> started;
  for_each_tile(tiles, [&](int tile) { started.push_back(tile); });
  EXPECT_EQ(started, tiles);
}

class PointerTest : public LoopTest, public ::testing::WithParamInterface<bool> {};

// Whenever the picture is interrupted, the corner below the pointer has at least the samples of the
// opposite one, and has more of them in the middle of a pass.
TEST_P(PointerTest, PassesStartThere) {
  const ThreadLimit one(1);
  LoopSettings settings;
  settings.first_divider = 1;
  RenderLoop loop(source(), settings, {});
  ViewSettings view = small_view();
  view.size = {{96, 64}};
  view.budget.samples = 40;  // too few paths to learn
  loop.set_view(view);
  ASSERT_TRUE(loop.read());
  const bool upper_right = GetParam();
  loop.set_pointer(upper_right ? std::array{95, 0} : std::array{0, 63});
  std::atomic<bool> stop = false, done = false;
  std::thread interruptions([&] {
    while (!done) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      stop = true;
    }
  });
  int ahead = 0, behind = 0;
  while (!loop.run(stop)) {
    stop = false;
    if (!loop.session()) continue;
    const Film& film = loop.session()->film();
    std::uint32_t near = film.samples(film.width() - 1, film.height() - 1),
                  far = film.samples(0, 0);
    if (!upper_right) std::swap(near, far);
    ahead += near > far;
    behind += near < far;
  }
  done = true;
  interruptions.join();
  EXPECT_GT(ahead, 0);
  EXPECT_EQ(behind, 0);
  const vector<float> refined = beauty(loop);
  RenderLoop plain(source(), settings, {});
  plain.set_view(view);
  ASSERT_TRUE(plain.read());
  finish(plain);
  EXPECT_EQ(beauty(plain), refined) << "the order changes nothing of the picture";
}

INSTANTIATE_TEST_SUITE_P(Corners, PointerTest, ::testing::Bool());

}  // namespace
}  // namespace oriel::interactive
