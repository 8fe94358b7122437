// SPDX-License-Identifier: Apache-2.0
#include "base/parallel.h"

#include <gtest/gtest.h>

#include <vector>

namespace oriel {
namespace parallel_test {

TEST(Parallel, BlocksContainEachNumberOnce) {
  for (const std::size_t count : {0, 1, 6, 7, 8, 14, 1000})
    for (const std::size_t block : {1, 7, 2000}) {
      std::vector<int> calls(count, 0);
      parallel_for_blocks(count, block, [&](std::size_t i) { ++calls.at(i); });
      EXPECT_EQ(calls, std::vector<int>(count, 1)) << count << " in blocks of " << block;
    }
}

}  // namespace parallel_test
}  // namespace oriel
