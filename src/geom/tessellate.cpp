// SPDX-License-Identifier: Apache-2.0
#include "geom/tessellate.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "geom/append_mesh.h"
#include "geom/equal_vertices.h"
#include "geom/freeform/freeform.h"
#include "geom/hair.h"
#include "geom/polygon.h"
#include "geom/subdivide.h"
#include "scene/approximation.h"
#include "scene/element_settings.h"

namespace oriel::geom {

namespace {

// Embree ignores geometry beyond this distance; such polygons are skipped with a diagnostic.
constexpr float kFarthestVertex = 1e18f;

bool is_usable_vertex(const Vec3& p) {
  return std::abs(p.x) < kFarthestVertex && std::abs(p.y) < kFarthestVertex &&
         std::abs(p.z) < kFarthestVertex;
}

class Tessellator {
 public:
  explicit Tessellator(Mesh& mesh) : mesh_(mesh) {}

  void add_group(const scene::PolygonGroup& group) {
    if (group.polygons.size() == 0) return;
    base_ = vertices_;
    add_vertices(group);
    add_polygons(group);
  }

  void finish() {
    const auto pad = [this](std::vector<Vec3>& column) {
      if (!column.empty()) column.resize(vertices_, Vec3(0));
      column.shrink_to_fit();
    };
    // Replaces positions that no triangle uses.
    std::replace_if(
        mesh_.positions.begin(), mesh_.positions.end(),
        [](const Vec3& p) { return !is_usable_vertex(p); }, Vec3(0));
    mesh_.positions.push_back(Vec3(0));
    mesh_.positions.shrink_to_fit();
    mesh_.triangles.shrink_to_fit();
    for_each_column(pad);
    if (mesh_.slots.empty()) mesh_.slots.emplace_back();
    if (mesh_.slots.size() == 1) mesh_.slot.clear();
    mesh_.slot.shrink_to_fit();
  }

  std::size_t without_area = 0, not_finite = 0, out_of_range = 0;

 private:
  template <typename Function>
  void for_each_column(Function&& function) {
    function(mesh_.normals);
    for (TextureSpace& space : mesh_.textures) {
      function(space.coordinate);
      function(space.basis_u);
      function(space.basis_v);
    }
    function(mesh_.dpdu);
    function(mesh_.dpdv);
    for (std::vector<Vec3>& step : mesh_.motion) function(step);
  }

  // Appends a column of the group. The column of the mesh is created, filled with nulls, when a
  // group first has it.
  void add_column(const scene::PolygonGroup& group, const std::vector<std::uint32_t>& indices,
                  std::vector<Vec3>& column, bool unit) const {
    const std::size_t pool = group.vectors.size();
    const auto exists = [pool](std::uint32_t i) { return i < pool; };
    if (std::none_of(indices.begin(), indices.end(), exists)) return;
    column.resize(base_, Vec3(0));
    make_room(column, vertices_);
    for (const std::uint32_t vertex : different_.kept) {
      const std::uint32_t i = vertex < indices.size() ? indices[vertex] : kNone;
      Vec3 value = i < pool ? group.vectors[i] : Vec3(0);
      if (!is_finite(value)) value = Vec3(0);
      column.push_back(unit ? normalize(value) : value);
    }
    column.resize(vertices_, Vec3(0));
  }

  void add_vertices(const scene::PolygonGroup& group) {
    const scene::VertexList& list = group.vertices;
    different_ = find_equal_vertices(list, group.vectors.size());
    vertices_ = base_ + different_.kept.size();
    usable_ = true;
    make_room(mesh_.positions, vertices_ + 1);
    for (const std::uint32_t vertex : different_.kept) {
      const std::uint32_t i = list.point[vertex];
      const Vec3 p = i < group.vectors.size() ? group.vectors[i] : Vec3(NAN);
      usable_ = usable_ && is_usable_vertex(p);
      mesh_.positions.push_back(p);
    }
    add_column(group, list.normal, mesh_.normals, true);
    const std::size_t spaces = std::min(list.textures.size(), kMaxTextureSpaces);
    if (mesh_.textures.size() < spaces) mesh_.textures.resize(spaces);
    for (std::size_t s = 0; s < spaces; ++s) {
      add_column(group, list.textures[s].coordinate, mesh_.textures[s].coordinate, false);
      add_column(group, list.textures[s].basis_u, mesh_.textures[s].basis_u, false);
      add_column(group, list.textures[s].basis_v, mesh_.textures[s].basis_v, false);
    }
    if (list.derivative.size() >= 2) {
      add_column(group, list.derivative[0], mesh_.dpdu, false);
      add_column(group, list.derivative[1], mesh_.dpdv, false);
    }
    if (mesh_.motion.size() < list.motion.size()) mesh_.motion.resize(list.motion.size());
    for (std::size_t m = 0; m < list.motion.size(); ++m)
      add_column(group, list.motion[m], mesh_.motion[m], false);
  }

