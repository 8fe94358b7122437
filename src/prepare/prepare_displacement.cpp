// SPDX-License-Identifier: Apache-2.0
#include "prepare/prepare_displacement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/math.h"
#include "base/parallel.h"
#include "geom/surface.h"
#include "scene/element_settings.h"
#include "transport/surface.h"

namespace oriel {
namespace {

using geom::kNone;
using geom::Triangle;

/// Minimum cosine (0.8 degrees) at which normals at one position count as equal: exporters write
/// one for each side of a seam of texture coordinates.
constexpr float kSameNormal = 0.9999f;
/// Maximum displacement; beyond ten times this value the ray tracer drops triangles.
constexpr float kFarthest = 1e17f;
/// Maximum number of normals at one position that a vertex is compared with.
constexpr std::size_t kMaxCompared = 16;

/// Unit normal of a facet and the angles at its corners; null and 0 without area.
struct Facet {
  Vec3 normal{0};
  std::array<float, 3> angle{};
};

Facet facet_of(const std::vector<Vec3>& positions, const Triangle& t) {
  // Double precision for the area of small triangles far from the origin.
  const Imath::V3d p[3] = {Imath::V3d(positions[t.a]), Imath::V3d(positions[t.b]),
                           Imath::V3d(positions[t.c])};
  const Imath::V3d n = (p[1] - p[0]).cross(p[2] - p[0]);
  const double area = n.length();
  Facet facet;
  if (!(area > 0)) return facet;
  facet.normal = Vec3(n / area);
  for (int k = 0; k < 3; ++k)
    facet.angle[k] =
        static_cast<float>(math::atan2(area, (p[(k + 1) % 3] - p[k]).dot(p[(k + 2) % 3] - p[k])));
  return facet;
}

/// The rotation by the smallest angle from the unit vector `from` to `to`.
struct Turn {
  Vec3 from{0, 0, 1}, to{0, 0, 1};
  Vec3 operator()(const Vec3& v) const {
    const Vec3 sum = from + to;
    const float cosine = dot(from, to);
    // Opposite directions: any rotation by half a turn is valid.
    if (cosine < -0.9999f) return -v;
    return v - sum * (dot(sum, v) / (1 + cosine)) + to * (2 * dot(from, v));
  }
};

class Displacer {
 public:
  Displacer(geom::Mesh& mesh, const Displacement& shaders, const scene::Leaf& leaf,
            const World& world, float limit)
      : mesh_(mesh), shaders_(shaders), leaf_(leaf), world_(world), limit_(limit) {}

  void run() {
    find_places();
    find_samples();
    evaluate();
    if (!mesh_.normals.empty()) {
      find_bundles();
      before_ = sum_facets();
    }
    move();
    if (!mesh_.normals.empty()) turn_normals();
  }

  std::size_t clamped = 0;
  float largest = 0;  ///< before clamping

 private:
  /// One evaluation: a vertex as a corner of a triangle of one slot.
  struct Sample {
    std::uint32_t triangle = 0, corner = 0;
    float amount = 0;
    /// Further displacement in the mesh's space, by shaders that change the normal or the point.
    Vec3 aside{0};
  };

  static std::uint32_t corner(const Triangle& t, std::size_t k) {
    return k == 0 ? t.a : k == 1 ? t.b : t.c;
  }
  const NodeList& shaders_of(std::size_t triangle) const {
    return shaders_[mesh_.slot_of(static_cast<std::uint32_t>(triangle))];
  }

  /// Assigns one number to all vertices with equal positions.
  void find_places() {
    const std::vector<Vec3>& p = mesh_.positions;
    order_.resize(mesh_.vertex_count());
    std::iota(order_.begin(), order_.end(), 0u);
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      if (p[a].x != p[b].x) return p[a].x < p[b].x;
      if (p[a].y != p[b].y) return p[a].y < p[b].y;
      if (p[a].z != p[b].z) return p[a].z < p[b].z;
      return a < b;
    });
    place_.resize(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) {
      if (i == 0 || p[order_[i]] != p[order_[i - 1]]) ++places_;
      place_[order_[i]] = places_ - 1;
    }
  }

