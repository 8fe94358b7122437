// SPDX-License-Identifier: Apache-2.0
// Test support: random objects with polygons, subdivision and free-form surfaces, and hair.
#pragma once

#include <algorithm>
#include <cmath>

#include "mi/testing/random_values.h"

namespace oriel::mi {

/// Columns without an entry are empty, and names are indexed in the order of their first use.
class RandomGeometry : protected RandomValues {
 protected:
  using RandomValues::RandomValues;

  /// A column with one entry per vertex, optionally with gaps.
  std::vector<std::uint32_t> column(std::size_t vertices, int vectors, bool gaps) {
    std::vector<std::uint32_t> c;
    bool any = false;
    for (std::size_t i = 0; i < vertices; ++i) {
      c.push_back(gaps && chance() ? scene::kNone : static_cast<std::uint32_t>(pick(vectors)));
      any |= c.back() != scene::kNone;
    }
    return any ? c : std::vector<std::uint32_t>{};
  }

  scene::PolygonGroup group(bool tagged) {
    scene::PolygonGroup g;
    if (chance()) g.name = name();
    if (chance()) g.settings.push_back(statement("approximate", {words("fine", true)}));
    const int vectors = 3 + pick(50);
    for (int i = 0; i < vectors; ++i) g.vectors.emplace_back(real(), real(), real());
    const std::size_t n = 3 + static_cast<std::size_t>(pick(40));
    g.vertices.point = column(n, vectors, false);
    if (chance()) g.vertices.normal = column(n, vectors, true);
    if (chance()) g.vertices.derivative = {column(n, vectors, false), column(n, vectors, false)};
    for (int i = pick(3); i > 0; --i) {
      scene::TextureColumn& t = g.vertices.textures.emplace_back();
      t.coordinate = column(n, vectors, false);
      if (!chance()) continue;
      t.basis_u = column(n, vectors, true);
      for (const std::uint32_t u : t.basis_u)
        t.basis_v.push_back(u == scene::kNone ? scene::kNone
                                              : static_cast<std::uint32_t>(pick(vectors)));
    }
    if (auto motion = column(n, vectors, true); !motion.empty()) g.vertices.motion = {motion};
    for (int i = pick(3); i > 0; --i) g.vertices.user.push_back(column(n, vectors, false));
    marks(g.vertices);
    polygons(g, static_cast<int>(n), tagged);
    for (int i = pick(3); i > 0; --i) subdivision(g, static_cast<int>(n), tagged);
    for (int i = pick(3); i > 0; --i) {
      scene::FreeCurve& c = g.freeform.curves.emplace_back();
      c.name = name();
      c.space = chance();
      c.basis = basis_use();
      c.points = control_points(vectors);
      for (int k = pick(3); k > 0; --k) c.special.push_back(real());
    }
    for (int i = pick(3); i > 0; --i) g.freeform.surfaces.push_back(surface(g, tagged, vectors));
    if (chance())
      g.freeform.connections.push_back(
          {{name(), name()}, {{name(), real(), real()}, {name(), real(), real()}}, {}});
    return g;
  }

  scene::BasisUse basis_use() {
    scene::BasisUse use{chance(), name(), {}};
    for (int i = 2 + pick(6); i > 0; --i) use.parameters.push_back(real());
    return use;
  }

  std::vector<scene::ControlPoint> control_points(int vertices) {
    std::vector<scene::ControlPoint> points;
    for (int i = pick(9); i > 0; --i)
      points.push_back({static_cast<std::uint32_t>(pick(vertices)), chance() ? real() : 1});
    return points;
  }

  scene::FreeSurface surface(scene::PolygonGroup& g, bool tagged, int vertices) {
    scene::FreeSurface s;
    s.name = name();
    s.material =
        static_cast<std::uint32_t>(tagged ? pick(9) : static_cast<int>(g.materials.size()));
    if (!tagged) g.materials.push_back(name());
    s.u = basis_use();
    s.v = basis_use();
    s.u_min = real();
    s.v_max = real();
    s.points = control_points(vertices);
    if (chance()) s.derivative = {1, 2};
    for (int i = pick(3); i > 0; --i)
      s.textures.push_back(
          {chance(), chance(), basis_use(), basis_use(), control_points(vertices)});
    for (int i = pick(4); i > 0; --i) {
      scene::SurfaceLoop& loop = s.loops.emplace_back();
      loop.kind = static_cast<scene::SurfaceLoop::Kind>(pick(3));
      for (int k = 1 + pick(3); k > 0; --k) loop.parts.push_back({name(), real(), real()});
      if (loop.kind == scene::SurfaceLoop::Kind::Special) loop.points = {7, 8};
    }
    return s;
  }

  void polygons(scene::PolygonGroup& g, int vertices, bool tagged) {
    scene::PolygonList& list = g.polygons;
    const auto loop = [&] {
      for (int i = 3 + pick(4); i > 0; --i)
        list.indices.push_back(static_cast<std::uint32_t>(pick(vertices)));
    };
    for (int i = pick(20); i > 0; --i) {
      if (list.first.empty()) list.first.push_back(0);
      loop();
      for (int holes = pick(3); holes > 0; --holes) {
        list.holes.push_back(static_cast<std::uint32_t>(list.indices.size()));
        loop();
      }
      list.first.push_back(static_cast<std::uint32_t>(list.indices.size()));
      // A new name is used at once, because names are indexed in the order of their first use.
      if (tagged) {
        list.material.push_back(static_cast<std::uint32_t>(pick(9)));
      } else if (g.materials.empty() || pick(4) == 0) {
        list.material.push_back(static_cast<std::uint32_t>(g.materials.size()));
        g.materials.push_back(name());
      } else {
        const int named = static_cast<int>(g.materials.size());
        const int choice = pick(named + 1);
        list.material.push_back(choice == named ? scene::kNone
                                                : static_cast<std::uint32_t>(choice));
      }
    }
  }

