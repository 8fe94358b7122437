// SPDX-License-Identifier: Apache-2.0
// Each parameter of each shader has a case, and each case holds. mia_material_x has its cases in
// tests/sensitivity. Parameters that are reported as ignored have none.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "cases.h"
#include "effects.h"

namespace oriel::effects {
namespace {

/// Shaders whose parameters are those of another.
const std::set<std::string_view> kOthersRows = {"mia_material", "mia_material_x",
                                                "mia_material_x_passes"};

Cases all_cases() {
  Cases all;
  for (const auto& cases : case_lists())
    for (const Case& c : cases()) all.push_back(c);
  return all;
}

TEST(Effects, EachParameterHasACaseAndEachCaseAParameter) {
  std::vector<std::string> tabled, shown;
  for (const ShaderSpec* spec : builtin_shaders().all())
    for (const ParamSpec& row : spec->params)
      if (row.support != Support::Ignored && !kOthersRows.count(spec->name))
        tabled.push_back(fmt::format("{}.{}", spec->name, row.name));
  for (const Case& c : all_cases()) shown.push_back(c.parameter);
  std::sort(tabled.begin(), tabled.end());
  std::sort(shown.begin(), shown.end());
  std::vector<std::string> without_case, without_row;
  std::set_difference(tabled.begin(), tabled.end(), shown.begin(), shown.end(),
                      std::back_inserter(without_case));
  std::set_difference(shown.begin(), shown.end(), tabled.begin(), tabled.end(),
                      std::back_inserter(without_row));
  EXPECT_TRUE(without_case.empty()) << fmt::format("{}", fmt::join(without_case, "\n"));
  // Names a second case of a parameter as well.
  EXPECT_TRUE(without_row.empty()) << fmt::format("{}", fmt::join(without_row, "\n"));
}

TEST(Effects, TheArchitecturalMaterialsHaveTheRowsOfOne) {
  const auto rows = [](const char* name) { return builtin_shaders().find(name)->params; };
  const auto all = rows("mia_material_x"), passes = rows("mia_material_x_passes");
  EXPECT_EQ(passes.data(), all.data());
  EXPECT_EQ(passes.size(), all.size());
  EXPECT_EQ(rows("mia_material").data(), all.data());
  EXPECT_LE(rows("mia_material").size(), all.size());
}

class EachEffect : public ::testing::TestWithParam<Case> {};

TEST_P(EachEffect, IsAsTheManualSays) { GetParam().check(); }

INSTANTIATE_TEST_SUITE_P(Shaders, EachEffect, ::testing::ValuesIn(all_cases()),
                         [](const auto& each) {
                           std::string name = each.param.parameter;
                           for (char& c : name)
                             if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                           return name;
                         });

}  // namespace
}  // namespace oriel::effects
