// SPDX-License-Identifier: Apache-2.0
#include "scene/flags.h"

#include "scene/element_settings.h"

#include <gtest/gtest.h>

namespace oriel::scene {
namespace flags_test {

Statement flag(std::string keyword) {
  Statement s;
  s.keyword = std::move(keyword);
  return s;
}
Statement flag(std::string keyword, bool on) {
  Statement s = flag(std::move(keyword));
  s.values.emplace_back();
  s.values[0].kind = Value::Kind::Boolean;
  s.values[0].boolean = on;
  return s;
}
Statement flag(std::string keyword, int bits) {
  Statement s = flag(std::move(keyword));
  s.values.emplace_back();
  s.values[0].kind = Value::Kind::Numbers;
  s.values[0].numbers = {static_cast<double>(bits)};
  return s;
}
Statement flag(std::string keyword, const char* word) {
  Statement s = flag(std::move(keyword));
  s.values.emplace_back();
  s.values[0].kind = Value::Kind::Text;
  s.values[0].text = word;
  return s;
}

using Flags = std::vector<Statement>;

ResolvedFlags resolve_flags(const Object& object, std::span<const Instance* const> chain,
                            Diagnostics& diagnostics) {
  FlagLayer instances;
  for (const Instance* i : chain)
    instances = overlay(instances, settings_of(*i, &diagnostics).flags);
  return resolve(settings_of(object, &diagnostics).flags, instances);
}

/// Flags of an object below instances, which are listed outermost first.
ResolvedFlags resolved(Flags object, std::vector<Flags> instances = {}) {
  Object o;
  o.flags = std::move(object);
  std::vector<Instance> chain(instances.size());
  std::vector<const Instance*> pointers;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    chain[i].flags = std::move(instances[i]);
    pointers.push_back(&chain[i]);
  }
  Diagnostics d;
  const ResolvedFlags r = resolve_flags(o, pointers, d);
  EXPECT_TRUE(d.all().empty());
  return r;
}

TEST(Flags, BareKeywordsMeanOn) {
  const ResolvedFlags r = resolved({flag("visible"), flag("shadow"), flag("trace")});
  EXPECT_TRUE(r.visible && r.casts_shadow && r.receives_shadow);
  EXPECT_EQ(r.reflection, (RayFlags{true, true}));
  EXPECT_FALSE(r.assumed_on);
}

TEST(Flags, ObjectWithoutFlagsIsAssumedOn) {
  const ResolvedFlags r = resolved({flag("tagged")}, {{flag("caustic", 3)}});
  EXPECT_TRUE(r.assumed_on && r.visible && r.casts_shadow);
  EXPECT_TRUE(r.reflection.seen && r.finalgather.seen);
}

TEST(Flags, UnwrittenFlagsAreOffButReceive) {
  const ResolvedFlags r = resolved({flag("visible")});
  EXPECT_TRUE(r.visible);
  EXPECT_FALSE(r.casts_shadow);
  EXPECT_TRUE(r.receives_shadow);
  EXPECT_EQ(r.reflection, (RayFlags{false, true}));
  EXPECT_EQ(r.transparency, (RayFlags{true, true}));
}

TEST(ObjectFlags, ShadowBitsCastAndReceive) {
  struct Row {
    Statement statement;
    bool casts, receives;
  };
  for (const Row& row : {Row{flag("shadow", true), true, true},
                         {flag("shadow", false), false, true},
                         {flag("shadow", 0), false, false},
                         {flag("shadow", 1), true, false},
                         {flag("shadow", 2), false, true},
                         {flag("shadow", 3), true, true}}) {
    const ResolvedFlags r = resolved({row.statement});
    EXPECT_EQ(r.casts_shadow, row.casts);
    EXPECT_EQ(r.receives_shadow, row.receives);
  }
}

TEST(ObjectFlags, TraceSetsReflectionRefractionAndGathering) {
  const ResolvedFlags off = resolved({flag("trace", false)});
  for (const RayFlags& f : {off.reflection, off.refraction, off.finalgather})
    EXPECT_EQ(f, (RayFlags{false, true}));
  EXPECT_EQ(off.transparency, (RayFlags{true, true}));
  EXPECT_EQ(resolved({flag("trace"), flag("reflection", 1)}).reflection, (RayFlags{true, false}));
  EXPECT_EQ(resolved({flag("trace"), flag("refraction", 2)}).refraction, (RayFlags{false, true}));
  EXPECT_EQ(resolved({flag("transparency", 0)}).transparency, (RayFlags{false, false}));
  EXPECT_EQ(resolved({flag("trace"), flag("finalgather", false)}).finalgather,
            (RayFlags{false, true}));
}

TEST(ObjectFlags, PhotonBooleanAndIntegerAreBothMeaningful) {
  EXPECT_EQ(resolved({}).caustic, (PhotonFlags{false, true, true}));
  EXPECT_EQ(resolved({flag("caustic", true), flag("caustic", 1)}).caustic,
            (PhotonFlags{false, true, false}));
  EXPECT_EQ(resolved({flag("caustic", 2), flag("caustic", true)}).caustic,
            (PhotonFlags{false, false, true}));
  EXPECT_EQ(resolved({flag("globillum", false), flag("globillum", 3)}).globillum,
            (PhotonFlags{true, true, true}));
}

TEST(InstanceFlags, FourBitsSwitchOnAndOff) {
  const auto shadow = [](int bits) {
    const ResolvedFlags r = resolved({flag("shadow", 1)}, {{flag("shadow", bits)}});
    return std::pair(r.casts_shadow, r.receives_shadow);
  };
  EXPECT_EQ(shadow(0), std::pair(true, false));  // nothing overridden
  EXPECT_EQ(shadow(2), std::pair(true, true));   // receive on
  EXPECT_EQ(shadow(3), std::pair(true, true));
  EXPECT_EQ(shadow(4), std::pair(false, false));  // cast off
  EXPECT_EQ(shadow(6), std::pair(false, true));
  EXPECT_EQ(shadow(12), std::pair(false, false));
  const ResolvedFlags off = resolved({flag("shadow", 1)}, {{flag("shadow", false)}});
  EXPECT_FALSE(off.casts_shadow);
  EXPECT_TRUE(off.receives_shadow);
}

TEST(InstanceFlags, TraceOffDisablesSending) {
  const ResolvedFlags r = resolved({flag("trace")}, {{flag("trace", false)}});
  for (const RayFlags& f : {r.reflection, r.refraction, r.finalgather})
    EXPECT_EQ(f, (RayFlags{false, false}));
}

TEST(InstanceFlags, LowerOverridesHigherAndBothOverrideTheObject) {
  EXPECT_FALSE(resolved({flag("visible")}, {{flag("visible", false)}}).visible);
  EXPECT_TRUE(
      resolved({flag("visible", false)}, {{flag("visible", false)}, {flag("visible")}}).visible);
  EXPECT_FALSE(resolved({}, {{flag("visible")}, {flag("visible", false)}}).visible);
  const ResolvedFlags r = resolved(
      {flag("visible")}, {{flag("caustic", true), flag("caustic", 4)}, {flag("caustic", 1)}});
  EXPECT_EQ(r.caustic, (PhotonFlags{false, true, true}));
}

TEST(ObjectFlags, OptionsHaveLowestPriority) {
  const FlagLayer options = photon_flags(8, 4);
  EXPECT_EQ(resolve(options, {}).caustic, (PhotonFlags{false, true, false}));
  EXPECT_EQ(resolve(options, {}).globillum, (PhotonFlags{false, false, true}));
  Object o;
  o.flags = {flag("caustic", 2), flag("globillum", 1)};
  Diagnostics d;
  const ResolvedFlags r = resolve(overlay(options, settings_of(o, &d).flags), {});
  EXPECT_EQ(r.caustic, (PhotonFlags{false, false, true}));
  EXPECT_EQ(r.globillum, (PhotonFlags{false, true, false}));
  EXPECT_EQ(photon_flags(std::nullopt, std::nullopt), FlagLayer{});
}

TEST(InstanceFlags, HideOfAnyInstanceHides) {
  EXPECT_TRUE(resolved({}, {{flag("hide", true)}, {flag("hide", false)}}).hidden);
  EXPECT_FALSE(resolved({}, {{flag("hide", false)}}).hidden);
}

TEST(InstanceFlags, NearestFaceApplies) {
  EXPECT_FALSE(resolved({}).face.has_value());
  EXPECT_EQ(resolved({flag("face", "back")}).face, Face::Back);
  EXPECT_EQ(resolved({flag("face", "back")}, {{flag("face both")}, {flag("face", "front")}}).face,
            Face::Front);
}

TEST(Flags, ValuesThatDoNotFitAreReportedAndSkipped) {
  Object o;
  o.flags = {flag("visible"), flag("visible", "yes"), flag("shadow", 99), flag("face", "up")};
  Diagnostics d;
  EXPECT_TRUE(resolve_flags(o, {}, d).visible);
  ASSERT_EQ(d.all().size(), 3u);
  EXPECT_EQ(d.all()[0].code, "OR-SC-201");
  EXPECT_EQ(d.all()[2].hint, "expected: face front|back|both");
}

}  // namespace flags_test
}  // namespace oriel::scene
