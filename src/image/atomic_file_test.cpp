// SPDX-License-Identifier: Apache-2.0
#include "image/atomic_file.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/files.h"

namespace oriel {
namespace atomic_file_test {

TEST(AtomicFile, ReplacesTheFileWithoutLeftovers) {
  const TestFolder folder;
  const std::string path = folder.file("a.txt");
  write_bytes(path, {'o', 'l', 'd'});
  write_atomically(path, [&](const std::string& t) {
    EXPECT_EQ(t.substr(t.size() - 4), ".txt");
    EXPECT_EQ(bytes_of(path).size(), 3u) << "the old file is there until the new one is whole";
    write_bytes(t, {'n'});
  });
  EXPECT_EQ(bytes_of(path), std::vector<char>{'n'});
  EXPECT_EQ(folder.count(), 1);
}

TEST(AtomicFile, KeepsTheOldFileWhenTheWriterThrows) {
  const TestFolder folder;
  const std::string path = folder.file("a.txt");
  write_bytes(path, {'o', 'l', 'd'});
  EXPECT_THROW(write_atomically(path,
                                [](const std::string& t) {
                                  write_bytes(t, {'x'});
                                  throw std::runtime_error("half way");
                                }),
               std::runtime_error);
  EXPECT_EQ(bytes_of(path).size(), 3u);
  EXPECT_EQ(folder.count(), 1);
}

}  // namespace atomic_file_test
}  // namespace oriel
