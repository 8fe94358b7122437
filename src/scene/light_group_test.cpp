// SPDX-License-Identifier: Apache-2.0
#include "scene/light_group.h"

#include <gtest/gtest.h>

#include "scene/render_options.h"

namespace oriel::scene {
namespace light_group_test {

TEST(LightGroup, PatternsMatchWholeNames) {
  EXPECT_TRUE(matches("lamp", "lamp"));
  EXPECT_FALSE(matches("lamp", "lamps"));
  EXPECT_FALSE(matches("amp", "lamp"));
  EXPECT_TRUE(matches("lamp*", "lamp"));
  EXPECT_TRUE(matches("lamp*", "lamp_17"));
  EXPECT_TRUE(matches("spot_??", "spot_07"));
  EXPECT_FALSE(matches("spot_??", "spot_7"));
  EXPECT_TRUE(matches("*_i", "a_i_b_i"));
  EXPECT_TRUE(matches("a*b*c", "a-b-b-c"));
  EXPECT_FALSE(matches("a*b*c", "a-c-b"));
  EXPECT_TRUE(matches("*", ""));
  EXPECT_FALSE(matches("?", ""));
  EXPECT_FALSE(matches("Lamp", "lamp"));
  // Many stars do not take exponential time.
  EXPECT_FALSE(matches(std::string(40, '*') + "x", std::string(4000, 'a')));
}

TEST(LightGroup, PatternsAreSeparatedByCommas) {
  EXPECT_EQ(split_patterns("lamp*, spot_?? ,,x"),
            (std::vector<std::string>{"lamp*", "spot_??", "x"}));
  EXPECT_TRUE(split_patterns(" , ").empty());
}

TEST(LightGroup, NamesThatCannotBeLayersAreRefused) {
  EXPECT_EQ(light_group_complaint({"key-2_a", {"*"}}), "");
  for (const char* name : {"", "a.b", "a b", "rest", "indirect"})
    EXPECT_NE(light_group_complaint({name, {"*"}}), "") << name;
  EXPECT_NE(light_group_complaint({"key", {}}), "");
}

TEST(LightGroup, OptionsDefineGroups) {
  const auto statement = [](const std::string& keyword, const std::string& text) {
    Statement s;
    s.keyword = keyword;
    s.quoted = true;
    Value v;
    v.kind = Value::Kind::Text;
    v.text = text;
    s.values.push_back(v);
    return s;
  };
  Options block;
  block.statements = {statement("light group key", "lamp*,spot"), statement("light group b", "x"),
                      statement("light group key", "other"), statement("light group rest", "y"),
                      statement("light group none", " ")};
  Diagnostics diagnostics;
  const RenderOptions options = interpret_options(block, diagnostics);
  EXPECT_EQ(options.light_groups, (std::vector<LightGroup>{{"key", {"other"}}, {"b", {"x"}}}));
  EXPECT_EQ(diagnostics.count(Severity::Warning), 2u);
  EXPECT_TRUE(options.unknown_strings.empty());
}

}  // namespace light_group_test
}  // namespace oriel::scene
