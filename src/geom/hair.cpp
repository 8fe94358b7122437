// SPDX-License-Identifier: Apache-2.0
#include "geom/hair.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "geom/motion.h"
#include "geom/surface.h"
#include "scene/motion.h"

namespace oriel::geom {

namespace {

using scene::Hair;
using Field = Hair::Field;
using FieldKind = Field::Kind;

constexpr float kFarthest = 1e18f;
/// Maximum number of motion vectors per point; the vectors of a hair apply to all of its points.
constexpr std::size_t kMaxSteps = scene::kMaxMotionSteps;

std::size_t width_of(const std::vector<Field>& fields) {
  std::size_t width = 0;
  for (const Field& field : fields) width += field.numbers();
  return width;
}

/// Attributes of a curve point other than its position.
struct Attributes {
  float radius = 1;
  Vec3 normal{0, 0, 0};
  std::vector<Vec3> textures;
  std::vector<Vec3> motion;  ///< displacement at equal steps of the motion interval
};

/// Reads the values of `fields` and overwrites those in `all`.
void read_fields(const std::vector<Field>& fields, std::span<const float> numbers,
                 Attributes& all) {
  std::size_t at = 0;
  for (const Field& field : fields) {
    const auto value = [&](std::size_t i) {
      return i < field.numbers() && at + i < numbers.size() ? numbers[at + i] : 0.0f;
    };
    if (field.kind == FieldKind::Radius) all.radius = std::max(0.0f, value(0));
    if (field.kind == FieldKind::Normal) all.normal = normalize(Vec3(value(0), value(1), value(2)));
    if (field.kind == FieldKind::Texture)
      for (std::size_t i = 0; i < field.numbers(); i += 3)
        all.textures.emplace_back(value(i), value(i + 1), value(i + 2));
    if (field.kind == FieldKind::Motion) {
      all.motion.clear();
      for (std::size_t i = 0; i < field.numbers(); i += 3)
        all.motion.emplace_back(value(i), value(i + 1), value(i + 2));
    }
    at += field.numbers();
  }
}

bool is_near(const Vec3& p) {
  return std::abs(p.x) < kFarthest && std::abs(p.y) < kFarthest && std::abs(p.z) < kFarthest;
}

/// Displacement at a share of the motion interval, 0 to 1.
Vec3 way_at(std::span<const Vec3> motion, float share) {
  if (motion.empty()) return Vec3(0);
  const KeysAt at(motion.size() + 1, share);
  const Vec3 from = at.step == 0 ? Vec3(0) : motion[at.step - 1];
  return from * (1 - at.share) + motion[at.step] * at.share;
}

/// Resamples the motion vectors of all points to `steps` steps.
void set_steps(Curves& curves, std::size_t steps) {
  std::vector<std::vector<Vec3>> columns(steps, std::vector<Vec3>(curves.points.size(), Vec3(0)));
  std::vector<Vec3> way(curves.motion.size());
  for (std::size_t i = 0; i < curves.points.size() && !way.empty(); ++i) {
    for (std::size_t m = 0; m < way.size(); ++m) way[m] = curves.motion[m][i];
    for (std::size_t m = 0; m < steps; ++m)
      columns[m][i] = way_at(way, static_cast<float>(m + 1) / static_cast<float>(steps));
  }
  curves.motion = std::move(columns);
}

class HairMaker {
 public:
  HairMaker(Curves& curves, const Hair& hair)
      : curves_(curves),
        hair_(hair),
        degree_(static_cast<std::size_t>(hair.degree.value_or(1))),
        hair_width_(width_of(hair.per_hair)),
        vertex_width_(3 + width_of(hair.per_vertex)) {}

  /// Returns false if the hair is invalid.
  bool add(std::size_t number) {
    const std::span<const float> all(hair_.scalars.data() + hair_.first[number],
                                     hair_.first[number + 1] - hair_.first[number]);
    if (all.size() < hair_width_ || (all.size() - hair_width_) % vertex_width_ != 0) return false;
    const std::size_t vertices = (all.size() - hair_width_) / vertex_width_;
    if (vertices < degree_ + 1) return false;
    Attributes common;
    common.radius = hair_.radius.value_or(1.0f);
    read_fields(hair_.per_hair, all.first(hair_width_), common);
    vertices_.clear();
    for (std::size_t v = 0; v < vertices; ++v) {
      const auto numbers = all.subspan(hair_width_ + v * vertex_width_, vertex_width_);
      const Vec3 p(numbers[0], numbers[1], numbers[2]);
      Vertex& vertex = vertices_.emplace_back(Vertex{p, common});
      read_fields(hair_.per_vertex, numbers.subspan(3), vertex.more);
      const std::vector<Vec3>& motion = vertex.more.motion;
      if (!is_near(p) || !std::all_of(motion.begin(), motion.end(), is_near)) return false;
    }
    const std::size_t pieces = (vertices - 1) / degree_;
    for (std::size_t i = 0; i < pieces; ++i) add_piece(i);
    add_point(vertices_[pieces * degree_]);
    return true;
  }

