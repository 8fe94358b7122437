// SPDX-License-Identifier: Apache-2.0
#include "photometry/light_profile.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/assert.h"
#include "base/math.h"

namespace oriel::photometry {
namespace {

constexpr float kDegree = kPi / 180;
/// Angles this close to the border of the table's range count as on the border, radians.
constexpr float kOnBorder = 2e-6f;
/// Maximum resolution of the table that replaces cubics.
constexpr std::size_t kMaxCells = 2048;

/// The interval of ascending values that contains x: index of its lower end, and position inside.
struct Place {
  std::size_t index;
  float share;
};
Place place_in(const std::vector<float>& values, float x) {
  const auto above = std::upper_bound(values.begin() + 1, values.end() - 1, x);
  const auto i = static_cast<std::size_t>(above - values.begin()) - 1;
  return {i, clamp01((x - values[i]) / (values[i + 1] - values[i]))};
}

/// Integral of (linear from `from` at t0 to `to` at t1) * sin t. In double, because cosines of
/// close angles cancel.
double ring_integral(double from, double to, double t0, double t1) {
  const double h = t1 - t0;
  const double ramp = math::sin(t1) - math::sin(t0) - h * math::cos(t1);
  return from * (math::cos(t0) - math::cos(t1)) + (to - from) * ramp / h;
}

/// The position in [0, 1] up to which the integral of a line from a to b is the share u of the
/// total.
double sample_line(double a, double b, double u) {
  if (a + b <= 0 || std::abs(b - a) < 1e-9 * (a + b)) return u;
  const double root = std::sqrt(std::max(0.0, a * a + u * (b * b - a * a)));
  return std::clamp((root - a) / (b - a), 0.0, 1.0);
}

/// The angle up to which ring_integral is the share u of its total. Newton's method with a bracket.
double sample_ring(double from, double to, double t0, double t1, double u) {
  const double target = u * ring_integral(from, to, t0, t1);
  const double slope = (to - from) / (t1 - t0);
  double low = t0, high = t1,
         t = t0 + sample_line(from * math::sin(t0), to * math::sin(t1), u) * (t1 - t0);
  for (int i = 0; i < 40; ++i) {
    const double here = from + slope * (t - t0);
    const double error = (t > t0 ? ring_integral(from, here, t0, t) : 0) - target;
    (error > 0 ? high : low) = t;
    const double density = here * math::sin(t);
    double next = density > 0 ? t - error / density : low;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - t) < 1e-9) return next;
    t = next;
  }
  return t;
}

/// End slope of the parabola through three points, limited to avoid overshoot.
float end_slope(float h0, float d0, float h1, float d1) {
  const float slope = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
  if (!(slope * d0 > 0)) return 0;
  return d0 * d1 <= 0 && std::abs(slope) > 3 * std::abs(d0) ? 3 * d0 : slope;
}

/// Slopes of the monotone cubic through (x, y): weighted harmonic means where both sides have the
/// same sign, else 0. `closed`: the last point equals the first.
std::vector<float> monotone_slopes(const std::vector<float>& x, const std::vector<float>& y,
                                   bool closed) {
  const std::size_t n = x.size();
  const auto step = [&](std::size_t i) { return x[i + 1] - x[i]; };
  const auto chord = [&](std::size_t i) { return (y[i + 1] - y[i]) / step(i); };
  const auto blend = [](float h0, float d0, float h1, float d1) {
    if (!(d0 * d1 > 0)) return 0.0f;
    const float w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
    return (w0 + w1) / (w0 / d0 + w1 / d1);
  };
  std::vector<float> slope(n);
  for (std::size_t i = 1; i + 1 < n; ++i)
    slope[i] = blend(step(i - 1), chord(i - 1), step(i), chord(i));
  if (closed) {
    slope.front() = slope.back() = blend(step(n - 2), chord(n - 2), step(0), chord(0));
  } else if (n > 2) {
    slope.front() = end_slope(step(0), chord(0), step(1), chord(1));
    slope.back() = end_slope(step(n - 2), chord(n - 2), step(n - 3), chord(n - 3));
  } else {
    slope.front() = slope.back() = chord(0);
  }
  return slope;
}

