// SPDX-License-Identifier: Apache-2.0
#include "base/checkpoint_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "base/file_text.h"
#include "base/temporary_folder.h"

namespace oriel {
namespace checkpoint_file_test {

class CheckpointFile : public ::testing::Test {
 protected:
  std::string path() const { return folder_.file("a.checkpoint"); }
  const std::vector<float> numbers_ = {1, 2, 3};
  const std::vector<std::uint8_t> bytes_ = {4, 5};

  void write_sample() const {
    CheckpointWriter out(path(), {{"seed", "7"}, {"empty", ""}});
    out.array(numbers_);
    out.value(std::uint32_t{9});
    out.list(bytes_);
    out.commit();
  }
  void replace(const std::string& content) const {
    std::ofstream(path(), std::ios::binary) << content;
  }
  /// The reason why the file is refused; empty if it is read.
  std::string refusal() const try {
    CheckpointReader in(path());
    std::vector<float> numbers(3);
    std::vector<std::uint8_t> bytes;
    std::uint32_t value = 0;
    in.array(numbers), in.value(value), in.list(bytes);
    in.end();
    return {};
  } catch (const CheckpointError& e) {
    return e.what();
  }
  /// The file with another body and a checksum that fits, as an attacker would write it.
  void forge(const std::string& labels, const std::string& body) const {
    std::string bytes = file_text(path()).substr(0, 16);
    const std::uint64_t sizes[] = {labels.size(), body.size()};
    bytes.append(reinterpret_cast<const char*>(sizes), sizeof sizes);
    Checksum64 sum;
    sum.add(labels), sum.add(body), sum.add(bytes);
    const std::uint64_t value = sum.value();
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    replace(bytes + labels + body);
  }
  static std::string number(std::uint64_t value, std::size_t size) {
    return {reinterpret_cast<const char*>(&value), size};
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(CheckpointFile, RoundTripIsExact) {
  write_sample();
  CheckpointReader in(path());
  EXPECT_EQ(in.labels(), (CheckpointLabels{{"seed", "7"}, {"empty", ""}}));
  std::vector<float> numbers(3);
  std::vector<std::uint8_t> bytes;
  std::uint32_t value = 0;
  in.array(numbers), in.value(value), in.list(bytes);
  EXPECT_EQ(numbers, numbers_);
  EXPECT_EQ(value, 9u);
  EXPECT_EQ(bytes, bytes_);
  EXPECT_NO_THROW(in.end());
}

TEST_F(CheckpointFile, EveryTruncationIsRefused) {
  write_sample();
  const std::string whole = file_text(path());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    replace(whole.substr(0, size));
    EXPECT_NE(refusal(), "") << size;
  }
  replace(whole + '\0');
  EXPECT_NE(refusal(), "") << "one byte more";
  replace(whole);
  EXPECT_EQ(refusal(), "");
}

TEST_F(CheckpointFile, EveryFlippedBitIsRefused) {
  write_sample();
  const std::string whole = file_text(path());
  for (std::size_t bit = 0; bit < whole.size() * 8; ++bit) {
    std::string torn = whole;
    torn[bit / 8] = static_cast<char>(torn[bit / 8] ^ (1 << bit % 8));
    replace(torn);
    EXPECT_NE(refusal(), "") << bit;
  }
}

TEST_F(CheckpointFile, SizesInTheFileAreCheckedBeforeMemoryIsTaken) {
  write_sample();
  const std::string body = file_text(path()).substr(40);
  for (const std::uint64_t count : {std::uint64_t{0}, std::uint64_t{2}, std::uint64_t{4},
                                    std::uint64_t{1} << 61, ~std::uint64_t{0}}) {
    forge("", number(count, 8) + std::string(40, '\1'));
    EXPECT_NE(refusal(), "") << count;
    forge("", number(3, 8) + std::string(16, '\1') + number(count, 8) + "x");
    EXPECT_NE(refusal(), "") << count;
    forge(number(count, 4) + "name", "");
    EXPECT_NE(refusal(), "") << count;
  }
  forge("", number(3, 8) + std::string(16, '\1') + number(1, 8) + "x");
  EXPECT_EQ(refusal(), "") << "the forgery itself is read";
  forge("", number(3, 8) + std::string(16, '\1') + number(1, 8) + "xy");
  EXPECT_NE(refusal(), "") << "bytes after the last array";
}

TEST_F(CheckpointFile, OtherFilesAreRefused) {
  EXPECT_EQ(refusal(), "there is no such file");
  replace(std::string(100, 'x'));
  EXPECT_EQ(refusal(), "it is not a checkpoint of Oriel");
  write_sample();
  std::string other = file_text(path());
  other[8] = 2;
  replace(other);
  EXPECT_EQ(refusal(), "it has format 2, and this program reads format 1");
}

TEST_F(CheckpointFile, WithoutCommitTheOldOneStays) {
  write_sample();
  const std::string before = file_text(path());
  {
    CheckpointWriter out(path(), {{"seed", "8"}});
    out.array(numbers_);
  }
  EXPECT_EQ(file_text(path()), before);
}

}  // namespace checkpoint_file_test
}  // namespace oriel
