// SPDX-License-Identifier: Apache-2.0
#include "transport/gather/light_points.h"

#include <cmath>

#include "base/parallel.h"
#include "color/luminance.h"
#include "lights/emission.h"
#include "lights/light_sampler.h"
#include "runtime/fill_point.h"
#include "transport/shadow.h"

namespace oriel {
namespace {

/// Stream number of the samples.
constexpr int kLightColumn = 0x6c696774;

/// Mean square of the luminance that samples of a light bring.
class MeanSquare {
 public:
  explicit MeanSquare(int samples) : samples_(samples) {}
  void add(float value) {
    if (std::isfinite(value * value)) sum_ += value * value;
  }
  float get() const { return sum_ / static_cast<float>(samples_); }

 private:
  int samples_;
  float sum_ = 0;
};

/// Of the irradiance by samples of a light.
float square_of_light(const World& world, const GatherPoint& at, int light, int samples,
                      sampling::Sampler& sampler, RayCounts& counts) {
  ShadingPoint point = at.point;
  MeanSquare square(samples);
  for (int i = 0; i < samples; ++i) {
    const auto s =
        sample_light(world.lights[static_cast<std::size_t>(light)], point, sampler.next_2d());
    if (!s) continue;
    const float cosine = dot(s->wi, at.normal);
    if (!(cosine > 0)) continue;
    const float unshadowed = luminance(s->irradiance) * cosine;
    if (!(unshadowed > 0)) continue;
    const Rgb open =
        s->shadow ? shadow_transmittance(world, point, s->wi, s->reach, counts, light).all : Rgb(1);
    square.add(unshadowed * lerp(luminance(open), 1.0f, s->shadow_factor));
  }
  return square.get();
}

/// Luminance that a triangle emits towards a point, at the place in that direction.
float emitted_by(const World& world, const TriangleSample& to, const Vec3& from, float time) {
  const TriangleCorners corners = corners_of(world, to.instance, to.primitive, time);
  const Vec3 u = corners.b - corners.a, v = corners.c - corners.a, normal = cross(u, v);
  const Vec3 place = from + to.wi * to.distance - corners.a;
  const float scale = 1 / dot(normal, normal);
  geom::Hit hit;
  hit.u = dot(cross(place, v), normal) * scale;
  hit.v = dot(cross(u, place), normal) * scale;
  hit.instance = to.instance;
  hit.primitive = to.primitive;
  geom::SurfacePoint surface;
  world.accel->interpolate(hit, surface);
  ShadingPoint point = point_of_triangle(world, to.instance, to.primitive, hit.u, hit.v,
                                         dot(to.wi, surface.ng) > 0, RayKind::FinalGather);
  return luminance(emission_at(material_of(world, hit), point).radiance);
}

/// Of the irradiance by samples of a part of the mesh lights.
float square_of_part(const World& world, const GatherPoint& at, std::size_t part, int samples,
                     sampling::Sampler& sampler, RayCounts& counts) {
  constexpr float kShort = 1 - 1e-3f;  // of the way to the surface that emits
  ShadingPoint point = at.point;
  MeanSquare square(samples);
  for (int i = 0; i < samples; ++i) {
    const Vec2 u_choice = sampler.next_2d(), u_place = sampler.next_2d();
    const auto s = world.light_sampler->sample_part(part, {at.point.position, at.normal},
                                                    point.time, u_choice, u_place);
    if (!s) continue;
    const float cosine = dot(s->wi, at.normal);
    if (!(cosine > 0)) continue;
    const float emitted = emitted_by(world, *s, point.position, point.time);
    if (!(emitted > 0)) continue;
    const Rgb open = shadow_transmittance(world, point, s->wi, s->distance * kShort, counts).all;
    square.add(emitted * luminance(open) * cosine / s->pdf);
  }
  return square.get();
}

/// Measures `count` lights. Inputs:  square_of(point, light, sampler, counts) and
/// by_tree(place, light), the probability of a light by the light tree.
template <class Square, class ByTree>
LearnedLights measure(std::span<const GatherPoint> points, std::size_t count, std::uint32_t seed,
                      RayCounts& counts, const Square& square_of, const ByTree& by_tree_of) {
  if (count == 0 || points.empty()) return {};
  std::vector<float> squares(points.size() * count), by_tree(squares.size());
  std::vector<SurfaceTree::Point> places(points.size());
  std::vector<RayCounts> traced(points.size());
  parallel_for(points.size(), [&](std::size_t i) {
    places[i] = {points[i].point.position, points[i].normal};
    sampling::Sampler sampler(kLightColumn, static_cast<int>(i), 0, seed);
    for (std::size_t k = 0; k < count; ++k) {
      squares[i * count + k] = square_of(points[i], k, sampler, traced[i]);
      by_tree[i * count + k] = by_tree_of(LitPoint{places[i].position, places[i].normal}, k);
    }
  });
  for (const RayCounts& of_point : traced) counts += of_point;
  return {places, squares, by_tree};
}

}  // namespace

LearnedLights measure_lights(const World& world, std::span<const GatherPoint> points, int samples,
                             std::uint32_t seed, RayCounts& counts) {
  const std::span<const int> lights = world.light_sampler->chosen_lights();
  const auto shines = [&](std::size_t k) {
    return gives_direct_light(world.lights[static_cast<std::size_t>(lights[k])]);
  };
  return measure(
      points, lights.size(), seed, counts,
      [&](const GatherPoint& at, std::size_t k, sampling::Sampler& sampler, RayCounts& traced) {
        return shines(k) ? square_of_light(world, at, lights[k], samples, sampler, traced) : 0;
      },
      [&](const LitPoint& at, std::size_t k) {
        return shines(k) ? world.light_sampler->probability_by_tree(at, lights[k]) : 0;
      });
}

LearnedLights measure_emitters(const World& world, std::span<const GatherPoint> points, int samples,
                               std::uint32_t seed, RayCounts& counts) {
  const MeshLights& emitters = world.light_sampler->mesh_lights();
  return measure(
      points, emitters.parts(), seed, counts,
      [&](const GatherPoint& at, std::size_t k, sampling::Sampler& sampler, RayCounts& traced) {
        return square_of_part(world, at, k, samples, sampler, traced);
      },
      [&](const LitPoint& at, std::size_t k) { return emitters.probability_of(k, at); });
}

}  // namespace oriel