/// Interpolates each interval with `parts` equal steps.
std::vector<float> refine_line(const std::vector<float>& x, const std::vector<float>& y,
                               const std::vector<int>& parts, bool closed) {
  const std::vector<float> slope = monotone_slopes(x, y, closed);
  std::vector<float> fine;
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    for (int k = 0; k < parts[i]; ++k) {
      const float t = static_cast<float>(k) / static_cast<float>(parts[i]), h = x[i + 1] - x[i];
      const float s = 1 - t;
      const float value = s * s * (1 + 2 * t) * y[i] + t * t * (1 + 2 * s) * y[i + 1] +
                          h * s * t * (s * slope[i] - t * slope[i + 1]);
      fine.push_back(std::max(0.0f, value));
    }
  fine.push_back(y.back());
  return fine;
}

std::vector<int> parts_of(const std::vector<float>& degrees, int cells) {
  const float range = degrees.back() - degrees.front();
  const std::size_t most = std::max<std::size_t>(1, kMaxCells / degrees.size());
  const float wide = cells > 0 ? range / static_cast<float>(std::min<int>(cells, kMaxCells)) : 1;
  std::vector<int> parts;
  for (std::size_t i = 0; i + 1 < degrees.size(); ++i) {
    const float wanted = std::ceil((degrees[i + 1] - degrees[i]) / wide - 1e-3f);
    parts.push_back(static_cast<int>(clamp(wanted, 1.0f, static_cast<float>(most))));
  }
  return parts;
}

std::vector<float> refine_angles(const std::vector<float>& x, const std::vector<int>& parts) {
  std::vector<float> fine;
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    for (int k = 0; k < parts[i]; ++k)
      fine.push_back(x[i] +
                     (x[i + 1] - x[i]) * static_cast<float>(k) / static_cast<float>(parts[i]));
  fine.push_back(x.back());
  return fine;
}

bool is_closed(const CandelaTable& table) {
  return table.azimuth.back() - table.azimuth.front() > 360 - 1e-3f;
}

/// Refines the table by cubic interpolation, first along each plane, then across.
CandelaTable refine(const CandelaTable& table, const ProfileGrid& grid) {
  const std::vector<int> polar = parts_of(table.polar, grid.polar_cells);
  const std::vector<int> azimuth = parts_of(table.azimuth, grid.azimuth_cells);
  CandelaTable fine{
      table.frame, refine_angles(table.polar, polar), refine_angles(table.azimuth, azimuth), {}};
  const std::size_t planes = table.azimuth.size(), cones = fine.polar.size();
  std::vector<float> along;
  for (std::size_t p = 0; p < planes; ++p) {
    const auto first = table.candela.begin() + static_cast<std::ptrdiff_t>(p * table.polar.size());
    const std::vector<float> line(first, first + static_cast<std::ptrdiff_t>(table.polar.size()));
    const std::vector<float> more = refine_line(table.polar, line, polar, false);
    along.insert(along.end(), more.begin(), more.end());
  }
  fine.candela.resize(fine.azimuth.size() * cones);
  for (std::size_t c = 0; c < cones; ++c) {
    std::vector<float> ring(planes);
    for (std::size_t p = 0; p < planes; ++p) ring[p] = along[p * cones + c];
    const std::vector<float> more = refine_line(table.azimuth, ring, azimuth, is_closed(table));
    for (std::size_t p = 0; p < more.size(); ++p) fine.candela[p * cones + c] = more[p];
  }
  return fine;
}

}  // namespace

LightProfile::LightProfile(CandelaTable table, const ProfileGrid& grid) {
  ORIEL_ASSERT(table.polar.size() >= 2 && table.azimuth.size() >= 2);
  ORIEL_ASSERT(table.candela.size() == table.polar.size() * table.azimuth.size());
  closed_ = is_closed(table);
  table_ = grid.cubic ? refine(table, grid) : std::move(table);
  for (std::vector<float>* angles : {&table_.polar, &table_.azimuth})
    for (float& a : *angles) a *= kDegree;
  measure();
}

LightProfile::Corners LightProfile::corners(std::size_t plane, std::size_t band) const {
  return {table_.at(plane, band), table_.at(plane, band + 1), table_.at(plane + 1, band),
          table_.at(plane + 1, band + 1)};
}

Vec3 LightProfile::direction(double polar, double azimuth) const {
  const auto ring = static_cast<float>(math::sin(polar));
  const PolarFrame& f = table_.frame;
  return normalize(f.pole * static_cast<float>(math::cos(polar)) +
                   f.zero * (ring * static_cast<float>(math::cos(azimuth))) +
                   f.side * (ring * static_cast<float>(math::sin(azimuth))));
}

