// SPDX-License-Identifier: Apache-2.0
#include "output/output_names.h"

#include <gtest/gtest.h>

#include <set>

namespace oriel {
namespace output_names_test {

std::string meant_by(std::string_view buffer) {
  const int index = output_of_frame_buffer(buffer);
  return index < 0 ? "" : material_output_names()[static_cast<std::size_t>(index)];
}

TEST(OutputNames, TwentyFourOutputsAndTheRestHaveAPlaceEach) {
  const auto& names = material_output_names();
  EXPECT_EQ(names.size(), 25u);
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), 25u);
  for (std::size_t i = 0; i < names.size(); ++i)
    EXPECT_EQ(material_output_index(names[i]), static_cast<int>(i));
  EXPECT_EQ(names.front(), "result");
  EXPECT_EQ(names[23], "opacity");
  EXPECT_EQ(names.back(), "other");
  EXPECT_EQ(material_output_index("diffuse"), -1);
  EXPECT_EQ(material_output_index(""), -1);
}

TEST(OutputNames, FrameBuffersMeanTheLongestNameTheyEndWith) {
  EXPECT_EQ(meant_by("diffuse_result"), "diffuse_result");
  EXPECT_EQ(meant_by("fb_diffuse_result"), "diffuse_result");
  EXPECT_EQ(meant_by("beauty:diffuse_raw"), "diffuse_raw");
  EXPECT_EQ(meant_by("pass 3 refl_level"), "refl_level");
  EXPECT_EQ(meant_by("07result"), "result");
  EXPECT_EQ(meant_by("my_result"), "result");
  EXPECT_EQ(meant_by("my_opacity_raw"), "opacity_raw");
  EXPECT_EQ(meant_by("my_opacity"), "opacity");
}

TEST(OutputNames, ALetterBeforeTheNameMakesAnotherWord) {
  EXPECT_EQ(meant_by("another"), "");
  EXPECT_EQ(meant_by("myresult"), "");
  EXPECT_EQ(meant_by("diffuse_result_2"), "");
  EXPECT_EQ(meant_by("subdiffuse_result"), "result");
  EXPECT_EQ(meant_by(""), "");
}

}  // namespace output_names_test
}  // namespace oriel
