// SPDX-License-Identifier: Apache-2.0
#include "geom/freeform/outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace oriel::geom::freeform {
namespace {

EdgePoint in_range(const OutlineInput& input, const V3d& uv) {
  return {std::clamp(uv.x, input.range.u0, input.range.u1),
          std::clamp(uv.y, input.range.v0, input.range.v1),
          {}};
}

/// Replaces the samples in the range of a seam by those of the seam.
std::vector<std::pair<double, std::optional<V3d>>> with_seam(const std::vector<double>& samples,
                                                             const Seam* seam) {
  std::vector<std::pair<double, std::optional<V3d>>> result;
  if (!seam || seam->t.empty()) {
    for (const double t : samples) result.emplace_back(t, std::nullopt);
    return result;
  }
  const double first = seam->t.front(), last = seam->t.back();
  const double lo = samples.front(), hi = samples.back();
  const double close = 1e-6 * (hi - lo);
  for (const double t : samples)
    if (t < first - close || t > last + close) result.emplace_back(t, std::nullopt);
  for (std::size_t i = 0; i < seam->t.size(); ++i)
    if (seam->t[i] >= lo - close && seam->t[i] <= hi + close)
      result.emplace_back(seam->t[i], seam->place[i]);
  std::sort(result.begin(), result.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  return result;
}

}  // namespace

V3d on_surface(const OutlineInput& input, const V3d& uv) {
  const EdgePoint p = in_range(input, uv);
  return input.net.point(p.u, p.v);
}

std::vector<double> sample_part(const CurveNet& curve, const scene::CurvePart& part,
                                const OutlineInput& input, Budget& budget) {
  const Direction& direction = curve.direction();
  const double a =
      std::clamp<double>(std::min(part.min, part.max), direction.begin(), direction.end());
  const double b =
      std::clamp<double>(std::max(part.min, part.max), direction.begin(), direction.end());
  if (!(a < b)) return {a};
  const scene::Approximation& approximation = input.approximation(part.curve);
  const Criteria criteria(approximation, input.view);
  return sample_curve([&](double t) { return on_surface(input, curve.at(t)); }, direction.breaks(),
                      direction.degree(), a, b, approximation, approximation.u, criteria, budget);
}

Polyline flatten(const scene::SurfaceLoop& loop, const OutlineInput& input, Budget& budget,
                 std::string& fault) {
  Polyline line{loop.kind, {}};
  for (const scene::CurvePart& part : loop.parts) {
    const auto found = input.curves.find(part.curve);
    if (found == input.curves.end()) {
      fault = fmt::format("curve \"{}\" does not exist or is invalid", part.curve);
      continue;
    }
    const auto seam = input.seams.find(part.curve);
    auto samples = with_seam(sample_part(found->second, part, input, budget),
                             seam == input.seams.end() ? nullptr : &seam->second);
    if (part.max < part.min) std::reverse(samples.begin(), samples.end());
    for (const auto& [t, place] : samples) {
      EdgePoint p = in_range(input, found->second.at(t));
      p.place = place;
      // Where parts meet, the point of a connected part has priority.
      const bool again =
          !line.points.empty() && line.points.back().u == p.u && line.points.back().v == p.v;
      if (!again)
        line.points.push_back(p);
      else if (place)
        line.points.back() = p;
    }
  }
  if (loop.kind == scene::SurfaceLoop::Kind::Special) return line;
  while (line.points.size() > 1 && line.points.front().u == line.points.back().u &&
         line.points.front().v == line.points.back().v) {
    if (line.points.back().place) line.points.front() = line.points.back();
    line.points.pop_back();
  }
  return line;
}

Polyline border(const OutlineInput& input, Budget& budget) {
  const Range& r = input.range;
  const scene::Approximation& a = input.of_surface;
  const Criteria criteria(a, input.view);
  Polyline line;
  const auto side = [&](bool along_u, double across, bool forward) {
    const Direction& d = along_u ? input.net.u() : input.net.v();
    std::vector<double> t = sample_curve(
        [&](double s) { return along_u ? input.net.point(s, across) : input.net.point(across, s); },
        d.breaks(), d.degree(), along_u ? r.u0 : r.v0, along_u ? r.u1 : r.v1, a,
        along_u ? a.u : a.v, criteria, budget);
    if (!forward) std::reverse(t.begin(), t.end());
    t.pop_back();  // the next side begins at this point
    for (const double s : t)
      line.points.push_back(along_u ? EdgePoint{s, across, {}} : EdgePoint{across, s, {}});
  };
  side(true, r.v0, true);
  side(false, r.u1, true);
  side(true, r.v1, false);
  side(false, r.u0, false);
  return line;
}

}  // namespace oriel::geom::freeform