  /// Lists the evaluations: each vertex once for each displaced slot around it.
  void find_samples() {
    std::vector<std::uint32_t> by_slot(mesh_.triangles.size());
    std::iota(by_slot.begin(), by_slot.end(), 0u);
    if (!mesh_.slot.empty())
      std::stable_sort(by_slot.begin(), by_slot.end(), [&](std::uint32_t a, std::uint32_t b) {
        return mesh_.slot[a] < mesh_.slot[b];
      });
    struct Latest {
      std::uint32_t slot = kNone, sample = 0;
    };
    std::vector<Latest> latest(mesh_.vertex_count());
    sample_of_.assign(mesh_.triangles.size() * 3, kNone);
    for (const std::uint32_t i : by_slot) {
      if (shaders_of(i).empty()) continue;
      const std::uint32_t slot = mesh_.slot_of(i);
      for (std::uint32_t k = 0; k < 3; ++k) {
        Latest& known = latest[corner(mesh_.triangles[i], k)];
        if (known.slot != slot) {
          known = {slot, static_cast<std::uint32_t>(samples_.size())};
          samples_.push_back({i, k});
        }
        sample_of_[std::size_t{i} * 3 + k] = known.sample;
      }
    }
  }

  void evaluate() {
    constexpr std::size_t kAtOnce = 512;
    parallel_for_blocks(samples_.size(), kAtOnce, [&](std::size_t i) { ask(samples_[i]); });
    for (Sample& s : samples_) {
      const bool straight = s.aside == Vec3(0);
      const float way = straight ? std::abs(s.amount) : length(s.aside + normal_at(s) * s.amount);
      largest = std::max(largest, way);
      if (!(limit_ > 0 && way > limit_)) continue;
      ++clamped;
      if (straight) {
        s.amount = std::copysign(limit_, s.amount);
      } else {
        s.amount *= limit_ / way;
        s.aside *= limit_ / way;
      }
    }
  }

  /// Unit, in the mesh's space.
  Vec3 normal_at(const Sample& sample) const {
    const Triangle& t = mesh_.triangles[sample.triangle];
    const std::uint32_t vertex = corner(t, sample.corner);
    const bool has_normal = !mesh_.normals.empty() && mesh_.normals[vertex] != Vec3(0);
    return has_normal ? normalize(mesh_.normals[vertex]) : facet_of(mesh_.positions, t).normal;
  }

  void ask(Sample& sample) const {
    const geom::Hit hit{.u = sample.corner == 1 ? 1.0f : 0.0f,
                        .v = sample.corner == 2 ? 1.0f : 0.0f,
                        .primitive = sample.triangle};
    geom::SurfacePoint surface;
    geom::interpolate(mesh_, hit, {&leaf_.local_to_world, &leaf_.world_to_local}, surface);
    ShadingPoint point;
    point.ray_kind = RayKind::Displace;
    point.position = surface.p;
    point.normal = point.geometric_normal = surface.ng;
    const std::uint32_t vertex = corner(mesh_.triangles[sample.triangle], sample.corner);
    if (!mesh_.normals.empty() && mesh_.normals[vertex] != Vec3(0))
      point.normal = normalize(transform_normal(mesh_.normals[vertex], leaf_.world_to_local));
    point.ray_direction = -point.normal;
    point.ray_origin = point.position;
    take_texture_spaces(surface, point);
    point.to_object = &leaf_.world_to_local;
    point.to_world = &leaf_.local_to_world;
    point.world = &world_;
    const ShadingPoint before = point;
    float sum = 0;
    for (const ShaderNode* node : shaders_of(sample.triangle)) sum += node->scalar(point);
    sample.amount = std::isfinite(sum) ? clamp(sum, -kFarthest, kFarthest) : 0;
    // p = point + amount * normal, with both as modified by the shaders.
    Vec3 aside(0);
    if (point.normal != before.normal)
      aside = (in_mesh(point.normal) - normal_at(sample)) * sample.amount;
    if (point.position != before.position)
      aside += transform_vector(point.position - before.position, leaf_.world_to_local);
    if (is_finite(aside) && length(aside) < kFarthest) sample.aside = aside;
  }

  /// A world direction and its length in units of the mesh.
  Vec3 in_mesh(const Vec3& direction) const {
    return normalize(transform_vector(direction, leaf_.world_to_local)) * length(direction);
  }