 private:
  struct Vertex {
    Vec3 p;
    Attributes more;
  };

  /// Adds all points of a piece except the last, which is the first of the next piece.
  void add_piece(std::size_t i) {
    const auto first = static_cast<std::uint32_t>(curves_.points.size());
    (degree_ == 1 ? curves_.lines : curves_.beziers).push_back(first);
    const Vertex* v = &vertices_[i * degree_];
    add_point(v[0]);
    if (degree_ == 3) {
      add_point(v[1]);
      add_point(v[2]);
    } else if (degree_ == 2) {
      add_point(between(v[0], v[1], 2.0f / 3));
      add_point(between(v[2], v[1], 2.0f / 3));
    }
  }

  static Vertex between(const Vertex& a, const Vertex& b, float t) {
    Vertex v = a;
    v.p = a.p * (1 - t) + b.p * t;
    v.more.radius = a.more.radius * (1 - t) + b.more.radius * t;
    for (std::size_t s = 0; s < v.more.textures.size(); ++s)
      v.more.textures[s] = a.more.textures[s] * (1 - t) + b.more.textures[s] * t;
    for (std::size_t m = 0; m < v.more.motion.size(); ++m)
      v.more.motion[m] = a.more.motion[m] * (1 - t) + b.more.motion[m] * t;
    return v;
  }

  void add_point(const Vertex& v) {
    const std::size_t before = curves_.points.size();
    const std::size_t asked = std::min(v.more.motion.size(), kMaxSteps);
    if (curves_.motion.size() < asked) set_steps(curves_, asked);
    const auto steps = static_cast<float>(curves_.motion.size());
    for (std::size_t m = 0; m < curves_.motion.size(); ++m)
      curves_.motion[m].push_back(way_at(v.more.motion, static_cast<float>(m + 1) / steps));
    curves_.points.push_back({v.p, v.more.radius});
    const auto put = [before](std::vector<Vec3>& column, const Vec3& value) {
      column.resize(before, Vec3(0));
      column.push_back(value);
    };
    if (v.more.normal != Vec3(0) || !curves_.normals.empty()) put(curves_.normals, v.more.normal);
    const std::size_t spaces = std::min(v.more.textures.size(), kMaxTextureSpaces);
    if (curves_.textures.size() < spaces) curves_.textures.resize(spaces);
    for (std::size_t s = 0; s < curves_.textures.size(); ++s)
      put(curves_.textures[s], s < spaces ? v.more.textures[s] : Vec3(0));
  }

