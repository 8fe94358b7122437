// SPDX-License-Identifier: Apache-2.0
#include "image/cryptomatte.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>

namespace oriel {
namespace cryptomatte_test {

TEST(Cryptomatte, HashesAreThoseOfTheSpecification) {
  // The manifests printed in the specification.
  EXPECT_EQ(murmur3_32("bunny"), 0x13851a76u);
  EXPECT_EQ(murmur3_32("default"), 0x42c9679fu);
  EXPECT_EQ(murmur3_32("bunny_porcelain_mat"), 0xb24b26d4u);
  // Of the hash itself: published vectors of MurmurHash3_x86_32.
  EXPECT_EQ(murmur3_32(""), 0u);
  EXPECT_EQ(murmur3_32("", 1), 0x514e28b7u);
  EXPECT_EQ(murmur3_32("aaaa", 0x9747b28c), 0x5a97808au);
  EXPECT_EQ(murmur3_32("Hello, world!", 0x9747b28c), 0x24884cbau);
}

TEST(Cryptomatte, IdsAreThoseOfTheReferenceTests) {
  EXPECT_EQ(cryptomatte_id("hello"), 6.0705627102400005616e-17f);
  EXPECT_FLOAT_EQ(cryptomatte_id("cube"), -4.08461912519e+15f);
  EXPECT_FLOAT_EQ(cryptomatte_id("sphere"), 2.79018604383e+15f);
  EXPECT_FLOAT_EQ(cryptomatte_id("plane"), 3.66557617593e-11f);
  EXPECT_EQ(cryptomatte_id("m\xc3\xa4"
                           "dchen"),
            6.2361298211599995797e+25f);
}

TEST(Cryptomatte, IdsAreNormalFloatsForAllNames) {
  for (int i = 0; i < 20000; ++i) {
    const float id = cryptomatte_id("object_" + std::to_string(i));
    EXPECT_TRUE(std::isnormal(id)) << i;
  }
  EXPECT_NE(cryptomatte_id(""), 0) << "nothing is not a name";
}

TEST(Cryptomatte, CoveragesAreMergedAndRanked) {
  std::vector<CryptomatteShare> shares = {{3, .1f}, {7, .4f}, {0, .1f}, {3, .25f}, {-2, .15f}};
  std::array<float, 8> out{};
  rank_shares(shares, out);
  EXPECT_EQ(out, (std::array<float, 8>{7, .4f, 3, .35f, -2, .15f, 0, .1f}));
  std::array<float, 4> few{};
  rank_shares(shares, few);
  EXPECT_EQ(few, (std::array<float, 4>{7, .4f, 3, .35f})) << "what has no rank is left out";
  std::vector<CryptomatteShare> nothing;
  rank_shares(nothing, few);
  EXPECT_EQ(few, (std::array<float, 4>{}));
}

TEST(Cryptomatte, HeaderContainsTypeHashAndNames) {
  const std::string names[] = {"default", "bunny", "a \"b\"\\", "bunny"};
  const auto m = cryptomatte_metadata("CryptoObject", names);
  const std::string key = "cryptomatte/3ae39a5/";  // of the hash 3ae39a58 of the type
  EXPECT_EQ(m.size(), 4u);
  EXPECT_EQ(m.at(key + "name"), "CryptoObject");
  EXPECT_EQ(m.at(key + "hash"), "MurmurHash3_32");
  EXPECT_EQ(m.at(key + "conversion"), "uint32_to_float32");
  const std::string& manifest = m.at(key + "manifest");
  EXPECT_NE(manifest.find(R"("bunny":"13851a76","default":"42c9679f")"), std::string::npos)
      << manifest;
  EXPECT_NE(manifest.find(R"("a \"b\"\\":")"), std::string::npos) << manifest;
}

}  // namespace cryptomatte_test
}  // namespace oriel
