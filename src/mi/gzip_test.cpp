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

std::optional<std::string> read(const GzipFile& file, const TextLimits& limits,
                                SourceFault& fault) {
  return read_gzip(open_regular(file.path()), limits, fault);
}

TEST(Gzip, TruncatedFileIsReported) {
  const GzipFile file(kScene);
  file.cut(9);
  SourceFault fault;
  EXPECT_FALSE(read(file, {}, fault));
  EXPECT_NE(fault.reason.find("damaged"), std::string::npos) << fault.reason;
}

TEST(Gzip, TextAboveTheSizeLimitIsRefused) {
  const GzipFile file(std::string(20 << 20, ' '));
  EXPECT_LT(std::filesystem::file_size(file.path()), 50'000u);
  SourceFault fault;
  EXPECT_FALSE(read(file, {.text = 1 << 20}, fault));
  EXPECT_EQ(fault.budget, Budget::Text);
}

// 1028 bytes of text for each byte is more than any scene has; a short text may have it.
TEST(Gzip, TheExpansionOfLongTextIsLimited) {
  const GzipFile shorter(std::string(20 << 20, ' '));
  SourceFault fault;
  EXPECT_TRUE(read(shorter, {.expansion = 200}, fault));
  const GzipFile longer(std::string(70 << 20, ' '));
  EXPECT_FALSE(read(longer, {.expansion = 200}, fault));
  EXPECT_EQ(fault.budget, Budget::Expansion);
  EXPECT_EQ(read(longer, {.expansion = 2000}, fault).value_or("").size(), std::size_t{70} << 20);
}

}  // namespace gzip_test
}  // namespace oriel::mi
