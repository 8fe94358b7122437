// SPDX-License-Identifier: Apache-2.0
#include "base/file_access.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <thread>

#include "base/temporary_folder.h"

namespace oriel {
namespace file_access_test {

namespace fs = std::filesystem;
using Fault = OpenFile::Fault;

class FileAccess : public ::testing::Test {
 protected:
  FileAccess() {
    for (const char* name : {"scene", "other"}) {
      fs::create_directory(folder_.path() / name);
      std::ofstream(folder_.path() / name / "a") << name;
    }
    access_.permit(path("scene"));
  }
  std::string path(const std::string& name) const { return folder_.file(name); }
  Fault fault(const std::string& name, FileUse use) const {
    return access_.open(path(name), use).fault();
  }

  TemporaryFolder folder_;
  oriel::FileAccess access_;
};

TEST_F(FileAccess, PathsBelowAFolderShareWholeNames) {
  EXPECT_TRUE(lies_below("/a/b", "/a") && lies_below("/a", "/a") && lies_below("/a", "/"));
  EXPECT_FALSE(lies_below("/ab", "/a") || lies_below("/", "/a") || lies_below("/a", ""));
}

TEST_F(FileAccess, AssetsOfOwnScenesMayLieAnywhereAndIncludesMayNot) {
  EXPECT_EQ(fault("scene/a", FileUse::Scene), Fault::None);
  EXPECT_EQ(fault("other/a", FileUse::Asset), Fault::None);
  EXPECT_EQ(fault("other/a", FileUse::Scene), Fault::Outside);
  EXPECT_EQ(fault("scene/../other/a", FileUse::Scene), Fault::Outside);
  EXPECT_EQ(fault("other/none", FileUse::Scene), Fault::Missing);
  access_.set_untrusted(true);
  EXPECT_EQ(fault("scene/a", FileUse::Asset), Fault::None);
  EXPECT_EQ(fault("other/a", FileUse::Asset), Fault::Outside);
  EXPECT_EQ(fault("other/none", FileUse::Asset), Fault::Outside) << "existence is not revealed";
  access_.permit(path("other/a"));
  EXPECT_EQ(fault("other/a", FileUse::Scene), Fault::None);
}

TEST_F(FileAccess, LinksAreResolvedBeforeTheCheck) {
  fs::create_symlink(path("other/a"), path("scene/out"));
  fs::create_symlink(path("other"), path("scene/folder"));
  fs::create_symlink("a", path("scene/in"));
  EXPECT_EQ(fault("scene/out", FileUse::Scene), Fault::Outside);
  EXPECT_EQ(fault("scene/folder/a", FileUse::Scene), Fault::Outside);
  EXPECT_EQ(fault("scene/in", FileUse::Scene), Fault::None);
  // The name of the opened file has no links.
  EXPECT_EQ(access_.open(path("scene/in"), FileUse::Scene).path(),
            fs::canonical(path("scene/a")).string());
}

// A link that changes between the check and the opening.
TEST_F(FileAccess, AChangingLinkNeverLeadsOutside) {
  std::atomic<bool> done = false;
  std::thread changing([&] {
    for (int i = 0; !done; ++i) {
      fs::create_symlink(i % 2 ? path("other/a") : path("scene/a"), path("scene/new"));
      fs::rename(path("scene/new"), path("scene/link"));
    }
  });
  int opened = 0;
  for (int i = 0; i < 20'000; ++i) {
    OpenFile file = access_.open(path("scene/link"), FileUse::Scene);
    if (!file) continue;
    ++opened;
    EXPECT_EQ(file.read(), "scene");
  }
  done = true;
  changing.join();
  EXPECT_GT(opened, 0);
}

TEST_F(FileAccess, OnlyRegularFilesAreOpened) {
  ASSERT_EQ(mkfifo(path("scene/pipe").c_str(), 0600), 0);
  for (const std::string& name :
       {path("scene/pipe"), path("scene"), std::string("/dev/zero"),
        std::string("/proc/self/environ"), std::string("/proc/version")}) {
    EXPECT_EQ(open_regular(name).fault(), Fault::NotRegular) << name;
    EXPECT_EQ(access_.open(name, FileUse::Asset).fault(), Fault::NotRegular) << name;
  }
  EXPECT_EQ(open_regular(path("none")).fault(), Fault::Missing);
}

TEST_F(FileAccess, UrlsAreNotOpened) {
  for (const char* url : {"http://host/a", "scene/file:///etc/passwd", "s3+x://b"}) {
    EXPECT_TRUE(is_url(url)) << url;
    EXPECT_EQ(access_.open(url, FileUse::Asset).fault(), Fault::Url);
    EXPECT_FALSE(access_.permits(url, FileUse::Asset));
  }
  for (const char* name : {"a/b", "C://a", "a:b", "://a"}) EXPECT_FALSE(is_url(name)) << name;
}

TEST_F(FileAccess, ContentIsReadUpToALimit) {
  OpenFile file = open_regular(path("other/a"));
  EXPECT_EQ(file.size(), 5u);
  EXPECT_EQ(file.read(2), "ot");
  EXPECT_EQ(file.read(), "her");
  std::ifstream again(file.descriptor_path());
  fs::remove(path("other/a"));
  std::string text;
  again >> text;
  EXPECT_EQ(text, "other");
}

}  // namespace file_access_test
}  // namespace oriel