  Curves& curves_;
  const Hair& hair_;
  std::size_t degree_, hair_width_, vertex_width_;
  std::vector<Vertex> vertices_;
};

/// Lines are numbered before curves, so the slots of curves move up when lines are added.
void set_slots(Mesh& mesh, const MaterialSlot& slot, std::size_t lines_before,
               std::size_t beziers_before) {
  const std::size_t triangles = mesh.triangles.size();
  // An object without polygons has one unused slot.
  if (triangles + lines_before + beziers_before == 0) mesh.slots.clear();
  auto found = std::find(mesh.slots.begin(), mesh.slots.end(), slot);
  if (found == mesh.slots.end()) found = mesh.slots.insert(found, slot);
  const auto number = static_cast<std::uint32_t>(found - mesh.slots.begin());
  mesh.slot.resize(triangles + lines_before + beziers_before, 0);
  mesh.slot.insert(mesh.slot.begin() + static_cast<std::ptrdiff_t>(triangles + lines_before),
                   mesh.curves.lines.size() - lines_before, number);
  mesh.slot.resize(triangles + mesh.curves.size(), number);
  if (mesh.slots.size() == 1) mesh.slot.clear();
}

/// Position, radius and derivative of a piece at u, and the points to interpolate columns between.
struct CurvePoint {
  Vec3 p, tangent;
  float radius;
  std::uint32_t first, last;
  Vec3 speed{0};       ///< per unit of ray time
  float farthest = 0;  ///< largest coordinate of the motion keys
};

CurvePoint evaluate(const Curves& curves, const std::vector<Curves::Point>& points,
                    std::size_t piece, float u) {
  if (piece < curves.lines.size()) {
    const std::uint32_t i = curves.lines[piece];
    const Curves::Point &a = points[i], &b = points[i + 1];
    return {a.p * (1 - u) + b.p * u, b.p - a.p, a.radius * (1 - u) + b.radius * u, i, i + 1};
  }
  const std::uint32_t i = curves.beziers[piece - curves.lines.size()];
  const Curves::Point* c = &points[i];
  const float w = 1 - u;
  const float b[4] = {w * w * w, 3 * w * w * u, 3 * w * u * u, u * u * u};
  CurvePoint at{Vec3(0), Vec3(0), 0, i, i + 3};
  for (int k = 0; k < 4; ++k) {
    at.p += c[k].p * b[k];
    at.radius += c[k].radius * b[k];
  }
  at.tangent = ((c[1].p - c[0].p) * (w * w) + (c[2].p - c[1].p) * (2 * w * u) +
                (c[3].p - c[2].p) * (u * u)) *
               3.0f;
  return at;
}

float largest(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

CurvePoint evaluate_at(const Curves& curves, std::size_t piece, float u, float time) {
  if (curves.keys.empty()) return evaluate(curves, curves.points, piece, u);
  const KeysAt at(curves.keys.size(), time);
  CurvePoint point = evaluate(curves, curves.keys[at.step], piece, u);
  const CurvePoint next = evaluate(curves, curves.keys[at.step + 1], piece, u);
  point.speed = (next.p - point.p) * at.pieces;
  point.farthest = std::max(largest(point.p), largest(next.p));
  point.p = point.p * (1 - at.share) + next.p * at.share;
  point.tangent = point.tangent * (1 - at.share) + next.tangent * at.share;
  return point;
}

}  // namespace

void add_hair(Mesh& mesh, const scene::Hair& hair, Diagnostics& diagnostics) {
  const std::size_t lines = mesh.curves.lines.size(), beziers = mesh.curves.beziers.size();
  HairMaker maker(mesh.curves, hair);
  std::size_t left_out = 0;
  for (std::size_t i = 0; i < hair.size(); ++i) left_out += !maker.add(i);
  if (mesh.curves.lines.size() > lines || mesh.curves.beziers.size() > beziers)
    set_slots(mesh, {hair.material, kNone}, lines, beziers);
  if (left_out > 0)
    diagnostics.warning("OR-GEOM-023", hair.where,
                        fmt::format("{} of {} hairs are skipped: their number of vertices does not "
                                    "match their degree, or of values their fields",
                                    left_out, hair.size()));
}

void interpolate_curve(const Mesh& mesh, const Hit& hit, const Placement& placement,
                       SurfacePoint& point) {
  const Curves& curves = mesh.curves;
  const CurvePoint at = evaluate_at(curves, hit.primitive - mesh.triangles.size(),
                                    clamp(hit.u, 0.0f, 1.0f), hit.time);
  const Mat4* forward = placement.local_to_world;
  Vec3 outward = normalize(forward ? transform_normal(hit.ng, *forward) : hit.ng);
  if (outward == Vec3(0)) outward = Vec3(0, 0, 1);
  const Vec3 local = at.p + outward * at.radius;
  point.p = forward ? transform_point(local, *forward) : local;
  point.ng = point.ns = normalize(hit.ng) == Vec3(0) ? outward : normalize(hit.ng);
  point.dpdu = forward ? transform_vector(at.tangent, *forward) : at.tangent;
  point.dpdv = cross(point.ng, normalize(point.dpdu)) * at.radius;
  point.speed = forward ? transform_vector(at.speed, *forward) : at.speed;
  point.uv_density = 0;
  // Embree finds the surface of a curve iteratively, to about this share of its radius.
  constexpr float kStep = 2e-3f, kRounding = 1e-6f;
  const float stretch =
      forward ? largest(transform_vector(outward * at.radius, *forward)) : at.radius;
  point.offset = kStep * stretch + kRounding * (largest(point.p) + largest(at.p) + at.farthest);
  point.slot = mesh.slot_of(hit.primitive);
  point.primitive = hit.primitive;
  point.texture_count =
      static_cast<std::uint32_t>(std::min(curves.textures.size(), kMaxTextureSpaces));
  const auto along = [&](const std::vector<Vec3>& column) {
    return column[at.first] * (1 - hit.u) + column[at.last] * hit.u;
  };
  // The normal of the underlying skin from the scene, flipped to the visible side.
  if (!curves.normals.empty() && along(curves.normals) != Vec3(0)) {
    const Vec3 normal = along(curves.normals);
    const Vec3 world =
        normalize(forward ? transform_normal(normal, *placement.world_to_local) : normal);
    const float cosine = dot(world, point.ng);
    constexpr float kHorizon = 1e-3f;
    point.ns = cosine < kHorizon ? normalize(world + point.ng * (kHorizon - cosine)) : world;
  }
  for (std::uint32_t s = 0; s < point.texture_count; ++s)
    point.textures[s] = {along(curves.textures[s]), Vec3(0), Vec3(0)};
}

}  // namespace oriel::geom
