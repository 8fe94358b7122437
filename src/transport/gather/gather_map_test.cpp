// SPDX-License-Identifier: Apache-2.0
// Final gather maps on disk: what is written comes back, what is not ours is refused.
#include "transport/gather/gather_map.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "sampling/sampler.h"

namespace oriel {
namespace gather_map_test {

class GatherMap : public ::testing::Test {
 protected:
  ~GatherMap() override { std::filesystem::remove(path_); }

  std::string bytes() const {
    std::ifstream in(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void put(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }
  /// The one message of a refusal.
  std::string refusal() const {
    Diagnostics d;
    EXPECT_FALSE(load_gather_map(path_, d));
    EXPECT_EQ(d.all().size(), 1u);
    EXPECT_TRUE(d.has("OR-TR-102"));
    return d.all().empty() ? "" : d.all()[0].message;
  }
  static std::vector<GatherRecord> some(int count) {
    std::vector<GatherRecord> records;
    sampling::Sampler sampler(3, 4, 5);
    for (int i = 0; i < count; ++i) {
      const auto h = GatherHemisphere::for_rays(normalize(Vec3(sampler.next_1d(), 1, 2)), 20);
      std::vector<GatherSample> samples;
      for (int s = 0; s < h.count(); ++s)
        samples.push_back({h.direction(s, sampler.next_2d()), Rgb(sampler.next_1d(), 0.5f, 2),
                           1 + sampler.next_1d()});
      samples[0].distance = std::numeric_limits<float>::infinity();
      records.push_back(make_gather_record(Vec3(sampler.next_1d(), static_cast<float>(i), 0), h,
                                           samples, {0.1f, 3}));
    }
    return records;
  }
  void write(const std::vector<GatherRecord>& records) const {
    Diagnostics d;
    ASSERT_TRUE(save_gather_map(records, path_, d));
    ASSERT_TRUE(d.all().empty());
  }

  std::string path_ = ::testing::TempDir() + "gathered.fgmap";
};

TEST_F(GatherMap, RoundTripIsExact) {
  const auto records = some(50);
  write(records);
  Diagnostics d;
  const auto back = load_gather_map(path_, d);
  ASSERT_TRUE(back);
  EXPECT_TRUE(d.all().empty());
  ASSERT_EQ(back->size(), records.size());
  // No padding: all members are floats.
  EXPECT_EQ(std::memcmp(back->data(), records.data(), records.size() * sizeof(GatherRecord)), 0);
}

TEST_F(GatherMap, EmptyMapIsAMap) {
  write({});
  Diagnostics d;
  const auto back = load_gather_map(path_, d);
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->empty());
}

TEST_F(GatherMap, MissingFileAndFolderAreRefused) {
  EXPECT_NE(refusal().find("could not be read"), std::string::npos);
  path_ = ::testing::TempDir();
  EXPECT_NE(refusal().find("could not be read"), std::string::npos);
  path_ = ::testing::TempDir() + "no/such/folder/map";
  Diagnostics d;
  EXPECT_FALSE(save_gather_map(some(1), path_, d));
  EXPECT_TRUE(d.has("OR-TR-101"));
}

TEST_F(GatherMap, ForeignFilesAreRefused) {
  for (const std::string& text :
       {std::string(), std::string("x"), std::string(5000, '\0'), std::string(77, '\xff')}) {
    put(text);
    EXPECT_NE(refusal().find("not a final gather map of Oriel"), std::string::npos);
  }
}

TEST_F(GatherMap, OtherVersionsAndByteOrdersAreNamed) {
  write(some(2));
  const std::string good = bytes();
  std::string other = good;
  std::swap(other[8], other[11]);
  std::swap(other[9], other[10]);
  put(other);
  EXPECT_NE(refusal().find("byte order"), std::string::npos);
  other = good;
  other[12] = 9;
  put(other);
  EXPECT_NE(refusal().find("version 9"), std::string::npos);
}

TEST_F(GatherMap, EveryFlippedByteIsNoticed) {
  write(some(2));
  const std::string good = bytes();
  for (std::size_t i = 0; i < good.size(); i += 3) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x41);
    put(bad);
    refusal();
  }
}

TEST_F(GatherMap, FilesOfAnyOtherLengthAreRejected) {
  write(some(2));
  const std::string good = bytes();
  for (std::size_t i = 0; i < good.size(); i += 7) {
    put(good.substr(0, i));
    refusal();
  }
  put(good + "x");
  refusal();
}

TEST_F(GatherMap, HugeCountsAreRefusedBeforeMemoryIsTaken) {
  write(some(1));
  std::string bad = bytes();
  for (std::size_t i = 24; i < 32; ++i) bad[i] = '\x7f';
  put(bad);
  EXPECT_NE(refusal().find("more than"), std::string::npos);
}

TEST_F(GatherMap, ImpossiblePointsAreRefused) {
  auto records = some(3);
  records[1].irradiance.x = -1;
  write(records);
  EXPECT_NE(refusal().find("cannot be"), std::string::npos);
  records[1].irradiance.x = std::nanf("");
  write(records);
  EXPECT_NE(refusal().find("cannot be"), std::string::npos);
}

}  // namespace gather_map_test
}  // namespace oriel
