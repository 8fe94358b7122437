// SPDX-License-Identifier: Apache-2.0
#include "geom/freeform/surface_mesh.h"

#include <fmt/format.h>

#include <algorithm>

#include "geom/tessellate.h"

namespace oriel::geom::freeform {
namespace {

/// Values of another surface over the same parameters; if its bases cover a different range, the
/// range is scaled.
class Lookup {
 public:
  Lookup(SurfaceNet net, const Range& range) : net_(std::move(net)) {
    const Direction &u = net_.u(), &v = net_.v();
    if (range.u0 < u.begin() || range.u1 > u.end()) map_u_ = stretch(range.u0, range.u1, u);
    if (range.v0 < v.begin() || range.v1 > v.end()) map_v_ = stretch(range.v0, range.v1, v);
  }
  Vec3 at(double u, double v) const {
    return Vec3(net_.point(map_u_.scale * u + map_u_.offset, map_v_.scale * v + map_v_.offset));
  }

 private:
  struct Map {
    double scale = 1, offset = 0;
  };
  static Map stretch(double from, double to, const Direction& d) {
    const double scale = (d.end() - d.begin()) / (to - from);
    return {scale, d.begin() - from * scale};
  }
  SurfaceNet net_;
  Map map_u_, map_v_;
};

void fill(std::vector<Vec3>& column, const Lookup& lookup, const std::vector<EdgePoint>& vertices) {
  column.reserve(vertices.size());
  for (const EdgePoint& p : vertices) column.push_back(lookup.at(p.u, p.v));
}

void add_textures(const SurfaceInput& input, const std::vector<EdgePoint>& vertices, Mesh& mesh,
                  Diagnostics& diagnostics) {
  for (const scene::TextureSurface& texture : input.surface.textures) {
    std::string fault;
    auto net = SurfaceNet::make(texture.u, texture.v, texture.points, input.object.bases,
                                input.group, fault);
    if (!net) {
      diagnostics.warning(
          "OR-GEOM-030", input.surface.where,
          fmt::format("a texture of surface \"{}\" is skipped: {}", input.surface.name, fault));
      continue;
    }
    const Lookup lookup(std::move(*net), input.outline.range);
    // Vectors belong to the preceding texture space: the first along u, the second along v.
    const bool own_space = !texture.vector || mesh.textures.empty();
    if (own_space && mesh.textures.size() >= kMaxTextureSpaces) continue;
    TextureSpace& space = own_space ? mesh.textures.emplace_back() : mesh.textures.back();
    std::vector<Vec3>& column = !texture.vector         ? space.coordinate
                                : space.basis_u.empty() ? space.basis_u
                                                        : space.basis_v;
    column.clear();
    fill(column, lookup, vertices);
  }
}

/// Motion vectors are interpolated with the same basis functions as the points.
void add_motion(const SurfaceInput& input, const std::vector<EdgePoint>& vertices, Mesh& mesh) {
  for (const auto& step : input.group.vertices.motion) {
    std::string fault;
    std::vector<V4d> net = control_net(input.group, input.surface.points, step, fault);
    if (net.empty()) return;
    const Lookup lookup(input.outline.net.with(std::move(net)), input.outline.range);
    fill(mesh.motion.emplace_back(), lookup, vertices);
  }
}

/// Positions and shading data of the vertices; triangles without area are dropped.
Mesh lift(const SurfaceInput& input, const PlaneMesh& plane, Diagnostics& diagnostics) {
  Mesh mesh;
  const SurfaceNet& net = input.outline.net;
  const bool derivatives = !input.surface.derivative.empty() || input.surface.textures.empty();
  const std::size_t count = plane.vertices.size();
  mesh.positions.reserve(count + 1);
  mesh.normals.reserve(count);
  if (derivatives) mesh.dpdu.reserve(count), mesh.dpdv.reserve(count);
  for (const EdgePoint& p : plane.vertices) {
    const Jet jet = net.jet(p.u, p.v);
    mesh.positions.emplace_back(p.place.value_or(jet.p));
    mesh.normals.emplace_back(net.normal(jet, p.u, p.v));
    if (!derivatives) continue;
    mesh.dpdu.emplace_back(jet.u);
    mesh.dpdv.emplace_back(jet.v);
  }
  add_textures(input, plane.vertices, mesh, diagnostics);
  add_motion(input, plane.vertices, mesh);
  mesh.triangles.reserve(plane.triangles.size());
  for (const Triangle& t : plane.triangles) {
    const Vec3 &a = mesh.positions[t.a], &b = mesh.positions[t.b], &c = mesh.positions[t.c];
    if (a != b && b != c && c != a) mesh.triangles.push_back(t);
  }
  mesh.positions.emplace_back(0.0f);
  return mesh;
}

}  // namespace

Range range_of(const scene::FreeSurface& surface, const SurfaceNet& net) {
  const auto clamped = [](double t, const Direction& d) {
    return std::clamp(t, d.begin(), d.end());
  };
  return {clamped(surface.u_min, net.u()), clamped(surface.u_max, net.u()),
          clamped(surface.v_min, net.v()), clamped(surface.v_max, net.v())};
}

bool is_range(const Range& range) { return range.u0 < range.u1 && range.v0 < range.v1; }

SurfacePart make_surface(const SurfaceInput& input, Budget& budget, Diagnostics& diagnostics) {
  const scene::FreeSurface& surface = input.surface;
  const OutlineInput& outline = input.outline;
  PlaneMesh plane;
  if (surface.loops.empty() &&
      outline.of_surface.technique != scene::Approximation::Technique::Criteria) {
    plane = grid_mesh(outline, budget);
  } else {
    std::vector<Polyline> lines;
    std::vector<EdgePoint> points;
    for (const scene::SurfaceLoop& loop : surface.loops) {
      std::string fault;
      lines.push_back(flatten(loop, outline, budget, fault));
      if (!fault.empty())
        diagnostics.warning("OR-GEOM-031", surface.where,
                            fmt::format("a trim of surface \"{}\": {}", surface.name, fault));
      // A loop without usable curves would trim everything away.
      if (lines.back().points.size() < (loop.kind == scene::SurfaceLoop::Kind::Special ? 2u : 3u))
        lines.pop_back();
      for (const std::uint32_t vertex : loop.points)
        if (vertex < input.group.vertices.size()) {
          const Vec3& at = input.group.vectors[input.group.vertices.point[vertex]];
          if (at.x > outline.range.u0 && at.x < outline.range.u1 && at.y > outline.range.v0 &&
              at.y < outline.range.v1)
            points.push_back({at.x, at.y, {}});
        }
    }
    std::size_t crossing = 0;
    plane = trimmed_mesh(outline, lines, points, budget, crossing);
    if (crossing > 0)
      diagnostics.warning("OR-GEOM-033", surface.where,
                          fmt::format("trimming curves of surface \"{}\" cross at {} points",
                                      surface.name, crossing),
                          "the edge of the surface is ragged there");
  }
  if (budget.spent)
    diagnostics.warning(
        "OR-GEOM-034", surface.where,
        fmt::format("the approximation of surface \"{}\" exceeds the triangle limit", surface.name),
        "the surface is tessellated more coarsely");
  SurfacePart part;
  part.mesh = lift(input, plane, diagnostics);
  part.edge = std::move(plane.edge);
  return part;
}

}  // namespace oriel::geom::freeform
