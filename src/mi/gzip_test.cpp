// SPDX-License-Identifier: Apache-2.0
#include "mi/gzip.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>

#include "mi/reader.h"

namespace oriel::mi {
namespace gzip_test {

/// A temporary file that is deleted with the test.
class GzipFile {
 public:
  explicit GzipFile(const std::string& text) {
    gzFile file = gzopen(path_.c_str(), "wb9");
    gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
    gzclose(file);
  }
  ~GzipFile() { std::filesystem::remove(path_); }
  const std::string& path() const { return path_; }
  void cut(std::uintmax_t bytes) const {
    std::filesystem::resize_file(path_, std::filesystem::file_size(path_) - bytes);
  }

 private:
  const std::string path_ = ::testing::TempDir() + "scene.mi.gz";
};

const std::string kScene = "options \"o\" samples 0 2 end options\nset \"x\" \"y\"\n";

// acceptance: H1
TEST(Gzip, CompressedSceneEqualsPlainScene) {
  const GzipFile file(kScene);
  Diagnostics diagnostics;
  const scene::Scene packed = read_scene(file.path(), {}, diagnostics);
  EXPECT_TRUE(diagnostics.all().empty());
  EXPECT_TRUE(packed == read_text(kScene, {}, diagnostics));
}

TEST(Gzip, TruncatedFileIsReported) {
  const GzipFile file(kScene);
  file.cut(9);
  std::string reason;
  EXPECT_FALSE(read_gzip(file.path(), 1 << 20, reason));
  EXPECT_NE(reason.find("damaged"), std::string::npos) << reason;
}

TEST(Gzip, MissingFileFails) {
  std::string reason;
  EXPECT_FALSE(read_gzip(::testing::TempDir() + "missing/scene.mi.gz", 1 << 20, reason));
  EXPECT_EQ(reason, "cannot be opened");
}

TEST(Gzip, TextAboveTheSizeLimitIsRefused) {
  const GzipFile file(std::string(20 << 20, ' '));
  EXPECT_LT(std::filesystem::file_size(file.path()), 50'000u);
  std::string reason;
  EXPECT_FALSE(read_gzip(file.path(), 1 << 20, reason));
  EXPECT_NE(reason.find("larger"), std::string::npos) << reason;
}

}  // namespace gzip_test
}  // namespace oriel::mi
