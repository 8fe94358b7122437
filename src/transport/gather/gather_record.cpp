// SPDX-License-Identifier: Apache-2.0
#include "transport/gather/gather_record.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"

namespace oriel {
namespace {

constexpr int kMaxFilter = 4;
/// Maximum ratio of the sample's distance to that of its plane at the stratum's border.
constexpr float kMaxShrink = 4;
/// Maximum radius relative to the distance of the nearest surface. Beside a window most rays hit
/// nothing, and the mean distance would extend the record past the window's frame. An estimate.
constexpr float kMaxClearance = 2;
/// Maximum relative change of the irradiance by the gradient over one radius; an estimate.
constexpr float kMaxChange = 0.5f;
/// Rays below this elevation, as sin^2(theta), detect objects on the surface.
constexpr float kLowRays = 2 / 3.0f;

float seen_distance(const GatherSample& s) {
  // The first test also rejects NaN; the clamp avoids a division by zero for a hit at the point
  // itself.
  return s.distance > 0 ? std::clamp(s.distance, 1e-6f, kGatherFarthest) : 1e-6f;
}

/// 1 / distance at which a direction near the sample's hits the plane of the sample's hit.
float nearness(const GatherSample& s, const Vec3& direction) {
  const float inverse = 1 / seen_distance(s);
  const float facing = dot(s.normal, s.direction);
  // A plane at a grazing angle does not predict distances in other directions.
  if (!(std::abs(facing) > 1e-3f)) return inverse;
  return inverse * clamp(dot(s.normal, direction) / facing, 0, kMaxShrink);
}

/// Change of E per length, by channel, in the local frame.
std::array<Vec3, 3> translational_gradient(const GatherHemisphere& hemisphere,
                                           std::span<const GatherSample> samples) {
  const int rings = hemisphere.rings, sectors = hemisphere.sectors;
  const auto at = [&](int j, int k) -> const GatherSample& {
    const int index = j * sectors + k;
    return samples[static_cast<std::size_t>(index)];
  };
  std::array<Vec3, 3> gradient{Vec3(0), Vec3(0), Vec3(0)};
  const auto add = [&](const Vec3& direction, const Rgb& amount) {
    for (int c = 0; c < 3; ++c) gradient[static_cast<std::size_t>(c)] += direction * amount[c];
  };
  const float n = static_cast<float>(rings), half = kPi / static_cast<float>(sectors);
  for (int k = 0; k < sectors; ++k) {
    const int before = k > 0 ? k - 1 : sectors - 1;
    // Borders of rings move along the middle of the sector; borders of sectors move across their
    // edge.
    const float middle = half * static_cast<float>(2 * k + 1);
    const float edge = half * static_cast<float>(2 * k);
    const Vec3 outward(math::cos(middle), math::sin(middle), 0);
    const Vec3 along_edge(math::cos(edge), math::sin(edge), 0);
    const auto moves = [&](const GatherSample& a, const GatherSample& b, const Vec3& azimuth,
                           float sin2) {
      const Vec3 border = hemisphere.frame.to_world(
          Vec3(azimuth.x * std::sqrt(sin2), azimuth.y * std::sqrt(sin2), std::sqrt(1 - sin2)));
      return (a.radiance - b.radiance) * std::max(nearness(a, border), nearness(b, border));
    };
    Rgb across(0), along(0);
    for (int j = 0; j < rings; ++j) {
      const float inner2 = static_cast<float>(j) / n;
      const float inner = std::sqrt(inner2);
      if (j > 0) along += moves(at(j, k), at(j - 1, k), outward, inner2) * (inner * (1 - inner2));
      const float outer = std::sqrt(static_cast<float>(j + 1) / n);
      across += moves(at(j, k), at(j, before), along_edge, inner2 + 0.5f / n) * (outer - inner);
    }
    add(outward, along * (2 * math::sin(half)));
    add(Vec3(-along_edge.y, along_edge.x, 0), across);
  }
  return gradient;
}

/// Median of the tangential distances of the low rays, in eight directions. The median is used
/// because grazing rays hit a concave surface itself at short distances.
std::array<float, 8> free_ways(const Vec3& normal, std::span<const GatherSample> samples) {
  std::array<std::vector<float>, 8> seen;
  float low = kLowRays;
  // With very few rings no ray may be low enough; then all rays count.
  const auto sin2 = [&](const GatherSample& s) { return 1 - sqr(dot(s.direction, normal)); };
  if (std::none_of(samples.begin(), samples.end(),
                   [&](const GatherSample& s) { return sin2(s) > low; }))
    low = 0;
  for (const GatherSample& s : samples) {
    const float s2 = sin2(s);
    if (!(s2 > low)) continue;
    const auto sector =
        static_cast<std::size_t>(std::lround(gather_sector(normal, s.direction))) % seen.size();
    const float d = seen_distance(s);
    seen[sector].push_back(d < kGatherFarthest ? d * std::sqrt(s2) : d);
  }
  std::array<float, 8> free = GatherRecord::all_free();
  for (std::size_t i = 0; i < seen.size(); ++i) {
    auto& d = seen[i];
    if (d.empty()) continue;
    const auto middle = d.begin() + static_cast<std::ptrdiff_t>((d.size() - 1) / 2);
    std::nth_element(d.begin(), middle, d.end());
    free[i] = *middle;
  }
  return free;
}

/// Standard error of the mean, estimated from the differences of neighbouring strata; relative to
/// the mean.
float noise_of(std::span<const GatherSample> samples, int rings, int sectors) {
  float squares = 0, sum = 0;
  int pairs = 0;
  const auto found = [&](int j, int k) {
    const int i = j * sectors + k;
    return gather_brightness(samples[static_cast<std::size_t>(i)].radiance);
  };
  for (int j = 0; j < rings; ++j)
    for (int k = 0; k < sectors; ++k) {
      const float own = found(j, k);
      sum += own;
      squares += sqr(own - found(j, (k + 1) % sectors));
      ++pairs;
      if (j + 1 == rings) continue;
      squares += sqr(own - found(j + 1, k));
      ++pairs;
    }
  const float n = static_cast<float>(rings * sectors);
  // Half the mean squared difference of neighbours is the variance of one.
  return sum > 0 ? std::sqrt(0.5f * squares / static_cast<float>(pairs) * n) / sum : 0;
}

}  // namespace

GatherHemisphere GatherHemisphere::for_rays(const Vec3& normal, int rays, float turn) {
  GatherHemisphere h;
  const float n = static_cast<float>(std::clamp(rays, 1, 1 << 20));
  h.rings = std::max(1, static_cast<int>(std::lround(std::sqrt(n / kPi))));
  // An even number, so that strata alternate around the circle.
  h.sectors = std::max(4, 2 * static_cast<int>(std::lround(n / static_cast<float>(2 * h.rings))));
  const Frame f(normal);
  const float c = math::cos(kTwoPi * turn), s = math::sin(kTwoPi * turn);
  h.frame = Frame(f.s * c + f.t * s, f.t * c - f.s * s, normal);
  return h;
}

Vec3 GatherHemisphere::direction(int i, const Vec2& u) const {
  const int ring = i / sectors;
  const float sin2 = (static_cast<float>(ring) + u.x) / static_cast<float>(rings);
  const float phi = kTwoPi * (static_cast<float>(i % sectors) + u.y) / static_cast<float>(sectors);
  const float sine = std::sqrt(sin2);
  // The minimum cosine keeps rays at the horizon above the surface.
  return frame.to_world(
      Vec3(sine * math::cos(phi), sine * math::sin(phi), std::sqrt(std::max(1e-12f, 1 - sin2))));
}

float gather_sector(const Vec3& normal, const Vec3& v) {
  const Frame f(normal);
  const float x = dot(v, f.s), y = dot(v, f.t);
  const float sum = std::abs(x) + std::abs(y);
  if (!(sum > 0)) return 0;
  const float turn = y / sum;
  return 2 * (x < 0 ? 2 - turn : (y < 0 ? 4 + turn : turn));
}

void filter_speckles(std::span<GatherSample> samples, int rings, int sectors, int reach) {
  reach = std::clamp(reach, 0, kMaxFilter);
  if (reach == 0) return;
  std::vector<Rgb> before;
  before.reserve(samples.size());
  for (const GatherSample& s : samples) before.push_back(s.radiance);
  struct Ray {
    float brightness;
    int index;
    bool operator<(const Ray& o) const {
      return brightness != o.brightness ? brightness < o.brightness : index < o.index;
    }
  };
  std::array<Ray, (2 * kMaxFilter + 1) * (2 * kMaxFilter + 1)> near;
  const int width = std::min(2 * reach + 1, sectors);
  for (int j = 0; j < rings; ++j)
    for (int k = 0; k < sectors; ++k) {
      std::size_t count = 0;
      for (int ring = std::max(0, j - reach); ring <= std::min(rings - 1, j + reach); ++ring)
        for (int i = 0; i < width; ++i) {
          const int index = ring * sectors + (k - reach + i + sectors * kMaxFilter) % sectors;
          near[count++] = {gather_brightness(before[static_cast<std::size_t>(index)]), index};
        }
      const auto middle = near.begin() + static_cast<std::ptrdiff_t>((count - 1) / 2);
      std::nth_element(near.begin(), middle, near.begin() + static_cast<std::ptrdiff_t>(count));
      const int own = j * sectors + k;
      samples[static_cast<std::size_t>(own)].radiance =
          before[static_cast<std::size_t>(middle->index)];
    }
}

GatherRecord make_gather_record(const Vec3& position, const GatherHemisphere& hemisphere,
                                std::span<const GatherSample> given, const GatherRadii& radii,
                                int filter) {
  const int rings = hemisphere.rings, sectors = hemisphere.sectors;
  std::vector<GatherSample> samples(given.begin(), given.end());
  samples.resize(static_cast<std::size_t>(hemisphere.count()));
  for (GatherSample& s : samples) {
    Rgb& l = s.radiance;
    l = is_finite(l) ? Rgb(std::max(0.0f, l.x), std::max(0.0f, l.y), std::max(0.0f, l.z)) : Rgb(0);
  }
  filter_speckles(samples, rings, sectors, filter);

  GatherRecord r;
  r.position = position;
  r.normal = hemisphere.frame.n;
  std::vector<Rgb> radiance;
  radiance.reserve(samples.size());
  float inverse = 0;
  for (const GatherSample& s : samples) {
    const float d = seen_distance(s);
    radiance.push_back(s.radiance);
    r.irradiance += s.radiance;
    inverse += 1 / d;
    r.min_distance = std::min(r.min_distance, d);
  }
  const auto count = static_cast<float>(samples.size());
  r.irradiance *= kPi / count;
  r.mean_distance = std::min(count / inverse, kGatherFarthest);
  r.free = free_ways(r.normal, samples);
  r.noise = noise_of(samples, rings, sectors);

  const HemisphereMoments moments = hemisphere_moments(radiance, rings, sectors);
  r.incoming = fit_incoming(moments, hemisphere.frame);
  const auto gradient = translational_gradient(hemisphere, samples);
  Vec3 total(0);
  for (int c = 0; c < 3; ++c) {
    const auto i = static_cast<std::size_t>(c);
    r.by_normal[i] = hemisphere.frame.to_world(Vec3(moments.x[c], moments.y[c], 0));
    r.by_position[i] = hemisphere.frame.to_world(gradient[i]);
    total += r.by_position[i];
  }
  const float steepness = length(total), e = gather_brightness(r.irradiance);
  const float slope_limit = steepness > 0 ? kMaxChange * e / steepness : kGatherFarthest;
  const float reach = std::min(r.mean_distance, kMaxClearance * r.min_distance);
  r.radius = std::min(radii.clamped(std::min(reach, slope_limit)), kGatherFarthest);
  return r;
}

void normalise_shares(std::span<Rgb> parts) {
  Rgb whole(0);
  for (const Rgb& part : parts) whole += part;
  for (int c = 0; c < 3 && !parts.empty(); ++c) {
    for (Rgb& part : parts) part[c] = whole[c] > 0 ? part[c] / whole[c] : 0;
    if (!(whole[c] > 0)) parts.back()[c] = 1;
  }
}

Rgb extrapolate(const GatherRecord& r, const Vec3& position, const Vec3& normal) {
  const Vec3 moved = position - r.position;
  Rgb e(0);
  for (int c = 0; c < 3; ++c) {
    const auto i = static_cast<std::size_t>(c);
    const float own = r.irradiance[c];
    const float there = own + dot(r.by_position[i], moved) + dot(r.by_normal[i], normal);
    e[c] = clamp(there, own * (1 / kGatherExtrapolation), own * kGatherExtrapolation);
  }
  return e;
}

}  // namespace oriel
