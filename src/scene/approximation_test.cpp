// SPDX-License-Identifier: Apache-2.0
#include "scene/approximation.h"

#include <gtest/gtest.h>

#include "scene/elements.h"

namespace oriel::scene {
namespace approximation_test {

using Kind = Approximation::Kind;
using Technique = Approximation::Technique;

Value word(std::string text) {
  Value v;
  v.kind = Value::Kind::Text;
  v.text = std::move(text);
  v.bare = true;
  return v;
}
Value name(std::string text) {
  Value v = word(std::move(text));
  v.bare = false;
  return v;
}
Value row(std::vector<double> numbers) {
  Value v;
  v.kind = Value::Kind::Numbers;
  v.numbers = std::move(numbers);
  return v;
}
Statement approximate(std::vector<Value> values, std::string keyword = "approximate") {
  return {std::move(keyword), false, std::move(values), {}};
}
Approximation read(std::vector<Value> values) {
  return approximation_of(approximate(std::move(values))).value_or(Approximation{});
}

TEST(Approximation, ParametricTakesBothDirectionsThenLimits) {
  const Approximation one = read({word("surface"), word("parametric"), row({3}), name("s")});
  EXPECT_EQ(one.kind, Kind::Surface);
  EXPECT_EQ(one.technique, Technique::Parametric);
  EXPECT_EQ(one.u, 3);
  EXPECT_EQ(one.v, 3);
  EXPECT_EQ(one.names, std::vector<std::string>{"s"});

  const Approximation two = read({word("surface"), word("parametric"), row({3, 4.5})});
  EXPECT_EQ(two.u, 3);
  EXPECT_EQ(two.v, 4.5f);

  const Approximation four = read({word("surface"), word("parametric"), row({3, 4, 1, 2})});
  EXPECT_EQ(four.v, 4);
  EXPECT_EQ(four.min_subdivisions, 1);
  EXPECT_EQ(four.max_subdivisions, 2);

  const Approximation curve = read({word("curve"), word("parametric"), row({3, 1, 2})});
  EXPECT_EQ(curve.u, 3);
  EXPECT_EQ(curve.min_subdivisions, 1);
  EXPECT_EQ(curve.max_subdivisions, 2);
}

TEST(Approximation, RegularMayBeInPercent) {
  const Approximation plain =
      read({word("surface"), word("regular"), word("parametric"), row({10, 20})});
  EXPECT_EQ(plain.technique, Technique::Regular);
  EXPECT_FALSE(plain.percent);
  EXPECT_EQ(plain.v, 20);
  const Approximation percent = read({word("surface"), word("regular"), word("parametric"),
                                      row({50}), word("%"), row({25}), word("%"), name("s")});
  EXPECT_TRUE(percent.percent);
  EXPECT_EQ(percent.u, 50);
  EXPECT_EQ(percent.v, 25);
  EXPECT_EQ(percent.names.size(), 1u);
}

TEST(Approximation, SpatialAndCurvatureAreCriteria) {
  const Approximation spatial =
      read({word("trim"), word("spatial"), word("view"), row({.5}), row({1, 4}), name("s")});
  EXPECT_EQ(spatial.kind, Kind::Trim);
  EXPECT_EQ(spatial.technique, Technique::Criteria);
  EXPECT_TRUE(spatial.view);
  EXPECT_EQ(spatial.length, .5f);
  EXPECT_EQ(spatial.min_subdivisions, 1);
  EXPECT_EQ(spatial.max_subdivisions, 4);

  const Approximation curvature = read({word("surface"), word("curvature"), row({.1, 30, 0, 6})});
  EXPECT_EQ(curvature.distance, .1f);
  EXPECT_NEAR(curvature.angle, kPi / 6, 1e-6f);
  EXPECT_EQ(curvature.max_subdivisions, 6);
}

TEST(Approximation, LengthDistanceAndAngleCombine) {
  const Approximation a =
      read({word("subdivision"), word("surface"), word("any"), word("delaunay"), word("grading"),
            row({4}), word("length"), row({2}), word("distance"), row({.5}), word("angle"),
            row({90, 0, 6}), word("max"), row({5000}), word("samples"), row({8})});
  EXPECT_EQ(a.kind, Kind::Subdivision);
  EXPECT_EQ(a.style, Approximation::Style::Delaunay);
  EXPECT_TRUE(a.any);
  EXPECT_EQ(a.grading, 4);
  EXPECT_EQ(a.length, 2);
  EXPECT_EQ(a.distance, .5f);
  EXPECT_NEAR(a.angle, kPi / 2, 1e-6f);
  EXPECT_EQ(a.max_subdivisions, 6);
  EXPECT_EQ(a.max_triangles, 5000);
  EXPECT_EQ(a.samples, 8);
}

// As a host application writes it after a trilist.
TEST(Approximation, FineViewLengthIsRead) {
  const Approximation a =
      read({word("view"), word("fine"), word("shared"), word("length"), row({2}), word("distance"),
            row({0}), word("angle"), row({0, 0, 6})});
  EXPECT_EQ(a.kind, Kind::Polygon);
  EXPECT_EQ(a.style, Approximation::Style::Fine);
  EXPECT_TRUE(a.view);
  EXPECT_EQ(a.length, 2);
  EXPECT_EQ(a.distance, 0);
  EXPECT_EQ(a.max_subdivisions, 6);
  EXPECT_EQ(read({word("fine"), word("length"), row({1})}).max_subdivisions, 7);
}

TEST(Approximation, InvalidValuesAreIgnored) {
  EXPECT_FALSE(approximation_of(approximate({})));
  EXPECT_FALSE(approximation_of(approximate({word("surface"), name("s")})));
  const Approximation a = read({word("surface"), word("length"), row({-1, -5, 1e30})});
  EXPECT_EQ(a.length, 0);
  EXPECT_EQ(a.min_subdivisions, 0);
  EXPECT_EQ(a.max_subdivisions, kMaxSubdivisions);
  EXPECT_EQ(read({word("surface"), word("parametric"), row({NAN, -INFINITY})}).u, 0);
  EXPECT_EQ(approximation_of(approximate({word("surface"), word("parametric"), row({1})},
                                         "shadow trace approximate"))
                ->rays,
            Approximation::Shadow | Approximation::Trace);
}

struct Rules {
  PolygonGroup group;
  Instance inner, outer;
  Options options;
  const Approximation* find(std::string_view surface) {
    rules = ApproximationRules(group, {&outer, &inner}, &options);
    return rules.find(Kind::Surface, surface);
  }
  ApproximationRules rules;
};
Statement surface(double u, std::vector<Value> rest = {}) {
  std::vector<Value> values = {word("surface"), word("parametric"), row({u})};
  values.insert(values.end(), rest.begin(), rest.end());
  return approximate(std::move(values));
}

TEST(ApproximationRules, NearestStatementAppliesUnlessOverridden) {
  Rules r;
  EXPECT_EQ(r.find("s"), nullptr);
  r.outer.flags = {surface(1)};
  EXPECT_EQ(r.find("s")->u, 1);
  r.inner.flags = {surface(2)};
  EXPECT_EQ(r.find("s")->u, 2);
  r.group.settings = {surface(3), surface(4, {name("s")}), surface(5, {name("other")})};
  EXPECT_EQ(r.find("s")->u, 4);
  EXPECT_EQ(r.find("other")->u, 5);
  EXPECT_EQ(r.find("third")->u, 3);
  r.outer.flags.push_back({"override", false, {}, {}});
  EXPECT_EQ(r.find("s")->u, 1);
  r.options.statements = {surface(9, {word("all")})};
  EXPECT_EQ(r.find("s")->u, 9);
  EXPECT_EQ(r.rules.find(Kind::Trim, "s"), nullptr);
}

TEST(ApproximationRules, BareStatementResetsAndRayTypesHaveLowerPriority) {
  Rules r;
  r.inner.flags = {surface(2), approximate({})};
  EXPECT_EQ(r.find("s"), nullptr);
  r.group.settings = {surface(3, {name("s")}), surface(4, {name("s")})};
  r.group.settings[1].keyword = "shadow approximate";
  EXPECT_EQ(r.find("s")->u, 3);
}

// A segment of length 2 at distance 10, 500 pixels per unit at distance 1: 100 pixels.
TEST(TessellationView, LengthsAreInPixelDiagonalsAndFallWithDistance) {
  TessellationView view;
  view.pixels_per_unit = 500;
  EXPECT_NEAR(view.pixels({-1, 0, -10}, {1, 0, -10}), 100 / std::sqrt(2.0f), 1e-3f);
  EXPECT_NEAR(view.pixels({-1, 0, -20}, {1, 0, -20}), 50 / std::sqrt(2.0f), 1e-3f);
  // Independent of the direction of the segment.
  EXPECT_NEAR(view.pixels({0, 0, -11}, {0, 0, -9}), 100 / std::sqrt(2.0f), 1e-3f);
  view.orthographic = true;
  EXPECT_NEAR(view.pixels({-1, 0, -20}, {1, 0, -20}), 1000 / std::sqrt(2.0f), 1e-2f);
  EXPECT_EQ(TessellationView{}.pixels({0, 0, 0}, {1, 0, 0}), 0);
}

}  // namespace approximation_test
}  // namespace oriel::scene
