// SPDX-License-Identifier: Apache-2.0
#include "transport/manifold/specular_chain.h"

#include <algorithm>
#include <cmath>

namespace oriel {
namespace {

/// Maximum number of Newton steps and of times that a step is shortened.
constexpr int kMostSteps = 10, kMostCuts = 3;
/// A chain ends at the target if it misses it by less than this angle (radians), and if Newton's
/// next step is smaller than kSettledStep.
constexpr float kMiss = 1e-3f, kSettledStep = 2e-4f;
/// Longest step, radians.
constexpr float kLongestStep = 0.3f;
/// A step must reduce the miss to this share.
constexpr float kProgress = 0.8f;
/// Least cosine between an interface and a ray.
constexpr float kLeastCosine = 1e-3f;

/// An interface at a hit, with the derivative of its shading normal along the surface.
struct Interface {
  geom::SurfacePoint point;
  Vec3 e1{0}, e2{0};  ///< edges of the triangle, world
  Vec3 n1{0}, n2{0};  ///< differences of the vertex normals along them, of the length of `raw`
  float inverse_length = 0;  ///< of the interpolated normal; 0 = flat

  /// Derivative of the unit shading normal along a displacement on the triangle.
  Vec3 turn(const Vec3& moved) const {
    if (inverse_length == 0) return Vec3(0);
    const Vec3 across = cross(e1, e2);
    const float area2 = dot(across, across);
    const float u = dot(cross(moved, e2), across) / area2;
    const float v = dot(cross(e1, moved), across) / area2;
    const Vec3 raw = (n1 * u + n2 * v) * inverse_length;
    return raw - point.ns * dot(point.ns, raw);
  }
};

void place_interface(const World& world, const geom::Hit& hit, Interface& at) {
  world.accel->interpolate(hit, at.point);
  const geom::InstanceDesc& desc = world.accel->instance(hit.instance);
  const geom::Mesh& mesh = world.accel->mesh(desc.mesh);
  if (mesh.normals.empty() || hit.primitive >= mesh.triangles.size()) return;
  const geom::Triangle& t = mesh.triangles[hit.primitive];
  const bool baked = world.accel->is_baked(desc.mesh);
  const auto edge = [&](std::uint32_t to) {
    const Vec3 e = mesh.positions[to] - mesh.positions[t.a];
    return baked ? e : transform_vector(e, desc.local_to_world);
  };
  Vec3 normals[3] = {mesh.normals[t.a], mesh.normals[t.b], mesh.normals[t.c]};
  if (normals[0] == normals[1] && normals[0] == normals[2]) return;
  for (Vec3& n : normals) {
    if (n == Vec3(0)) return;
    if (!baked) n = transform_normal(n, desc.world_to_local);
  }
  at.e1 = edge(t.b);
  at.e2 = edge(t.c);
  const Vec3 raw = normals[0] * (1 - hit.u - hit.v) + normals[1] * hit.u + normals[2] * hit.v;
  const float inverse = 1 / length(raw);
  at.inverse_length = dot(raw, at.point.ns) < 0 ? -inverse : inverse;
  at.n1 = normals[1] - normals[0];
  at.n2 = normals[2] - normals[0];
}

/// The last ray, with its derivatives.
struct Bundle {
  Vec3 d, dp[2], dd[2];
};

/// Mirrors the bundle. n: against the ray, dn: its derivatives.
void reflect(Bundle& b, const Vec3& n, const Vec3 dn[2]) {
  const float c = dot(b.d, n);
  for (int k = 0; k < 2; ++k)
    b.dd[k] = b.dd[k] - (n * (dot(b.dd[k], n) + dot(b.d, dn[k])) + dn[k] * c) * 2;
  b.d = normalize(b.d - n * (2 * c));
}

/// Refracts the bundle. False: total reflection.
bool refract(Bundle& b, const Vec3& n, const Vec3 dn[2], float eta) {
  const float mu = 1 / eta, c = -dot(b.d, n);
  const float g2 = 1 - (1 - c * c) * mu * mu;
  if (!(g2 > 1e-6f)) return false;
  const float g = std::sqrt(g2);
  for (int k = 0; k < 2; ++k) {
    const float dc = -(dot(b.dd[k], n) + dot(b.d, dn[k]));
    const float dg = mu * mu * c * dc / g;
    b.dd[k] = b.dd[k] * mu + n * (mu * dc - dg) + dn[k] * (mu * c - g);
  }
  b.d = normalize(b.d * mu + n * (mu * c - g));
  return true;
}

/// The plane of the target, perpendicular to the chain.
struct Arrival {
  Vec2 miss{0};        ///< by how much the chain passes the target
  Vec2 columns[2];     ///< derivatives of the place where it arrives
  float angle = 0;     ///< the miss as seen from the last interface, radians
  bool ahead = false;  ///< the target is before the end of the chain
};

Arrival arrive(const SpecularChain& chain, const ChainTarget& target) {
  Arrival a;
  const Frame frame(chain.direction);
  const auto across = [&](const Vec3& v) { return Vec2(dot(v, frame.s), dot(v, frame.t)); };
  if (target.endless) {
    a.ahead = dot(target.at, chain.direction) > 0;
    a.miss = across(target.at);
    for (int k = 0; k < 2; ++k) a.columns[k] = across(chain.turn[k]);
    a.angle = a.miss.length();
    return a;
  }
  const Vec3 to = target.at - chain.position;
  const float distance = dot(to, chain.direction);
  a.ahead = distance > 0;
  a.miss = across(to);
  for (int k = 0; k < 2; ++k) a.columns[k] = across(chain.by[k] + chain.turn[k] * distance);
  a.angle = a.ahead ? a.miss.length() / distance : 1;
  return a;
}

float determinant(const Arrival& a) {
  return a.columns[0].x * a.columns[1].y - a.columns[1].x * a.columns[0].y;
}

/// Newton's step. False: it is not determined.
bool step_of(const Arrival& a, Vec2& step) {
  const float det = determinant(a);
  const float scale = a.columns[0].length2() + a.columns[1].length2();
  if (!(std::abs(det) > 1e-6f * scale)) return false;
  step.x = (a.miss.x * a.columns[1].y - a.columns[1].x * a.miss.y) / det;
  step.y = (a.columns[0].x * a.miss.y - a.miss.x * a.columns[0].y) / det;
  return std::isfinite(step.x) && std::isfinite(step.y);
}

}  // namespace

bool trace_chain(const World& world, const ChainReceiver& from, const ChainKind& kind,
                 const Vec3& first, SpecularChain& chain, RayCounts& counts) {
  const Frame frame(first);
  chain.first = first;
  geom::Ray ray;
  ray.org =
      from.position + from.normal * (dot(first, from.normal) < 0 ? -from.offset : from.offset);
  ray.dir = first;
  ray.mask = geom::RayMask::FinalGather;
  ray.time = from.time;
  Vec3 left = from.position;
  Bundle b{first, {Vec3(0), Vec3(0)}, {frame.s, frame.t}};
  for (int i = 0; i < kind.count; ++i) {
    geom::Hit& hit = chain.hit[i];
    ++counts.gather;
    if (!world.accel->intersect(ray, hit)) return false;
    if (static_cast<std::int32_t>(world.accel->instance(hit.instance).user) != kind.instance[i])
      return false;
    Interface at;
    place_interface(world, hit, at);
    const geom::SurfacePoint& point = at.point;
    const float side = dot(point.ng, b.d) > 0 ? -1.0f : 1.0f;
    const Vec3 ng = point.ng * side, n = point.ns * side;
    const float slant = dot(b.d, ng);
    if (slant > -kLeastCosine || dot(b.d, n) > -kLeastCosine) return false;
    const float t = dot(point.p - left, b.d);
    Vec3 dn[2];
    for (int k = 0; k < 2; ++k) {
      const Vec3 moved = b.dp[k] + b.dd[k] * t;
      b.dp[k] = moved - b.d * (dot(moved, ng) / slant);
      dn[k] = at.turn(b.dp[k]) * side;
    }
    chain.ray[i] = ray;
    chain.normal[i] = n;
    if (kind.refracts(i)) {
      if (!refract(b, n, dn, kind.eta[i]) || dot(b.d, ng) >= 0) return false;
    } else {
      reflect(b, n, dn);
      if (dot(b.d, ng) <= 0) return false;
    }
    left = point.p;
    ray.org = point.ray_origin(b.d);
    ray.dir = b.d;
  }
  chain.position = left;
  chain.direction = b.d;
  chain.last = ray;
  for (int k = 0; k < 2; ++k) chain.by[k] = b.dp[k], chain.turn[k] = b.dd[k];
  return true;
}

std::optional<SpecularChain> find_chain(const World& world, const ChainReceiver& from,
                                        const ChainKind& kind, const Vec3& first,
                                        const ChainTarget& target, RayCounts& counts) {
  SpecularChain chain, next;
  if (!trace_chain(world, from, kind, first, chain, counts)) return std::nullopt;
  Arrival arrival = arrive(chain, target);
  for (int i = 0; i < kMostSteps && arrival.ahead; ++i) {
    Vec2 step;
    if (!step_of(arrival, step)) return std::nullopt;
    const float size = step.length();
    if (arrival.angle < kMiss && size < kSettledStep) return chain;
    if (size > kLongestStep) step *= kLongestStep / size;
    const Frame frame(chain.first);
    bool better = false;
    for (int cut = 0; cut < kMostCuts && !better; ++cut, step *= 0.3f) {
      const Vec3 moved = normalize(chain.first + frame.s * step.x + frame.t * step.y);
      if (dot(moved, from.normal) <= 0) continue;
      if (!trace_chain(world, from, kind, moved, next, counts)) continue;
      const Arrival there = arrive(next, target);
      better = there.ahead && there.angle < kProgress * std::max(arrival.angle, 1e-5f);
      if (better) arrival = there;
    }
    if (!better) return std::nullopt;
    chain = next;
  }
  return std::nullopt;
}

float concentration(const ChainKind& kind, const SpecularChain& chain, const ChainTarget& target) {
  const float det = std::abs(determinant(arrive(chain, target)));
  if (!(det > 0)) return 0;
  float indices = 1;
  for (int i = 0; i < kind.count; ++i)
    if (kind.refracts(i)) indices *= kind.eta[i];
  const float result = 1 / (det * indices * indices);
  return std::isfinite(result) ? result : 0;
}

}  // namespace oriel
