// SPDX-License-Identifier: Apache-2.0
// Each parameter of the architectural material has a case, and each case holds.
#include <utility>

#include "../same_names.h"
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

TEST(ParameterEffect, EachParameterHasACaseAndEachCaseAParameter) {
  std::vector<std::string> tabled, shown;
  for (const ParamSpec& row : mia_material_rows()) tabled.emplace_back(row.name);
  for (const Case& c : all_cases()) shown.emplace_back(c.parameter);
  testing::expect_same_names(std::move(tabled), std::move(shown));
}

class EachParameter : public ::testing::TestWithParam<Case> {};

TEST_P(EachParameter, HasItsDocumentedEffect) { GetParam().check(); }

INSTANTIATE_TEST_SUITE_P(MiaMaterialX, EachParameter, ::testing::ValuesIn(all_cases()),
                         [](const auto& each) { return std::string(each.param.parameter); });

}  // namespace
}  // namespace oriel::sensitivity
