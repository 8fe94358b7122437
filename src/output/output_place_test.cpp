// SPDX-License-Identifier: Apache-2.0
#include "output/output_place.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/temporary_folder.h"

namespace oriel {
namespace output_place_test {

namespace fs = std::filesystem;

OutputRoots roots_of(const fs::path& folder) { return {folder.string(), {folder.string()}}; }

TEST(OutputPlace, AbsoluteNamesOutsideLieBesideTheScene) {
  const TemporaryFolder folder;
  const fs::path scene = fs::canonical(folder.path());
  for (const char* name :
       {"C:\\Users\\me\\render\\x.exr", "c:/x.exr", "/home/me/x.exr", "\\\\server\\share\\x.exr"}) {
    const OutputPlace place = output_place(name, roots_of(scene));
    EXPECT_EQ(place.path, (scene / "x.exr").string()) << name;
    EXPECT_TRUE(place.moved) << name;
  }
}

TEST(OutputPlace, OtherNamesAreUnchanged) {
  const TemporaryFolder folder;
  const fs::path scene = fs::canonical(folder.path());
  for (const std::string& name : {std::string("images/x.exr"), std::string("images\\x.exr"),
                                  (scene / "images/x.exr").string()}) {
    const OutputPlace place = output_place(name, roots_of(scene));
    EXPECT_EQ(place.path, (scene / "images/x.exr").string()) << name;
    EXPECT_FALSE(place.moved) << name;
  }
  for (const char* name : {"../x.exr", "..\\x.exr", "C:\\..", "", "/"})
    EXPECT_EQ(output_place(name, roots_of(scene)).path, "") << name;
}

TEST(OutputPlace, FoldersAreMadeBelowTheRootAlone) {
  const TemporaryFolder folder;
  const fs::path scene = fs::canonical(folder.path()) / "scene", other = folder.path() / "other";
  fs::create_directory(scene);
  EXPECT_EQ(output_fault((scene / "a/b/x.exr").string(), roots_of(scene)), "");
  EXPECT_TRUE(fs::is_directory(scene / "a/b"));
  EXPECT_TRUE(fs::is_empty(scene / "a/b")) << "the test leaves nothing";
  EXPECT_NE(output_fault((other / "x.exr").string(), roots_of(scene)), "");
  EXPECT_FALSE(fs::exists(other));
}

TEST(OutputPlace, UnwritablePathsAreErrors) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "x.exr");
  std::ofstream(folder.path() / "file") << "text";
  EXPECT_NE(output_fault((folder.path() / "x.exr").string(), roots_of(folder.path())), "");
  EXPECT_NE(output_fault((folder.path() / "file/y.exr").string(), roots_of(folder.path())), "");
  EXPECT_NE(output_fault((folder.path() / std::string(300, 'x')).string(), roots_of(folder.path())),
            "");
}

}  // namespace output_place_test
}  // namespace oriel
