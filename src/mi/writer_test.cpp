// SPDX-License-Identifier: Apache-2.0
#include "mi/writer.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "mi/text_sink.h"
#include "support/files.h"

namespace oriel::mi {
namespace writer_test {

using namespace scene;

std::string written(const Scene& scene) {
  std::ostringstream out;
  write_scene(scene, out);
  const std::string text = out.str();
  return text.substr(text.find('\n') + 1);  // without the initial comment
}

template <class T>
std::string written(T element) {
  Scene scene;
  scene.add(std::move(element));
  return written(scene).substr(1);
}

Value text(std::string word, bool bare = false) {
  Value v;
  v.kind = Value::Kind::Text;
  v.text = std::move(word);
  v.bare = bare;
  return v;
}

Value numbers(std::vector<double> list, bool integral = false) {
  Value v;
  v.kind = Value::Kind::Numbers;
  v.numbers = std::move(list);
  v.integral = integral;
  return v;
}

Value boolean(bool on) {
  Value v;
  v.kind = Value::Kind::Boolean;
  v.boolean = on;
  return v;
}

Statement statement(std::string keyword, std::vector<Value> values = {}, bool quoted = false) {
  return {std::move(keyword), quoted, std::move(values), {}};
}

ShaderUse call(std::string type, std::vector<Argument> arguments = {}) {
  ShaderUse use;
  use.type = std::move(type);
  use.arguments = std::move(arguments);
  return use;
}

ShaderUse reference(std::string name) {
  ShaderUse use;
  use.reference = std::move(name);
  return use;
}

template <class Put>
std::string sunk(Put put) {
  std::ostringstream stream;
  {
    TextSink sink(stream);
    put(sink);
  }
  return stream.str();
}

TEST(TextSink, NumbersAreTheShortestThatReadBackTheSame) {
  const auto f = [](float x) { return sunk([x](TextSink& s) { s.number(x); }); };
  EXPECT_EQ(f(0.1f), "0.1");
  EXPECT_EQ(f(1.0f), "1");
  EXPECT_EQ(f(-8e-22f), "-8e-22");
  EXPECT_EQ(f(16777216.0f), "16777216");
  EXPECT_EQ(f(std::numeric_limits<float>::infinity()), "3.4028235e+38");
  EXPECT_EQ(f(std::numeric_limits<float>::quiet_NaN()), "0");
  const auto i = [](double x) { return sunk([x](TextSink& s) { s.integer(x); }); };
  EXPECT_EQ(i(4294967295.0), "4294967295");
  EXPECT_EQ(i(1e22), "10000000000000000000000");
  const auto s = [](double x) { return sunk([x](TextSink& t) { t.scalar(x); }); };
  EXPECT_EQ(s(-3), "-3.");
  EXPECT_EQ(s(0.25), "0.25");
  EXPECT_EQ(s(1234567890123456.0), "1.234567890123456e+15");
}

TEST(TextSink, QuotesAreEscapedAndOtherBackslashesStay) {
  const auto q = [](std::string_view x) { return sunk([x](TextSink& s) { s.quoted(x); }); };
  EXPECT_EQ(q(""), "\"\"");
  EXPECT_EQ(q("say \"hi\""), "\"say \\\"hi\\\"\"");
  EXPECT_EQ(q("C:\\textures\\a.tif"), "\"C:\\textures\\a.tif\"");
  EXPECT_EQ(q("C:\\textures\\"), "\"C:\\textures/\"");
}

TEST(TextSink, LongTextsPassThroughTheBufferWhole) {
  const std::string block(70'000, 'x');
  EXPECT_EQ(sunk([&](TextSink& s) {
              s.put("a");
              s.put(block);
              s.put(std::string_view(block).substr(0, 60'000));
              s.put("b");
            }),
            "a" + block + block.substr(0, 60'000) + "b");
}

// acceptance: H1
TEST(Writer, OptionsKeepWordsNumbersAndStrings) {
  Options o;
  o.name = "opt";
  o.statements = {statement("samples", {numbers({-1, 2}, true)}),
                  statement("filter", {text("clip mitchell", true), numbers({4, 4})}),
                  statement("photonmap file", {text("a \"b\".pm")}),
                  statement("trace", {boolean(true)}),
                  statement("frame buffer", {numbers({0}, true)}),
                  statement("finalgather mode", {text("automatic")}, true)};
  EXPECT_EQ(written(o),
            "options \"opt\"\n"
            "    samples -1 2\n"
            "    filter clip mitchell 4 4.\n"
            "    photonmap file \"a \\\"b\\\".pm\"\n"
            "    trace on\n"
            "    frame buffer 0 \"\"\n"
            "    \"finalgather mode\" \"automatic\"\n"
            "end options\n");
}

TEST(Writer, CamerasWriteOutputsFirstAndUninterpretedBlocksLast) {
  Camera c;
  c.name = "cam";
  c.orthographic = true;
  c.aperture = 36.5f;
  c.resolution = std::array<int, 2>{640, 480};
  c.outputs.resize(4);
  c.outputs[0].types = "rgba";
  c.outputs[0].file = "a.tif";
  c.outputs[1].format = "pic";
  c.outputs[1].file = "x.pic";
  c.outputs[2].types = "rgb";
  c.outputs[2].file = "x.rgb";
  c.outputs[2].modifiers = {statement("quality", {numbers({90}, true)})};
  c.outputs[3].types = "fb0";
  c.outputs[3].shaders = {reference("glare")};
  c.frame_buffers.resize(1);
  c.frame_buffers[0].name = "main";
  c.frame_buffers[0].datatype = "rgba";
  c.frame_buffers[0].filtering = false;
  c.frame_buffers[0].modifiers = {statement("quality", {numbers({90}, true)})};
  c.frame_buffers[0].uninterpreted = {{"deep", "[ 1 2 ]", {}}};
  c.uninterpreted = {{"pass", "\"p\" read", {}}};
  EXPECT_EQ(written(c),
            "camera \"cam\"\n"
            "    output \"rgba\" \"a.tif\"\n"
            "    output \"pic\" \"x.pic\"\n"
            "    output \"rgb\" \"\" quality 90 \"x.rgb\"\n"
            "    output \"fb0\" = \"glare\"\n"
            "    focal infinity\n"
            "    aperture 36.5\n"
            "    resolution 640 480\n"
            "    framebuffer \"main\"\n"
            "        datatype \"rgba\"\n"
            "        filtering off\n"
            "        quality 90\n"
            "        deep [ 1 2 ]\n"
            "    pass \"p\" read\n"
            "end camera\n");
}

TEST(Writer, ShadersNestValuesOfEveryKind) {
  Value connection;
  connection.kind = Value::Kind::Connection;
  connection.text = "tex.outColor";
  Value null;
  Value structure;
  structure.kind = Value::Kind::Struct;
  structure.members = {{"k", numbers({1}, true), {}}};
  Value array;
  array.kind = Value::Kind::Array;
  array.items = {text("l1"), text("l2")};
  ShaderElement s;
  s.name = "s";
  s.functions = {call("mib", {{"a", connection, {}},
                              {"b", null, {}},
                              {"c", structure, {}},
                              {"d", array, {}},
                              {"e", numbers({0.5, 1}), {}}}),
                 reference("next")};
  EXPECT_EQ(written(s),
            "shader \"s\" \"mib\" (\n"
            "    \"a\" = \"tex.outColor\",\n"
            "    \"b\" null,\n"
            "    \"c\" {\n"
            "        \"k\" 1\n"
            "    },\n"
            "    \"d\" [ \"l1\", \"l2\" ],\n"
            "    \"e\" 0.5 1\n"
            ") = \"next\"\n");
}

TEST(Writer, GroupsWriteAllVertexFieldsAndResetTheMaterial) {
  Object o;
  o.name = "o";
  o.flags = {statement("visible"), statement("shadow", {numbers({3}, true)})};
  PolygonGroup& g = o.groups.emplace_back();
  g.name = "g";
  g.settings = {statement("merge", {numbers({0.5})}),
                statement("approximate", {text("fine", true)})};
  g.vectors.emplace_back(0.0f, 0.0f, 0.0f);
  g.vectors.emplace_back(1.0f, 0.0f, 0.25f);
  g.vectors.emplace_back(1.0f, 1.0f, 0.0f);
  g.vertices.point = {0, 1, 2};
  g.vertices.normal = {2, kNone, 2};
  g.vertices.derivative = {{0, 0, kNone}, {1, 1, kNone}};
  g.vertices.textures = {{{0, 1, 2}, {}, {}}, {{1, kNone, 2}, {0, kNone, 0}, {1, kNone, 1}}};
  g.vertices.motion = {{0, 0, 0}};
  g.vertices.user = {{1, 1, 1}, {2, 2, 2}};
  g.polygons.first = {0, 3, 6, 12};
  g.polygons.indices = {0, 1, 2, 2, 1, 0, 0, 1, 2, 0, 2, 1};
  g.polygons.holes = {9};
  g.polygons.material = {kNone, 0, kNone};
  g.materials = {"m"};
  EXPECT_EQ(written(o),
            "object \"o\"\n"
            "    visible\n"
            "    shadow 3\n"
            "    group \"g\"\n"
            "        merge 0.5\n"
            "0 0 0\n1 0 0.25\n1 1 0\n"
            "v 0 n 2 d 0 1 t 0 t 1 0 1 m 0 u 1 u 2\n"
            "v 1 d 0 1 t 1 m 0 u 1 u 2\n"
            "v 2 n 2 t 2 t 2 0 1 m 0 u 1 u 2\n"
            "p 0 1 2\n"
            "p \"m\" 2 1 0\n"
            "p \"\" 0 1 2 hole 0 2 1\n"
            "        approximate fine\n"
            "    end group\n"
            "end object\n");
  o.flags.push_back(statement("tagged"));
  o.groups[0].polygons.material = {4, 0, 7};
  const std::string tagged = written(o);
  EXPECT_NE(tagged.find("p 4  0 1 2\np 0  2 1 0\np 7  0 1 2 hole 0 2 1\n"), std::string::npos);
}

TEST(Writer, InstancesWriteMatricesLinksAndParameters) {
  Instance i;
  i.name = "i";
  i.element = "o";
  i.flags = {statement("caustic", {boolean(true)}), statement("caustic", {numbers({3}, true)})};
  i.transform = Mat4();
  (*i.transform)[3][0] = -2.5f;
  i.material_list = true;
  i.materials = {"a", "b"};
  i.light_links = LightLinks{true, {}};
  i.shadow_links = LightLinks{false, {"l"}};
  i.parameters.emplace();
  EXPECT_EQ(written(i),
            "instance \"i\" \"o\"\n"
            "    caustic on\n"
            "    caustic 3\n"
            "    transform\n"
            "        1 0 0 0\n        0 1 0 0\n        0 0 1 0\n        -2.5 0 0 1\n"
            "    material [ \"a\", \"b\" ]\n"
            "    light \"exclusive\" [ ]\n"
            "    light shadow [ \"l\" ]\n"
            "    ()\n"
            "end instance\n");
}

TEST(Writer, DeclarationsComeFirstWithStructsArraysAndDefaults) {
  Scene s;
  s.commands = {statement("verbose", {boolean(false)}), statement("link", {text("base.so")})};
  s.packages = {"base.mi"};
  ShaderDeclaration d;
  d.name = "sh";
  ParamDecl color, scalar, array, element;
  color.type = ParamType::Color;
  color.name = "c";
  color.default_value = numbers({1, 0.5, 0, 1});
  element.type = ParamType::Light;
  array.type = ParamType::Array;
  array.name = "lights";
  array.members = {element};
  scalar.name = "out";
  d.results = {scalar};
  d.parameters = {color, array};
  d.requirements = {statement("version", {numbers({1}, true)}),
                    statement("apply", {text("material", true), text("texture", true)})};
  s.declarations = {d};
  s.renders = {{"root", "cam", "opt", {}}};
  EXPECT_EQ(written(s),
            "verbose off\n"
            "link \"base.so\"\n"
            "$include <base.mi>\n"
            "declare shader struct {\n"
            "    scalar \"out\"\n"
            "} \"sh\" (\n"
            "    color \"c\" default 1 0.5 0 1,\n"
            "    array light \"lights\"\n"
            ")\n"
            "    version 1\n"
            "    apply material, texture\n"
            "end declare\n"
            "\n"
            "render \"root\" \"cam\" \"opt\"\n");
}

TEST(Writer, TexturesHaveFilesPixelsOrProcedures) {
  Texture t;
  t.name = "t";
  t.local = true;
  t.filter = 0.5f;
  t.file = "C:\\maps\\a.tif";
  EXPECT_EQ(written(t), "local filter 0.5 color texture \"t\" \"C:\\maps\\a.tif\"\n");
  Texture p;
  p.name = "p";
  p.type = ParamType::ScalarTexture;
  p.size = {2, 1, 1};
  p.pixels = {0x00, 0xff};
  EXPECT_EQ(written(p), "scalar texture \"p\" [ 2 1 1 ]\n'00ff'\n");
  Texture q;
  q.name = "q";
  q.procedure = {reference("noise")};
  EXPECT_EQ(written(q), "color texture \"q\" = \"noise\"\n");
}

TEST(Writer, WriteErrorIsReportedAndLeavesNoFile) {
  Diagnostics d;
  EXPECT_FALSE(write_scene(Scene(), "/nowhere/at/all.mi", d));
  EXPECT_TRUE(d.has("OR-MI-050"));
  const auto path = std::filesystem::temp_directory_path() / "oriel_writer_test.mi";
  EXPECT_TRUE(write_scene(Scene(), path.string(), d));
  EXPECT_FALSE(std::filesystem::exists(path.string() + ".part"));
  std::filesystem::remove(path);
}

TEST(SceneFile, EditsAreDetectedByTheChecksum) {
  const TestFolder folder;
  const std::string path = folder.file("a.mi");
  Scene scene;
  for (int i = 0; i < 3000; ++i) {  // more than a buffer
    Texture t;
    t.name = "texture_" + std::to_string(i);
    t.file = "folder/picture.tif";
    scene.add(std::move(t));
  }
  Diagnostics d;
  ASSERT_TRUE(write_scene(scene, path, d));
  EXPECT_TRUE(is_unedited_scene(path));
  const std::string whole = text_of(path);
  std::ostringstream expected;
  write_scene(scene, expected);
  EXPECT_EQ(whole.substr(0, whole.rfind("# oriel")), expected.str());
  for (const std::size_t at : {std::size_t{0}, whole.size() / 2, whole.size() - 2}) {
    std::string edited = whole;
    edited[at] = edited[at] == 'x' ? 'y' : 'x';
    std::ofstream(path) << edited;
    EXPECT_FALSE(is_unedited_scene(path)) << at;
  }
  for (const std::string& edited : {whole + "\n", whole.substr(1), std::string("#mi\n")}) {
    std::ofstream(path) << edited;
    EXPECT_FALSE(is_unedited_scene(path));
  }
  EXPECT_FALSE(is_unedited_scene(folder.file("missing")));
}

}  // namespace writer_test
}  // namespace oriel::mi
