// SPDX-License-Identifier: Apache-2.0
// Placeholders: objects and assemblies with contents in separate files.
#include "mi/placeholder.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "mi/testing/test_support.h"
#include "mi/writer.h"
#include "scene/element_settings.h"
#include "scene/hierarchy.h"

namespace oriel::mi {
namespace placeholder_test {

class Placeholder : public FolderTest {
 protected:
  scene::Scene read(std::string_view elements, std::string_view members = "\"i\"") {
    return read_scene(
        write("scene.mi",
              fmt::format("{}\ncamera \"cam\" end camera\ninstance \"c\" \"cam\" end instance\n"
                          "options \"o\" end options\ninstgroup \"root\" \"c\" {} end instgroup\n"
                          "render \"root\" \"c\" \"o\"\n",
                          elements, members)),
        options_, diagnostics_);
  }
  std::string messages() const {
    std::string all;
    for (const Diagnostic& d : diagnostics_.all()) all += diagnostics_.format(d) + "\n";
    return all;
  }
  ReadOptions options_ = Snippet::known_shaders();
  Diagnostics diagnostics_;
};

const char* const kTriangle =
    "object \"x\" visible trace tagged group 0 0 0 1 0 0 0 1 0 v 0 v 1 v 2 p 0 0 1 2 end group "
    "end object\n";

// acceptance: H1
TEST_F(Placeholder, ObjectGetsTheGeometryInItsFile) {
  write("parts/x.mi", kTriangle);
  const scene::Scene scene = read(
      "object \"x\" shadow box 0 0 0 1 1 1 file \"parts/x.mi\" end object\n"
      "instance \"i\" \"x\" end instance");
  EXPECT_EQ(messages(), "");
  const auto leaves = scene::flatten(scene, "root", diagnostics_);
  ASSERT_EQ(leaves.size(), 2u);
  ASSERT_TRUE(leaves[1].object());
  EXPECT_EQ(leaves[1].object()->groups.size(), 1u);
  EXPECT_TRUE(scene::settings_of(*leaves[1].object()).tagged);
  EXPECT_TRUE(leaves[1].flags.visible) << "as its file says";
  EXPECT_TRUE(leaves[1].flags.casts_shadow) << "as the placeholder says";
}

// acceptance: H1
TEST_F(Placeholder, AssemblyGetsTheGroupInItsFile) {
  write("part.mi", std::string("material \"m\" \"s\" ( ) end material\n") + kTriangle +
                       "instance \"xi\" \"x\" material [ \"m\" ] end instance\n"
                       "instgroup \"a\" \"xi\" end instgroup\n");
  const scene::Scene scene = read(
      "assembly \"a\" box 0 0 0 1 1 1 file \"part.mi\" end assembly\n"
      "instance \"i\" \"a\" end instance\ninstance \"j\" \"a\" end instance",
      "\"i\" \"j\"");
  EXPECT_EQ(messages(), "");
  EXPECT_EQ(scene::flatten(scene, "root", diagnostics_).size(), 3u);
  EXPECT_TRUE(scene.find("m"));
}

// acceptance: H1
TEST_F(Placeholder, IsWrittenBackAsAReference) {
  write("x.mi", kTriangle);
  const scene::Scene scene = read(
      "object \"x\" visible on box 0 0 0 1 1 1 file \"x.mi\" end object\n"
      "instance \"i\" \"x\" end instance");
  std::ostringstream out;
  write_scene(scene, out);
  EXPECT_EQ(out.str().find(" group\n"), std::string::npos) << out.str();
  EXPECT_NE(out.str().find("file \"x.mi\""), std::string::npos);
  const std::string path = write("again.mi", out.str());
  EXPECT_TRUE(read_scene(path, options_, diagnostics_) == scene);
}

TEST_F(Placeholder, MissingFileIsReportedAndTheRestIsRead) {
  const scene::Scene scene = read(
      "object \"x\" file \"nowhere.mi\" end object\ninstance \"i\" \"x\" end instance\n"
      "assembly \"a\" file \"nothing.mi\" end assembly\ninstance \"j\" \"a\" end instance",
      "\"i\" \"j\"");
  EXPECT_NE(messages().find("nowhere.mi"), std::string::npos) << messages();
  EXPECT_NE(messages().find("nothing.mi"), std::string::npos);
  EXPECT_EQ(scene::flatten(scene, "root", diagnostics_).size(), 2u) << "camera and empty object";
}

TEST_F(Placeholder, FilesOutsideTheFolderOfTheSceneAreRefused) {
  std::filesystem::create_directories(folder_ / "inner");
  write("x.mi", kTriangle);
  const std::string path = write(
      "inner/s.mi",
      "object \"x\" file \"../x.mi\" end object\ninstance \"i\" \"x\" end instance\n"
      "camera \"cam\" end camera\ninstance \"c\" \"cam\" end instance\noptions \"o\" end options\n"
      "instgroup \"root\" \"c\" \"i\" end instgroup\nrender \"root\" \"c\" \"o\"\n");
  const scene::Scene scene = read_scene(path, options_, diagnostics_);
  ASSERT_EQ(diagnostics_.all().size(), 1u) << messages();
  EXPECT_EQ(diagnostics_.all()[0].code, code::kForbiddenInclude);
  EXPECT_TRUE(scene.get<scene::Object>("x")->content.empty());
}

TEST_F(Placeholder, AFileThatNamesItselfIsReadOnce) {
  write("x.mi", "object \"x\" file \"x.mi\" end object\n");
  const scene::Scene scene =
      read("object \"x\" file \"x.mi\" end object\ninstance \"i\" \"x\" end instance");
  EXPECT_LT(scene.elements().size(), 20u);
  EXPECT_FALSE(scene.get<scene::Object>("x")->content.empty());
}

}  // namespace placeholder_test
}  // namespace oriel::mi
