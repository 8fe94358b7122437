// SPDX-License-Identifier: Apache-2.0
#include "scene/asset_path.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/temporary_folder.h"

namespace oriel::scene {
namespace asset_path_test {

using Names = std::vector<std::string>;

TEST(AssetPath, CandidatesAreEndsOfThePath) {
  EXPECT_EQ(spellings_of("W:\\maps\\oak.tif"),
            (Names{"W:\\maps\\oak.tif", "W:/maps/oak.tif", "maps/oak.tif", "oak.tif"}));
  EXPECT_EQ(spellings_of("//server/maps//oak.tif"),
            (Names{"//server/maps//oak.tif", "server/maps//oak.tif", "maps//oak.tif", "oak.tif"}));
  EXPECT_EQ(spellings_of("oak.tif"), Names{"oak.tif"});
}

TEST(AssetPath, ShortenedCandidatesContainNoParentFolder) {
  EXPECT_EQ(spellings_of("..\\a\\..\\oak.tif"),
            (Names{"..\\a\\..\\oak.tif", "../a/../oak.tif", "oak.tif"}));
}

TEST(AssetPath, LongestMatchingPathIsFound) {
  const TemporaryFolder temporary;
  const std::filesystem::path& folder = temporary.path();
  std::filesystem::create_directories(folder / "maps");
  std::ofstream(folder / "maps/oak.tif") << "below";
  const auto found = [&](const char* written) { return find_asset(written, folder.string()); };
  EXPECT_EQ(found("W:\\house\\maps\\oak.tif"), (folder / "maps/oak.tif").string());
  EXPECT_EQ(found("maps\\oak.tif"), (folder / "maps/oak.tif").string());
  EXPECT_EQ(found("W:\\oak.tif"), (folder / "W:\\oak.tif").string());
  std::ofstream(folder / "oak.tif") << "beside";
  EXPECT_EQ(found("/mnt/house/oak.tif"), (folder / "oak.tif").string());
}

TEST(AssetPath, NamesThatDifferOnlyInCaseAreFound) {
  const TemporaryFolder temporary;
  const std::filesystem::path& folder = temporary.path();
  std::filesystem::create_directories(folder / "Maps");
  std::ofstream(folder / "Maps/Oak.TIF") << "oak";
  const auto found = [&](const char* written) { return find_asset(written, folder.string()); };
  for (const char* written : {"W:\\house\\maps\\oak.tif", "MAPS/OAK.TIF", "maps\\Oak.tif"})
    EXPECT_EQ(found(written), (folder / "Maps/Oak.TIF").string()) << written;
  EXPECT_EQ(found("maps/elm.tif"), (folder / "maps/elm.tif").string());
  // The exact match, or the first one in order.
  std::ofstream(folder / "Maps/oak.tif") << "exact";
  EXPECT_EQ(found("maps/oak.tif"), (folder / "Maps/oak.tif").string());
  EXPECT_EQ(found("maps/oak.Tif"), (folder / "Maps/Oak.TIF").string());
}

}  // namespace asset_path_test
}  // namespace oriel::scene
