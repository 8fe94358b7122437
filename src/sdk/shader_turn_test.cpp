// SPDX-License-Identifier: Apache-2.0
#include "sdk/shader_turn.h"

#include <gtest/gtest.h>

#include <thread>

#include "sdk/user_spec.h"

namespace oriel::sdk {
namespace shader_turn_test {

TEST(ShaderTurn, MayBeEnteredAgainByItsThreadAlone) {
  ShaderTurn turn;
  std::atomic<bool> stopped = false, entered = false;
  ASSERT_TRUE(turn.enter(stopped));
  ASSERT_TRUE(turn.enter(stopped));
  EXPECT_EQ(turn.depth(), 2);
  std::thread other([&] {
    EXPECT_EQ(turn.depth(), 0);
    turn.restore(0);  // of its own levels, so without effect
    entered = turn.enter(stopped);
    turn.leave();
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_FALSE(entered);
  turn.restore(1);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_FALSE(entered);
  turn.leave();
  other.join();
  EXPECT_TRUE(entered);
}

TEST(ShaderTurn, IsGivenUpAfterAStop) {
  ShaderTurn turn;
  std::atomic<bool> stopped = true;
  ASSERT_TRUE(turn.enter(stopped));
  std::thread([&] { EXPECT_FALSE(turn.enter(stopped)); }).join();
}

// The system gives ids of ended threads to new ones.
TEST(ThreadPointers, AreNotFoundByLaterThreads) {
  ThreadPointers pointers;
  int value = 0;
  for (int i = 0; i < 50; ++i)
    std::thread([&] {
      EXPECT_EQ(pointers.get(), nullptr);
      pointers.set(&value);
      EXPECT_EQ(pointers.get(), &value);
    }).join();
  EXPECT_EQ(pointers.all().size(), 50u);
}

}  // namespace shader_turn_test
}  // namespace oriel::sdk
