// SPDX-License-Identifier: Apache-2.0
// Syntax variants of real exporters that a strict reader would reject.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "mi/testing/test_support.h"

namespace oriel::mi {
namespace wild_test {

using scene::kNone;
using scene::Value;

#define EXPECT_SILENT(read) EXPECT_TRUE((read).diagnostics.all().empty()) << (read).messages()

// acceptance: H1
TEST(Wild, FlagsOnTheHeaderLineMayBeBareOrIntegers) {
  const Snippet read(
      "object \"o\" visible shadow trace caustic 1 tag 7 group 0 0 0 end group end object");
  EXPECT_SILENT(read);
  const auto& flags = read.get<scene::Object>("o").flags;
  ASSERT_EQ(flags.size(), 5u);
  EXPECT_EQ(flags[0].keyword, "visible");
  EXPECT_TRUE(flags[0].values.empty());
  EXPECT_EQ(flags[3].values[0].numbers[0], 1);
}

// acceptance: H1
TEST(Wild, ElementsMayBeOnOneLineWithoutSeparators) {
  const Snippet read(
      "shader \"s1\" \"s\" ( ) material \"m\" = \"s1\" shadow = \"s1\" photon = \"s1\" "
      "end material instance \"i\" \"m\" end instance");
  EXPECT_SILENT(read);
  EXPECT_EQ(read.get<scene::Material>("m").slots.size(), 2u);
  EXPECT_EQ(read.get<scene::Instance>("i").element, "m");
}

constexpr std::string_view kSquare = "0 0 0 1 0 0 1 1 0 0 1 0 v 0 v 1 v 2 v 3 ";

std::string object(std::string_view flags, std::string_view polygons) {
  return fmt::format("object \"o\" {} group {}{} end group end object", flags, kSquare, polygons);
}

// acceptance: H1
TEST(Wild, EmptyMaterialNameMeansTheInstanceMaterial) {
  const Snippet read(object("", "p \"\" 0 1 3 2 p \"m\" 0 1 2 p 2 1 3 p \"\" 0 1 2"));
  EXPECT_SILENT(read);
  const auto& group = read.get<scene::Object>("o").groups[0];
  EXPECT_EQ(group.polygons.material, (std::vector<std::uint32_t>{kNone, 0, 0, kNone}));
  EXPECT_EQ(group.materials, (std::vector<std::string>{"m"}));
}

// acceptance: H1
TEST(Wild, TaggedObjectsHaveALabelPerPolygon) {
  const Snippet read(object("tagged on", "p 0  0 1 2 p 7 0 1 2 3"));
  EXPECT_SILENT(read);
  const auto& polygons = read.get<scene::Object>("o").groups[0].polygons;
  EXPECT_EQ(polygons.material, (std::vector<std::uint32_t>{0, 7}));
  EXPECT_EQ(polygons.first, (std::vector<std::uint32_t>{0, 3, 7}));
}

// acceptance: H1
TEST(Wild, InstanceMaterialsMayBeAListWithoutBlanks) {
  const Snippet read("instance \"i\" \"o\" material [\"a\",\"b\"] end instance");
  EXPECT_SILENT(read);
  EXPECT_TRUE(read.get<scene::Instance>("i").material_list);
  EXPECT_EQ(read.get<scene::Instance>("i").materials, (std::vector<std::string>{"a", "b"}));
}

// acceptance: H1
TEST(Wild, AFlagWrittenTwiceKeepsBothMeanings) {
  const Snippet read("instance \"i\" \"o\" caustic on caustic 3 end instance");
  EXPECT_SILENT(read);
  const auto& flags = read.get<scene::Instance>("i").flags;
  ASSERT_EQ(flags.size(), 2u);
  EXPECT_TRUE(flags[0].values[0].boolean);
  EXPECT_EQ(flags[1].values[0].numbers[0], 3);
}

// acceptance: H1
TEST(Wild, AnEmptyExclusiveLightListIsKept) {
  const Snippet read(
      "instance \"i\" \"o\" light \"exclusive\" [] light shadow [\"l\"] end instance");
  EXPECT_SILENT(read);
  const auto& instance = read.get<scene::Instance>("i");
  ASSERT_TRUE(instance.light_links && instance.shadow_links);
  EXPECT_TRUE(instance.light_links->exclusive && instance.light_links->lights.empty());
  EXPECT_EQ(instance.shadow_links->lights[0], "l");
}

// acceptance: H1
TEST(Wild, AnEmptyParameterListMayCloseAnInstance) {
  const Snippet read(
      "instance \"i\" \"o\" transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 data \"d\" () "
      "end instance");
  EXPECT_SILENT(read);
  ASSERT_TRUE(read.get<scene::Instance>("i").parameters);
  EXPECT_EQ(read.get<scene::Instance>("i").flags[0].values[0].text, "d");
}

using WildFiles = FolderTest;

// acceptance: H1
TEST_F(WildFiles, IncludeMayContainTheBodyOfAGroup) {
  write("body.mi", "0 0 0 1 0 0\n# the rest\n0 1 0\nv 0 v 1 v 2\np 0 1 2");
  const std::string path =
      write("s.mi", "object \"o\" group\n\t $include \"body.mi\"\nend group end object");
  Diagnostics d;
  const scene::Scene scene = read_scene(path, {}, d);
  EXPECT_TRUE(d.all().empty());
  EXPECT_EQ(scene.get<scene::Object>("o")->groups[0].polygons.size(), 1u);
}

// acceptance: H1
TEST(Wild, GroupsMayHaveUnquotedNamesAndNamesAnyCharacter) {
  const Snippet read(
      "object \"A|B(C 01)\" group _body 0 0 0 end group end object\n"
      "instance \":Root\" \"A|B(C 01)\" end instance shader \"n:shader\" \"s\" ( )"
      " shader \"file 2\" = \"n:shader\"");
  EXPECT_SILENT(read);
  EXPECT_EQ(read.get<scene::Object>("A|B(C 01)").groups[0].name, "_body");
  EXPECT_NE(read.scene.find(":Root"), nullptr);
  EXPECT_NE(read.scene.find("file 2"), nullptr);
}

// acceptance: H1
TEST(Wild, TrailingCommasAreLegal) {
  const Snippet read("shader \"x\" \"s\" ( \"a\" 1 , \"b\" 2, )");
  EXPECT_SILENT(read);
  EXPECT_EQ(read.get<scene::ShaderElement>("x").functions[0].arguments.size(), 2u);
}

// acceptance: H1
TEST(Wild, VerticesMayHaveSeveralTextureSetsWithBasisVectors) {
  const Snippet read(
      "object \"o\" group 0 0 0 1 0 0 2 0 0 v 0 n 1 t 0 1 2 t 2 0 1 v 1 end group "
      "end object");
  EXPECT_SILENT(read);
  const auto& v = read.get<scene::Object>("o").groups[0].vertices;
  EXPECT_EQ(v.normal, (std::vector<std::uint32_t>{1, kNone}));
  ASSERT_EQ(v.textures.size(), 2u);
  EXPECT_EQ(v.textures[1].coordinate, (std::vector<std::uint32_t>{2, kNone}));
  EXPECT_EQ(v.textures[1].basis_v, (std::vector<std::uint32_t>{1, kNone}));
}

// acceptance: H1
TEST(Wild, TrilistIsReadInBothLayouts) {
  const Snippet line(
      "object \"o\" tagged on trilist vertex 3 p n t 2 b 2 triangle 1 "
      "[ 0 0 0 0 0 1 0 0 1 0 0 0 1 0 1 0 0 0 0 1 1 0 1 0 0 0 1 0 "
      "0 1 0 0 0 1 0 1 1 0 0 0 1 0 ] [ 5 0 1 2 ] end trilist end object");
  EXPECT_SILENT(line);
  const auto& g = line.get<scene::Object>("o").groups.at(0);
  ASSERT_EQ(g.vertices.size(), 3u);
  EXPECT_EQ(g.vectors[g.vertices.point[1]], Vec3(1, 0, 0));
  EXPECT_EQ(g.vectors[g.vertices.normal[2]], Vec3(0, 0, 1));
  EXPECT_EQ(g.vectors[g.vertices.textures[0].coordinate[1]], Vec3(1, 0, 0));
  EXPECT_EQ(g.vectors[g.vertices.textures[0].basis_v[2]], Vec3(0, 1, 0));
  EXPECT_EQ(g.polygons.indices, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(g.polygons.material, (std::vector<std::uint32_t>{5}));

  const Snippet block(
      "object \"o\"\ntrilist\nvertex 3\np n t 3\ntriangle 1\ndata 1 1\n[\n"
      "0 0 0 0 0 1 0 0 0\n1 0 0 0 0 1 1 0 0\n0 1 0 0 0 1 0 1 0\n]\n[\n0 0 1 2\n]\n"
      "triangle data [ 1 2 ] [ 3 ]\nend trilist\nend object");
  EXPECT_EQ(block.count(code::kIgnored), block.diagnostics.all().size()) << block.messages();
  EXPECT_EQ(block.get<scene::Object>("o").groups.at(0).polygons.size(), 1u);

  const Snippet older(
      "object \"o\" trilist vector [4] vertex [3] p n triangle [1] "
      "[ 0 0 0 1 0 0 0 1 0 0 0 1 ] [ 0 3 1 3 2 3 ] [ \"m\" 0 1 2 ] "
      "end trilist end object");
  EXPECT_SILENT(older);
  const auto& old = older.get<scene::Object>("o").groups.at(0);
  EXPECT_EQ(old.vertices.normal, (std::vector<std::uint32_t>{3, 3, 3}));
  EXPECT_EQ(old.materials, (std::vector<std::string>{"m"}));
}

// acceptance: H1
TEST(Wild, AnApproximationMayFollowATrilist) {
  const Snippet read(
      "object \"o\" trilist vertex 3 p triangle 1 [ 0 0 0 1 0 0 0 1 0 ] [ 0 1 2 ] "
      "end trilist approximate view fine shared length 2 distance 0 angle 0 0 6 "
      "end object");
  EXPECT_SILENT(read);
  const auto& settings = read.get<scene::Object>("o").groups.at(0).settings;
  ASSERT_EQ(settings.size(), 1u);
  EXPECT_EQ(settings[0].keyword, "approximate");
  EXPECT_EQ(settings[0].values.size(), 9u);
}

// acceptance: H1
TEST(Wild, OptionsMayContainStatesDataAndTraversal) {
  const Snippet read(
      "options \"o\" state [ \"a\" ( \"x\" 1 ) , \"b\" ( ) ] data \"A|d\" "
      "traversal someName samples 0 2 end options");
  EXPECT_SILENT(read);
  const auto& options = read.get<scene::Options>("o");
  ASSERT_EQ(options.state.size(), 2u);
  EXPECT_EQ(options.state[0].type, "a");
  EXPECT_EQ(options.state[0].arguments[0].name, "x");
  EXPECT_EQ(options.state[1].type, "b");
  ASSERT_EQ(options.statements.size(), 3u);
  EXPECT_EQ(options.statements[1].values[0].text, "someName");
}

// acceptance: H1
TEST(Wild, StringOptionsKeepTheWrittenType) {
  const Snippet read(
      "options \"o\" \"unified sampling\" 1 \"light importance sampling\" \"on\"\n"
      "\"samples quality\" .5 .5 .5 .5 \"samples quality\" 1. \"gi\" off end options");
  EXPECT_SILENT(read);
  const auto& s = read.get<scene::Options>("o").statements;
  ASSERT_EQ(s.size(), 5u);
  EXPECT_TRUE(s[1].quoted);
  EXPECT_EQ(s[1].values[0].text, "on");
  EXPECT_EQ(s[2].values[0].numbers.size(), 4u);
  EXPECT_EQ(s[4].values[0].kind, Value::Kind::Boolean);
}

// acceptance: H1
TEST(Wild, BooleansHaveFourSpellings) {
  for (const char* word : {"on", "true"}) EXPECT_TRUE(value_of(word).boolean);
  for (const char* word : {"off", "false"}) EXPECT_FALSE(value_of(word).boolean);
}

// acceptance: H1
TEST(Wild, ScalarIsAcceptedAsInteger) {
  const Snippet read("camera \"c\" frame 7 7. resolution 640. 480 end camera");
  EXPECT_SILENT(read);
  EXPECT_EQ(read.get<scene::Camera>("c").other[0].values[0].numbers, (std::vector<double>{7, 7}));
  EXPECT_EQ(read.get<scene::Camera>("c").resolution->at(0), 640);
}

// acceptance: H1
TEST(Wild, ArraysOfStructuresAreValues) {
  const Value v = value_of("[{ \"name\" \"a\", \"size\" 2 }\n, { \"name\" \"b\" } ]");
  ASSERT_EQ(v.items.size(), 2u);
  EXPECT_EQ(v.items[0].members[1].value.numbers[0], 2);
}

// acceptance: H1
TEST(Wild, ShaderParametersAcceptNamesConnectionsAndMembers) {
  const Snippet read(
      "shader \"basis1\" \"s\" ( ) shader \"x\" \"s\" ( \"bump\" \"b\", \"k\"=\"basis1\","
      " \"u\" = \"basis1.u\" ) material \"m\" opaque \"s\" ( ) shadow end material");
  EXPECT_SILENT(read);
  const auto& a = read.get<scene::ShaderElement>("x").functions[0].arguments;
  EXPECT_EQ(a[0].value.kind, Value::Kind::Text);
  EXPECT_EQ(a[1].value.text, "basis1");
  EXPECT_EQ(a[2].value.text, "basis1.u");
  EXPECT_TRUE(read.get<scene::Material>("m").opaque);
  ASSERT_NE(read.get<scene::Material>("m").slot("shadow"), nullptr);
}

// acceptance: H1
TEST(Wild, CameraOutputsComeInManyForms) {
  const Snippet read(
      "camera \"c\" output \"pic\" \"x.pic\" output \"rgb\" \"x.sgi\" "
      "output \"rgba\" \"x.tif\" output \"+rgba\" \"png\" \"x.png\" output = \"f\" "
      "output \"s\" ( ) output \"rgba\" \"exr\" quality 3 compress \"zip\" \"x.exr\" "
      "focal infinity end camera shader \"f\" \"s\" ( )");
  EXPECT_SILENT(read);
  const auto& o = read.get<scene::Camera>("c").outputs;
  ASSERT_EQ(o.size(), 7u);
  EXPECT_EQ(o[0].format + "/" + o[0].types, "pic/");
  EXPECT_EQ(o[1].format + "/" + o[1].types, "/rgb");
  EXPECT_EQ(o[2].types, "rgba");
  EXPECT_EQ(o[3].types + o[3].format + o[3].file, "+rgbapngx.png");
  EXPECT_EQ(o[4].shaders[0].reference, "f");
  EXPECT_EQ(o[5].shaders[0].type, "s");
  EXPECT_EQ(o[6].file, "x.exr");
  EXPECT_EQ(o[6].modifiers.size(), 2u);
  EXPECT_TRUE(read.get<scene::Camera>("c").orthographic);
}

// acceptance: H1
TEST(Wild, StatementsMayFollowAnInlineLightShader) {
  const Snippet read(
      "light \"l\" \"s\" ( ) direction 0 -1 0 end light\n"
      "light \"k\" = \"x\" origin 1 2 3 end light shader \"x\" \"s\" ( )");
  EXPECT_SILENT(read);
  EXPECT_EQ(*read.get<scene::Light>("l").direction, Vec3(0, -1, 0));
  EXPECT_EQ(*read.get<scene::Light>("k").origin, Vec3(1, 2, 3));
}

TEST(Wild, MissingPackagesAreWarningsIfAShaderIsMissing) {
  const Snippet read(
      "$include \"a.mi\"\n$include \"b.mi\"\nmaterial \"m\" \"nobody\" ( ) end material options "
      "\"o\" end options camera \"c\" end camera instance \"ci\" \"c\" end instance instgroup "
      "\"r\" "
      "\"ci\" end instgroup render \"r\" \"ci\" \"o\"");
  EXPECT_EQ(read.count(code::kMissingInclude), 2u) << read.messages();
  EXPECT_EQ(read.message(code::kMissingInclude).severity, Severity::Warning);
}

// acceptance: H1
TEST(Wild, AMissingElementIsNamedTogetherWithTheIncludeThatFailed) {
  const Snippet read(
      "$include \"geometry.mi\"\noptions \"o\" end options camera \"c\" end camera "
      "instance \"ci\" \"c\" end instance render \"root\" \"ci\" \"o\"");
  EXPECT_EQ(read.count(code::kMissingInclude), 1u);
  const Diagnostic d = read.message(code::kUnresolved);
  EXPECT_NE(d.message.find("\"root\""), std::string::npos);
  EXPECT_NE(d.hint.find("geometry.mi"), std::string::npos);
}

// acceptance: H1
TEST(Wild, UnknownParametersAndExtraNumbersAreReportedWithTheirShader) {
  const Snippet read(
      "declare shader \"d\" ( color \"tint\", scalar \"size\" ) version 1 end declare\n"
      "shader \"x\" \"d\" (\n\"tint\" 1 2 3 4 5,\n\"sise\" 1 )\n"
      "shader \"y\" \"d\" ( \"size\" 2 )");
  const Diagnostic many = read.message(code::kTooManyValues);
  EXPECT_EQ(many.where.line, 3u);
  EXPECT_NE(many.message.find("\"d\""), std::string::npos);
  const Diagnostic unknown = read.message(code::kUnknownParameter);
  EXPECT_EQ(unknown.where.line, 4u);
  EXPECT_EQ(unknown.hint, "did you mean \"size\"?");
  EXPECT_NE(read.scene.find("y"), nullptr);
}

// acceptance: H1
TEST(Wild, AShaderMayBeChangedAfterItWasUsed) {
  const Snippet read(
      "shader \"x\" \"s\" ( \"list\" [\"a\"], \"k\" 1 ) material \"m\" = \"x\" end material "
      "incremental shader \"x\" \"s\" ( \"list\" [] )");
  EXPECT_SILENT(read);
  const auto& a = read.get<scene::ShaderElement>("x").functions[0].arguments;
  ASSERT_EQ(a.size(), 2u);
  EXPECT_TRUE(a[0].value.items.empty());
}

// acceptance: H1
TEST(Wild, DeclarationsMayReturnNamelessStructuresAndUseTypesAsNames) {
  const Snippet read(
      "declare shader struct { color \"a\", scalar \"b\" } \"d\" ( color \"Color\", "
      "integer \"q\" default -1, ) version 3 apply texture,\n material "
      "gui \"g\" { control \"x\" \"y\" ( \"hidden\" ) control \"z\" {} () } "
      "end declare # done");
  EXPECT_SILENT(read);
  const auto* d = read.scene.find_declaration("d");
  ASSERT_NE(d, nullptr);
  EXPECT_EQ(d->results.size(), 2u);
  EXPECT_EQ(d->parameters[1].default_value->numbers[0], -1);
  EXPECT_EQ(d->requirements[1].values.size(), 2u);
  EXPECT_EQ(d->uninterpreted[0].keyword, "gui");
}

// acceptance: H1
TEST(Wild, ConcaveKeywordsAndBowTiesArePolygonsLikeOthers) {
  const Snippet read(object("", "c \"m\" 0 1 2 3 cp \"m\" 0 2 1 3"));
  EXPECT_SILENT(read);
  EXPECT_EQ(read.get<scene::Object>("o").groups[0].polygons.size(), 2u);
}

// acceptance: H1
TEST(Wild, AnExportersSceneIsReadWithOnlyItsMissingPackagesReported) {
  ReadOptions options = Snippet::known_shaders();
  options.packages = {"base", "architectural", "physics"};
  options.knows_shader = [](std::string_view type) { return type.starts_with("mi"); };
  Diagnostics d;
  const scene::Scene scene =
      read_scene(ORIEL_SOURCE_DIR "/scenes/nine-tiles/nine-tiles.mi", options, d);
  ASSERT_EQ(d.all().size(), 1u) << "one note for all packages of which nothing is used";
  EXPECT_EQ(d.all()[0].code, code::kMissingInclude);
  EXPECT_EQ(d.all()[0].severity, Severity::Note);
  for (const char* name : {"contour", "paint", "production", "mayabase", "AdskShaderSDK"})
    EXPECT_NE(d.all()[0].message.find(name), std::string::npos) << name;
  EXPECT_EQ(scene.packages,
            (std::vector<std::string>{"base.mi", "physics.mi", "architectural.mi"}));
  EXPECT_EQ(scene.elements().size(), 22u);
  EXPECT_EQ(scene.get<scene::InstanceGroup>("scene")->members.size(), 12u);
  EXPECT_EQ(scene.renders.size(), 1u);
  EXPECT_GT(scene.get<scene::Options>("opt")->statements.size(), 80u);
}

}  // namespace wild_test
}  // namespace oriel::mi
