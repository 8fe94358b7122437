// SPDX-License-Identifier: Apache-2.0
// Invalid profiles: each has one message with the line and a hint.
#include "photometry/profile_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "photometry/eulumdat.h"
#include "photometry/ies.h"

namespace oriel::photometry {
namespace profile_file_test {

/// An IES file whose parts can be replaced.
struct Parts {
  std::string tilt = "TILT=NONE", header = "1 -1 1 3 1 1 2 0 0 0", factors = "1 1 40",
              vertical = "0 45 90", horizontal = "0", candela = "7 8 9";
  std::string text() const {
    return fmt::format("IESNA91\n{}\n{}\n{}\n{}\n{}\n{}\n", tilt, header, factors, vertical,
                       horizontal, candela);
  }
};

ProfileError error_of(const std::string& text, bool eulumdat = false) {
  try {
    eulumdat ? parse_eulumdat(text) : parse_ies(text);
  } catch (const ProfileError& e) {
    return e;
  }
  return {-1, "it was read", ""};
}

void expect_error(const std::string& text, int line, const std::string& words,
                  bool eulumdat = false) {
  const ProfileError e = error_of(text, eulumdat);
  EXPECT_EQ(e.line, line) << e.what();
  EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
  EXPECT_FALSE(e.hint.empty()) << words;
  EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
}

// acceptance: H6
TEST(ProfileFile, BadIesFilesNameTheLineAndTheReason) {
  EXPECT_EQ(error_of(Parts().text()).line, -1);
  expect_error("a picture of a lamp", 0, "no TILT line");
  expect_error(Parts{.tilt = "TILT NONE"}.text(), 2, "no \"=\"");
  expect_error(Parts{.tilt = "TILT=INCLUDE\n9 1 0 1"}.text(), 3, "geometry");
  expect_error(Parts{.tilt = "TILT=INCLUDE\n1 1 0 -3"}.text(), 3, "TILT factor");
  expect_error(Parts{.header = "1 -1 0 3 1 1 2 0 0 0"}.text(), 3, "candela multiplier is 0");
  expect_error(Parts{.header = "1 -1 1 3.5 1 1 2 0 0 0"}.text(), 3, "number of vertical angles");
  expect_error(Parts{.header = "1 -1 1 -3 1 1 2 0 0 0"}.text(), 3, "number of vertical angles");
  expect_error(Parts{.header = "1 -1 1 9000 9000 1 2 0 0 0"}.text(), 3, "declares 9000 x 9000");
  expect_error(Parts{.header = "1 -1 1 999999999 1 1 2 0 0 0"}.text(), 3, "vertical angles");
  expect_error(Parts{.header = "1 -1 1 3 1 4 2 0 0 0"}.text(), 3, "photometric type");
  expect_error(Parts{.header = "1 -1 1 3 1 lamp 2 0 0 0"}.text(), 3, "\"lamp\"");
  expect_error(Parts{.factors = "0 1 40"}.text(), 4, "ballast factor");
  expect_error(Parts{.vertical = "0 45 45"}.text(), 5, "must be ascending");
  expect_error(Parts{.vertical = "0 90 45"}.text(), 5, "must be ascending");
  expect_error(Parts{.vertical = "0 45 190"}.text(), 5, "outside");
  expect_error(Parts{.vertical = "0 nan 90"}.text(), 5, "\"nan\"");
  expect_error(
      Parts{.header = "1 -1 1 3 2 1 2 0 0 0", .horizontal = "0 75", .candela = "7 8 9 7 8 9"}
          .text(),
      6, "horizontal angles are from 0 to 75");
  expect_error(Parts{.candela = "7\n8\n-9"}.text(), 9, "negative");
  expect_error(Parts{.candela = "7 inf 9"}.text(), 7, "\"inf\"");
  expect_error(Parts{.candela = "7 1e300 9"}.text(), 7, "cd");
  expect_error(Parts{.candela = "7 8"}.text(), 7, "ends before an intensity");
  expect_error(Parts{.candela = "0 0 0"}.text(), 0, "all intensities are 0");
  expect_error(Parts{.header = "1 -1 1 3 1 2 2 0 0 0"}.text(), 6, "one horizontal angle");
}

std::string ldt(int line, const std::string& with) {
  std::vector<std::string> lines = {"Maker", "1", "1",    "1", "0", "2",
                                    "90",    "R", "Lamp", "7", "f", "2020"};
  for (int i = 0; i < 9; ++i) lines.emplace_back("100");
  for (const char* field : {"100", "80", "1", "0", "1", "1", "LED", "1000", "3000", "80", "25"})
    lines.emplace_back(field);
  for (int i = 0; i < 10; ++i) lines.emplace_back("0.5");
  for (const char* field : {"0", "0", "90", "100", "50"}) lines.emplace_back(field);
  if (line > 0) lines[static_cast<std::size_t>(line) - 1] = with;
  return fmt::format("{}\n", fmt::join(lines, "\n"));
}

TEST(ProfileFile, BadEulumdatFilesNameTheLineAndTheReason) {
  EXPECT_EQ(error_of(ldt(0, ""), true).line, -1) << error_of(ldt(0, ""), true).what();
  expect_error(ldt(3, "5"), 3, "Isym", true);
  expect_error(ldt(4, "many"), 4, "\"many\"", true);
  expect_error(ldt(6, "1"), 6, "Ng", true);
  expect_error(ldt(6, "1000000000"), 6, "Ng", true);
  expect_error(ldt(24, "0"), 24, "conversion factor", true);
  expect_error(ldt(26, "0"), 26, "sets of lamps", true);
  expect_error(ldt(29, "-5"), 29, "flux of the lamps", true);
  expect_error(ldt(45, "0"), 45, "must be ascending", true);
  expect_error(ldt(45, "200"), 45, "outside", true);
  expect_error(ldt(47, "-1"), 47, "negative", true);
  expect_error(ldt(6, "3"), 47, "ends before an intensity", true);
  expect_error("Maker\n1\n4\n2" + ldt(0, "").substr(11), 4, "are inconsistent with", true);
}

TEST(ProfileFile, FilesThatCannotBeOpenedSaySo) {
  const auto message = [](const std::string& path) {
    try {
      read_profile(path);
    } catch (const ProfileError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(message("/nowhere/lamp.ies").find("does not exist"), std::string::npos);
  EXPECT_NE(message(::testing::TempDir()).find("folder"), std::string::npos);
  const std::string path = ::testing::TempDir() + "/oriel-empty.ies";
  std::ofstream(path) << "\n \n";
  EXPECT_NE(message(path).find("empty"), std::string::npos);
}

TEST(ProfileFile, TheFormatIsToldByContentAndAnglesTurnAsAsked) {
  const std::string ies = ::testing::TempDir() + "/oriel-turn.ies";
  std::ofstream(ies) << "IESNA91\nTILT=NONE\n1 -1 1 3 5 1 2 0 0 0 1 1 40\n0 90 180\n0 90 180 270 "
                        "360\n0 0 0  0 100 0  0 0 0  0 0 0  0 0 0\n";
  const Vec3 y(0, 1, 0);
  const auto at = [&](Turn turn, const Vec3& d) {
    return LightProfile(read_profile(ies, ProfileFormat::ByContent, turn).table).evaluate(d);
  };
  EXPECT_NEAR(at(Turn::AsFormat, y), 100, 1e-3);
  EXPECT_NEAR(at(Turn::CounterClockwise, y), 100, 1e-3);
  EXPECT_NEAR(at(Turn::Clockwise, -y), 100, 1e-3);
  EXPECT_NEAR(at(Turn::Clockwise, y), 0, 1e-3);
  const std::string eulumdat = ::testing::TempDir() + "/oriel-turn.ldt";
  std::ofstream(eulumdat) << ldt(0, "");
  EXPECT_EQ(read_profile(eulumdat).report.format, "EULUMDAT");
  EXPECT_THROW(read_profile(eulumdat, ProfileFormat::Ies), ProfileError);
  EXPECT_THROW(read_profile(ies, ProfileFormat::Eulumdat), ProfileError);
}

TEST(ProfileFile, AnyBytesEndInAProfileOrAMessage) {
  std::mt19937 engine(5);
  const std::string samples[] = {Parts().text(), ldt(0, "")};
  for (int i = 0; i < 4000; ++i) {
    const bool eulumdat = i % 2 != 0;
    std::string text = samples[eulumdat ? 1 : 0];
    for (int k = 0; k < 1 + i % 4; ++k) {
      const std::size_t at = engine() % text.size();
      if (engine() % 3 == 0)
        text.erase(at, engine() % 8);
      else
        text[at] = "0123456789 .,-+e\n\r\t\0x\xff"[engine() % 22];
      if (text.empty()) text = "1";
    }
    try {
      const ProfileData data = eulumdat ? parse_eulumdat(text) : parse_ies(text);
      const LightProfile profile(data.table, {.cubic = i % 3 == 0});
      ASSERT_TRUE(std::isfinite(profile.flux()) && profile.flux() >= 0);
      ASSERT_TRUE(is_finite(profile.sample(Vec2(.3f, .8f)).direction));
    } catch (const ProfileError& e) {
      ASSERT_FALSE(std::string(e.what()).empty());
    }
  }
}

}  // namespace profile_file_test
}  // namespace oriel::photometry
