// SPDX-License-Identifier: Apache-2.0
#include "lights/portal_table.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/math.h"
#include "base/parallel.h"
#include "color/luminance.h"
#include "lights/light_sampler.h"
#include "lights/moved_light.h"
#include "runtime/environment.h"
#include "runtime/world.h"
#include "sampling/rectangle.h"

namespace oriel {
namespace {

/// Cells each way over half a turn: 0.35 degrees resolve lamps in a photographed sky, a sky from
/// formulas is smooth.
constexpr std::size_t kDetailedSide = 512, kSmoothSide = 128, kDraftSide = 64;
/// The same where a table small enough for the fastest cache will do.
constexpr std::size_t kRoughSide = 32;
/// Luminance of a cell of it over the mean from which on choices go by it; a guess: a clear sky
/// without its sun stays below.
constexpr float kUneven = 4;
/// Mean square of the radiance over the square of its mean, from which on directions are sampled by
/// the table. Below it, samples that are even in solid angle have little more noise and take less
/// time.
constexpr double kStructured = 1.3;
/// Share of the mean radiance added everywhere.
constexpr float kEvenShare = 0.05f;
/// Grazing light that is given up, as for other flat lights.
constexpr float kMinCosine = 1e-6f;

std::size_t side_of(TableDetail detail) {
  if (detail == TableDetail::Draft) return kDraftSide;
  return detail == TableDetail::Detailed ? kDetailedSide : kSmoothSide;
}

/// Coordinate of the table, in [0,1], of the tangent x / z; z above 0.
float uv_of(float x, float z) { return 0.5f * x / (std::abs(x) + z) + 0.5f; }
/// Its inverse.
float tangent_of(float uv) {
  const float s = 2 * uv - 1;
  return s / (1 - std::abs(s));
}

/// Solid angle for each unit of area of the table: a, b are the tangents.
float solid_angle_of(float a, float b) {
  const float s = 1 + a * a + b * b;
  return 4 * sqr((1 + std::abs(a)) * (1 + std::abs(b))) / (s * std::sqrt(s));
}

/// The rectangle seen from a point.
struct Seen {
  float x0, x1, y0, y1, depth;
  sampling::Window window() const { return PortalTable::window(x0, x1, y0, y1, depth); }
};

Seen seen_from(const Light& light, const Vec3& from) {
  const Portal& portal = *light.portal;
  const PortalTable& table = *portal.table;
  const Vec3 to = light.position - from;
  const float x = dot(to, table.x()), y = dot(to, table.y());
  return {x - portal.half_u, x + portal.half_u, y - portal.half_v, y + portal.half_v,
          dot(to, table.z())};
}

}  // namespace

PortalTable::PortalTable(const NodeList& shaders, const World& world, RayKind lookup, const Vec3& x,
                         const Vec3& y, const Vec3& z, TableDetail detail)
    : x_(x), y_(y), z_(z), shaders_(shaders), lookup_(lookup) {
  const std::size_t side = side_of(detail);
  std::vector<float> values(side * side), angles(side * side);
  parallel_for(side, [&](std::size_t j) {
    for (std::size_t i = 0; i < side; ++i) {
      // Four points of a cell: a small bright source between two centres must not be missed.
      for (int k = 0; k < 4; ++k) {
        const auto tangent = [&](std::size_t cell, bool upper) {
          const float at =
              (static_cast<float>(cell) + (upper ? 0.75f : 0.25f)) / static_cast<float>(side);
          return tangent_of(at);
        };
        const float a = tangent(i, k & 1), b = tangent(j, k & 2);
        const float angle = solid_angle_of(a, b) / 4;
        const Vec3 d = normalize(x_ * a + y_ * b + z_);
        const float l = luminance(rgb(environment_radiance(shaders_, world, Vec3(0), d, lookup_)));
        angles[j * side + i] += angle;
        if (std::isfinite(l)) values[j * side + i] += std::max(0.0f, l) * angle;
      }
    }
  });
  double light = 0, angle = 0;  // double: many terms of very different size
  for (std::size_t i = 0; i < values.size(); ++i)
    light += static_cast<double>(values[i]), angle += static_cast<double>(angles[i]);
  lights_ = light > 0;
  mean_luminance_ = static_cast<float>(light / angle);
  double squares = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    squares += static_cast<double>(sqr(values[i]) / angles[i]);
  structured_ = squares * angle > kStructured * sqr(light);
  const float even = kEvenShare * mean_luminance_;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] += even * angles[i];
  table_ = std::make_unique<sampling::WindowedDistribution2D>(values, side, side);
  const std::size_t block = side / kRoughSide;
  std::vector<float> rough(kRoughSide * kRoughSide), rough_angles(kRoughSide * kRoughSide);
  for (std::size_t j = 0; j < side; ++j)
    for (std::size_t i = 0; i < side; ++i) {
      const std::size_t cell = j / block * kRoughSide + i / block;
      rough[cell] += values[j * side + i] / static_cast<float>(block * block);
      rough_angles[cell] += angles[j * side + i] / static_cast<float>(block * block);
    }
  for (std::size_t i = 0; i < rough.size(); ++i)
    uneven_ |= rough[i] > kUneven * mean_luminance_ * rough_angles[i];
  rough_ = std::make_unique<sampling::WindowedDistribution2D>(rough, kRoughSide, kRoughSide);
}

