// SPDX-License-Identifier: Apache-2.0
#include "image/sphere_blur.h"

#include <algorithm>
#include <cmath>

#include "base/fraction.h"
#include "base/frame.h"
#include "base/math.h"
#include "base/parallel.h"

namespace oriel::image {
namespace {

/// Variance of the quadratic spline along one axis, in texels^2.
constexpr float kSplineVariance = 0.25f;
/// Variance of a texel averaged from four points, and of a box-filtered texel, in texels^2.
constexpr float kFourPointVariance = 1 / 16.0f, kBoxVariance = 1 / 12.0f;
/// Kernel width of level 0 in texels.
const float kFirstWidth = std::sqrt(kSplineVariance + kFourPointVariance);
/// Minimum side of a cube face in texels.
constexpr int kMinSide = 6;
/// Sample points of a kernel per square texel of its variance, and their minimum number.
constexpr float kPointsPerTexel = 16, kMinPoints = 48;

float texel_width(int side) { return std::sqrt(4 * kPi / 6) / static_cast<float>(side); }

/// The cosine of the angle that contains the share u of the kernel exp(k (cos t - 1)).
float cosine_at(float u, float k) {
  return std::max(-1.0f, 1 + math::log(1 - u * (1 - math::exp(-2 * k))) / k);
}

/// The map convolved with a kernel of the given variance, at evenly distributed sample points.
CubeMap blurred(const CubeMap& map, float variance) {
  const float k = 1 / variance;
  // The effective area of the kernel is 2 pi times the variance, at most the whole sphere.
  constexpr float kWhole = 2;
  const auto points = static_cast<int>(std::max(
      kMinPoints, kPointsPerTexel * std::min(variance, kWhole) / sqr(texel_width(map.side()))));
  std::vector<Vec3> offsets;
  for (int i = 0; i < points; ++i) {
    const float z = cosine_at((static_cast<float>(i) + 0.5f) / static_cast<float>(points), k);
    const float r = std::sqrt(std::max(0.0f, 1 - z * z));
    const float golden = 0.61803399f * static_cast<float>(i);
    const float phi = kTwoPi * fraction(golden);
    offsets.emplace_back(r * math::cos(phi), r * math::sin(phi), z);
  }
  CubeMap out(map.side());
  out.fill([&](int face, int x, int y) {
    const Frame frame(
        map.direction(face, static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
    Rgba sum(0);
    for (const Vec3& o : offsets) sum += map.lookup(frame.to_world(o));
    return sum * (1 / static_cast<float>(points));
  });
  // The sample points are not an exact quadrature; rescale to keep the mean colour.
  const Rgba before = map.mean(), after = out.mean();
  Rgba factor(1);
  for (int c = 0; c < 4; ++c)
    if ((&after.r)[c] > 0) (&factor.r)[c] = (&before.r)[c] / (&after.r)[c];
  out.fill([&](int face, int x, int y) { return out.at(face, x, y) * factor; });
  return out;
}

}  // namespace

CubeMap::CubeMap(int side)
    : side_(side),
      texels_(6 * (static_cast<std::size_t>(side) + 2) * (static_cast<std::size_t>(side) + 2),
              Rgba(0)) {}

Vec3 CubeMap::direction(int face, float x, float y) const {
  const float step = kPi / 2 / static_cast<float>(side_);
  const int axis = face / 2;
  Vec3 d;
  d[axis] = face % 2 == 0 ? 1.0f : -1.0f;
  d[(axis + 1) % 3] = math::tan(step * x - kPi / 4);
  d[(axis + 2) % 3] = math::tan(step * y - kPi / 4);
  return normalize(d);
}

float CubeMap::solid_angle(float x, float y) const {
  const float step = kPi / 2 / static_cast<float>(side_);
  const float a = sqr(math::tan(step * x - kPi / 4)), b = sqr(math::tan(step * y - kPi / 4));
  return sqr(step) * (1 + a) * (1 + b) / math::pow(1 + a + b, 1.5f);
}

Rgba CubeMap::lookup(const Vec3& d) const {
  const Vec3 size(std::abs(d.x), std::abs(d.y), std::abs(d.z));
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const int face = 2 * axis + (d[axis] < 0 ? 1 : 0);
  const auto split = [&](float tangent, float* weights) {
    const float x = (math::atan(tangent) * (2 * kInvPi) + 0.5f) * static_cast<float>(side_);
    const int i = std::clamp(static_cast<int>(x), 0, side_ - 1);
    const float f = x - static_cast<float>(i) - 0.5f;
    weights[0] = 0.5f * sqr(0.5f - f);
    weights[1] = 0.75f - f * f;
    weights[2] = 0.5f * sqr(0.5f + f);
    return i;
  };
  float wx[3], wy[3];
  const int x = split(d[(axis + 1) % 3] / size[axis], wx);
  const int y = split(d[(axis + 2) % 3] / size[axis], wy);
  Rgba sum(0);
  for (int j = 0; j < 3; ++j) {
    const Rgba* row = &texels_[index(face, x - 1, y - 1 + j)];
    sum += (row[0] * wx[0] + row[1] * wx[1] + row[2] * wx[2]) * wy[j];
  }
  return sum;
}

void CubeMap::fill(const std::function<Rgba(int face, int x, int y)>& colour) {
  const std::size_t rows = static_cast<std::size_t>(side_) + 2;
  parallel_for(6 * rows, [&](std::size_t line) {
    const auto face = static_cast<int>(line / rows), y = static_cast<int>(line % rows) - 1;
    for (int x = -1; x <= side_; ++x) at(face, x, y) = colour(face, x, y);
  });
}

CubeMap CubeMap::halved() const {
  CubeMap half(side_ / 2);
  half.fill([&](int face, int x, int y) {
    const bool inside = x >= 0 && y >= 0 && x < half.side_ && y < half.side_;
    Rgba sum(0);
    float all = 0;
    for (int k = 0; k < 4; ++k) {
      const int fine_x = 2 * x + k % 2, fine_y = 2 * y + k / 2;
      const float mid_x = static_cast<float>(fine_x) + 0.5f;
      const float mid_y = static_cast<float>(fine_y) + 0.5f;
      const float weight = solid_angle(mid_x, mid_y);
      all += weight;
      sum += (inside ? at(face, fine_x, fine_y) : lookup(direction(face, mid_x, mid_y))) * weight;
    }
    return sum * (1 / all);
  });
  return half;
}

Rgba CubeMap::mean() const {
  double sum[4] = {}, all = 0;  // double: a million terms of very different size
  for (int face = 0; face < 6; ++face)
    for (int y = 0; y < side_; ++y)
      for (int x = 0; x < side_; ++x) {
        const double weight =
            solid_angle(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
        all += weight;
        for (int c = 0; c < 4; ++c) sum[c] += weight * (&at(face, x, y).r)[c];
      }
  Rgba mean;
  for (int c = 0; c < 4; ++c) (&mean.r)[c] = static_cast<float>(sum[c] / all);
  return mean;
}

SphereBlur::SphereBlur(int samples, const std::function<Rgba(const Vec3&)>& source) {
  constexpr int kMultiple = 16;
  const int least = static_cast<int>(std::ceil(std::sqrt(static_cast<float>(samples) / 6)));
  CubeMap map((std::max(least, 1) + kMultiple - 1) / kMultiple * kMultiple);
  map.fill([&](int face, int x, int y) {
    Rgba sum(0);
    for (int k = 0; k < 4; ++k) {
      const Rgba c = source(map.direction(face, static_cast<float>(x) + (k % 2 ? 0.75f : 0.25f),
                                          static_cast<float>(y) + (k / 2 ? 0.75f : 0.25f)));
      if (std::isfinite(c.r + c.g + c.b + c.a)) sum += c;
    }
    return sum * 0.25f;
  });
  levels_[0] = map;
  for (int j = 1; j < kLevels; ++j) {
    const float texel = sqr(texel_width(map.side()));
    const float own = 2 * kSplineVariance + (j < 3 ? kFourPointVariance : kBoxVariance);
    levels_[static_cast<std::size_t>(j)] = blurred(map, sqr(width(j)) - own * texel);
    // Halve the resolution while the kernel is at least twice as wide as a texel; the spline error
    // stays small.
    if (j > 1 && map.side() % 2 == 0 && map.side() / 2 >= kMinSide) map = map.halved();
  }
}

float SphereBlur::width(int level) const {
  return std::ldexp(kFirstWidth * texel_width(side()), level);
}

Rgba SphereBlur::lookup(const Vec3& direction, const Weights& weights) const {
  Rgba sum(0);
  for (std::size_t j = 0; j < levels_.size(); ++j)
    if (weights[j] > 0) sum += levels_[j].lookup(direction) * weights[j];
  return sum;
}

SphereBlur::Weights SphereBlur::weights_of(const std::function<float(float)>& kernel) const {
  // Rings with angles in geometric steps, so that narrow and wide parts of the kernel have equal
  // weight.
  constexpr int kRings = 96, kRounds = 400;
  const float least = 0.1f * width(0);
  std::array<double, kRings> wanted{};  // double: sums terms of very different size
  std::array<std::array<double, kLevels>, kRings> has{};
  std::array<double, kLevels> all{};
  double total = 0;
  for (std::size_t i = 0; i < kRings; ++i) {
    const auto edge = [&](std::size_t at) {
      return at == 0 ? 0.0f : least * math::pow(kPi / least, static_cast<float>(at) / kRings);
    };
    const float a = edge(i), b = edge(i + 1), middle = 0.5f * (a + b);
    const double ring = static_cast<double>(b - a) * math::sin(middle);
    wanted[i] = ring * std::max(0.0f, kernel(middle));
    total += wanted[i];
    for (std::size_t j = 0; j < kLevels; ++j) {
      const float k = 1 / sqr(width(static_cast<int>(j)));
      has[i][j] = ring * math::exp(k * (math::cos(middle) - 1));
      all[j] += has[i][j];
    }
  }
  std::array<double, kLevels> weights;
  weights.fill(1.0 / kLevels);
  for (auto& ring : has)
    for (std::size_t j = 0; j < kLevels; ++j) ring[j] /= all[j];
  for (int round = 0; round < kRounds; ++round) {
    std::array<double, kLevels> next{};
    for (std::size_t i = 0; i < kRings; ++i) {
      double mixed = 0;
      for (std::size_t j = 0; j < kLevels; ++j) mixed += weights[j] * has[i][j];
      if (!(mixed > 0)) continue;
      for (std::size_t j = 0; j < kLevels; ++j)
        next[j] += wanted[i] / total * weights[j] * has[i][j] / mixed;
    }
    weights = next;
  }
  // Drop levels with a negligible weight, since each level costs a lookup.
  constexpr double kNegligible = 1e-3;
  double sum = 0;
  for (double& w : weights) sum += w = w < kNegligible ? 0 : w;
  Weights out{};
  for (std::size_t j = 0; j < kLevels; ++j) out[j] = static_cast<float>(weights[j] / sum);
  return out;
}

}  // namespace oriel::image
