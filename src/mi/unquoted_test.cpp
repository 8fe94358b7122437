// SPDX-License-Identifier: Apache-2.0
// Unquoted names, as in hand-written scenes, and stray tokens.
#include "mi/reader.h"
#include "mi/testing/test_support.h"

namespace oriel::mi {
namespace unquoted_test {

TEST(UnquotedNames, AreAcceptedForAllNames) {
  const Snippet read(
      "options opt trace on end options\n"
      "camera cam output rgba exr \"x.exr\" output rgba \"y.exr\" focal 1 end camera\n"
      "shader paint mib_paint ( colour 1 0 0, tex pic )\n"
      "color texture pic mib_marble ( )\n"
      "material red mib_phong ( diffuse 1 0 0 ) shadow mib_shade ( ) photon = paint end material\n"
      "material blue opaque = paint end material\n"
      "light lamp mib_lamp ( ) origin 0 0 0 object ball 2 2 end light\n"
      "object ball visible on shadow on group 0 0 0 1 0 0 0 1 0 0 0 1 v 0 v 1 v 2 v 3 "
      "p red 0 1 2 p 0 2 3 c blue 0 3 1 p blue 1 2 3 end group end object\n"
      "instance ball_i ball hide off end instance\n"
      "instance lamp_i lamp material red visible on end instance\n"
      "instance cam_i cam end instance\n"
      "instance bare visible on ( \"p\" 1 ) end instance\n"
      "instgroup world ball_i cam_i lamp_i end instgroup\n");
  EXPECT_TRUE(read.diagnostics.all().empty()) << read.messages();
  const auto& group = read.get<scene::Object>("ball").groups.at(0);
  EXPECT_EQ(group.materials, (std::vector<std::string>{"red", "blue"}));
  EXPECT_EQ(group.polygons.material, (std::vector<std::uint32_t>{0, 0, 1, 1}));
  EXPECT_EQ(group.polygons.indices.size(), 12u);
  EXPECT_EQ(read.get<scene::Instance>("ball_i").element, "ball");
  EXPECT_EQ(read.get<scene::Instance>("lamp_i").materials, std::vector<std::string>{"red"});
  EXPECT_EQ(read.get<scene::Instance>("bare").element, "");
  EXPECT_TRUE(read.get<scene::Instance>("bare").parameters.has_value());
  const auto& red = read.get<scene::Material>("red");
  ASSERT_EQ(red.shaders.size(), 1u);
  EXPECT_EQ(red.shaders[0].type, "mib_phong");
  EXPECT_EQ(red.slots.size(), 2u);
  EXPECT_TRUE(read.get<scene::Material>("blue").opaque);
  ASSERT_TRUE(read.get<scene::Light>("lamp").area.has_value());
  EXPECT_EQ(read.get<scene::Light>("lamp").area->values[0].text, "ball");
  const auto& outputs = read.get<scene::Camera>("cam").outputs;
  ASSERT_EQ(outputs.size(), 2u);
  EXPECT_EQ(outputs[0].types + outputs[0].format + outputs[0].file, "rgbaexrx.exr");
  EXPECT_EQ(outputs[1].types + outputs[1].file, "rgbay.exr");
  EXPECT_EQ(read.get<scene::Texture>("pic").procedure.at(0).type, "mib_marble");
}

TEST(UnquotedNames, KeywordsAreNotNames) {
  const Snippet read(
      "instance i material visible on end instance\n"
      "light l object visible on end light light k object end light\n"
      "camera c output frame 3 output rgba end camera\n");
  EXPECT_TRUE(read.get<scene::Instance>("i").materials.empty());
  EXPECT_EQ(read.get<scene::Instance>("i").flags.size(), 1u);
  EXPECT_FALSE(read.get<scene::Light>("l").area.has_value());
  EXPECT_EQ(read.get<scene::Light>("l").other.size(), 1u);
  EXPECT_FALSE(read.get<scene::Light>("k").area.has_value());
  EXPECT_EQ(read.get<scene::Camera>("c").other.size(), 1u);
}

TEST(StrayTokens, InAHeaderAreSkipped) {
  const std::string body = " group 0 0 0 1 0 0 0 1 0 v 0 v 1 v 2 p 0 1 2 end group";
  for (const char* stray :
       {"shadwo on", "\"shadow\" on", ", ", "17", "( \"a\" 1 )", "= \"x\"", "@"}) {
    const Snippet read("object \"o\" visible on " + std::string(stray) + " trace on" + body +
                       " end object material \"m\" \"s\" ( ) end material\n");
    const auto& object = read.get<scene::Object>("o");
    ASSERT_EQ(object.groups.size(), 1u) << stray << read.messages();
    EXPECT_EQ(object.groups[0].polygons.size(), 1u) << stray;
    EXPECT_GE(object.flags.size(), 2u) << stray;
    EXPECT_EQ(read.count(code::kSyntax), 0u) << stray << read.messages();
    EXPECT_EQ(read.get<scene::Material>("m").shaders.size(), 1u) << stray;
  }
  // Header and body on one line.
  const Snippet line("object \"o\" shadwo on" + body + " end object\n");
  EXPECT_EQ(line.get<scene::Object>("o").groups.size(), 1u) << line.messages();
}

TEST(StrayTokens, InOtherElementsAreSkipped) {
  const Snippet read(
      "material \"m\" opaqe , \"s\" ( ) shadow \"t\" ( ) end material\n"
      "instance \"i\" \"o\" , transfrom 1 transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 5 1 end instance\n"
      "light \"l\" \"s\" ( ) , origin 1 2 3 end light\n"
      "camera \"c\" ; focal 2 , aperture 3 end camera\n"
      "options \"p\" 7 , trace on end options\n");
  EXPECT_EQ(read.get<scene::Material>("m").shaders.size(), 1u) << read.messages();
  EXPECT_EQ(read.get<scene::Material>("m").slots.size(), 1u);
  EXPECT_TRUE(read.get<scene::Instance>("i").transform.has_value());
  EXPECT_TRUE(read.get<scene::Light>("l").origin.has_value());
  EXPECT_FLOAT_EQ(read.get<scene::Camera>("c").aperture.value_or(0), 3);
  EXPECT_EQ(read.get<scene::Options>("p").statements.size(), 1u);
  EXPECT_EQ(read.count(code::kSyntax), 0u) << read.messages();
}

}  // namespace unquoted_test
}  // namespace oriel::mi