  std::uint32_t slot_for(const scene::PolygonGroup& group, std::uint32_t material) {
    if (material == last_material_ && &group == last_group_) return last_slot_;
    MaterialSlot slot;
    if (mesh_.tagged)
      slot.label = material;
    else if (material < group.materials.size())
      slot.name = group.materials[material];
    const auto [entry, is_new] = slot_index_.try_emplace(
        {slot.name, slot.label}, static_cast<std::uint32_t>(mesh_.slots.size()));
    if (is_new) mesh_.slots.push_back(std::move(slot));
    last_group_ = &group;
    last_material_ = material;
    return last_slot_ = entry->second;
  }

  void add_polygons(const scene::PolygonGroup& group) {
    const scene::PolygonList& polygons = group.polygons;
    std::size_t next_hole = 0;
    for (std::size_t i = 0; i < polygons.size(); ++i) {
      const std::uint32_t begin = polygons.first[i], end = polygons.first[i + 1];
      holes_.clear();
      for (; next_hole < polygons.holes.size() && polygons.holes[next_hole] < end; ++next_hole)
        if (polygons.holes[next_hole] >= begin + (holes_.empty() ? 0 : holes_.back()))
          holes_.push_back(polygons.holes[next_hole] - begin);
      if (end < begin || end > polygons.indices.size()) {
        ++out_of_range;
        continue;
      }
      const std::size_t before = mesh_.triangles.size();
      corners_.assign(polygons.indices.begin() + begin, polygons.indices.begin() + end);
      add_polygon();
      if (mesh_.triangles.size() == before) continue;
      const std::uint32_t material = i < polygons.material.size() ? polygons.material[i] : kNone;
      mesh_.slot.resize(mesh_.triangles.size(), slot_for(group, material));
    }
  }

  /// Adds the polygon in corners_, whose entries become vertices of the mesh.
  void add_polygon() {
    bool finite = true;
    for (std::uint32_t& c : corners_) {
      if (c >= different_.number_of.size()) {
        ++out_of_range;
        return;
      }
      c = static_cast<std::uint32_t>(base_) + different_.number_of[c];
      finite = finite && (usable_ || is_usable_vertex(mesh_.positions[c]));
    }
    if (!finite) {
      ++not_finite;
      return;
    }
    if (corners_.size() == 3 && holes_.empty()) {
      add_triangle({corners_[0], corners_[1], corners_[2]});
      return;
    }
    places_.clear();
    for (const std::uint32_t c : corners_) places_.push_back(mesh_.positions[c]);
    cut_.clear();
    if (!triangulator_.triangulate(places_, holes_, cut_)) {
      ++without_area;
      return;
    }
    for (const Triangle& t : cut_)
      mesh_.triangles.push_back({corners_[t.a], corners_[t.b], corners_[t.c]});
  }

  void add_triangle(const Triangle& t) {
    // Double: keeps the area of a small triangle far from the origin, and avoids underflow for
    // coordinates near 1e-20.
    const Imath::V3d a(mesh_.positions[t.a]), b(mesh_.positions[t.b]), c(mesh_.positions[t.c]);
    if ((b - a).cross(c - a) == Imath::V3d(0))
      ++without_area;
    else
      mesh_.triangles.push_back(t);
  }

