// SPDX-License-Identifier: Apache-2.0
#include "image/sphere_blur.h"

#include <algorithm>
#include <cmath>

#include "base/frame.h"
#include "base/parallel.h"

namespace oriel::image {
namespace {

/// Of the spline across one axis, in texels: a quarter of its square.
constexpr float kSplineVariance = 0.25f;
/// Of a texel that four points stand for, and of one that is a mean.
constexpr float kFourPointVariance = 1 / 16.0f, kBoxVariance = 1 / 12.0f;
/// Width of the first level in texels.
const float kFirstWidth = std::sqrt(kSplineVariance + kFourPointVariance);
/// Maps do not get smaller than that many texels each way.
constexpr int kLeastSide = 13;
/// Points of a kernel that is as wide as texels of its map; more where it is wider.
constexpr float kPointsPerTexel = 64;

float texel_width(int side) { return std::sqrt(4 * kPi) / static_cast<float>(side); }

/// Cosine below which lies the share u of the kernel exp(k (cos t - 1)).
float cosine_at(float u, float k) {
  return std::max(-1.0f, 1 + std::log(1 - u * (1 - std::exp(-2 * k))) / k);
}

/// The map under a kernel of that variance, at points spread evenly over it.
SphereMap blurred(const SphereMap& map, float variance) {
  SphereMap out(map.side());
  const float k = 1 / variance;
  const auto points =
      static_cast<int>(kPointsPerTexel * std::max(1.0f, variance / sqr(texel_width(map.side()))));
  std::vector<Vec3> offsets;
  for (int i = 0; i < points; ++i) {
    const float z = cosine_at((static_cast<float>(i) + 0.5f) / static_cast<float>(points), k);
    const float r = std::sqrt(std::max(0.0f, 1 - z * z));
    const float golden = 0.61803399f * static_cast<float>(i);
    const float phi = kTwoPi * (golden - std::floor(golden));
    offsets.emplace_back(r * std::cos(phi), r * std::sin(phi), z);
  }
  parallel_for(static_cast<std::size_t>(map.side()), [&](std::size_t line) {
    const int y = static_cast<int>(line);
    for (int x = 0; x < map.side(); ++x) {
      const Frame frame(map.direction(x, y));
      Rgba sum(0);
      for (const Vec3& o : offsets) sum += map.lookup(square_of(frame.to_world(o)));
      out.at(x, y) = sum * (1 / static_cast<float>(points));
    }
  });
  // The points are no exact quadrature: what they brighten or darken all in all is made up for.
  const Rgba before = map.mean(), after = out.mean();
  Rgba factor(1);
  for (int c = 0; c < 4; ++c)
    if ((&after.r)[c] > 0) (&factor.r)[c] = (&before.r)[c] / (&after.r)[c];
  for (int y = 0; y < out.side(); ++y)
    for (int x = 0; x < out.side(); ++x) out.at(x, y) *= factor;
  out.close();
  return out;
}

}  // namespace

Vec2 square_of(const Vec3& d) {
  const float r = std::sqrt(std::max(0.0f, 1 - std::abs(d.z)));
  const float turn = std::atan2(std::abs(d.y), std::abs(d.x)) * (2 * kInvPi);
  float v = turn * r, u = r - v;
  if (d.z < 0) {
    const float old = u;
    u = 1 - v;
    v = 1 - old;
  }
  return Vec2(std::copysign(u, d.x) + 1, std::copysign(v, d.y) + 1) * 0.5f;
}

Vec3 direction_of(const Vec2& square) {
  const float u = 2 * square.x - 1, v = 2 * square.y - 1;
  const float inner = 1 - std::abs(u) - std::abs(v);  // below 0: the lower half
  const float r = 1 - std::abs(inner);
  const float phi = r > 0 ? ((std::abs(v) - std::abs(u)) / r + 1) * (kPi / 4) : 0;
  const float across = r * std::sqrt(std::max(0.0f, 2 - r * r));
  return Vec3(std::copysign(across * std::cos(phi), u), std::copysign(across * std::sin(phi), v),
              std::copysign(1 - r * r, inner));
}

SphereMap::SphereMap(int side)
    : side_(side), texels_(static_cast<std::size_t>((side + 2) * (side + 2)), Rgba(0)) {}

Vec3 SphereMap::direction(int x, int y) const {
  const auto n = static_cast<float>(side_);
  return direction_of(Vec2((static_cast<float>(x) + 0.5f) / n, (static_cast<float>(y) + 0.5f) / n));
}

void SphereMap::close() {
  const int last = side_ - 1;
  for (int i = 0; i < side_; ++i) {
    at(i, -1) = at(last - i, 0);
    at(i, side_) = at(last - i, last);
    at(-1, i) = at(0, last - i);
    at(side_, i) = at(last, last - i);
  }
  // All corners of the square are one point.
  at(-1, -1) = at(last, last);
  at(side_, side_) = at(0, 0);
  at(-1, side_) = at(last, 0);
  at(side_, -1) = at(0, last);
}

Rgba SphereMap::lookup(const Vec2& square) const {
  const auto split = [this](float s, float* weights) {
    const float x = s * static_cast<float>(side_);
    const int i = std::clamp(static_cast<int>(x), 0, side_ - 1);
    const float f = x - static_cast<float>(i) - 0.5f;
    weights[0] = 0.5f * sqr(0.5f - f);
    weights[1] = 0.75f - f * f;
    weights[2] = 0.5f * sqr(0.5f + f);
    return i;
  };
  float wx[3], wy[3];
  const int x = split(square.x, wx), y = split(square.y, wy);
  Rgba sum(0);
  for (int j = 0; j < 3; ++j) {
    const Rgba* row = &texels_[index(x - 1, y - 1 + j)];
    sum += (row[0] * wx[0] + row[1] * wx[1] + row[2] * wx[2]) * wy[j];
  }
  return sum;
}

SphereMap SphereMap::halved() const {
  SphereMap half(side_ / 2);
  for (int y = 0; y < half.side_; ++y)
    for (int x = 0; x < half.side_; ++x)
      half.at(x, y) = (at(2 * x, 2 * y) + at(2 * x + 1, 2 * y) + at(2 * x, 2 * y + 1) +
                       at(2 * x + 1, 2 * y + 1)) *
                      0.25f;
  half.close();
  return half;
}

Rgba SphereMap::mean() const {
  double sum[4] = {};  // a million terms of very different size
  for (int y = 0; y < side_; ++y)
    for (int x = 0; x < side_; ++x)
      for (int c = 0; c < 4; ++c) sum[c] += (&at(x, y).r)[c];
  Rgba mean;
  for (int c = 0; c < 4; ++c)
    (&mean.r)[c] = static_cast<float>(sum[c] / (static_cast<double>(side_) * side_));
  return mean;
}

SphereBlur::SphereBlur(int side, const std::function<Rgba(const Vec3&)>& source) {
  constexpr int kMultiple = 16;
  SphereMap map((std::max(side, kMultiple) + kMultiple - 1) / kMultiple * kMultiple);
  const auto n = static_cast<float>(map.side());
  parallel_for(static_cast<std::size_t>(map.side()), [&](std::size_t line) {
    const int y = static_cast<int>(line);
    for (int x = 0; x < map.side(); ++x) {
      Rgba sum(0);
      for (int k = 0; k < 4; ++k) {
        const Vec2 at((static_cast<float>(x) + (k & 1 ? 0.75f : 0.25f)) / n,
                      (static_cast<float>(y) + (k & 2 ? 0.75f : 0.25f)) / n);
        const Rgba c = source(direction_of(at));
        if (std::isfinite(c.r + c.g + c.b + c.a)) sum += c;
      }
      map.at(x, y) = sum * 0.25f;
    }
  });
  map.close();
  levels_[0] = map;
  for (int j = 1; j < kLevels; ++j) {
    const std::size_t level = static_cast<std::size_t>(j);
    const float texel = sqr(texel_width(map.side()));
    const float own = 2 * kSplineVariance + (j == 1 ? kFourPointVariance : kBoxVariance);
    levels_[level] = blurred(map, sqr(width(j)) - own * texel);
    if (map.side() % 2 == 0 && map.side() / 2 >= kLeastSide) map = map.halved();
  }
}

float SphereBlur::width(int level) const {
  return std::ldexp(kFirstWidth * texel_width(side()), level);
}

Rgba SphereBlur::lookup(const Vec3& direction, const Weights& weights) const {
  const Vec2 square = square_of(direction);
  Rgba sum(0);
  for (std::size_t j = 0; j < levels_.size(); ++j)
    if (weights[j] > 0) sum += levels_[j].lookup(square) * weights[j];
  return sum;
}

SphereBlur::Weights SphereBlur::weights_of(const std::function<float(float)>& kernel) const {
  // Rings between angles in geometric steps: what is narrow counts as well as what is wide.
  constexpr int kRings = 96, kRounds = 400;
  const float least = 0.1f * width(0);
  std::array<double, kRings> wanted{};  // double: shares of very different size are added up
  std::array<std::array<double, kLevels>, kRings> has{};
  std::array<double, kLevels> all{};
  double total = 0;
  for (std::size_t i = 0; i < kRings; ++i) {
    const auto edge = [&](std::size_t at) {
      return at == 0 ? 0.0f : least * std::pow(kPi / least, static_cast<float>(at) / kRings);
    };
    const float a = edge(i), b = edge(i + 1), middle = 0.5f * (a + b);
    const double ring = static_cast<double>(b - a) * std::sin(middle);
    wanted[i] = ring * std::max(0.0f, kernel(middle));
    total += wanted[i];
    for (std::size_t j = 0; j < kLevels; ++j) {
      const float k = 1 / sqr(width(static_cast<int>(j)));
      has[i][j] = ring * std::exp(k * (std::cos(middle) - 1));
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
  // What is left of levels that do not help costs a look-up each.
  constexpr double kNegligible = 1e-3;
  double sum = 0;
  for (double& w : weights) sum += w = w < kNegligible ? 0 : w;
  Weights out{};
  for (std::size_t j = 0; j < kLevels; ++j) out[j] = static_cast<float>(weights[j] / sum);
  return out;
}

}  // namespace oriel::image
