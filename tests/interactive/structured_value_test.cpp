// SPDX-License-Identifier: Apache-2.0
// Edits of arrays and structures; every parameter of every architectural shader takes an edit.
#include "interactive/structured_value.h"
#include "interactive/loop_support.h"
#include "interactive/scene_edit.h"
#include "mi/reader.h"
#include "runtime/binder.h"

namespace oriel::interactive {
namespace {

using scene::Value;

TEST(StructuredValue, TextsOfTheSceneLanguage) {
  const auto list = parse_structured("[ 1 0 .5, = \"tint\", \"a \\\"b\\\"\", on, null, [] ]");
  ASSERT_TRUE(list);
  ASSERT_EQ(list->items.size(), 6u);
  EXPECT_EQ(list->items[0].numbers, (std::vector<double>{1, 0, .5}));
  EXPECT_EQ(list->items[1].kind, Value::Kind::Connection);
  EXPECT_EQ(list->items[1].text, "tint");
  EXPECT_EQ(list->items[2].text, "a \"b\"");
  EXPECT_TRUE(list->items[3].boolean);
  EXPECT_EQ(list->items[4].kind, Value::Kind::Null);
  EXPECT_EQ(list->items[5].kind, Value::Kind::Array);

  const auto record = parse_structured("{\"color\" 1 2 3, \"inner\" {\"on\" off}}");
  ASSERT_TRUE(record);
  ASSERT_EQ(record->members.size(), 2u);
  EXPECT_EQ(record->members[0].name, "color");
  EXPECT_EQ(record->members[1].value.members[0].value.kind, Value::Kind::Boolean);
  EXPECT_EQ(structured_text(*record), "{\"color\" 1 2 3, \"inner\" {\"on\" off}}");
  EXPECT_EQ(*parse_structured(structured_text(*list)), *list);
}

TEST(StructuredValue, OtherTextsAreNone) {
  for (const char* text : {"", "1 2", "[", "[1", "[1,]", "{1}", "{\"a\"}", "[1] 2", "[word]",
                           "[=a]", "{\"a\" 1, }", "[\"a]", "[1 x]"})
    EXPECT_FALSE(parse_structured(text)) << text;
  EXPECT_FALSE(parse_structured(std::string(100, '[') + std::string(100, ']'))) << "too deep";
  EXPECT_TRUE(parse_structured(std::string(16, '[') + std::string(16, ']')));
}

/// A value of each type that a shader accepts, in the form of edits; parts of arrays and
/// structures are written as in scenes.
std::string edit_value(const ParamSpec& p, ParamType type, bool nested) {
  const auto named = [&](const char* name) {
    return nested ? "\"" + std::string(name) + "\"" : std::string(name);
  };
  switch (type) {
    case ParamType::Boolean:
      return "on";
    case ParamType::Integer:
      return std::to_string(static_cast<int>(std::clamp(1.0f, p.min, p.max)));
    case ParamType::Scalar:
      return std::to_string(std::clamp(.5f, p.min, p.max));
    case ParamType::Color:
    case ParamType::Spectrum:
      return ".1 .2 .3";
    case ParamType::Vector:
      return "0 0 1";
    case ParamType::Transform:
      return "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";
    case ParamType::String:
      return named("word");
    case ParamType::Light:
      return named("lamp_inst");
    case ParamType::Material:
      return named("box_mtl");
    case ParamType::Geometry:
      return named("wall_inst");
    case ParamType::ColorTexture:
    case ParamType::ScalarTexture:
    case ParamType::VectorTexture:
      return named("wood");
    case ParamType::LightProfile:
      return named("profile");
    case ParamType::Shader:
      return nested ? "= \"tint\"" : "=tint";
    default:
      return {};
  }
}

std::string value_of_parameter(const ParamSpec& p) {
  if (p.type != ParamType::Array) return edit_value(p, p.type, false);
  if (p.element != ParamType::Struct) {
    const std::string item = edit_value(p, p.element, true);
    return "[" + item + ", " + item + "]";
  }
  std::string text = "[{";
  for (const ParamSpec& member : p.members) {
    if (text.size() > 2) text += ", ";
    text += std::string("\"") + member.name + "\" " + edit_value(member, member.type, true);
  }
  return text + "}]";
}

class EveryParameter : public LoopTest {};

// acceptance: W2
TEST_F(EveryParameter, OfArchitecturalShadersTakesAnEditOfItsType) {
  std::string text = editable_scene();
  std::string added =
      "shader \"tint\" \"mib_color_mix\" ( \"color_base\" .5 .5 .5 )\n"
      "color texture \"wood\" = \"tint\"\n";
  std::vector<const ShaderSpec*> specs;
  for (const ShaderSpec* spec : builtin_shaders().all())
    if (spec->library == std::string_view("architectural")) {
      added += "shader \"the_" + std::string(spec->name) + "\" \"" + spec->name + "\" ()\n";
      specs.push_back(spec);
    }
  ASSERT_GE(specs.size(), 15u);
  text.insert(text.find("light \"lamp\""), added);
  write("scene.mi", text);
  Diagnostics read;
  const SceneSource from = source();
  const scene::Scene scene = mi::read_scene(from.path, from.read, read);
  std::size_t parameters = 0, arrays = 0;
  for (const ShaderSpec* spec : specs)
    for (const ParamSpec& p : spec->params) {
      const std::string value = value_of_parameter(p);
      if (p.type == ParamType::LightProfile || p.type == ParamType::Data) continue;
      const std::string target = "the_" + std::string(spec->name) + "." + p.name;
      ASSERT_FALSE(value.empty()) << target << " of type " << scene::type_name(p.type);
      scene::Scene edited = scene;
      ASSERT_NO_THROW(apply_edit(edited, target + "=" + value, builtin_shaders())) << target;
      World world;
      world.lights.emplace_back();
      Diagnostics messages;
      const std::unordered_map<std::string, std::vector<int>> lights = {{"lamp_inst", {0}}};
      Binder binder(edited, builtin_shaders(), world, lights, messages);
      binder.named("the_" + std::string(spec->name), {});
      for (const Diagnostic& d : messages.all())
        EXPECT_NE(d.severity, Severity::Warning)
            << target << "=" << value << ": " << d.message << " [" << d.code << "]";
      ++parameters;
      arrays += p.type == ParamType::Array;
    }
  EXPECT_GT(parameters, 300u);
  EXPECT_GE(arrays, 4u);
}

}  // namespace
}  // namespace oriel::interactive
