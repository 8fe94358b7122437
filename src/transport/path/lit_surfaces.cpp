// SPDX-License-Identifier: Apache-2.0
#include "transport/path/lit_surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "lights/sample_light.h"
#include "sampling/sampler.h"
#include "sampling/warp.h"
#include "transport/surface.h"

namespace oriel {
namespace {

/// Camera rays that are followed to find lit surfaces, in groups that threads share, and surfaces
/// that each of them meets.
constexpr std::size_t kPaths = 16384, kPathsOfGroup = 128;
/// Groups after which it is decided whether there are too many lit surfaces.
constexpr std::size_t kFirstGroups = 16;
constexpr int kSurfaces = 4, kMaxTransparent = 8;
/// Share of lit surfaces from which on rays find them often enough.
constexpr float kMostLit = 0.15f;
/// Fewer lit surfaces say too little about where they are.
constexpr std::size_t kFewestFound = 16;
/// Cells along each side of the rectangle of a light.
constexpr std::size_t kCells = 64;

bool is_usable(const Light& light) {
  return light.shape == LightShape::Directional && light.path.empty() && !light.placed_by_shader &&
         light.shader && !light.shader->runs_code_of_users() && gives_direct_light(light);
}

}  // namespace

/// A surface that a light reaches.
struct LitSurfaces::Lit {
  int light = 0;
  Vec3 position{0};
  float cosine = 0;
};

namespace {

/// Follows camera rays over surfaces as if all were diffuse.
class LitWalk {
 public:
  LitWalk(const World& world, const std::vector<int>& lights) : world_(world), lights_(lights) {}

  template <class F>
  void follow(Vec2 raster, sampling::Sampler& sampler, F&& on_lit) {
    const Camera::Ray eye = world_.camera.ray(raster);
    geom::Ray ray;
    ray.org = eye.origin;
    ray.dir = eye.direction;
    ray.time = eye.time;
    ray.mask = geom::RayMask::Camera;
    int transparent = 0;
    for (int i = 0; i < kSurfaces;) {
      geom::Hit hit;
      ++rays;
      if (!world_.accel->intersect(ray, hit)) return;
      ShadingPoint point;
      fill_point(world_, ray, hit, {}, RayKind::FinalGather, point);
      if (material_of(world_, hit).may_transmit) {
        if (++transparent > kMaxTransparent) return;
        ray = leave(point, ray.dir, std::numeric_limits<float>::infinity(), ray.mask);
        continue;
      }
      if (i++ > 0) {
        ++surfaces;
        test(point, on_lit);
      }
      const Vec3 out = Frame(point.geometric_normal)
                           .to_world(sampling::sample_cosine_hemisphere(sampler.next_2d()));
      ray = leave(point, out, std::numeric_limits<float>::infinity(), geom::RayMask::FinalGather);
    }
  }

  std::uint64_t rays = 0, surfaces = 0;

 private:
  template <class F>
  void test(const ShadingPoint& point, F&& on_lit) {
    for (const int light : lights_) {
      const Vec3 to_light = -world_.lights[static_cast<std::size_t>(light)].direction;
      const float cosine = dot(point.geometric_normal, to_light);
      if (!(cosine > 0)) continue;
      ++rays;
      const float endless = std::numeric_limits<float>::infinity();
      if (!world_.accel->occluded(leave(point, to_light, endless, geom::RayMask::Shadow)))
        on_lit(light, point.position, cosine);
    }
  }

