// SPDX-License-Identifier: Apache-2.0
#include "photometry/eulumdat.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/directions.h"

namespace oriel::photometry {
namespace eulumdat_test {

using testing::luminaire_direction;

struct Form {
  int symmetry = 0;
  float first = 0;  // of the stored planes
  int stored = 24;
  const char* flux = "2000";
  const char* factor = "1";
  bool commas = false;
  const char* end = "\n";
};

/// 24 planes of 15 degrees, 13 angles of 15 degrees.
template <class F>
std::string file_of(const Form& form, const F& candela) {
  std::vector<std::string> lines = {
      "Maker",    "1",   std::to_string(form.symmetry), "24", "15", "13", "15", "R", "Lamp", "7",
      "lamp.ldt", "2020"};
  for (int i = 0; i < 9; ++i) lines.emplace_back("100");
  for (const char* field :
       {"100", "80", form.factor, "0", "1", "2", "LED", form.flux, "3000", "80", "25"})
    lines.emplace_back(field);
  for (int i = 0; i < 10; ++i) lines.emplace_back("0.5");
  for (int c = 0; c < 24; ++c) lines.push_back(std::to_string(15 * c));
  for (int g = 0; g < 13; ++g) lines.push_back(std::to_string(15 * g));
  for (int c = 0; c < form.stored; ++c)
    for (int g = 0; g < 13; ++g)
      lines.push_back(fmt::format("{:.4f}", candela(form.first + 15.0f * static_cast<float>(c),
                                                    15.0f * static_cast<float>(g))));
  std::string text;
  for (std::string& line : lines) {
    if (form.commas) std::replace(line.begin(), line.end(), '.', ',');
    text += line + form.end;
  }
  return text;
}

LightProfile profile_of(const std::string& text) {
  return LightProfile(parse_eulumdat(text).table);
}

// acceptance: H6
TEST(EulumdatFile, SymmetriesSaveWhatTheFullTableWrites) {
  const struct {
    Form form;
    bool along, across;  // mirrored in C0 - C180, in C90 - C270
  } kCases[] = {{{.symmetry = 1, .stored = 1}, true, true},
                {{.symmetry = 2, .stored = 13}, true, false},
                {{.symmetry = 3, .first = 90, .stored = 13}, false, true},
                {{.symmetry = 4, .stored = 7}, true, true}};
  for (const auto& c : kCases) {
    const auto intensity = [&](float plane, float gamma) {
      if (c.form.symmetry == 1) return 100 + gamma;
      const float a = plane * kPi / 180;
      // Even in sine: symmetric to C0 - C180. Even in cosine: to C90 - C270.
      const float s = c.along ? std::abs(std::sin(a)) : std::sin(a);
      const float k = c.across ? std::abs(std::cos(a)) : std::cos(a);
      return 300 + 80 * s + 50 * k + 20 * s * k + gamma * (1 + s);
    };
    const LightProfile part = profile_of(file_of(c.form, intensity));
    const LightProfile full = profile_of(file_of({}, intensity));
    for (float plane = 0; plane < 360; plane += 7.5f)
      for (float gamma = 0; gamma <= 180; gamma += 7.5f)
        ASSERT_NEAR(part.evaluate(luminaire_direction(gamma, plane - 90)),
                    full.evaluate(luminaire_direction(gamma, plane - 90)), 2e-2f)
            << c.form.symmetry << ": " << plane << ' ' << gamma;
  }
}

TEST(EulumdatFile, ValuesAreForAThousandLumenOfTheLamps) {
  const auto flat = [](float, float) { return 1000 / (4 * kPi); };
  EXPECT_NEAR(profile_of(file_of({}, flat)).flux(), 2000, .1);
  EXPECT_NEAR(profile_of(file_of({.flux = "500", .factor = "1.5"}, flat)).flux(), 750, .1);
  const Form german{.flux = "500.5", .commas = true, .end = "\r\n"};
  EXPECT_NEAR(profile_of(file_of(german, flat)).flux(), 500.5, .1);
  const ProfileReport report = parse_eulumdat(file_of({}, flat)).report;
  EXPECT_EQ(report.lamp_lumens, 2000);
  EXPECT_EQ(report.lamps, 2);
  EXPECT_EQ(report.watts, 25);
  EXPECT_EQ(report.luminaire, "Lamp");
}

TEST(EulumdatFile, PlanesLieAcrossTheLuminaireAndRunAgainstTheClock) {
  const auto only = [](float at) {
    return [at](float c, float gamma) { return c == at && gamma == 90 ? 500.0f : 0.0f; };
  };
  EXPECT_NEAR(profile_of(file_of({}, only(0))).evaluate(Vec3(0, -1, 0)), 1000, .1);
  EXPECT_NEAR(profile_of(file_of({}, only(90))).evaluate(Vec3(1, 0, 0)), 1000, .1);
  EXPECT_NEAR(profile_of(file_of({}, only(180))).evaluate(Vec3(0, 1, 0)), 1000, .1);
}

}  // namespace eulumdat_test
}  // namespace oriel::photometry