sampling::Window PortalTable::window(float x0, float x1, float y0, float y1, float depth) {
  return {Vec2(uv_of(x0, depth), uv_of(y0, depth)), Vec2(uv_of(x1, depth), uv_of(y1, depth))};
}

PortalTable::Sample PortalTable::sample(Vec2 u, const sampling::Window& window) const {
  const auto s = table_->sample(u, window);
  if (!(s.pdf > 0)) return {};
  const float a = tangent_of(s.uv.x), b = tangent_of(s.uv.y);
  return {normalize(Vec3(a, b, 1)), s.pdf / solid_angle_of(a, b)};
}

float PortalTable::pdf(const Vec3& local, const sampling::Window& window) const {
  const Vec2 uv(uv_of(local.x, local.z), uv_of(local.y, local.z));
  return table_->pdf(uv, window) / solid_angle_of(local.x / local.z, local.y / local.z);
}

float PortalTable::rough_integral(float x0, float x1, float y0, float y1) const {
  return rough_->integral({Vec2(uv_of(x0, 1), uv_of(y0, 1)), Vec2(uv_of(x1, 1), uv_of(y1, 1))});
}

std::optional<ShapeSample> sample_through(const Light& light, const Vec3& from, Vec2 u) {
  const PortalTable& table = *light.portal->table;
  const Seen seen = seen_from(light, from);
  if (!(seen.depth > 0)) return std::nullopt;
  const auto s = table.sample(u, seen.window());
  if (!(s.pdf > 0) || !std::isfinite(s.pdf) || !(s.local.z > kMinCosine)) return std::nullopt;
  ShapeSample sample;
  sample.wi = table.x() * s.local.x + table.y() * s.local.y + table.z() * s.local.z;
  sample.distance = seen.depth / s.local.z;
  sample.position = from + sample.wi * sample.distance;
  sample.cosine = s.local.z;
  sample.pdf = s.pdf;
  return sample;
}

float pdf_through(const Light& light, const Vec3& from, const Vec3& wi) {
  const Seen seen = seen_from(light, from);
  if (!(seen.depth > 0)) return 0;
  const PortalTable& table = *light.portal->table;
  const Vec3 local(dot(wi, table.x()), dot(wi, table.y()), dot(wi, table.z()));
  return local.z > 0 ? table.pdf(local, seen.window()) : 0;
}

Rgb portal_radiance(const Light& light, const Vec3& from, const Vec3& wi, float distance,
                    float cosine, RayKind kind) {
  const Portal& portal = *light.portal;
  Rgb radiance = portal.scale;
  const World& world = *portal.world;
  const bool gathered = !portal.own_environment && portal.lookup == RayKind::FinalGather;
  if (gathered && world.light_sampler && !portal.shaders.empty())
    radiance *= world.light_sampler->environment_radiance({.origin = from, .direction = wi});
  else if (!portal.shaders.empty())
    radiance *= rgb(environment_radiance(portal.shaders, world, from, wi, portal.lookup));
  else if (!portal.own_environment)
    return Rgb(0);
  if (kind != RayKind::Light && kind != RayKind::FinalGather) return radiance;
  // The colour a light shader would give for this sample, of the whole area at its distance.
  const float share = light.area * cosine / (kPi * sqr(distance));
  return max_component(radiance) * share < portal.cutoff ? Rgb(0) : radiance;
}

float mean_luminance(const Portal& portal, float environment) {
  const float scale = luminance(portal.scale);
  if (portal.table) return scale * portal.table->mean_luminance();
  if (portal.shaders.empty()) return portal.own_environment ? scale : 0;
  // Without a table all that is known is what the camera's environment shows, if it is that one.
  return scale * (portal.own_environment ? 1 : environment);
}