  void marks(scene::VertexList& list) {
    for (std::uint32_t i = 0; i < list.size(); ++i) {
      if (pick(5) != 0) continue;
      scene::VertexMark& mark = list.marks.emplace_back();
      mark.vertex = i;
      mark.kind = static_cast<scene::VertexMark::Kind>(pick(4));
      if (chance()) mark.level = pick(9);
    }
  }

  /// Picks an existing name: a new one would have to be the next one used.
  std::uint32_t known_material(const scene::PolygonGroup& g, bool tagged) {
    if (tagged) return static_cast<std::uint32_t>(pick(9));
    const int named = static_cast<int>(g.materials.size());
    const int choice = pick(named + 1);
    return choice == named ? scene::kNone : static_cast<std::uint32_t>(choice);
  }

  void subdivision(scene::PolygonGroup& g, int vertices, bool tagged) {
    using Surface = scene::SubdivisionSurface;
    Surface& s = g.subdivisions.emplace_back();
    s.name = name();
    s.form = chance() ? Surface::Form::CcMesh : Surface::Form::Surface;
    if (chance()) s.announced = {pick(90), pick(90)};
    for (int i = pick(3); i > 0; --i)
      s.texture_rules.push_back(chance() ? Surface::TextureRule::Face
                                         : Surface::TextureRule::Subdivision);
    scene::PolygonList& faces = s.faces;
    const int count = pick(9);
    for (int face = 0; face < count; ++face) {
      if (face == 0) faces.first.push_back(0);
      const int corners = 3 + pick(4);
      for (int i = 0; i < corners; ++i)
        faces.indices.push_back(static_cast<std::uint32_t>(pick(vertices)));
      faces.first.push_back(static_cast<std::uint32_t>(faces.indices.size()));
      const std::uint32_t material = known_material(g, tagged);
      // The column starts at the first face with a material.
      if (!faces.material.empty() || material != scene::kNone) {
        faces.material.resize(static_cast<std::size_t>(face), scene::kNone);
        faces.material.push_back(material);
      }
      const auto number = static_cast<std::uint32_t>(face);
      for (int edge = 0; edge < corners; ++edge)
        if (pick(4) == 0)
          s.creases.push_back(
              {number, static_cast<std::uint32_t>(edge), static_cast<float>(1 + pick(8)) / 8});
      if (pick(4) == 0) s.trims.push_back({number, static_cast<std::uint32_t>(pick(16))});
      if (pick(4) == 0) s.details.push_back({number, {"{", "p 1 { 2 } }", {}}});
    }
    for (int i = pick(3); i > 0; --i) {
      Surface::Derivative& d = s.derivatives.emplace_back();
      d.order = 1 + pick(2);
      if (chance()) d.space = pick(4);
    }
  }

  std::vector<scene::Hair::Field> hair_fields() {
    using Kind = scene::Hair::Field::Kind;
    std::vector<scene::Hair::Field> fields;
    for (int i = pick(4); i > 0; --i) {
      const auto kind = static_cast<Kind>(pick(5));
      fields.push_back({kind, kind == Kind::Normal || kind == Kind::Radius ? 1 : pick(4)});
    }
    return fields;
  }

  scene::Hair hair() {
    scene::Hair h;
    if (chance()) h.material = name();
    if (chance()) h.radius = std::abs(real());
    if (chance()) h.approximate = pick(9);
    if (chance()) h.degree = 1 + pick(3);
    if (chance()) h.max_size = pick(99);
    if (chance()) h.max_depth = pick(99);
    h.per_hair = hair_fields();
    h.per_vertex = hair_fields();
    for (int i = pick(60); i > 0; --i) h.scalars.push_back(real());
    for (int i = pick(9); i > 0; --i)
      h.first.push_back(static_cast<std::uint32_t>(pick(static_cast<int>(h.scalars.size()) + 1)));
    std::sort(h.first.begin(), h.first.end());
    return h;
  }

  scene::Object object() {
    scene::Object o;
    o.name = name();
    const bool tagged = chance();
    o.flags = {statement("visible", {}), statement("shadow", {numbers(1)}),
               statement("trace", {boolean()})};
    if (tagged) o.flags.push_back(statement("tagged", {}));
    for (int i = pick(3); i > 0; --i) {
      scene::Basis& b = o.bases.emplace_back();
      b = {name(), static_cast<scene::Basis::Kind>(pick(5)), chance(), 3, 1, {}};
      if (b.kind == scene::Basis::Kind::Matrix) b.matrix = {real(), real(), real(), real()};
    }
    for (int i = pick(3); i > 0; --i) o.groups.push_back(group(tagged));
    for (int i = pick(3); i > 0; --i) o.hairs.push_back(hair());
    return o;
  }
};

}  // namespace oriel::mi
