// SPDX-License-Identifier: Apache-2.0
// Each parameter of each shader has a case, and each case holds. mia_material_x has its cases in
// tests/parameter_effect. Parameters that are reported as ignored have none.
#include <fmt/format.h>

#include <map>
#include <set>
#include <utility>

#include "../same_names.h"
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
  testing::expect_same_names(std::move(tabled), std::move(shown));
}

TEST(Effects, TheArchitecturalMaterialsHaveTheRowsOfOne) {
  const auto rows = [](const char* name) { return builtin_shaders().find(name)->params; };
  const auto all = rows("mia_material_x"), passes = rows("mia_material_x_passes");
  EXPECT_EQ(passes.data(), all.data());
  EXPECT_EQ(passes.size(), all.size());
  EXPECT_EQ(rows("mia_material").data(), all.data());
  EXPECT_LE(rows("mia_material").size(), all.size());
}

/// The cases of one shader: a test for each parameter would start a thousand processes.
struct ShaderCases {
  std::string shader;
  Cases cases;
};
void PrintTo(const ShaderCases& s, std::ostream* out) { *out << s.shader; }

std::vector<ShaderCases> cases_by_shader() {
  std::map<std::string, Cases> sorted;
  for (const Case& c : all_cases())
    sorted[c.parameter.substr(0, c.parameter.find('.'))].push_back(c);
  std::vector<ShaderCases> all;
  for (const auto& [shader, cases] : sorted) all.push_back({shader, cases});
  return all;
}

class EachEffect : public ::testing::TestWithParam<ShaderCases> {};

TEST_P(EachEffect, MatchesTheManual) {
  for (const Case& c : GetParam().cases) {
    SCOPED_TRACE(c.parameter);
    c.check();
  }
}

INSTANTIATE_TEST_SUITE_P(Shaders, EachEffect, ::testing::ValuesIn(cases_by_shader()),
                         [](const auto& each) { return each.param.shader; });

}  // namespace
}  // namespace oriel::effects