  Mesh& mesh_;
  std::size_t base_ = 0, vertices_ = 0;
  bool usable_ = true;           // all positions of the current group
  DifferentVertices different_;  // of the current group
  std::map<std::pair<std::string, std::uint32_t>, std::uint32_t> slot_index_;
  const scene::PolygonGroup* last_group_ = nullptr;
  std::uint32_t last_material_ = 0, last_slot_ = 0;
  PolygonTriangulator triangulator_;
  std::vector<std::uint32_t> corners_;
  std::vector<Vec3> places_;
  std::vector<std::uint32_t> holes_;
  std::vector<Triangle> cut_;
};

/// The finer of the approximation of the surface and that of its displacement; null: none.
const scene::Approximation* requested_approximation(const scene::PolygonGroup& group,
                                                    const scene::SubdivisionSurface& surface,
                                                    const scene::ApproximationRules& rules,
                                                    const scene::ApproximationContext& context) {
  using Kind = scene::Approximation::Kind;
  const bool ccmesh = surface.form == scene::SubdivisionSurface::Form::CcMesh;
  const scene::Approximation* own =
      rules.find(ccmesh ? Kind::CcMesh : Kind::Subdivision, surface.name);
  const scene::Approximation* displace = rules.find(Kind::Displace, surface.name);
  if (displace) {
    const SubdivisionCage cage = cage_of(group, surface);
    if (!own || subdivision_level(cage, displace, context.view) >
                    subdivision_level(cage, own, context.view))
      own = displace;
  }
  return own;
}

Mesh subdivide_as_asked(const scene::PolygonGroup& group, const scene::SubdivisionSurface& surface,
                        bool tagged, const scene::ApproximationRules& rules,
                        const scene::ApproximationContext& context, Diagnostics& diagnostics) {
  return subdivide(group, surface, tagged, requested_approximation(group, surface, rules, context),
                   context.view, diagnostics, context.most_triangles / 2);
}

}  // namespace

std::uint64_t subdivided_triangles(const scene::Object& object,
                                   const scene::ApproximationContext& context) {
  std::uint64_t sum = 0;
  for (const scene::PolygonGroup& group : object.groups) {
    if (group.subdivisions.empty()) continue;
    const scene::ApproximationRules rules = context.rules(group);
    for (const scene::SubdivisionSurface& surface : group.subdivisions) {
      const SubdivisionCage cage = cage_of(group, surface);
      const int level = affordable_level(
          cage, subdivision_level(cage, requested_approximation(group, surface, rules, context),
                                  context.view));
      sum += triangles_at_level(cage, level);
    }
  }
  return sum;
}

Mesh tessellate(const scene::Object& object, Diagnostics& diagnostics) {
  return tessellate(object, {}, diagnostics);
}

Mesh tessellate(const scene::Object& object, const scene::ApproximationContext& context,
                Diagnostics& diagnostics) {
  Mesh mesh;
  mesh.tagged = scene::settings_of(object).tagged;
  Tessellator tessellator(mesh);
  for (const scene::PolygonGroup& group : object.groups) tessellator.add_group(group);
  tessellator.finish();
  for (const scene::PolygonGroup& group : object.groups) {
    if (group.subdivisions.empty()) continue;
    const scene::ApproximationRules rules = context.rules(group);
    for (const scene::SubdivisionSurface& surface : group.subdivisions)
      append_mesh(mesh,
                  subdivide_as_asked(group, surface, mesh.tagged, rules, context, diagnostics));
  }
  for (const scene::PolygonGroup& group : object.groups)
    append_mesh(mesh, tessellate_freeform(object, group, context, diagnostics));
  for (const scene::Hair& hair : object.hairs) add_hair(mesh, hair, diagnostics);

  const std::size_t left_out =
      tessellator.without_area + tessellator.not_finite + tessellator.out_of_range;
  if (left_out > 0)
    diagnostics.warning(
        "OR-GEOM-001", object.where,
        fmt::format(
            "object \"{}\": {} of its polygons are skipped ({} without area, {} with corners "
            "that are not finite, {} with corners that do not exist)",
            object.name, left_out, tessellator.without_area, tessellator.not_finite,
            tessellator.out_of_range));
  for (const scene::PolygonGroup& group : object.groups)
    if (group.vertices.textures.size() > kMaxTextureSpaces) {
      diagnostics.warning(
          "OR-GEOM-002", object.where,
          fmt::format("object \"{}\" has {} texture spaces; only the first {} are used",
                      object.name, group.vertices.textures.size(), kMaxTextureSpaces));
      break;
    }
  return mesh;
}

}  // namespace oriel::geom
