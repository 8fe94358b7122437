// SPDX-License-Identifier: Apache-2.0
// What every test program begins with: a place for temporary files that no other process shares,
// since ctest runs the tests of one program as processes beside one another.
#include <gtest/gtest.h>

#include "base/temporary_folder.h"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const oriel::TemporaryFolder folder;
  setenv("TMPDIR", folder.path().c_str(), 1);
  return RUN_ALL_TESTS();
}
