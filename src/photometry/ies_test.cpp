// SPDX-License-Identifier: Apache-2.0
#include "photometry/ies.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "support/directions.h"

namespace oriel::photometry {
namespace ies_test {

using testing::luminaire_direction;

std::string list(const std::vector<float>& values) {
  return fmt::format("{}\n", fmt::join(values, " "));
}

std::vector<float> steps(float first, float last, float step) {
  std::vector<float> all;
  for (float a = first; a <= last + 1e-3f; a += step) all.push_back(a);
  return all;
}

/// An intensity without symmetry, in the luminaire frame.
float lobes(const Vec3& d) { return 100 + 60 * d.x + 30 * d.y - 40 * d.z + 25 * d.x * d.y * d.z; }

template <class F>
std::string file_of(int type, const std::vector<float>& v, const std::vector<float>& h,
                    const F& candela, const std::string& head = "1 -1 1") {
  std::string text = fmt::format("IESNA:LM-63-2002\nTILT=NONE\n{} {} {} {} 2 0 0 0\n1 1 50\n", head,
                                 v.size(), h.size(), type);
  text += list(v) + list(h);
  for (const float b : h) {
    std::vector<float> plane;
    for (const float a : v) plane.push_back(candela(a, b));
    text += list(plane);
  }
  return text;
}

LightProfile profile_of(const std::string& text) { return LightProfile(parse_ies(text).table); }

/// The same intensity everywhere.
void expect_same(const LightProfile& a, const LightProfile& b) {
  for (float v = 0; v <= 180; v += 7.5f)
    for (float h = 0; h < 360; h += 7.5f)
      ASSERT_NEAR(a.evaluate(luminaire_direction(v, h)), b.evaluate(luminaire_direction(v, h)),
                  1e-2f)
          << v << ' ' << h;
}

// acceptance: H6
TEST(IesFile, SymmetriesSaveWhatTheFullTableWrites) {
  const std::vector<float> v = steps(0, 180, 15);
  const struct {
    const char* name;
    std::vector<float> stored;
    Vec3 mirror;  // components whose sign does not affect the intensity
    std::string symmetry;
  } kCases[] = {{"quadrants", steps(0, 90, 15), Vec3(0, 0, 1), "four equal quadrants"},
                {"0 - 180", steps(0, 180, 15), Vec3(1, 0, 1), ""},
                {"90 - 270", steps(90, 270, 15), Vec3(0, 1, 1), ""}};
  for (const auto& c : kCases) {
    const auto intensity = [&](float a, float b) {
      Vec3 d = luminaire_direction(a, b);
      if (c.mirror.x == 0) d.x = std::abs(d.x);
      if (c.mirror.y == 0) d.y = std::abs(d.y);
      return lobes(d);
    };
    const LightProfile full = profile_of(file_of(1, v, steps(0, 360, 15), intensity));
    const LightProfile part = profile_of(file_of(1, v, c.stored, intensity));
    expect_same(part, full);
    EXPECT_NEAR(part.flux(), full.flux(), 1e-4f * full.flux()) << c.name;
  }
  const auto round = [](float a, float) { return 10 + a; };
  expect_same(profile_of(file_of(1, v, {0}, round)),
              profile_of(file_of(1, v, steps(0, 360, 90), round)));
  // A full circle without its last plane.
  const auto any = [](float a, float b) { return lobes(luminaire_direction(a, b)); };
  expect_same(profile_of(file_of(1, v, steps(0, 345, 15), any)),
              profile_of(file_of(1, v, steps(0, 360, 15), any)));
}

// acceptance: H6
TEST(IesFile, TypesCBAndAMeanTheSameDirections) {
  // A beam in two directions that no symmetry maps to each other, in the angles of each type.
  const auto spot = [](const Vec3& d, const Vec3& at) {
    return 1000 * std::pow(std::max(0.0f, dot(d, normalize(at))), 40.0f);
  };
  const Vec3 beam(.5f, -.3f, -.8f);
  const std::vector<float> half = steps(-90, 90, 2.5f);
  const auto sine = [](float deg) { return std::sin(deg * kPi / 180); };
  const auto cosine = [](float deg) { return std::cos(deg * kPi / 180); };
  // Type B: h towards -y, v about it from nadir towards +x. Type A: v above the horizon, h to -y.
  const auto type_b = [&](float v, float h) {
    return Vec3(cosine(h) * sine(v), -sine(h), -cosine(h) * cosine(v));
  };
  const auto type_a = [&](float v, float h) {
    return Vec3(cosine(v) * cosine(h), -cosine(v) * sine(h), sine(v));
  };
  const LightProfile c =
      profile_of(file_of(1, steps(0, 180, 2.5f), steps(0, 360, 2.5f),
                         [&](float v, float h) { return spot(luminaire_direction(v, h), beam); }));
  const LightProfile b = profile_of(
      file_of(2, half, half, [&](float v, float h) { return spot(type_b(v, h), beam); }));
  const LightProfile a = profile_of(
      file_of(3, half, half, [&](float v, float h) { return spot(type_a(v, h), beam); }));
  for (const LightProfile* p : {&c, &b, &a}) {
    EXPECT_NEAR(p->evaluate(normalize(beam)), 1000, 25);
    EXPECT_NEAR(p->evaluate(normalize(Vec3(.5f, .3f, -.8f))),
                spot(normalize(Vec3(.5f, .3f, -.8f)), beam), 25);
    EXPECT_NEAR(dot(p->peak_direction(), normalize(beam)), 1, 2e-3);
    EXPECT_NEAR(p->flux(), 2 * kPi * 1000 / 41, .02 * 2 * kPi * 1000 / 41);
  }
  // By hand: (V, H) = (0, 0) is nadir in type B, and horizontal and forward in type A.
  const auto one = [](float v, float h) { return v == 0 && h == 0 ? 100.0f : 0.0f; };
  EXPECT_EQ(profile_of(file_of(2, half, half, one)).evaluate(Vec3(0, 0, -1)), 100);
  EXPECT_EQ(profile_of(file_of(3, half, half, one)).evaluate(Vec3(1, 0, 0)), 100);
  const auto right = [](float v, float h) { return v == 0 && h == 45 ? 100.0f : 0.0f; };
  EXPECT_NEAR(profile_of(file_of(2, half, half, right)).evaluate(normalize(Vec3(0, -1, -1))), 100,
              .1);
  EXPECT_NEAR(profile_of(file_of(3, half, half, right)).evaluate(normalize(Vec3(1, -1, 0))), 100,
              .1);
  const auto up = [](float v, float h) { return v == 45 && h == 0 ? 100.0f : 0.0f; };
  EXPECT_NEAR(profile_of(file_of(2, half, half, up)).evaluate(normalize(Vec3(1, 0, -1))), 100, .1);
  EXPECT_NEAR(profile_of(file_of(3, half, half, up)).evaluate(normalize(Vec3(1, 0, 1))), 100, .1);
}

TEST(IesFile, HalvesOfTypesAAndBAreMirrored) {
  for (const int type : {2, 3}) {
    const auto even = [](float v, float h) { return 200 - std::abs(v) - .5f * std::abs(h); };
    const LightProfile full =
        profile_of(file_of(type, steps(-90, 90, 10), steps(-90, 90, 10), even));
    expect_same(profile_of(file_of(type, steps(-90, 90, 10), steps(0, 90, 10), even)), full);
    expect_same(profile_of(file_of(type, steps(0, 90, 10), steps(0, 90, 10), even)), full);
  }
}

TEST(IesFile, FactorsActOnceAndLinearly) {
  const auto hundred = [](float, float) { return 100.0f; };
  const auto plain = [&](const std::string& head) {
    return profile_of(file_of(1, {0, 90, 180}, {0}, hundred, head)).peak();
  };
  EXPECT_FLOAT_EQ(plain("1 -1 1"), 100);
  EXPECT_FLOAT_EQ(plain("2 1000 3.5"), 350);  // neither lamps nor lumens scale
  const auto with = [](const char* tag, const char* factors) {
    return profile_of(fmt::format("{}\nTILT=NONE\n1 1000 2 2 1 1 2 0 0 0\n{} 40\n0 180\n0\n5 5\n",
                                  tag, factors))
        .peak();
  };
  EXPECT_FLOAT_EQ(with("IESNA91", ".9 .8"), 10 * .9f * .8f);
  EXPECT_FLOAT_EQ(with("IESNA:LM-63-1995", ".9 .8"), 10 * .9f * .8f);
  EXPECT_FLOAT_EQ(with("No tag: 1986", ".9 .8"), 10 * .9f * .8f);
  // Since 2002 the second number is not a factor.
  EXPECT_FLOAT_EQ(with("IESNA:LM-63-2002", ".9 .8"), 9);
  EXPECT_FLOAT_EQ(with("IES:LM-63-2019", ".9 1.10001"), 9);
}

// acceptance: H6
TEST(IesFile, EveryVersionSeparatorAndLineEndIsRead) {
  const struct {
    const char *text, *version;
  } kCases[] = {
      {"Some lamp\r\nof 1986\r\nTILT=NONE\r\n1,-1,1 2 1,1 2\r\n0 0 0 1 1 40\r\n0,90\r\n0\r\n7, 7",
       "LM-63-1986"},
      {"IESNA91\rTILT=NONE\r1 -1 1. 2 1 1 2 0. .0 -0.5 1 1 40\r0 90 0 7. 7e0\r", "LM-63-1991"},
      {"IESNA:LM-63-1995\n[TEST] 1\n[MORE]  \n\nTilt = none\n\n1 -1\n\n1 2 1 1 1 0 0 0\t1 1 +40 "
       "0\n90\n0\n7\n7\n",
       "LM-63-1995"},
      {"\xef\xbb\xbfIESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0 1 1 40 0 90 0 7 7\x1a",
       "LM-63-2002"},
      {"IES:LM-63-2019\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1.00001 40\n0 90\n0\n7 7\n",
       "LM-63-2019"}};
  for (const auto& c : kCases) {
    const ProfileData data = parse_ies(c.text);
    EXPECT_EQ(data.report.version, c.version);
    EXPECT_FALSE(data.report.lamp_lumens);
    EXPECT_EQ(data.report.watts, 40);
    EXPECT_NEAR(LightProfile(data.table).flux(), 2 * kPi * 7, 1e-3);
  }
  const std::string line = "[MORE] " + std::string(100000, 'x') + "\n";
  EXPECT_EQ(parse_ies("IESNA91\n[LUMINAIRE] A lamp\x1b[31m\n" + line +
                      "TILT=NONE\n2 600 1 2 1 1 2 0 0 0 1 1 40 0 90 0 7 7")
                .report.luminaire,
            "A lamp [31m");
}

TEST(IesFile, TiltFactorsAreThoseOfTheLuminaireAsMeasured) {
  const std::string rest = "1 -1 1 2 1 1 2 0 0 0 1 1 40 0 90 0 7 7\n";
  const ProfileData included = parse_ies("IESNA91\nTILT=INCLUDE\n1\n3\n0 45 90\n.5 .9 .8\n" + rest);
  EXPECT_FLOAT_EQ(included.table.candela[0], 3.5f);
  const std::string folder = ::testing::TempDir();
  std::ofstream(folder + "/oriel-ies-test.tlt") << "1\n2\n0 90\n.25 .9\n";
  const ProfileData beside = parse_ies("IESNA91\nTILT=oriel-ies-test.tlt\n" + rest, folder);
  EXPECT_FLOAT_EQ(beside.table.candela[0], 1.75f);
  EXPECT_TRUE(beside.report.notes.empty());
  const ProfileData absent = parse_ies("IESNA91\nTILT=/etc/other.tlt\n" + rest, folder);
  EXPECT_FLOAT_EQ(absent.table.candela[0], 7);
  EXPECT_EQ(absent.report.notes.size(), 1u);
}

}  // namespace ies_test
}  // namespace oriel::photometry
