// SPDX-License-Identifier: Apache-2.0
// Includes: search paths, refused files, locations in messages.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "mi/testing/test_support.h"

namespace oriel::mi {
namespace include_test {

std::string include_line(int i) { return fmt::format("$include \"f{}.mi\"\n", i); }

class Include : public FolderTest {
 protected:
  scene::Scene read(const std::string& path) { return read_scene(path, options_, diagnostics_); }
  ReadOptions options_ = Snippet::known_shaders();
  Diagnostics diagnostics_;
};

// acceptance: H1
TEST_F(Include, QuotedSearchesOwnFolderThenPaths) {
  write("scene/parts/a.mi", "$include \"b.mi\"\n$include <c.mi>\n");
  write("scene/parts/b.mi", "shader \"b\" \"s\" ( )");
  write("lib/c.mi", "shader \"c\" \"s\" ( )");
  options_.include_paths = {(folder_ / "lib").string()};
  const scene::Scene scene = read(write("scene/s.mi", "$include \"parts\\a.mi\""));
  EXPECT_TRUE(diagnostics_.all().empty());
  EXPECT_TRUE(scene.find("b") && scene.find("c"));
}

TEST_F(Include, AngleBracketsSearchPathsThenOwnFolder) {
  write("scene/a.mi", "shader \"beside\" \"s\" ( )");
  write("scene/b.mi", "shader \"b\" \"s\" ( )");
  write("lib/a.mi", "shader \"lib\" \"s\" ( )");
  options_.include_paths = {(folder_ / "lib").string()};
  const scene::Scene scene = read(write("scene/s.mi", "$include <a.mi>\n$include <b.mi>\n"));
  EXPECT_TRUE(diagnostics_.all().empty());
  EXPECT_TRUE(scene.find("lib") && scene.find("b"));
  EXPECT_EQ(scene.find("beside"), nullptr);
}

TEST_F(Include, MessagesListTheIncludeChain) {
  write("inner.mi", "\n\n  shader \"x\" ,");
  read(write("outer.mi", "# outer\n$include \"inner.mi\"\n"));
  ASSERT_EQ(diagnostics_.all().size(), 1u);
  const std::string text = diagnostics_.format(diagnostics_.all()[0]);
  EXPECT_NE(text.find("inner.mi:3:14"), std::string::npos) << text;
  EXPECT_NE(text.find("outer.mi:2:1"), std::string::npos) << text;
}

TEST_F(Include, FilesOutsideAllowedFoldersAreRefused) {
  const std::string secret = write("other/x.mi", "shader \"x\" \"s\" ( )");
  const std::string path =
      write("scene/s.mi", fmt::format("$include \"../other/x.mi\"\n$include \"{}\"\n", secret));
  EXPECT_EQ(read(path).find("x"), nullptr);
  EXPECT_TRUE(diagnostics_.has(code::kForbiddenInclude));
  options_.include_paths = {(folder_ / "other").string()};
  EXPECT_NE(read(path).find("x"), nullptr);
}

TEST_F(Include, RegistriesReadTheirFilesInOrder) {
  write("a.mi", "shader \"a\" \"s\" ( )");
  write("b.mi", "incremental shader \"a\" \"t\" ( )");
  const scene::Scene scene = read(
      write("s.mi",
            "registry \"r\" { mi \"a.mi\" } { mi \"b.mi\" } end registry shader \"c\" \"s\" ( )"));
  EXPECT_TRUE(diagnostics_.all().empty());
  ASSERT_NE(scene.get<scene::ShaderElement>("a"), nullptr);
  EXPECT_EQ(scene.get<scene::ShaderElement>("a")->functions[0].type, "t");
  EXPECT_NE(scene.find("c"), nullptr);
}

TEST_F(Include, LineNumbersStayCorrectAfterMemoryRelease) {
  std::string lines;
  for (int i = 0; i < 400'000; ++i) lines += "# some words\n";  // 5 MB
  const scene::Scene scene = read(write("s.mi", lines + "shader \"a\" \"s\" ( )\n" + lines +
                                                    "shader \"b\" \"s\" ( )\nshader \"x\" ,"));
  EXPECT_TRUE(scene.find("a") && scene.find("b"));
  ASSERT_EQ(diagnostics_.all().size(), 1u);
  EXPECT_EQ(diagnostics_.all()[0].where.line, 800'003u);
}

TEST_F(Include, CyclesEndWithAMessage) {
  write("b.mi", "$include \"a.mi\"\nshader \"b\" \"s\" ( )");
  const scene::Scene scene = read(write("a.mi", "$include \"b.mi\"\n"));
  EXPECT_TRUE(diagnostics_.has(code::kIncludeCycle));
  EXPECT_NE(scene.find("b"), nullptr);
}

TEST_F(Include, DepthAndNumberAreBounded) {
  for (int i = 0; i < 20; ++i)
    write(fmt::format("f{}.mi", i), include_line(i + 1) + include_line(i + 1));
  options_.budgets.set(Budget::Includes, 1000);
  read(write("s.mi", "$include \"f0.mi\"\n"));
  EXPECT_TRUE(diagnostics_.has(code::kIncludeLimit));
}

TEST_F(Include, AMissingFileIsReportedOnceAndPackagesAreSatisfied) {
  options_.packages = {"base"};
  const scene::Scene scene =
      read(write("s.mi",
                 "$include <base.mi>\n$include \"C:\\mr\\include\\base.mi\"\n$include <paint.mi>\n"
                 "$include <paint.mi>\nlink \"base.so\"\nshader \"x\" \"s\" ( )"));
  EXPECT_EQ(diagnostics_.all().size(), 1u);
  EXPECT_NE(diagnostics_.all()[0].message.find("paint.mi"), std::string::npos);
  EXPECT_EQ(scene.packages, (std::vector<std::string>{"base.mi"}));
  EXPECT_NE(scene.find("x"), nullptr);
}

TEST_F(Include, AnUnreadableSceneIsAnErrorAndEmpty) {
  Reader reader((folder_ / "none.mi").string(), {}, diagnostics_);
  EXPECT_FALSE(reader.opened());
  scene::Scene scene;
  EXPECT_FALSE(reader.next_frame(scene));
  EXPECT_EQ(diagnostics_.count(Severity::Error), 1u);
}

}  // namespace include_test
}  // namespace oriel::mi
