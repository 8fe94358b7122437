// SPDX-License-Identifier: Apache-2.0
#include "farm/pack_layout.h"

#include <gtest/gtest.h>

namespace oriel::farm {
namespace pack_layout_test {

TEST(PackLayout, FilesBesideTheSceneKeepTheirPlace) {
  PackLayout layout("/house/main.mi");
  EXPECT_EQ(layout.place("/house/main.mi"), "main.mi");
  EXPECT_EQ(layout.place("/house/maps/oak.png"), "maps/oak.png");
  EXPECT_EQ(layout.place("/house/maps/../maps/./oak.png"), "maps/oak.png");
}

TEST(PackLayout, EqualNamesOfOtherFoldersDoNotCollide) {
  PackLayout layout("/house/main.mi");
  EXPECT_EQ(layout.place("/a/maps/oak.png"), "external/maps/oak.png");
  EXPECT_EQ(layout.place("/b/maps/oak.png"), "external/maps-2/oak.png");
  EXPECT_EQ(layout.place("/c/Maps/oak.png"), "external/Maps-3/oak.png");
  // Files of one folder stay together.
  EXPECT_EQ(layout.place("/a/maps/lamp.ies"), "external/maps/lamp.ies");
}

TEST(PackLayout, NamesOfThePackAreReserved) {
  PackLayout layout("/house/main.mi");
  EXPECT_EQ(layout.place("/house/MAIN.mi"), "external/house/MAIN.mi");
  EXPECT_EQ(layout.place("/house/pack.json"), "external/house/pack.json");
  EXPECT_EQ(layout.place("/house/external/x.png"), "external/external/x.png");
  EXPECT_EQ(layout.place("/house/shaders/x.png"), "external/shaders/x.png");
}

TEST(PackLayout, NamesNeedNoQuotes) {
  EXPECT_EQ(plain_name("it's \"oak\"\\1\n$(x).png"), "it_s _oak__1___x_.png");
  EXPECT_EQ(plain_name("caf\xc3\xa9 2.png"), "caf\xc3\xa9 2.png");
  EXPECT_EQ(plain_name(".."), "files");
  PackLayout layout("/house/main.mi");
  EXPECT_EQ(layout.place("/house/6\" nail.png"), "external/house/6_ nail.png");
}

TEST(PackLayout, LibrariesKeepTheirName) {
  PackLayout layout("/house/main.mi");
  EXPECT_EQ(layout.place_library("/lib/a b/$x.so"), "shaders/$x.so");
}

}  // namespace pack_layout_test
}  // namespace oriel::farm
