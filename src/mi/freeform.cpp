// SPDX-License-Identifier: Apache-2.0
#include "mi/freeform.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "mi/elements.h"

namespace oriel::mi {
namespace {

using scene::Basis;
using scene::ControlPoint;

/// Consecutive numbers, not yet split into parameters and control points.
struct Row {
  struct Number {
    double value;
    bool integral;
    float weight;  ///< from `w f` after the number
  };
  std::vector<Number> numbers;
  bool weighted = false;
};

float narrowed(double value) {
  constexpr double kMax = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -kMax, kMax));
}

Row read_row(Parse& parse) {
  Row row;
  while (parse.at_number()) {
    const Token token = parse.in.next();
    row.numbers.push_back({token.number, token.integral, 1});
    if (!parse.in.accept_word("w")) continue;
    row.numbers.back().weight = parse.real("a weight");
    row.weighted = true;
  }
  return row;
}

const Basis* find_basis(const scene::Object& object, const std::string& name) {
  const auto found = std::find_if(object.bases.rbegin(), object.bases.rend(),
                                  [&](const Basis& b) { return b.name == name; });
  return found == object.bases.rend() ? nullptr : &*found;
}

/// Number of leading parameters in the row. `across`: number of control points in the other
/// direction, 0 if unknown.
///
/// Parameters are usually written with a decimal point and indices without. If this is ambiguous,
/// the number of control points that the basis requires decides.
std::size_t count_parameters(const Row& row, const Basis* basis, std::size_t across) {
  const auto& numbers = row.numbers;
  const auto is_integral = [](const Row::Number& n) { return n.integral; };
  const auto first = std::find_if(numbers.begin(), numbers.end(), is_integral);
  const auto clean = static_cast<std::size_t>(first - numbers.begin());
  if (clean >= 2 && std::all_of(first, numbers.end(), is_integral)) return clean;
  for (std::size_t n = 2; basis && across > 0 && n < numbers.size(); ++n)
    if (basis->control_points(n) * across == numbers.size() - n) return n;
  const auto last = std::find_if_not(numbers.rbegin(), numbers.rend(), is_integral);
  return static_cast<std::size_t>(numbers.rend() - last);
}

std::vector<ControlPoint> points_of(const Row& row, std::size_t first) {
  std::vector<ControlPoint> points;
  points.reserve(row.numbers.size() - first);
  for (std::size_t i = first; i < row.numbers.size(); ++i)
    points.push_back({as_index(row.numbers[i].value), row.numbers[i].weight});
  return points;
}

void parameters_of(const Row& row, std::size_t first, std::size_t end,
                   std::vector<float>& parameters) {
  for (std::size_t i = first; i < end; ++i) parameters.push_back(narrowed(row.numbers[i].value));
}

void read_basis_name(Parse& parse, scene::BasisUse& use) {
  use.rational = parse.in.accept_word("rational");
  use.basis = parse.name("the name of a basis");
}

/// [rational] "basis" [min max] parameters... twice, and the control points.
struct Patch {
  scene::BasisUse u, v;
  float range[4] = {0, 1, 0, 1};
  std::vector<ControlPoint> points;
};

Patch read_patch(Parse& parse, const scene::Object& object, bool ranges) {
  Patch patch;
  read_basis_name(parse, patch.u);
  for (int i = 0; ranges && i < 2; ++i) patch.range[i] = parse.real("the range of u");
  const Row u = read_row(parse);
  parameters_of(u, 0, u.numbers.size(), patch.u.parameters);

  read_basis_name(parse, patch.v);
  for (int i = 2; ranges && i < 4; ++i) patch.range[i] = parse.real("the range of v");
  const Row v = read_row(parse);
  const Basis* const basis_u = find_basis(object, patch.u.basis);
  const std::size_t across = basis_u ? basis_u->control_points(patch.u.parameters.size()) : 0;
  const std::size_t count = count_parameters(v, find_basis(object, patch.v.basis), across);
  parameters_of(v, 0, count, patch.v.parameters);
  patch.points = points_of(v, count);
  return patch;
}

/// trim | hole | special: curves with parameter ranges, or vertices.
scene::SurfaceLoop read_loop(Parse& parse, scene::SurfaceLoop::Kind kind) {
  scene::SurfaceLoop loop{kind, {}, {}};
  for (;;) {
    if (parse.at_number()) {
      loop.points.push_back(as_index(parse.number("a vertex")));
    } else if (parse.in.at(Token::Kind::String)) {
      scene::CurvePart& part = loop.parts.emplace_back();
      part.curve = parse.name("the name of a curve");
      part.min = parse.real("where the part begins");
      part.max = parse.real("where the part ends");
    } else {
      return loop;
    }
  }
}

