// SPDX-License-Identifier: Apache-2.0
#include "base/diagnostic.h"

#include <gtest/gtest.h>

#include <array>
#include <fstream>

#include "base/temporary_folder.h"

namespace oriel {
namespace diagnostic_test {

TEST(Diagnostics, LocationsContainTheIncludeChain) {
  Diagnostics d;
  const auto outer = d.add_file("scene.mi");
  const auto inner = d.add_file("part.mi", {outer, 7, 1});
  d.error("OR-MI-001", {inner, 3, 9}, "unknown statement 'colour'", "did you mean 'color'?");
  const std::string text = d.format(d.all().front());
  EXPECT_NE(text.find("in file included from scene.mi:7:1:"), std::string::npos);
  EXPECT_NE(text.find("part.mi:3:9: error: unknown statement"), std::string::npos);
  EXPECT_NE(text.find("hint: did you mean"), std::string::npos);
}

TEST(Diagnostics, RepeatedDiagnosticsAreLimitedAndCounted) {
  Diagnostics d;
  for (int i = 0; i < 1000; ++i) d.warning("OR-MI-002", {}, "again");
  EXPECT_EQ(d.all().size(), Diagnostics::kMaxPerCode + 1);
}

TEST(NearestName, FindsTyposAndRejectsUnrelatedNames) {
  const std::string names[] = {"refl_gloss", "diffuse", "reflectivity"};
  EXPECT_EQ(nearest_name("refl_glos", names), "refl_gloss");
  EXPECT_EQ(nearest_name("zzz", names), "");
}

TEST(NearestName, SwappedNeighboursCountOnce) {
  // Two edits of four letters are too many.
  EXPECT_EQ(nearest_name("siez", std::array<std::string, 1>{"size"}), "size");
  EXPECT_EQ(nearest_name("sieg", std::array<std::string, 1>{"size"}), "");
}

TEST(NearestName, TheLimitGrowsWithTheLength) {
  const std::array<std::string, 1> names = {"abcdefghi"};
  EXPECT_EQ(nearest_name("xbcxefgxi", names), "abcdefghi");
  EXPECT_EQ(nearest_name("xbxdxfgxi", names), "");
}

TEST(NearestName, FilesAreThoseOfTheFolder) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "wood.png") << "x";
  EXPECT_EQ(nearest_file((folder.path() / "wod.png").string()), "wood.png");
  EXPECT_EQ(nearest_file((folder.path() / "stone.png").string()), "");
  EXPECT_EQ(nearest_file((folder.path() / "none" / "wod.png").string()), "");
}

}  // namespace diagnostic_test
}  // namespace oriel