  void move() {
    struct Mean {
      Imath::V3d direction{0}, aside{0};
      double amount = 0, weight = 0;  // double, so that equal amounts remain equal
    };
    std::vector<Mean> mean(places_);
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      if (shaders_of(i).empty()) continue;
      const Triangle& t = mesh_.triangles[i];
      const Facet facet = facet_of(mesh_.positions, t);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = corner(t, k);
        const bool has_normal = !mesh_.normals.empty() && mesh_.normals[v] != Vec3(0);
        const double angle = facet.angle[k];
        Mean& m = mean[place_[v]];
        m.direction += Imath::V3d(has_normal ? mesh_.normals[v] : facet.normal) * angle;
        const Sample& sample = samples_[sample_of_[i * 3 + k]];
        m.amount += sample.amount * angle;
        m.aside += Imath::V3d(sample.aside) * angle;
        m.weight += angle;
      }
    }
    for (std::size_t v = 0; v < place_.size(); ++v) {
      const Mean& m = mean[place_[v]];
      // Facets with opposite normals have no common direction: they are not displaced.
      if (m.weight > 0 && m.direction.length() > 1e-6 * m.weight)
        mesh_.positions[v] +=
            Vec3(m.direction.normalized() * (m.amount / m.weight) + m.aside / m.weight);
    }
  }

  /// Groups vertices with the same position and normal: the facets around them rotate that normal.
  void find_bundles() {
    bundle_.assign(place_.size(), kNone);
    std::vector<std::uint32_t> here;  // one vertex of each group at the current position
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const std::uint32_t v = order_[i];
      if (i == 0 || place_[v] != place_[order_[i - 1]]) here.clear();
      if (mesh_.normals[v] == Vec3(0)) continue;
      const std::size_t compared = std::min(here.size(), kMaxCompared);
      const auto known = std::find_if(
          here.end() - static_cast<std::ptrdiff_t>(compared), here.end(), [&](std::uint32_t other) {
            return dot(mesh_.normals[v], mesh_.normals[other]) > kSameNormal;
          });
      if (known != here.end()) {
        bundle_[v] = bundle_[*known];
      } else {
        bundle_[v] = bundles_++;
        here.push_back(v);
      }
    }
  }

  /// Mean normals of the facets around each group, weighted by their angles there; not unit.
  std::vector<Vec3> sum_facets() const {
    std::vector<Vec3> sums(bundles_, Vec3(0));
    for (const Triangle& t : mesh_.triangles) {
      const Facet facet = facet_of(mesh_.positions, t);
      for (std::size_t k = 0; k < 3; ++k)
        if (const std::uint32_t b = bundle_[corner(t, k)]; b != kNone)
          sums[b] += facet.normal * facet.angle[k];
    }
    return sums;
  }

  void turn_normals() {
    const std::vector<Vec3> after = sum_facets();
    const auto turn_all = [&](std::vector<Vec3>& column, bool unit) {
      if (column.empty()) return;
      for (std::size_t v = 0; v < bundle_.size(); ++v) {
        const std::uint32_t b = bundle_[v];
        if (b == kNone || before_[b] == after[b]) continue;
        const Turn turn{normalize(before_[b]), normalize(after[b])};
        if (turn.from == Vec3(0) || turn.to == Vec3(0)) continue;
        column[v] = unit ? normalize(turn(column[v])) : turn(column[v]);
      }
    };
    turn_all(mesh_.normals, true);
    for (geom::TextureSpace& space : mesh_.textures) {
      turn_all(space.basis_u, false);
      turn_all(space.basis_v, false);
    }
    turn_all(mesh_.dpdu, false);
    turn_all(mesh_.dpdv, false);
  }

  geom::Mesh& mesh_;
  const Displacement& shaders_;
  const scene::Leaf& leaf_;
  const World& world_;
  float limit_;
  std::vector<std::uint32_t> order_;      // vertices by position
  std::vector<std::uint32_t> place_;      // per vertex
  std::vector<std::uint32_t> bundle_;     // per vertex; kNone without normal
  std::vector<std::uint32_t> sample_of_;  // per corner; kNone without displacement
  std::vector<Sample> samples_;
  std::vector<Vec3> before_;  // facets around each group before displacement
  std::uint32_t places_ = 0, bundles_ = 0;
};

float limit_of(const scene::Object& object, const scene::RenderOptions& options) {
  const float limit = scene::settings_of(object).max_displace;
  return limit > 0 ? limit : options.max_displace;
}

}  // namespace

Displacement displacement_of(std::span<const int> materials, const World& world) {
  const auto shaders = [&](int material) -> const NodeList& {
    return world.materials[static_cast<std::size_t>(material)].displace;
  };
  if (!world.options.displace ||
      std::all_of(materials.begin(), materials.end(), [&](int m) { return shaders(m).empty(); }))
    return {};
  Displacement displacement;
  displacement.reserve(materials.size());
  for (const int m : materials) displacement.push_back(shaders(m));
  return displacement;
}

void displace(geom::Mesh& mesh, const Displacement& displacement, const scene::Leaf& leaf,
              const World& world, Diagnostics& diagnostics) {
  if (displacement.empty() || mesh.empty()) return;
  const scene::Object& object = *leaf.object();
  const float limit = limit_of(object, world.options);
  Displacer displacer(mesh, displacement, leaf, world, limit);
  displacer.run();
  if (displacer.clamped > 0)
    diagnostics.warning(
        "OR-RN-031", object.where,
        fmt::format("object \"{}\": displacement reaches {:.4g}, `max displace` allows {:.4g}; "
                    "clamped at {} vertices",
                    object.name, displacer.largest, limit, displacer.clamped),
        "raise `max displace` of the object or the options");
}

}  // namespace oriel
