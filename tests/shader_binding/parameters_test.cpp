// SPDX-License-Identifier: Apache-2.0
// Binding of written values to parameters: all types, conversions, rejected values.
#include <fmt/format.h>

#include "probe.h"

namespace oriel {
namespace parameters_test {

#define EXPECT_SILENT(s) EXPECT_TRUE((s).diagnostics.all().empty()) << (s).messages()

TEST(Parameters, UnwrittenOnesTakeTheirDeclaredDefaults) {
  const ProbeScene s(probe_call(""));
  EXPECT_SILENT(s);
  const ProbeParams p = s.params();
  EXPECT_FALSE(p.flag);
  EXPECT_EQ(p.count, 0);
  EXPECT_EQ(p.amount, 0);
  EXPECT_EQ(p.place, Vec3(0));
  EXPECT_EQ(p.matrix, Mat4());
  EXPECT_TRUE(p.text.empty());
  EXPECT_EQ(p.other.node, nullptr);
  EXPECT_EQ(p.lamp.index, -1);
  EXPECT_EQ(p.picture.texture, nullptr);
  EXPECT_EQ(p.lights.size, 0);
  EXPECT_TRUE(p.flag_on);
  EXPECT_EQ(p.count_seven, 7);
  EXPECT_EQ(p.amount_half, 0.5f);
  expect_color(p.tint_warm, .9f, .6f, .3f, 1);
}

TEST(Parameters, EveryTypeIsBoundAsWritten) {
  const ProbeScene s(
      probe_call("\"flag\" on, \"count\" -12, \"amount\" 2.5e-3, \"tint\" .1 .2 .3 .4, "
                 "\"place\" 1 -2 3, \"matrix\" 1 0 0 0 0 2 0 0 0 0 3 0 4 5 6 1, "
                 "\"text\" \"hello\", \"other\" \"k\", \"lamp\" \"lamp_inst\", "
                 "\"weights\" [ 1, 2.5, -3 ], \"tints\" [ 1 0 0, .5, 0 0 1 .5 ], "
                 "\"flag_on\" off, \"count_seven\" 3, \"amount_half\" 1",
                 "shader \"k\" \"probe_scalar\" ( \"amount\" 2 )\n"
                 "light \"lamp\" \"mib_light_point\" ( \"color\" 1 1 1 ) origin 0 0 0 end light\n"
                 "instance \"lamp_inst\" \"lamp\" end instance"),
      "\"lamp_inst\"");
  EXPECT_SILENT(s);
  const ProbeParams p = s.params();
  EXPECT_TRUE(p.flag);
  EXPECT_EQ(p.count, -12);
  EXPECT_FLOAT_EQ(p.amount, 2.5e-3f);
  expect_color(p.tint, .1f, .2f, .3f, .4f);
  EXPECT_EQ(p.place, Vec3(1, -2, 3));
  EXPECT_EQ(p.matrix, Mat4(1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 3, 0, 4, 5, 6, 1));
  EXPECT_EQ(p.text, "hello");
  ASSERT_NE(p.other.node, nullptr);
  EXPECT_STREQ(p.other.node->spec().name, "probe_scalar");
  EXPECT_EQ(p.lamp.index, 0);
  ASSERT_EQ(p.weights.size, 3);
  EXPECT_EQ(std::vector<float>(p.weights.begin(), p.weights.end()),
            (std::vector<float>{1, 2.5f, -3}));
  ASSERT_EQ(p.tints.size, 3);
  expect_color(p.tints.data[0], 1, 0, 0, 1);
  expect_color(p.tints.data[1], .5f, .5f, .5f, 1);
  expect_color(p.tints.data[2], 0, 0, 1, .5f);
  EXPECT_FALSE(p.flag_on);
  EXPECT_EQ(p.count_seven, 3);
  EXPECT_EQ(p.amount_half, 1);
}

TEST(Parameters, BooleansAndIntegersConvert) {
  for (const auto& [text, expected] : {std::pair{"1", true},
                                       {"0", false},
                                       {"on", true},
                                       {"off", false},
                                       {"true", true},
                                       {"false", false}}) {
    const ProbeScene s(probe_call(fmt::format("\"flag\" {0}, \"count\" {0}", text)));
    EXPECT_SILENT(s);
    EXPECT_EQ(s.params().flag, expected) << text;
    EXPECT_EQ(s.params().count, expected ? 1 : 0) << text;
  }
}

TEST(Parameters, ColoursTakeOneThreeOrFourNumbers) {
  expect_color(ProbeScene(probe_call("\"tint\" .25")).params().tint, .25f, .25f, .25f, 1);
  expect_color(ProbeScene(probe_call("\"tint\" .1 .2 .3")).params().tint, .1f, .2f, .3f, 1);
  expect_color(ProbeScene(probe_call("\"tint\" .1 .2 .3 0")).params().tint, .1f, .2f, .3f, 0);
}

TEST(Parameters, NullLeavesTheDefault) {
  const ProbeScene s(probe_call("\"count_seven\" null, \"tint_warm\" null, \"other\" null"));
  EXPECT_SILENT(s);
  EXPECT_EQ(s.params().count_seven, 7);
  expect_color(s.params().tint_warm, .9f, .6f, .3f, 1);
  EXPECT_EQ(s.params().other.node, nullptr);
}

TEST(Parameters, LastOfTwoValuesWins) {
  EXPECT_EQ(ProbeScene(probe_call("\"count\" 1, \"count\" 2")).params().count, 2);
}

TEST(Parameters, AliasesReachTheSameParameter) {
  EXPECT_EQ(ProbeScene(probe_call("\"quantity\" 4")).params().amount, 4);
  // The spellings in the text of the manual and in the declaration.
  const testing::PreparedScene s(testing::scene_text(
      "material \"m\" \"mia_material_x\" ( \"refl_samples\" 3, \"refr_samples\" 5, "
      "\"refr_trans_w\" .25 ) end material"));
  EXPECT_SILENT(s);
  const ShaderNode* node = s.material("m")->surface.back();
  for (const auto& [name, expected] : {std::pair{"refl_gloss_samples", 3.0f},
                                       {"refr_gloss_samples", 5},
                                       {"refr_trans_weight", .25f}}) {
    for (const ParamSpec& row : node->spec().params) {
      if (std::string_view(row.name) != name) continue;
      const auto* at = &node->constants<std::byte>() + row.offset;
      const float value = row.type == ParamType::Integer
                              ? static_cast<float>(*reinterpret_cast<const int*>(at))
                              : *reinterpret_cast<const float*>(at);
      EXPECT_EQ(value, expected) << name;
    }
  }
}

TEST(Parameters, UnknownNamesAreSkippedWithTheNearestName) {
  const ProbeScene s(probe_call("\"amuont\" 3,\n\"count\" 2,\n\"quux_something\" 1"));
  std::vector<Diagnostic> found;
  for (const Diagnostic& d : s.diagnostics.all())
    if (d.code == "OR-RT-010") found.push_back(d);
  ASSERT_EQ(found.size(), 2u) << s.messages();
  EXPECT_NE(found[0].hint.find("\"amount\""), std::string::npos) << found[0].hint;
  EXPECT_EQ(found[1].where.line, found[0].where.line + 2);
  EXPECT_GT(found[0].where.column, 0u);
  EXPECT_EQ(s.params().count, 2);
  EXPECT_EQ(s.params().amount, 0);
}

TEST(Parameters, WrongTypesAreReportedWithTheirLineAndSkipped) {
  for (const char* argument :
       {"\"amount_half\" \"text\"", "\"amount_half\" 1 2", "\"count_seven\" [ 1 ]",
        "\"tint_warm\" 1 2", "\"tint_warm\" 1 2 3 4 5", "\"tint_warm\" on", "\"flag_on\" \"off?\"",
        "\"place\" 1 2 3 4", "\"matrix\" 1 2 3", "\"amount_half\" { \"a\" 1 }", "\"weights\" 3 4",
        "\"lights\" [ 1, 2 ]"}) {
    const ProbeScene s(probe_call(fmt::format("\n\n{}", argument)));
    const Diagnostic* message = s.only("OR-RT-011");
    if (!message) {
      EXPECT_GT(s.diagnostics.count(Severity::Warning), 0u) << argument << s.messages();
    } else {
      EXPECT_GE(message->where.line, 4u) << argument;
    }
    const ProbeParams p = s.params();
    EXPECT_EQ(p.amount_half, 0.5f) << argument;
    EXPECT_EQ(p.count_seven, 7) << argument;
    EXPECT_TRUE(p.flag_on) << argument;
    expect_color(p.tint_warm, .9f, .6f, .3f, 1);
    EXPECT_EQ(p.place, Vec3(0)) << argument;
    EXPECT_EQ(p.matrix, Mat4()) << argument;
    EXPECT_EQ(p.lights.size, 0) << argument;
  }
}

TEST(Parameters, ArraysOfLightsTakeInstancesAndGroupsOfThem) {
  const ProbeScene s(
      probe_call("\"lights\" [ \"c_inst\", \"pair_inst\", \"nobody\" ], \"lamp\" \"b_inst\"",
                 "light \"a\" \"mib_light_point\" ( ) origin 0 0 0 end light\n"
                 "instance \"a_inst\" \"a\" end instance\n"
                 "instance \"b_inst\" \"a\" end instance\n"
                 "instance \"c_inst\" \"a\" end instance\n"
                 "instgroup \"pair\" \"a_inst\" \"b_inst\" end instgroup\n"
                 "instance \"pair_inst\" \"pair\" end instance"),
      "\"pair_inst\" \"c_inst\"");
  ASSERT_EQ(s.world->lights.size(), 3u);
  const ProbeParams p = s.params();
  ASSERT_EQ(p.lights.size, 3);
  std::vector<std::string> names;
  for (const LightRef& l : p.lights)
    names.push_back(s.world->lights[static_cast<std::size_t>(l.index)].name);
  EXPECT_EQ(names, (std::vector<std::string>{"c_inst", "a_inst", "b_inst"}));
  EXPECT_EQ(s.world->lights[static_cast<std::size_t>(p.lamp.index)].name, "b_inst");
  ASSERT_NE(s.only("OR-RT-015"), nullptr) << s.messages();
  EXPECT_NE(s.only("OR-RT-015")->message.find("nobody"), std::string::npos);
}

TEST(Parameters, UnknownShadersBecomeAVisibleFallback) {
  const ProbeScene s(
      "material \"m\" \"mia_materiel_x\" ( \"diffuse\" 1 1 1 ) end material\n"
      "material \"n\" \"mia_materiel_x\" ( ) end material");
  ASSERT_NE(s.only("OR-RT-001"), nullptr) << s.messages();
  EXPECT_NE(s.only("OR-RT-001")->hint.find("mia_material_x"), std::string::npos);
  ShadingPoint point;
  Closure closure;
  shade(*s.material("m"), point, closure);
  ASSERT_EQ(closure.count, 1);
  EXPECT_GT(closure.lobes[0].weight.x, 4 * closure.lobes[0].weight.y);
  EXPECT_EQ(s.report.binding.missing_shaders, (std::vector<std::string>{"mia_materiel_x"}));
}

TEST(Parameters, GeneratedDeclarationsReadBackSilentlyAndTheSame) {
  for (const std::string& library : builtin_packages()) {
    Diagnostics diagnostics;
    const scene::Scene scene =
        mi::read_text(mi_declarations(builtin_shaders(), library), {}, diagnostics);
    EXPECT_TRUE(diagnostics.all().empty())
        << library << ": "
        << (diagnostics.all().empty() ? "" : diagnostics.format(diagnostics.all()[0]));
    for (const ShaderSpec* spec : builtin_shaders().all()) {
      if (library != spec->library) continue;
      const scene::ShaderDeclaration* d = scene.find_declaration(spec->name);
      ASSERT_NE(d, nullptr) << spec->name;
      ASSERT_EQ(d->parameters.size(), spec->params.size()) << spec->name;
      EXPECT_EQ(d->results.size(), std::max<std::size_t>(1, spec->results.size())) << spec->name;
      for (std::size_t i = 0; i < spec->params.size(); ++i) {
        const ParamSpec& row = spec->params[i];
        const scene::ParamDecl& read = d->parameters[i];
        EXPECT_EQ(read.name, row.name) << spec->name;
        EXPECT_EQ(read.type, row.type) << spec->name << '.' << row.name;
        if (row.type == ParamType::Array) {
          ASSERT_EQ(read.members.size(), 1u);
          EXPECT_EQ(read.members[0].type, row.element) << spec->name << '.' << row.name;
        }
        const bool has_value = row.type == ParamType::Boolean || row.type == ParamType::Integer ||
                               row.type == ParamType::Scalar || row.type == ParamType::Color ||
                               row.type == ParamType::Vector;
        EXPECT_EQ(read.default_value.has_value(), has_value && row.declared_default)
            << spec->name << '.' << row.name;
        if (!read.default_value) continue;
        if (read.default_value->kind == scene::Value::Kind::Boolean) {
          EXPECT_EQ(read.default_value->boolean, row.fallback[0] != 0) << row.name;
        } else {
          for (std::size_t k = 0; k < read.default_value->numbers.size() && k < 3; ++k)
            EXPECT_EQ(static_cast<float>(read.default_value->numbers[k]), row.fallback[k])
                << spec->name << '.' << row.name;
        }
      }
    }
  }
}

}  // namespace parameters_test
}  // namespace oriel
