// SPDX-License-Identifier: Apache-2.0
#include "scene/element_settings.h"

#include <gtest/gtest.h>

namespace oriel::scene {
namespace element_settings_test {

struct Numbers {
  double value = 0;
};

void set_value(Numbers& n, const StatementValues& v) { n.value = v.number_or(0, -1); }

constexpr Row<Numbers> kRows[] = {
    {"a", "off|on|x [float]", Support::Effective, "", nullptr},
    {"a (y)", "z|w", Support::Effective, "", nullptr},
    {"b: one|two", "... p|q_r string", Support::Harmless, "", set_value},
    {"c", "<text>", Support::Uninterpreted, ""},
    {"\"d\"", "int", Support::Effective, "", set_value},
};

Statement statement(std::string keyword, std::initializer_list<Value> values = {}) {
  return {std::move(keyword), false, values, {}};
}

Value numbers(std::vector<double> all) {
  Value v;
  v.kind = Value::Kind::Numbers;
  v.numbers = std::move(all);
  return v;
}

Value word(std::string text) {
  Value v;
  v.kind = Value::Kind::Text;
  v.text = std::move(text);
  v.bare = true;
  return v;
}

Value boolean(bool on) {
  Value v;
  v.kind = Value::Kind::Boolean;
  v.boolean = on;
  return v;
}

TEST(StatementTable, FormsOfTheParserComeFromTheRows) {
  const ElementTable<Numbers> table(kRows);
  ASSERT_EQ(table.forms().size(), 3u);
  EXPECT_EQ(table.forms()[0].keyword, "a");
  EXPECT_EQ(table.forms()[0].words, "x|y z|y w");
  EXPECT_EQ(table.forms()[0].strings, 0);
  EXPECT_EQ(table.forms()[1].keyword, "b one");
  EXPECT_EQ(table.forms()[2].keyword, "b two");
  EXPECT_EQ(table.forms()[2].words, "p|q r");
  EXPECT_EQ(table.forms()[2].strings, 1);
  EXPECT_EQ(table.special_words(), std::vector<std::string_view>{"c"});
  EXPECT_EQ(name_of(table.rows()[1]), "a y");
  EXPECT_EQ(name_of(table.rows()[2]), "b");
}

TEST(StatementTable, TheLongestKeywordMatchesAndTheLastStatementWins) {
  const ElementTable<Numbers> table(kRows);
  std::vector<FormItem> items;
  EXPECT_EQ(table.match(statement("a", {word("y z")}), items).row, &table.rows()[1]);
  EXPECT_EQ(table.match(statement("a y", {word("z")}), items).row, &table.rows()[1]);
  EXPECT_EQ(table.match(statement("a", {word("x")}), items).row, &table.rows()[0]);
  EXPECT_EQ(table.match(statement("e"), items).row, nullptr);
  const auto b = [](double n) { return statement("b two", {numbers({n})}); };
  EXPECT_EQ(table.read({b(3), statement("e"), b(5)}).value, 5);
  EXPECT_EQ(table.read({b(3), statement("b one", {boolean(true)})}).value, -1);
}

TEST(ElementSettings, MissingNumbersOfACameraAreZeroAndAWindowHasFour) {
  Camera camera;
  EXPECT_EQ(settings_of(camera), CameraSettings{});
  camera.other = {statement("offset", {numbers({3})}), statement("clip", {numbers({2, 5})}),
                  statement("window", {numbers({1, 2, 3, 4})}),
                  statement("frame", {numbers({7, .5})}), statement("tag", {numbers({5e9})})};
  const CameraSettings s = settings_of(camera);
  EXPECT_EQ(s.offset, Vec2(3, 0));
  EXPECT_EQ(s.clip_far, 5);
  EXPECT_EQ(s.window, (std::array<float, 4>{1, 2, 3, 4}));
  EXPECT_EQ(s.frame, 7);
  EXPECT_EQ(s.frame_time, .5f);
  EXPECT_EQ(s.label, 4294967295u);
  camera.other.push_back(statement("window", {numbers({1, 2, 3})}));
  EXPECT_FALSE(settings_of(camera).window.has_value());
}

TEST(ElementSettings, StereoHasThreeMethods) {
  const auto stereo = [](std::initializer_list<Value> values) {
    Camera camera;
    camera.other = {statement("stereo", values)};
    return settings_of(camera).stereo;
  };
  EXPECT_EQ(stereo({}), Stereo::OffAxis);
  EXPECT_EQ(stereo({boolean(true)}), Stereo::OffAxis);
  EXPECT_EQ(stereo({boolean(false)}), Stereo::None);
  EXPECT_EQ(stereo({word("toe in")}), Stereo::ToeIn);
  EXPECT_EQ(stereo({word("off axis")}), Stereo::OffAxis);
  EXPECT_EQ(stereo({word("offset")}), Stereo::Offset);
}

TEST(ElementSettings, LightsHavePhotonsAndShadowMaps) {
  Light light;
  EXPECT_EQ(settings_of(light).exponent, 2);
  light.other = {statement("exponent", {numbers({1})}),
                 statement("energy", {numbers({4, 5})}),
                 statement("caustic photons", {numbers({100, 200})}),
                 statement("globillum photons", {numbers({-5})}),
                 statement("visible"),
                 statement("shadowmap", {boolean(false)}),
                 statement("shadowmap detail samples", {numbers({9})}),
                 statement("shadowmap filter", {word("gauss")}),
                 statement("shadowmap unheard of")};
  const LightSettings s = settings_of(light);
  EXPECT_EQ(s.exponent, 1);
  EXPECT_EQ(s.energy, Rgb(4, 5, 0));
  EXPECT_EQ(s.caustic, (LightSettings::Photons{100, 200}));
  EXPECT_EQ(s.globillum, (LightSettings::Photons{0, 0}));
  EXPECT_TRUE(s.visible);
  EXPECT_FALSE(s.shadow_map.on);  // the last statement has words without a row
  EXPECT_EQ(s.shadow_map.detail_samples, 9);
  EXPECT_EQ(s.shadow_map.filter, 'g');
}

TEST(ElementSettings, InstancesHaveOverrideAndMotionOff) {
  Instance instance;
  instance.flags = {statement("motion", {boolean(true)}), statement("visible", {numbers({4})})};
  EXPECT_FALSE(settings_of(instance).motion_off || settings_of(instance).overrides);
  EXPECT_TRUE(settings_of(instance).visible_light);
  instance.flags = {statement("motion", {boolean(false)}), statement("override"),
                    statement("data", {word("d")})};
  const InstanceSettings s = settings_of(instance);
  EXPECT_TRUE(s.motion_off && s.overrides);
  EXPECT_EQ(s.data, "d");
}

TEST(ElementSettings, StatementsThatStartWithAFlagKeywordAreNotFlags) {
  // `shadow approximate` starts with the keyword of a flag.
  Object object;
  object.flags = {statement("shadow approximate", {word("fine")}), statement("tagged")};
  Diagnostics diagnostics;
  const ObjectSettings s = settings_of(object, &diagnostics);
  EXPECT_TRUE(diagnostics.all().empty());
  EXPECT_EQ(s.flags, FlagLayer{});
  EXPECT_TRUE(s.tagged);
}

}  // namespace element_settings_test
}  // namespace oriel::scene
