// SPDX-License-Identifier: Apache-2.0
// Texture files that are opened before the shaders that use them are bound.
#include "prepare/textures_ahead.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "prepare/testing/prepared_scene.h"

namespace oriel {
namespace textures_ahead_test {

// Directly, by a connection, in a struct, by a shader list, in a procedure of another texture, and
// in the environment; neither those of unused materials nor a loop of references.
constexpr const char* kElements =
    "color texture \"a\" \"a.png\" color texture \"b\" \"b.png\" color texture \"c\" \"c.png\"\n"
    "color texture \"sky\" \"sky.exr\" color texture \"unused\" \"unused.png\"\n"
    "shader \"of_b\" \"mib_texture_lookup\" ( \"tex\" \"b\" )\n"
    "shader \"of_c\" \"mib_texture_lookup\" ( \"tex\" \"c\" )\n"
    "shader \"of_sky\" \"mib_lookup_spherical\" ( \"tex\" \"sky\" )\n"
    "color texture \"procedure\" = \"of_c\"\n"
    "material \"m\" \"mib_illum_lambert\" ( \"ambient\" = \"of_b\" )\n"
    "  displace \"mib_texture_lookup\" ( \"tex\" \"procedure\" ) end material\n"
    "material \"n\" \"mib_texture_lookup\" ( \"tex\" \"unused\" ) end material\n"
    "material \"direct\" \"mib_texture_lookup\" ( \"tex\" \"a\" ) end material\n"
    "object \"named\" visible group 0 0 0 1 0 0 1 1 0 v 0 v 1 v 2 p \"direct\" 0 1 2 end group "
    "end object instance \"named_i\" \"named\" end instance\n";

TEST(TexturesAhead, AreThoseOfUsedMaterialsAndOfTheEnvironment) {
  testing::PreparedScene prepared(
      testing::scene_text(kElements, "\"named_i\"", "environment = \"of_sky\""));
  ASSERT_FALSE(prepared.scene.renders.empty()) << prepared.messages();
  const scene::RenderCommand& command = prepared.scene.renders.back();
  Diagnostics diagnostics;
  const auto leaves = scene::flatten(prepared.scene, command.root, diagnostics);
  const auto* camera = prepared.scene.get<scene::Camera>("cam");
  ASSERT_NE(camera, nullptr);
  const auto used = used_textures(prepared.scene, *camera, leaves);
  std::vector<std::string> sorted = used;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(sorted, (std::vector<std::string>{"a", "b", "c", "sky"}));
  ASSERT_FALSE(used.empty());
  EXPECT_EQ(used.front(), "sky") << "it is needed first";
}

TEST(TexturesAhead, EachMissingFileIsReportedOnce) {
  const testing::PreparedScene prepared(
      testing::scene_text(kElements, "\"named_i\"", "environment = \"of_sky\""));
  for (const char* name : {"\"a\"", "\"b\"", "\"c\"", "\"sky\""}) {
    const auto& all = prepared.diagnostics.all();
    EXPECT_EQ(std::count_if(all.begin(), all.end(),
                            [&](const Diagnostic& d) {
                              return d.code == "OR-RT-020" &&
                                     d.message.find(name) != std::string::npos;
                            }),
              1)
        << name << prepared.messages();
  }
}

}  // namespace textures_ahead_test
}  // namespace oriel
