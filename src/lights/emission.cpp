// SPDX-License-Identifier: Apache-2.0
#include "lights/emission.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include "base/parallel.h"
#include "color/luminance.h"
#include "geom/motion.h"
#include "lights/open_sides.h"
#include "runtime/fill_point.h"
#include "runtime/tracer.h"

namespace oriel {
namespace {

/// Triangles that are probed of each instance.
constexpr std::uint32_t kTrianglesProbed = 16;

/// A tracer of an empty scene; records whether the shader asks for light.
class EmptyTracer final : public Tracer {
 public:
  bool asked = false;

  std::optional<Met> probe(const Vec3&, const Vec3&, float) override { return std::nullopt; }
  std::optional<Met> probe_from(const ShadingPoint&, const Vec3&, float) override {
    return std::nullopt;
  }
  PickedLights pick_lights(const Vec3&) override {
    asked = true;
    return {};
  }
  std::optional<Arriving> light(int, ShadingPoint&) override {
    asked = true;
    return std::nullopt;
  }
  Vec2 next() override { return Vec2(0.5f); }
  Depth depth() const override { return {}; }
  Seen trace(const ShadingPoint&, const SubRay&) override {
    asked = true;
    return {};
  }
  Rgb irradiance(const ShadingPoint&, const Vec3&) override {
    asked = true;
    return Rgb(0);
  }
  Rgba shade(const NodeList&, ShadingPoint&, MaterialOutputs*) override {
    asked = true;
    return Rgba(0);
  }
  bool write_buffer(std::size_t, const Rgba&) override { return false; }
  std::optional<Rgba> read_buffer(std::size_t) const override { return std::nullopt; }
};

}  // namespace

bool may_emit(const Material& material) {
  return std::any_of(material.surface.begin(), material.surface.end(), [](const ShaderNode* node) {
    return !node->spec().material.may_emit || node->spec().material.may_emit(*node);
  });
}

TriangleCorners corners_of(const World& world, std::uint32_t instance, std::uint32_t primitive,
                           float time) {
  const geom::InstanceDesc& desc = world.accel->instance(instance);
  const geom::Mesh& mesh = world.accel->mesh(desc.mesh);
  const auto at = geom::corners_at(mesh, mesh.triangles[primitive], time);
  TriangleCorners corners{at[0], at[1], at[2]};
  if (world.accel->is_baked(desc.mesh)) return corners;
  const Mat4 forward = desc.path.empty() ? desc.local_to_world : geom::matrix_at(desc.path, time);
  for (Vec3* p : {&corners.a, &corners.b, &corners.c}) *p = transform_point(*p, forward);
  return corners;
}

ShadingPoint point_of_triangle(const World& world, std::uint32_t instance, std::uint32_t primitive,
                               float u, float v, bool from_behind, RayKind kind) {
  geom::Hit hit;
  hit.t = 1;
  hit.u = u;
  hit.v = v;
  hit.instance = instance;
  hit.primitive = primitive;
  hit.time = world.shutter.middle();
  geom::SurfacePoint surface;
  world.accel->interpolate(hit, surface);
  geom::Ray ray;
  ray.dir = from_behind ? surface.ng : -surface.ng;
  ray.org = surface.p - ray.dir;
  ShadingPoint point;
  fill_point(world, ray, hit, {}, kind, point);
  return point;
}

SurfaceEmission emission_at(const Material& material, ShadingPoint& point) {
  EmptyTracer tracer;
  point.tracer = &tracer;
  Closure closure;
  shade(material, point, closure);
  point.tracer = nullptr;
  return {closure.emission * closure.opacity, tracer.asked};
}

std::vector<EmissionKind> emissive_materials(const World& world) {
  std::vector<EmissionKind> kinds(world.materials.size(), EmissionKind::None);
  std::vector<int> left(world.materials.size());
  for (std::size_t m = 0; m < left.size(); ++m)
    left[m] = may_emit(world.materials[m]) ? kEmissionProbes : 0;
  for (std::uint32_t i = 0; i < world.accel->instance_count(); ++i) {
    const geom::InstanceDesc& desc = world.accel->instance(i);
    const std::vector<int>& worn = world.instances[desc.user].materials;
    if (std::none_of(worn.begin(), worn.end(),
                     [&](int m) { return left[static_cast<std::size_t>(m)] > 0; }))
      continue;
    const geom::Mesh& mesh = world.accel->mesh(desc.mesh);
    const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
    const std::uint32_t step = std::max(1u, count / kTrianglesProbed);
    for (std::uint32_t t = step / 2; t < count; t += step) {
      const auto m = static_cast<std::size_t>(worn[mesh.slot_of(t)]);
      if (left[m] <= 0) continue;
      for (const bool behind : {false, true})
        // Some materials show the camera an emission that does not light the scene.
        for (const RayKind kind : {RayKind::FinalGather, RayKind::Eye}) {
          ShadingPoint point = point_of_triangle(world, i, t, 1 / 3.0f, 1 / 3.0f, behind, kind);
          const SurfaceEmission emission = emission_at(world.materials[m], point);
          if (emission.of_lights)
            kinds[m] = EmissionKind::OfLights;
          else if (max_component(emission.radiance) > 0 && kinds[m] == EmissionKind::None)
            kinds[m] = EmissionKind::Source;
        }
      left[m] = kinds[m] != EmissionKind::None ? 0 : left[m] - 1;
    }
  }
  return kinds;
}

std::vector<EmissionKind> emissive_instances(const World& world,
                                             const std::vector<EmissionKind>& materials) {
  std::vector<EmissionKind> kinds(world.instances.size(), EmissionKind::None);
  for (std::size_t i = 0; i < kinds.size(); ++i)
    for (const int m : world.instances[i].materials) {
      const EmissionKind kind = materials[static_cast<std::size_t>(m)];
      if (kind != EmissionKind::None && kinds[i] != EmissionKind::Source) kinds[i] = kind;
    }
  return kinds;
}

namespace {

/// Points of a triangle that are probed, as weights of corners b and c; in large meshes only the
/// first.
constexpr Vec2 kPlaces[] = {
    {1 / 3.0f, 1 / 3.0f}, {1 / 6.0f, 1 / 6.0f}, {2 / 3.0f, 1 / 6.0f}, {1 / 6.0f, 2 / 3.0f}};
constexpr std::size_t kLargeMesh = 50000;
/// Groups of triangles whose sides are probed, over all instances; at least one for each of them.
constexpr std::size_t kGroups = 1024;
/// Share of its light that an enclosed side counts with, at least.
constexpr float kLeastOpen = 1 / 64.0f;

/// The tree uses only the box: a few times are enough.
void extend_over_time(const World& world, std::uint32_t instance, std::uint32_t triangle,
                      geom::Box3& box) {
  constexpr int kTimes = 8;
  for (int i = 0; i <= kTimes; ++i) {
    const TriangleCorners at =
        corners_of(world, instance, triangle, world.shutter.at(static_cast<float>(i) / kTimes));
    for (const Vec3& p : {at.a, at.b, at.c}) box.extendBy(p);
  }
}

struct Sides {
  float front = 0, back = 0;  ///< luminance, means over the places
};

Sides sides_of(const World& world, const Material& material, std::uint32_t instance,
               std::uint32_t primitive, std::size_t places) {
  Sides sides;
  for (std::size_t i = 0; i < places; ++i)
    for (const bool behind : {false, true}) {
      ShadingPoint point = point_of_triangle(world, instance, primitive, kPlaces[i].x, kPlaces[i].y,
                                             behind, RayKind::FinalGather);
      const float l = luminance(emission_at(material, point).radiance) / static_cast<float>(places);
      if (l > 0 && std::isfinite(l)) (behind ? sides.back : sides.front) += l;
    }
  return sides;
}

/// The emissive triangles of one instance.
struct EmissiveInstance {
  std::uint32_t instance = 0;
  std::vector<EmissiveTriangle> triangles;
  std::vector<LightBounds> bounds;
  double power = 0, power_times_radiance = 0, area = 0;  ///< double: millions of terms
};

/// Sets the side that shines to open places, and how much the other one does beside it.
void set_sides(const Sides& sides, const OpenSides::Shares& open, const Vec3& front,
               LightBounds& bounds) {
  const float a = sides.front * std::max(open.front, kLeastOpen),
              b = sides.back * std::max(open.back, kLeastOpen);
  bounds.normals = {a >= b ? front : -front, 1};
  bounds.cos_reach = 0;
  bounds.behind = std::min(a, b) / std::max(a, b);
}

/// Inputs:  groups: of neighbouring triangles, whose sides are probed together.
EmissiveInstance emissive_triangles(const World& world, std::uint32_t instance,
                                    const std::vector<EmissionKind>& materials,
                                    std::size_t groups) {
  EmissiveInstance out;
  out.instance = instance;
  const geom::InstanceDesc& desc = world.accel->instance(instance);
  const std::vector<int>& worn = world.instances[desc.user].materials;
  const geom::Mesh& mesh = world.accel->mesh(desc.mesh);
  const std::size_t places = mesh.triangles.size() > kLargeMesh ? 1 : std::size(kPlaces);
  std::vector<Sides> sides(mesh.triangles.size());
  constexpr std::size_t kBatch = 256;
  parallel_for_blocks(sides.size(), kBatch, [&](std::size_t i) {
    const auto t = static_cast<std::uint32_t>(i);
    const auto m = static_cast<std::size_t>(worn[mesh.slot_of(t)]);
    if (materials[m] == EmissionKind::Source)
      sides[i] = sides_of(world, world.materials[m], instance, t, places);
  });
  const bool moves = !desc.path.empty() || !mesh.keys.empty();
  std::optional<OpenSides> open;
  if (!moves && std::any_of(sides.begin(), sides.end(),
                            [](const Sides& s) { return s.front > 0 && s.back > 0; }))
    open.emplace(world, instance, materials, groups);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Sides& g = sides[i];
    const auto t = static_cast<std::uint32_t>(i);
    const TriangleCorners corners = corners_of(world, instance, t, world.shutter.middle());
    const Vec3 normal = corners.normal_times_area();
    const float area = length(normal), brightest = std::max(g.front, g.back);
    const float power = (g.front + g.back) * area;
    if (!(power > 0) || !std::isfinite(power)) continue;
    LightBounds b;
    for (const Vec3& p : {corners.a, corners.b, corners.c}) b.box.extendBy(p);
    b.falling = brightest * area;
    if (moves) {
      // The normal of a moving triangle changes.
      extend_over_time(world, instance, t, b.box);
    } else {
      // The front is where the accel's normal points, which mirrored instances turn over.
      geom::Hit hit;
      hit.u = hit.v = 1 / 3.0f;
      hit.instance = instance;
      hit.primitive = t;
      geom::SurfacePoint surface;
      world.accel->interpolate(hit, surface);
      set_sides(g, open ? open->at(t) : OpenSides::Shares{1, 1}, surface.ng, b);
      b.thickness = std::abs(dot(surface.ng, b.box.center() - corners.a));
    }
    out.triangles.push_back({instance, t, power});
    out.bounds.push_back(b);
    out.power += static_cast<double>(power);
    out.power_times_radiance += static_cast<double>(power * brightest);
    out.area += static_cast<double>(area);
  }
  return out;
}

}  // namespace