void LightProfile::measure() {
  const std::size_t bands = table_.polar.size() - 1, planes = table_.azimuth.size() - 1;
  std::vector<float> by_band(bands), by_cell(planes);
  double total = 0;
  cells_.reserve(bands);
  for (std::size_t b = 0; b < bands; ++b) {
    const double t0 = table_.polar[b], t1 = table_.polar[b + 1];
    double sum = 0;
    for (std::size_t p = 0; p < planes; ++p) {
      const Corners c = corners(p, b);
      const double wide = double{table_.azimuth[p + 1]} - double{table_.azimuth[p]};
      const double flux =
          wide / 2 *
          (ring_integral(c.near0, c.far0, t0, t1) + ring_integral(c.near1, c.far1, t0, t1));
      by_cell[p] = static_cast<float>(std::max(0.0, flux));
      sum += by_cell[p];
    }
    by_band[b] = static_cast<float>(sum);
    total += sum;
    cells_.emplace_back(by_cell);
  }
  bands_ = sampling::Distribution1D(by_band);
  flux_ = static_cast<float>(total);
  inverse_flux_ = flux_ > 0 ? 1 / flux_ : 0;
  const auto most = std::max_element(table_.candela.begin(), table_.candela.end());
  const auto index = static_cast<std::size_t>(most - table_.candela.begin());
  peak_ = *most;
  peak_direction_ = direction(double{table_.polar[index % table_.polar.size()]},
                              double{table_.azimuth[index / table_.polar.size()]});
}

float LightProfile::interpolate(float polar, float azimuth) const {
  const std::vector<float>&cones = table_.polar, &planes = table_.azimuth;
  if (polar < cones.front() - kOnBorder || polar > cones.back() + kOnBorder) return 0;
  if (azimuth < planes.front() - kOnBorder) azimuth += kTwoPi;
  if (!closed_ && azimuth > planes.back() + kOnBorder) return 0;
  const Place cone = place_in(cones, polar), plane = place_in(planes, azimuth);
  const auto along = [&](std::size_t p) {
    return lerp(table_.at(p, cone.index), table_.at(p, cone.index + 1), cone.share);
  };
  return lerp(along(plane.index), along(plane.index + 1), plane.share);
}

float LightProfile::evaluate(const Vec3& direction) const {
  const PolarFrame& f = table_.frame;
  const float x = dot(direction, f.zero), y = dot(direction, f.side);
  return interpolate(math::atan2(std::sqrt(x * x + y * y), dot(direction, f.pole)),
                     math::atan2(y, x));
}

LightProfile::Sample LightProfile::sample(const Vec2& u) const {
  if (!(flux_ > 0)) return {};
  const auto band = bands_.choose(u.x);
  const auto cell = cells_[band.index].choose(u.y);
  const double t0 = table_.polar[band.index], t1 = table_.polar[band.index + 1];
  const Corners c = corners(cell.index, band.index);
  const double share = sample_line(ring_integral(c.near0, c.far0, t0, t1),
                                   ring_integral(c.near1, c.far1, t0, t1), double{cell.u});
  const double near = c.near0 + (c.near1 - c.near0) * share;
  const double far = c.far0 + (c.far1 - c.far0) * share;
  const double polar = sample_ring(near, far, t0, t1, double{band.u});
  const double p0 = table_.azimuth[cell.index], p1 = table_.azimuth[cell.index + 1];
  const double value = near + (far - near) * (polar - t0) / (t1 - t0);
  return {direction(polar, p0 + (p1 - p0) * share), static_cast<float>(value) * inverse_flux_};
}

float beam_width_deg(const LightProfile& profile, const Vec3& axis, const Vec3& toward,
                     float share) {
  const float most = profile.evaluate(axis) * share;
  if (!(most > 0)) return 0;
  const Vec3 across = normalize(toward - axis * dot(toward, axis));
  const auto intensity = [&](float deg, float sign) {
    const float a = deg * kDegree;
    return profile.evaluate(axis * math::cos(a) + across * (sign * math::sin(a)));
  };
  float sum = 0;
  for (const float sign : {1.0f, -1.0f}) {
    constexpr float kStep = 0.1f;
    int steps = 0;
    while (steps < 1800 && intensity(kStep * static_cast<float>(steps + 1), sign) >= most) ++steps;
    float low = kStep * static_cast<float>(steps), high = low + kStep;
    for (int i = 0; i < 12 && steps < 1800; ++i) {
      const float middle = 0.5f * (low + high);
      (intensity(middle, sign) >= most ? low : high) = middle;
    }
    sum += low;
  }
  return sum;
}

}  // namespace oriel::photometry