  const World& world_;
  const std::vector<int>& lights_;
};

/// The cells with the shares of their neighbours, since few rays were followed.
std::vector<float> smoothed(const std::vector<float>& cells) {
  std::vector<float> out(cells.size(), 0.0f);
  const auto at = [&](std::size_t x, std::size_t y) { return y * kCells + x; };
  for (std::size_t y = 0; y < kCells; ++y)
    for (std::size_t x = 0; x < kCells; ++x) {
      if (cells[at(x, y)] == 0) continue;
      for (std::size_t j = std::max<std::size_t>(y, 1) - 1; j <= std::min(y + 1, kCells - 1); ++j)
        for (std::size_t i = std::max<std::size_t>(x, 1) - 1; i <= std::min(x + 1, kCells - 1); ++i)
          out[at(i, j)] += cells[at(x, y)];
    }
  return out;
}

}  // namespace

LitSurfaces::LitSurfaces(const World& world, const Window& window, std::uint32_t seed,
                         RayCounts& counts)
    : world_(&world) {
  std::vector<int> lights;
  for (std::size_t i = 0; i < world.lights.size(); ++i)
    if (is_usable(world.lights[i])) lights.push_back(static_cast<int>(i));
  if (lights.empty() || window.width() <= 0 || window.height() <= 0) return;
  struct Group {
    std::vector<Lit> lit;
    std::uint64_t rays = 0, surfaces = 0;
  };
  const auto follow = [&](std::size_t g) {
    Group group;
    LitWalk walk(world, lights);
    for (std::size_t i = 0; i < kPathsOfGroup; ++i) {
      const auto index = static_cast<std::uint32_t>(g * kPathsOfGroup + i);
      sampling::Sampler sampler(0, 0, index, seed);
      const Vec2 u = sampler.next_2d();
      const Vec2 raster(static_cast<float>(window.x0) + u.x * static_cast<float>(window.width()),
                        static_cast<float>(window.y0) + u.y * static_cast<float>(window.height()));
      walk.follow(raster, sampler, [&](int light, const Vec3& position, float cosine) {
        group.lit.push_back({light, position, cosine});
      });
    }
    group.rays = walk.rays;
    group.surfaces = walk.surfaces;
    return group;
  };
  std::vector<Lit> lit;
  std::uint64_t surfaces = 0;
  constexpr std::size_t kEnds[] = {0, kFirstGroups, kPaths / kPathsOfGroup};
  for (int k = 0; k < 2; ++k) {
    const std::size_t first = kEnds[k], last = kEnds[k + 1];
    std::vector<Group> groups(last - first);
    parallel_for(groups.size(), [&](std::size_t g) { groups[g] = follow(first + g); });
    for (const Group& group : groups) {
      lit.insert(lit.end(), group.lit.begin(), group.lit.end());
      counts.gather += group.rays;
      surfaces += group.surfaces;
    }
    if (static_cast<float>(lit.size()) > kMostLit * static_cast<float>(surfaces)) return;
  }
  for (const int light : lights) add_beam(light, lit);
  float total = 0;
  for (const Beam& beam : beams_) total += beam.probability;
  for (Beam& beam : beams_) beam.probability /= total;
}

/// Sets what follows from the light and the origin.
void LitSurfaces::place(Beam& beam, const Vec3& origin) const {
  beam.origin = origin;
  beam.frame = Frame(-world_->lights[static_cast<std::size_t>(beam.light)].direction);
  const geom::Box3 box = world_->accel->bounds();
  beam.reach = length(box.size()) + length(box.center() - beam.origin);
}

void LitSurfaces::save(CheckpointWriter& out) const {
  out.value(std::uint64_t{beams_.size()});
  for (const Beam& beam : beams_) {
    out.value(std::int32_t{beam.light});
    for (const float number : {beam.probability, beam.origin.x, beam.origin.y, beam.origin.z,
                               beam.low.x, beam.low.y, beam.size.x, beam.size.y})
      out.value(number);
    out.array(beam.cells.values());
  }
}

void LitSurfaces::restore(CheckpointReader& in, const World& world) {
  world_ = &world;
  beams_.clear();
  const auto require = [](bool condition) {
    if (!condition) throw CheckpointError("its lit surfaces are invalid");
  };
  std::uint64_t count = 0;
  in.value(count);
  require(count <= world.lights.size());
  for (; count > 0; --count) {
    Beam& beam = beams_.emplace_back();
    std::int32_t light = 0;
    in.value(light);
    require(light >= 0 && static_cast<std::size_t>(light) < world.lights.size() &&
            is_usable(world.lights[static_cast<std::size_t>(light)]));
    beam.light = light;
    Vec3 origin(0);
    for (float* number : {&beam.probability, &origin.x, &origin.y, &origin.z, &beam.low.x,
                          &beam.low.y, &beam.size.x, &beam.size.y}) {
      in.value(*number);
      require(std::isfinite(*number));
    }
    require(beam.probability >= 0 && beam.size.x > 0 && beam.size.y > 0);
    place(beam, origin);
    std::vector<float> cells(kCells * kCells);
    in.array(cells);
    beam.cells = sampling::Distribution2D(cells, kCells, kCells);
  }
}

void LitSurfaces::add_beam(int light, const std::vector<Lit>& lit) {
  Beam beam;
  beam.light = light;
  Imath::V3d sum(0);  // double: thousands of places
  std::size_t count = 0;
  for (const Lit& l : lit)
    if (l.light == light) sum += Imath::V3d(l.position), ++count;
  if (count < kFewestFound) return;
  place(beam, Vec3(sum / static_cast<double>(count)));
  const auto on_rectangle = [&](const Vec3& p) {
    return Vec2(dot(p - beam.origin, beam.frame.s), dot(p - beam.origin, beam.frame.t));
  };
  Vec2 low(std::numeric_limits<float>::infinity()), high(-low);
  for (const Lit& l : lit) {
    if (l.light != light) continue;
    const Vec2 at = on_rectangle(l.position);
    low = Vec2(std::min(low.x, at.x), std::min(low.y, at.y));
    high = Vec2(std::max(high.x, at.x), std::max(high.y, at.y));
  }
  // One cell more on each side, for what few rays did not find.
  const Vec2 margin = (high - low) / static_cast<float>(kCells - 2);
  beam.low = low - margin;
  beam.size = high - low + margin * 2.0f;
  if (!(beam.size.x > 0 && beam.size.y > 0)) return;
  std::vector<float> cells(kCells * kCells, 0.0f);
  const auto cell_along = [](float x, float from, float size) {
    return std::min(static_cast<std::size_t>((x - from) / size * kCells), kCells - 1);
  };
  float total = 0;
  for (const Lit& l : lit) {
    if (l.light != light) continue;
    const Vec2 at = on_rectangle(l.position);
    cells[cell_along(at.y, beam.low.y, beam.size.y) * kCells +
          cell_along(at.x, beam.low.x, beam.size.x)] += l.cosine;
    total += l.cosine;
  }
  beam.probability = total;
  beam.cells = sampling::Distribution2D(smoothed(cells), kCells, kCells);
  beams_.push_back(std::move(beam));
}

std::optional<LitSurfaces::Sample> LitSurfaces::sample(float time, float u_beam, const Vec2& u_cell,
                                                       const Vec2& u_light) const {
  const Beam* beam = &beams_.back();
  for (const Beam& b : beams_) {
    if (u_beam < b.probability) {
      beam = &b;
      break;
    }
    u_beam -= b.probability;
  }
  Sample sample;
  sample.light = beam->light;
  sample.to_light = direction_to(world_->lights[static_cast<std::size_t>(beam->light)], u_light);
  const Vec2 at = beam->low + beam->cells.sample(u_cell).uv * beam->size;
  geom::Ray ray;
  ray.org =
      beam->origin + beam->frame.s * at.x + beam->frame.t * at.y + sample.to_light * beam->reach;
  ray.dir = -sample.to_light;
  ray.mask = geom::RayMask::Shadow;
  ray.time = time;
  geom::Hit hit;
  if (!world_->accel->intersect(ray, hit)) return std::nullopt;
  geom::SurfacePoint surface;
  world_->accel->interpolate(hit, surface);
  sample.position = surface.p;
  sample.normal = surface.ng;
  sample.instance = hit.instance;
  sample.primitive = hit.primitive;
  sample.on_primitive = Vec2(hit.u, hit.v);
  sample.density = density(beam->light, surface.p, sample.to_light);
  if (!(sample.density > 0)) return std::nullopt;
  return sample;
}

float LitSurfaces::density(int light, const Vec3& position, const Vec3& to_light) const {
  for (const Beam& beam : beams_) {
    if (beam.light != light) continue;
    // Where the ray of the light through the point meets the rectangle.
    const float cosine = dot(to_light, beam.frame.n);
    if (!(cosine > 0)) return 0;
    const Vec3 from = position - beam.origin;
    const Vec3 at = from - to_light * (dot(from, beam.frame.n) / cosine);
    const Vec2 uv((dot(at, beam.frame.s) - beam.low.x) / beam.size.x,
                  (dot(at, beam.frame.t) - beam.low.y) / beam.size.y);
    if (!(uv.x >= 0 && uv.x < 1 && uv.y >= 0 && uv.y < 1)) return 0;
    return beam.probability * beam.cells.pdf(uv) / (beam.size.x * beam.size.y * cosine);
  }
  return 0;
}

}  // namespace oriel