bool read_surface_statement(Parse& parse, const scene::Object& object,
                            scene::FreeSurface& surface) {
  using Kind = scene::SurfaceLoop::Kind;
  constexpr std::pair<std::string_view, Kind> kLoops[] = {
      {"trim", Kind::Trim}, {"hole", Kind::Hole}, {"special", Kind::Special}};
  for (const auto& [word, kind] : kLoops)
    if (parse.in.accept_word(word)) {
      surface.loops.push_back(read_loop(parse, kind));
      return true;
    }
  if (parse.in.accept_word("derivative")) {
    while (parse.at_number()) surface.derivative.push_back(parse.integer("1 or 2"));
    return true;
  }
  if (!parse.in.at_word("volume") && !parse.in.at_word("vector") && !parse.in.at_word("texture"))
    return false;
  scene::TextureSurface texture;
  texture.volume = parse.in.accept_word("volume");
  texture.vector = parse.in.accept_word("vector");
  parse.expect_word("texture");
  Patch patch = read_patch(parse, object, false);
  texture.u = std::move(patch.u);
  texture.v = std::move(patch.v);
  texture.points = std::move(patch.points);
  surface.textures.push_back(std::move(texture));
  return true;
}

}  // namespace

void read_basis(Parse& parse, scene::Object& object, SourceLocation /*at*/) {
  constexpr std::pair<std::string_view, Basis::Kind> kKinds[] = {
      {"bezier", Basis::Kind::Bezier},
      {"bspline", Basis::Kind::BSpline},
      {"taylor", Basis::Kind::Taylor},
      {"cardinal", Basis::Kind::Cardinal},
      {"matrix", Basis::Kind::Matrix}};
  static const std::vector<std::string> kWords = {"bezier", "bspline", "taylor", "cardinal",
                                                  "matrix"};
  Basis basis;
  basis.name = parse.name("the name of a basis");
  basis.rational = parse.in.accept_word("rational");
  const auto kind = std::find_if(std::begin(kKinds), std::end(kKinds),
                                 [&](const auto& k) { return parse.in.at_word(k.first); });
  if (kind == std::end(kKinds)) parse.unexpected("a kind of basis", kWords);
  parse.in.next();
  basis.kind = kind->second;
  // A cardinal basis is always cubic; a degree is accepted and ignored.
  if (basis.kind != Basis::Kind::Cardinal)
    basis.degree = parse.integer("a degree");
  else if (parse.at_number())
    parse.in.next();
  if (basis.kind == Basis::Kind::Matrix) {
    basis.step = parse.integer("a step");
    while (parse.at_number()) basis.matrix.push_back(parse.real("a coefficient"));
  }
  object.bases.push_back(std::move(basis));
}

void read_curve(Parse& parse, const scene::Object& object, scene::PolygonGroup& group, bool space,
                SourceLocation at) {
  scene::FreeCurve curve;
  curve.name = parse.name("the name of a curve");
  curve.space = space;
  curve.where = at;
  read_basis_name(parse, curve.basis);
  const Row row = read_row(parse);
  const std::size_t count = count_parameters(row, find_basis(object, curve.basis.basis), 1);
  parameters_of(row, 0, count, curve.basis.parameters);
  curve.points = points_of(row, count);
  if (parse.in.accept_word("special"))
    while (parse.at_number()) curve.special.push_back(parse.real("a parameter"));
  group.freeform.curves.push_back(std::move(curve));
}

void read_surface(Parse& parse, const scene::Object& object, scene::PolygonGroup& group,
                  GroupBuilder& builder, SourceLocation at) {
  scene::FreeSurface surface;
  surface.name = parse.name("the name of a surface");
  surface.where = at;
  if (parse.tagged)
    surface.material = as_index(parse.number("the label of this surface"));
  else
    surface.material = builder.material_index(parse.name("the name of a material"));
  Patch patch = read_patch(parse, object, true);
  surface.u = std::move(patch.u);
  surface.v = std::move(patch.v);
  surface.points = std::move(patch.points);
  std::tie(surface.u_min, surface.u_max) = std::pair(patch.range[0], patch.range[1]);
  std::tie(surface.v_min, surface.v_max) = std::pair(patch.range[2], patch.range[3]);
  while (read_surface_statement(parse, object, surface)) {
  }
  group.freeform.surfaces.push_back(std::move(surface));
}

void read_connection(Parse& parse, scene::PolygonGroup& group, SourceLocation at) {
  scene::Connection connection;
  connection.where = at;
  for (int side = 0; side < 2; ++side) {
    connection.surface[side] = parse.name("the name of a surface");
    scene::CurvePart& part = connection.part[side];
    part.curve = parse.name("the name of a curve");
    part.min = parse.real("where the part begins");
    part.max = parse.real("where the part ends");
  }
  group.freeform.connections.push_back(std::move(connection));
}

}  // namespace oriel::mi
