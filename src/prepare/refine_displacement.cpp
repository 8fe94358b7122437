// SPDX-License-Identifier: Apache-2.0
#include "prepare/refine_displacement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "geom/split_edges.h"

namespace oriel {
namespace {

using scene::Approximation;
using Kind = Approximation::Kind;
using Technique = Approximation::Technique;

/// The approximations that apply to any part of the object.
std::vector<Approximation> approximations_of(const scene::Object& object,
                                             const scene::ApproximationContext& context) {
  std::vector<Approximation> found;
  const auto add = [&](const Approximation* a) {
    if (a && std::find(found.begin(), found.end(), *a) == found.end()) found.push_back(*a);
    return a != nullptr;
  };
  for (const scene::PolygonGroup& group : object.groups) {
    const scene::ApproximationRules rules = context.rules(group);
    if (group.polygons.size() > 0 && !add(rules.find(Kind::Displace, group.name)) &&
        !add(rules.find(Kind::Polygon, group.name)))
      add(rules.find(Kind::Trilist, group.name));
    for (const scene::SubdivisionSurface& surface : group.subdivisions)
      add(rules.find(Kind::Displace, surface.name));
    for (const scene::FreeSurface& surface : group.freeform.surfaces)
      add(rules.find(Kind::Displace, surface.name));
  }
  return found;
}

class DisplacementRefiner {
 public:
  DisplacementRefiner(geom::Mesh& mesh, const Displacement& displacement,
                      const std::vector<Approximation>& approximations,
                      const scene::TessellationView& view, std::size_t limit)
      : mesh_(mesh),
        displacement_(displacement),
        approximations_(approximations),
        view_(view),
        limit_(limit) {}

  /// displaced(copy) moves the vertices of a copy of the mesh. False: the limit of triangles would
  /// be exceeded.
  template <typename Displaced>
  bool run(Displaced&& displaced) {
    geom::EdgeSplitter splitter(mesh_);
    const std::size_t most = most_triangles();
    for (int done = 0; done < scene::kMaxSubdivisions; ++done) {
      if (done >= kBeforeMeasuring && measures_shape()) {
        shape_ = mesh_;
        displaced(shape_);
      }
      const auto wants = [&](std::uint32_t triangle, std::uint32_t a, std::uint32_t b) {
        return !displacement_[mesh_.slot_of(triangle)].empty() &&
               std::any_of(approximations_.begin(), approximations_.end(),
                           [&](const Approximation& ap) { return is_coarse(ap, done, a, b); });
      };
      // Limits of the scene itself are not reported.
      if (!splitter.pass(wants, most)) return !splitter.exceeded || most < limit_;
    }
    return true;
  }

 private:
  static constexpr int kBeforeMeasuring = 2;

  /// The largest `max` of the approximations, if all have one.
  std::size_t most_triangles() const {
    std::size_t most = 0;
    for (const Approximation& a : approximations_)
      most =
          std::max(most, a.max_triangles > 0 ? static_cast<std::size_t>(a.max_triangles) : limit_);
    return std::min(most, limit_);
  }

  bool measures_shape() const {
    return std::any_of(approximations_.begin(), approximations_.end(), [](const auto& a) {
      return a.technique == Technique::Criteria && (a.distance > 0 || a.angle > 0);
    });
  }

  /// Whether the approximation requires a split of the mesh edge a-b, which was split `done` times.
  bool is_coarse(const Approximation& ap, int done, std::uint32_t a, std::uint32_t b) const {
    if (ap.technique == Technique::Parametric) return static_cast<float>(done) < ap.u;
    if (ap.technique == Technique::Regular) return math::exp2(static_cast<float>(done)) < ap.u;
    if (done < ap.min_subdivisions) return true;
    if (done >= ap.max_subdivisions) return false;
    unsigned asked = 0, unmet = 0;
    const auto test = [&](float limit, auto&& measured) {
      if (!(limit > 0)) return;
      ++asked;
      unmet += measured() > limit;
    };
    test(ap.length, [&] { return length_of(ap, mesh_, a, b); });
    test(ap.angle, [&] { return angle_of(a, b); });
    // Of an arc whose end normals differ by a small angle.
    test(ap.distance, [&] {
      return shape_.normals.empty() ? INFINITY : length_of(ap, shape_, a, b) * angle_of(a, b) / 8;
    });
    return ap.any ? asked > 0 && unmet == asked : unmet > 0;
  }

  float length_of(const Approximation& ap, const geom::Mesh& mesh, std::uint32_t a,
                  std::uint32_t b) const {
    const Vec3 &p = mesh.positions[a], &q = mesh.positions[b];
    return ap.view ? view_.pixels(p, q) : length(q - p);
  }

  /// Angle between the displaced normals; larger than any limit before the first measurement.
  float angle_of(std::uint32_t a, std::uint32_t b) const {
    if (shape_.normals.empty()) return kPi;
    return math::acos(clamp(dot(shape_.normals[a], shape_.normals[b]), -1.0f, 1.0f));
  }

  geom::Mesh& mesh_;
  const Displacement& displacement_;
  const std::vector<Approximation>& approximations_;
  const scene::TessellationView& view_;
  const std::size_t limit_;
  geom::Mesh shape_;  // displaced, at the last measurement
};

}  // namespace

bool refine_for_displacement(geom::Mesh& mesh, const Displacement& displacement,
                             const scene::Leaf& leaf, const scene::ApproximationContext& context,
                             const World& world, std::size_t most, Diagnostics& diagnostics) {
  if (displacement.empty() || mesh.triangles.empty()) return true;
  const scene::Object& object = *leaf.object();
  const std::vector<Approximation> approximations = approximations_of(object, context);
  if (approximations.empty()) return true;
  if (std::all_of(approximations.begin(), approximations.end(),
                  [](const Approximation& a) { return a.smooth; }))
    geom::add_facet_normals(mesh);
  const std::size_t limit = std::min(most, kMaxMicroTriangles);
  DisplacementRefiner refiner(mesh, displacement, approximations, context.view, limit);
  const bool whole = refiner.run([&](geom::Mesh& copy) {
    Diagnostics unheard;
    displace(copy, displacement, leaf, world, unheard);
  });
  if (whole) return true;
  if (limit < kMaxMicroTriangles) return false;
  diagnostics.warning(
      "OR-RN-032", object.where,
      fmt::format("object \"{}\": its displacement would take more than {} triangles; it stays "
                  "at {}",
                  object.name, kMaxMicroTriangles, mesh.triangles.size()),
      "ask for less in `approximate displace`");
  return true;
}

}  // namespace oriel