PortalDirection sample_portal_direction(const Light& light, Vec2 u) {
  const PortalTable& table = *light.portal->table;
  const auto s = table.sample(u, {});
  return {table.x() * s.local.x + table.y() * s.local.y + table.z() * s.local.z, s.pdf};
}

namespace {

bool crosses_at_rest(const Light& light, const Vec3& from, const Vec3& direction, float t_most) {
  const float facing = -dot(direction, light.direction);
  if (!(facing > kMinCosine)) return false;
  const Vec3 to = light.position - from;
  const float t = -dot(to, light.direction) / facing;
  if (!(t > 0 && t < t_most)) return false;
  const Vec3 local = direction * t - to;
  const Portal& portal = *light.portal;
  return std::abs(dot(local, portal.across_u)) <= 1 && std::abs(dot(local, portal.across_v)) <= 1;
}

/// Whether its axes stay as they are.
bool stays_upright(const Light& light) {
  constexpr float kParallel = 1e-5f;
  return std::all_of(light.path.begin(), light.path.end(), [](const Mat4& m) {
    float most = 0;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        most = std::max(most, std::abs(m[row][column] - (row == column ? 1.0f : 0.0f)));
    return most < kParallel;
  });
}

}  // namespace

bool crosses_portal(const Light& light, const Vec3& from, const Vec3& direction, float t_most,
                    float time) {
  if (is_at_rest(light, time)) return crosses_at_rest(light, from, direction, t_most);
  const MovedLight moved(light, time);
  return crosses_at_rest(light, moved.place_at_rest(from), moved.way_at_rest(direction), t_most);
}

PortalsOnWay portals_on_way(const World& world, const Vec3& from, const Vec3& direction,
                            float t_most, float time, bool mapped) {
  PortalsOnWay way;
  world.light_sampler->portals().for_each_on_way(from, direction, t_most, [&](int index) {
    const Light& light = world.lights[static_cast<std::size_t>(index)];
    const Portal& portal = *light.portal;
    if (!crosses_portal(light, from, direction, t_most, time)) return;
    way.ends_diffuse |= portal.blocks_diffuse_rays() || mapped;
    if (portal.visible)
      way.ends_view = true;
    else
      way.view *= portal.transparency;
  });
  return way;
}

bool is_behind_portal(const World& world, const Vec3& point, const Vec3& to_source, float t_most,
                      float time) {
  bool behind = false;
  world.light_sampler->portals().for_each_on_way(point, to_source, t_most, [&](int index) {
    behind |= crosses_portal(world.lights[static_cast<std::size_t>(index)], point, to_source,
                             t_most, time);
  });
  return behind;
}

void open_portals(World& world, TableDetail detail) {
  std::vector<std::shared_ptr<const PortalTable>> tables;
  for (std::size_t i = 0; i < world.lights.size(); ++i) {
    Light& light = world.lights[i];
    if (!light.portal) continue;
    Portal& portal = *light.portal;
    world.has_tinted_portals |= !portal.visible && portal.transparency != Rgb(1);
    portal.world = &world;
    if (!portal.own_environment)
      portal.shaders = world.environment;
    else if (portal.environment)
      portal.shaders = {portal.environment};
    portal.half_u = length(light.edge_u) / 2;
    portal.half_v = length(light.edge_v) / 2;
    const Vec3 normal = cross(light.edge_u, light.edge_v);
    portal.across_u = cross(light.edge_v, normal) * (2 / dot(normal, normal));
    portal.across_v = cross(normal, light.edge_u) * (2 / dot(normal, normal));
    // The table is for windows of one orientation.
    if (portal.shaders.empty() || !light.axes.square_corners || !stays_upright(light)) continue;
    const Vec3 x = normalize(light.edge_u), y = normalize(light.edge_v);
    const auto same = [&](const std::shared_ptr<const PortalTable>& t) {
      constexpr float kParallel = 1 - 1e-6f;
      return dot(t->x(), x) > kParallel && dot(t->y(), y) > kParallel &&
             dot(t->z(), light.direction) < -kParallel && t->shaders() == portal.shaders &&
             t->lookup() == portal.lookup;
    };
    auto table = std::find_if(tables.begin(), tables.end(), same);
    if (table == tables.end()) {
      tables.push_back(std::make_shared<const PortalTable>(portal.shaders, world, portal.lookup, x,
                                                           y, -light.direction, detail));
      table = tables.end() - 1;
    }
    portal.table = *table;
    if (portal.table->lights()) continue;
    if (detail == TableDetail::Draft)
      portal.table = nullptr;  // a small source may have been missed
    else
      portal.scale = Rgb(0);
  }
}

}  // namespace oriel
