// SPDX-License-Identifier: Apache-2.0
#include "base/input_files.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "base/temporary_folder.h"

namespace oriel {
namespace input_files_test {

TEST(InputFiles, FramesAreForgottenAndScenesAreKept) {
  note_input_file("a.mi", InputKind::Scene);
  note_input_file("b.png", InputKind::Frame);
  EXPECT_EQ(input_files(InputKind::Frame).count("b.png"), 1u);
  forget_frame_inputs();
  EXPECT_EQ(input_files(InputKind::Scene).count("a.mi"), 1u);
  EXPECT_TRUE(input_files(InputKind::Frame).empty());
}

TEST(InputFiles, SmallFilesCountByContentAndLargeOnesByTime) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a");
  namespace fs = std::filesystem;
  const auto write = [&](const std::string& text, int seconds) {
    std::ofstream(path) << text;
    fs::last_write_time(path, fs::file_time_type(std::chrono::seconds(seconds)));
  };
  const auto sums = [&] { return std::pair(file_checksum(path, 10), file_checksum(path, 1)); };
  write("one", 100);
  const auto first = sums();
  write("one", 200);
  EXPECT_EQ(sums().first, first.first) << "same content";
  EXPECT_NE(sums().second, first.second) << "another time";
  write("two", 100);
  EXPECT_NE(sums().first, first.first) << "another content";
  EXPECT_EQ(sums().second, first.second) << "same size and time";
  EXPECT_EQ(file_checksum(folder.file("missing"), 10), 0u);
  EXPECT_EQ(file_checksum(folder.path().string(), 10), 0u);
}

}  // namespace input_files_test
}  // namespace oriel
