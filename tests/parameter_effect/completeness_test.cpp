// SPDX-License-Identifier: Apache-2.0
// Each parameter of the architectural material has a case, and each case holds.
#include <algorithm>

#include "cases.h"
#include "shaders/architectural/mia_material.h"

namespace oriel::sensitivity {
namespace {

Cases all_cases() {
  Cases all;
  for (const auto cases :
       {diffuse_cases, reflection_cases, refraction_cases, direction_cases, limit_cases,
        occlusion_cases, option_cases, interpolation_cases, base_layer_cases})
    for (const Case& c : cases()) all.push_back(c);
  return all;
}

TEST(Sensitivity, EachParameterHasACaseAndEachCaseAParameter) {
  std::vector<std::string> tabled, shown;
  for (const ParamSpec& row : mia_material_rows()) tabled.emplace_back(row.name);
  for (const Case& c : all_cases()) shown.emplace_back(c.parameter);
  std::sort(tabled.begin(), tabled.end());
  std::sort(shown.begin(), shown.end());
  std::vector<std::string> without_case, without_row;
  std::set_difference(tabled.begin(), tabled.end(), shown.begin(), shown.end(),
                      std::back_inserter(without_case));
  std::set_difference(shown.begin(), shown.end(), tabled.begin(), tabled.end(),
                      std::back_inserter(without_row));
  EXPECT_EQ(without_case, std::vector<std::string>());
  EXPECT_EQ(without_row, std::vector<std::string>());  // names a second case of a row as well
}

class EachParameter : public ::testing::TestWithParam<Case> {};

TEST_P(EachParameter, ChangesThePictureAsTheManualSays) { GetParam().check(); }

INSTANTIATE_TEST_SUITE_P(MiaMaterialX, EachParameter, ::testing::ValuesIn(all_cases()),
                         [](const auto& each) { return std::string(each.param.parameter); });

}  // namespace
}  // namespace oriel::sensitivity
