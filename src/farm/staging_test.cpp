// SPDX-License-Identifier: Apache-2.0
#include "farm/staging.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "support/files.h"

namespace oriel::farm {
namespace staging_test {

namespace fs = std::filesystem;

class Staging : public ::testing::Test {
 protected:
  Staging() {
    job_.folder = folder_.file("job");
    job_.name = "house";
    job_.scene = "house.mi";
    fs::create_directories(job_.path("scene/maps"));
    for (const char* name : {"house.mi", "pack.json", "maps/oak.png"})
      std::ofstream(job_.path(std::string("scene/") + name)) << name;
    job_.stage = folder_.file("node");
  }
  TestFolder folder_;
  Job job_;
};

TEST_F(Staging, TheSceneIsCopiedOnceForEachNode) {
  const auto old = fs::file_time_type::clock::now() - std::chrono::hours(77);
  fs::last_write_time(job_.path("scene/maps/oak.png"), old);
  const std::string copy = staged_scene(job_);
  EXPECT_EQ(fs::path(copy).parent_path(), job_.stage);
  EXPECT_EQ(text_of(copy + "/maps/oak.png"), "maps/oak.png");
  EXPECT_EQ(fs::last_write_time(copy + "/maps/oak.png"), old);
  // A second task reads the same copy.
  std::ofstream(copy + "/maps/oak.png") << "mark";
  EXPECT_EQ(staged_scene(job_), copy);
  EXPECT_EQ(text_of(copy + "/maps/oak.png"), "mark");
  EXPECT_EQ(std::distance(fs::directory_iterator(job_.stage), fs::directory_iterator()), 1);
}

TEST_F(Staging, AnotherSceneIsAnotherCopy) {
  const std::string copy = staged_scene(job_);
  std::ofstream(job_.path("scene/house.mi")) << "edited";
  EXPECT_NE(staged_scene(job_), copy);
}

TEST_F(Staging, WithoutACopyTheSceneOfTheJobIsRead) {
  std::ofstream(job_.stage) << "a file";
  EXPECT_EQ(staged_scene(job_), job_.path("scene"));
  job_.stage.clear();
  EXPECT_EQ(staged_scene(job_), job_.path("scene"));
}

TEST_F(Staging, CopiesThatOthersMayChangeAreNotRead) {
  const std::string copy = staged_scene(job_);
  fs::permissions(copy, fs::perms::others_write, fs::perm_options::add);
  EXPECT_EQ(staged_scene(job_), job_.path("scene"));
}

}  // namespace staging_test
}  // namespace oriel::farm