MeshLights mesh_lights_of(const World& world, const std::vector<EmissionKind>& materials) {
  const auto triangles_of = [&](std::uint32_t instance) {
    return world.accel->mesh(world.accel->instance(instance).mesh).triangles.size();
  };
  std::vector<std::uint32_t> emitters;
  std::size_t all = 0;
  for (std::uint32_t i = 0; i < world.accel->instance_count(); ++i) {
    const geom::InstanceDesc& desc = world.accel->instance(i);
    const std::vector<int>& worn = world.instances[desc.user].materials;
    if (!(desc.mask & geom::RayMask::FinalGather) ||
        std::none_of(worn.begin(), worn.end(), [&](int m) {
          return materials[static_cast<std::size_t>(m)] == EmissionKind::Source;
        }))
      continue;
    emitters.push_back(i);
    all += triangles_of(i);
  }
  std::vector<EmissiveInstance> found;
  for (const std::uint32_t i : emitters) {
    const std::size_t groups = all > kGroups ? kGroups * triangles_of(i) / all : triangles_of(i);
    if (EmissiveInstance g = emissive_triangles(world, i, materials, groups); !g.triangles.empty())
      found.push_back(std::move(g));
  }
  // The brightest first: there is a limit.
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return a.power * b.area > b.power * a.area;
  });
  std::vector<EmissiveTriangle> triangles;
  std::vector<LightBounds> bounds;
  std::vector<std::uint32_t> of_instance(world.accel->instance_count());
  double power = 0, power_times_radiance = 0;
  for (EmissiveInstance& g : found) {
    if (triangles.size() + g.triangles.size() > kMaxEmissiveTriangles) continue;
    of_instance[g.instance] = static_cast<std::uint32_t>(triangles_of(g.instance));
    triangles.insert(triangles.end(), g.triangles.begin(), g.triangles.end());
    bounds.insert(bounds.end(), g.bounds.begin(), g.bounds.end());
    power += g.power;
    power_times_radiance += g.power_times_radiance;
    g = {};
  }
  if (triangles.empty()) return {};
  const Vec3 size = world.accel->bounds().size();
  const double box = 2 * static_cast<double>(size.x * size.y + size.y * size.z + size.z * size.x);
  // Area that would have the same power all of the same brightness; two sides count as two.
  const double width = power * power / power_times_radiance;
  if (width > static_cast<double>(kWideShare) * box) return {};
  return {std::move(triangles), bounds, of_instance};
}

}  // namespace oriel
