// SPDX-License-Identifier: Apache-2.0
// Shader connections: results and members, promotions, chains, cycles, phenomena.
#include <fmt/format.h>

#include <chrono>

#include "probe.h"

namespace oriel {
namespace connections_test {

#define EXPECT_SILENT(s) EXPECT_TRUE((s).diagnostics.all().empty()) << (s).messages()

constexpr std::string_view kSources =
    "shader \"col\" \"probe\" ( \"tint\" .1 .2 .6 .5 )\n"
    "shader \"sca\" \"probe_scalar\" ( \"amount\" .75 )\n"
    "shader \"vec\" \"probe_vector\" ( \"place\" 1 2 3 )\n"
    "shader \"many\" \"probe_many\" ( )\n"
    "shader \"a.b\" \"probe_scalar\" ( \"amount\" 9 )\n";

TEST(Connections, ValuesArePromotedBetweenScalarColourAndVector) {
  const ProbeScene same(
      probe_call("\"tint\" = \"col\", \"amount\" = \"sca\", \"place\" = \"vec\"", kSources));
  EXPECT_SILENT(same);
  expect_color(same.params().tint, .1f, .2f, .6f, .5f);
  EXPECT_FLOAT_EQ(same.params().amount, .75f);
  EXPECT_EQ(same.params().place, Vec3(1, 2, 3));

  const ProbeScene crossed(probe_call(
      "\"tint\" = \"sca\", \"amount\" = \"col\", \"place\" = \"col\", \"flag\" = \"sca\", "
      "\"count\" = \"vec\"",
      kSources));
  EXPECT_SILENT(crossed);
  expect_color(crossed.params().tint, .75f, .75f, .75f, 1);
  EXPECT_FLOAT_EQ(crossed.params().amount, .3f);
  EXPECT_EQ(crossed.params().place, Vec3(.1f, .2f, .6f));
  EXPECT_TRUE(crossed.params().flag);
  EXPECT_EQ(crossed.params().count, 2);

  const ProbeScene rest(probe_call("\"tint\" = \"vec\", \"place\" = \"sca\"", kSources));
  expect_color(rest.params().tint, 1, 2, 3, 1);
  EXPECT_EQ(rest.params().place, Vec3(.75f));
}

TEST(Connections, MembersOfAStructAreReachedByName) {
  const ProbeScene s(
      probe_call("\"tint\" = \"many.out_color\", \"amount\" = \"many.out_alpha\", "
                 "\"place\" = \"many.out_normal\", \"tint_warm\" = \"many\"",
                 kSources));
  EXPECT_SILENT(s);
  expect_color(s.params().tint, .1f, .2f, .3f, .4f);
  EXPECT_FLOAT_EQ(s.params().amount, .75f);
  EXPECT_EQ(s.params().place, Vec3(1, 2, 3));
  expect_color(s.params().tint_warm, .1f, .2f, .3f, .4f);
}

TEST(Connections, NamesMayContainDotsAndSingleResultsAnyMember) {
  const ProbeScene s(
      probe_call("\"amount\" = \"a.b\", \"amount_half\" = \"a.b.outValue\", "
                 "\"tint\" = \"col.outColor\"",
                 kSources));
  EXPECT_SILENT(s);
  EXPECT_EQ(s.params().amount, 9);
  EXPECT_EQ(s.params().amount_half, 9);
  expect_color(s.params().tint, .1f, .2f, .6f, .5f);
}

TEST(Connections, UnknownMembersAndShadersAreReportedWithANearName) {
  const ProbeScene member(probe_call("\"amount\" = \"many.out_alpa\"", kSources));
  ASSERT_NE(member.only("OR-RT-006"), nullptr) << member.messages();
  EXPECT_NE(member.only("OR-RT-006")->hint.find("out_alpha"), std::string::npos);
  const ProbeScene shader(probe_call("\"amount_half\" = \"manyy.out_alpha\"", kSources));
  EXPECT_NE(shader.only("OR-RT-005"), nullptr) << shader.messages();
  EXPECT_EQ(shader.params().amount_half, 0.5f);
}

TEST(Connections, ChainsAreEvaluatedToTheEnd) {
  std::string text = "shader \"n0\" \"probe\" ( \"tint\" .3 .4 .5 )\n";
  for (int i = 1; i <= 50; ++i)
    text += fmt::format("shader \"n{}\" \"probe\" ( \"tint\" = \"n{}\" )\n", i, i - 1);
  const ProbeScene s(probe_call("\"tint\" = \"n50\"", text));
  EXPECT_SILENT(s);
  expect_color(s.params().tint, .3f, .4f, .5f, 1);
}

TEST(Connections, OrderOfDefinitionDoesNotMatter) {
  const ProbeScene s(probe_call("\"tint\" = \"late\"") +
                     "shader \"late\" \"probe\" ( \"tint\" = \"later\" )\n"
                     "shader \"later\" \"probe\" ( \"tint\" .3 .4 .5 )\n");
  expect_color(s.params().tint, .3f, .4f, .5f, 1);
}

TEST(Connections, CyclesAreReportedAndEnd) {
  const ProbeScene own(probe_call("\"tint\" = \"x\"",
                                  "shader \"x\" \"probe\" ( \"tint\" = \"x\", \"amount\" 1 )\n"));
  EXPECT_TRUE(own.diagnostics.has("OR-RT-004")) << own.messages();
  own.params();
  const ProbeScene round(probe_call("\"tint\" = \"x\"",
                                    "shader \"x\" \"probe\" ( \"tint\" = \"y\" )\n"
                                    "shader \"y\" \"probe\" ( \"tint\" = \"z\" )\n"
                                    "shader \"z\" \"probe\" ( \"tint\" = \"x\" )\n"));
  EXPECT_TRUE(round.diagnostics.has("OR-RT-004")) << round.messages();
  expect_color(round.params().tint, 0, 0, 0, 1);
}

TEST(Connections, GraphsThatDoubleWithEachLayerAreCutOff) {
  std::string text = "shader \"a0\" \"probe\" ( ) shader \"b0\" \"probe\" ( )\n";
  for (int i = 1; i <= 60; ++i)
    for (const char* name : {"a", "b"})
      text += fmt::format(
          "shader \"{0}{1}\" \"probe\" ( \"tint\" = \"a{2}\", \"amount\" = \"b{2}\", "
          "\"tint_warm\" = \"a{2}\" )\n",
          name, i, i - 1);
  const auto start = std::chrono::steady_clock::now();
  const ProbeScene s(probe_call("\"tint\" = \"a60\"", text));
  EXPECT_TRUE(s.diagnostics.has("OR-RT-007")) << s.messages();
  s.params();
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

TEST(Connections, TexturesThatDoubleWithEachLayerAreCutOff) {
  std::string text = "color texture \"t0\" [1 1 3] 'ffffff'\n";
  for (int i = 1; i <= 60; ++i)
    text += fmt::format(
        "color texture \"t{0}\" \"mib_texture_lookup\" ( \"tex\" \"t{1}\", \"coord\" = shader "
        "\"c{0}\" \"mib_texture_lookup\" ( \"tex\" \"t{1}\", \"coord\" .5 .5 0 ) )\n",
        i, i - 1);
  const auto start = std::chrono::steady_clock::now();
  const ProbeScene s(probe_call(
      "\"tint\" = \"all\"",
      text + "shader \"all\" \"mib_texture_lookup\" ( \"tex\" \"t60\", \"coord\" .5 .5 0 )\n"));
  EXPECT_TRUE(s.diagnostics.has("OR-RT-007")) << s.messages();
  s.params();
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

TEST(Connections, ShadersWithoutAValueAreRefused) {
  const ProbeScene s(probe_call("\"tint_warm\" = \"lit\"",
                                "shader \"lit\" \"mib_light_point\" ( \"color\" 1 1 1 )\n"));
  EXPECT_NE(s.only("OR-RT-012"), nullptr) << s.messages();
  expect_color(s.params().tint_warm, .9f, .6f, .3f, 1);
}

constexpr std::string_view kPhenomenon =
    "declare phenomenon color \"phen\" ( color \"main\" default .2 .3 .4, scalar \"gain\" default "
    "5,\n"
    " struct \"st\" { scalar \"inner\", color \"shade\" }, shader \"sh\" )\n"
    " shader \"leaf\" \"probe\" ( \"tint\" = interface \"main\" )\n"
    " root \"probe\" ( \"tint\" = \"leaf\", \"amount\" = interface \"gain\",\n"
    "   \"amount_half\" = interface \"st.inner\", \"tint_warm\" = interface \"st.shade\" )\n"
    "end declare\n";

TEST(Phenomena, InterfaceValuesAndDeclaredDefaultsReachTheShadersInside) {
  const ProbeScene s(
      std::string(kPhenomenon) +
          "material \"m\" \"phen\" ( \"main\" 1 2 3 ) end material\n"
          "material \"n\" \"phen\" ( \"gain\" 8, \"st\" { \"inner\" .125 } ) end material\n"
          "object \"o2\" visible tagged group 0 0 0 1 0 0 0 1 0 v 0 v 1 v 2 p 0 0 1 2 "
          "end group end object instance \"o2i\" \"o2\" material [ \"n\" ] end instance",
      "\"o2i\"");
  EXPECT_SILENT(s);
  const ProbeParams m = s.params("m"), n = s.params("n");
  expect_color(m.tint, 1, 2, 3, 1);
  EXPECT_EQ(m.amount, 5);
  EXPECT_EQ(m.amount_half, 0.5f);
  // The second use has a leaf of its own.
  expect_color(n.tint, .2f, .3f, .4f, 1);
  EXPECT_EQ(n.amount, 8);
  EXPECT_EQ(n.amount_half, 0.125f);
  expect_color(n.tint_warm, .9f, .6f, .3f, 1);
}

TEST(Phenomena, InterfaceParametersMayBeConnectedOutside) {
  const ProbeScene s(
      std::string(kPhenomenon) + std::string(kSources) +
      "material \"m\" \"phen\" ( \"main\" = \"col\", \"gain\" = \"many.out_alpha\" ) "
      "end material");
  EXPECT_SILENT(s);
  expect_color(s.params().tint, .1f, .2f, .6f, .5f);
  EXPECT_EQ(s.params().amount, .75f);
}

TEST(Phenomena, NestedOnesPassValuesThroughEachLevel) {
  const ProbeScene s(std::string(kPhenomenon) +
                     "declare phenomenon color \"outer\" ( color \"c\", scalar \"g\" default 3 )\n"
                     " shader \"leaf\" \"probe\" ( \"tint\" .5 .5 .5 )\n"
                     " shader \"in\" \"phen\" ( \"main\" = interface \"c\", \"gain\" = interface "
                     "\"g\" )\n"
                     " root \"probe\" ( \"tint\" = \"in\", \"tint_warm\" = \"leaf\" ) end declare\n"
                     "material \"m\" \"outer\" ( \"c\" 7 8 9 ) end material");
  EXPECT_SILENT(s);
  expect_color(s.params().tint, 7, 8, 9, 1);
  expect_color(s.params().tint_warm, .5f, .5f, .5f, 1);
}

TEST(Phenomena, AShaderListMayTakeItsShaderFromAParameter) {
  const ProbeScene s(
      "declare phenomenon color \"pass\" ( shader \"sh\", shader \"unset\" )\n"
      " root = interface \"sh\" end declare\n" +
      std::string(kSources) + "material \"m\" \"pass\" ( \"sh\" \"col\" ) end material");
  EXPECT_SILENT(s);
  expect_color(s.params().tint, .1f, .2f, .6f, .5f);
}

TEST(Phenomena, RootMaterialsContributeAllSlots) {
  const ProbeScene s(
      "declare phenomenon material \"mat\" ( color \"c\" default .5 .5 .5, scalar \"t\" )\n"
      " shader \"surf\" \"mia_material\" ( \"diffuse\" = interface \"c\", \"transparency\" = "
      "interface \"t\" )\n"
      " shader \"sky\" \"probe\" ( \"tint\" = interface \"c\" )\n"
      " material \"inner\" = \"surf\" shadow = \"surf\" environment = \"sky\" end material\n"
      " root material \"inner\" end declare\n"
      "shader \"use\" \"mat\" ( \"c\" 1 0 0, \"t\" .5 )\n"
      "material \"m\" = \"use\" end material\n"
      "material \"n\" \"mat\" ( ) end material\n"
      "object \"o2\" visible tagged group 0 0 0 1 0 0 0 1 0 v 0 v 1 v 2 p 0 0 1 2 "
      "end group end object instance \"o2i\" \"o2\" material [ \"n\" ] end instance",
      "\"o2i\"");
  EXPECT_SILENT(s);
  const Material *m = s.material("m"), *n = s.material("n");
  ASSERT_TRUE(m && n);
  EXPECT_TRUE(m->has_shadow_shader);
  EXPECT_TRUE(m->may_transmit);
  EXPECT_FALSE(n->may_transmit);
  ASSERT_EQ(m->environment.size(), 1u);
  ShadingPoint point;
  expect_color(m->environment[0]->color(point), 1, 0, 0, 1);
  expect_color(n->environment[0]->color(point), .5f, .5f, .5f, 1);
}

TEST(Phenomena, TexturesInsideBelongToEachUse) {
  const ProbeScene s(
      "declare phenomenon color \"tex\" ( color \"c\" )\n"
      " shader \"flat\" \"probe\" ( \"tint\" = interface \"c\" )\n"
      " root \"mib_texture_lookup\" ( \"tex\" \"flat\", \"coord\" .5 .5 0 ) end declare\n"
      "material \"m\" \"tex\" ( \"c\" 1 0 0 ) end material\n"
      "material \"n\" \"tex\" ( \"c\" 0 1 0 ) end material\n"
      "object \"o2\" visible tagged group 0 0 0 1 0 0 0 1 0 v 0 v 1 v 2 p 0 0 1 2 "
      "end group end object instance \"o2i\" \"o2\" material [ \"n\" ] end instance",
      "\"o2i\"");
  EXPECT_SILENT(s);
  ShadingPoint point;
  ASSERT_TRUE(s.node("m") && s.node("n"));
  expect_color(s.node("m")->color(point), 1, 0, 0, 1);
  expect_color(s.node("n")->color(point), 0, 1, 0, 1);
}

TEST(Phenomena, CyclesInsideAreReportedAndEnd) {
  const ProbeScene inner(
      "declare phenomenon color \"loop\" ( )\n"
      " shader \"x\" \"probe\" ( \"tint\" = \"y\" ) shader \"y\" \"probe\" ( \"tint\" = \"x\" )\n"
      " root = \"x\" end declare\nmaterial \"m\" \"loop\" ( ) end material");
  EXPECT_TRUE(inner.diagnostics.has("OR-RT-004")) << inner.messages();
  const ProbeScene twice(
      "declare phenomenon color \"self\" ( )\n"
      " root \"probe\" ( \"tint\" = \"a\", \"amount\" = \"b\" )\n"
      " shader \"a\" \"self\" ( ) shader \"b\" \"self\" ( ) end declare\n"
      "material \"m\" \"self\" ( ) end material");
  EXPECT_TRUE(twice.diagnostics.has("OR-RT-004")) << twice.messages();
}

TEST(Phenomena, MissingRootShowsTheFallback) {
  const ProbeScene s(
      "declare phenomenon color \"empty\" ( ) shader \"x\" \"probe\" ( ) end declare\n"
      "material \"m\" \"empty\" ( ) end material");
  EXPECT_NE(s.only("OR-RT-002"), nullptr) << s.messages();
  ASSERT_NE(s.node(), nullptr);
}

TEST(Phenomena, InterfaceOutsideIsReported) {
  const ProbeScene s(probe_call("\"amount_half\" = interface \"g\""));
  EXPECT_NE(s.only("OR-RT-013"), nullptr) << s.messages();
  EXPECT_EQ(s.params().amount_half, 0.5f);
}

}  // namespace connections_test
}  // namespace oriel
