// SPDX-License-Identifier: Apache-2.0
#include "measure_places.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "command.h"

namespace oriel::app {
namespace {

/// More sensors are rejected: the spacing is probably in the wrong unit.
constexpr double kMaxSensors = 1e6;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(separator, at), text.size());
    parts.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

std::optional<float> number(const std::string& text) {
  char* end = nullptr;
  const float value = std::strtof(text.c_str(), &end);
  if (text.empty() || *end != 0 || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// A length in scene units: "0.5", or "0.5m" if --meters-per-unit is given.
float parse_length(const std::string& option, std::string text,
                   const std::optional<float>& meters_per_unit) {
  float unit = 1;
  const std::string whole = text;
  if (text.ends_with('m')) {
    if (!meters_per_unit)
      throw UsageError(
          fmt::format("{} {}: a length in metres requires --meters-per-unit", option, whole));
    unit = 1 / *meters_per_unit;
    text.pop_back();
  }
  const auto value = number(text);
  if (!value)
    throw UsageError(fmt::format("{} {}: expected a length in scene units, or in metres as 0.5m",
                                 option, whole));
  return *value * unit;
}

/// A rectangle of nu x nv cells, each with a sensor in its centre.
struct Rectangle {
  Vec3 origin, u, v;
  int nu, nv;
};

int cells(double length, float spacing) {
  return std::max(1, static_cast<int>(std::min(std::lround(length / spacing) * 1.0, 1e7)));
}

Places lay_out(const Rectangle& r, const Vec3& normal) {
  if (double(r.nu) * double(r.nv) > kMaxSensors)
    throw UsageError(fmt::format("{} x {} sensors: the maximum is one million", r.nu, r.nv));
  Places places;
  places.columns = r.nu, places.rows = r.nv;
  places.spacing[0] = length(r.u) / static_cast<float>(r.nu);
  places.spacing[1] = length(r.v) / static_cast<float>(r.nv);
  for (int j = r.nv - 1; j >= 0; --j)
    for (int i = 0; i < r.nu; ++i) {
      const float a = (static_cast<float>(i) + .5f) / static_cast<float>(r.nu);
      const float b = (static_cast<float>(j) + .5f) / static_cast<float>(r.nv);
      places.sensors.push_back({r.origin + r.u * a + r.v * b, normal});
    }
  return places;
}

float positive_spacing(const PlaceArguments& a) {
  const float spacing = parse_length("--spacing", a.spacing, a.meters_per_unit);
  if (!(spacing > 0))
    throw UsageError(fmt::format("--spacing {}: expected a positive length", a.spacing));
  return spacing;
}

Rectangle grid_of(const PlaceArguments& a) {
  const std::vector<std::string> parts = split(a.grid, ':');
  const auto wrong = [&] {
    return UsageError(fmt::format(
        "--grid {}: expected ORIGIN:U:V:NUxNV (a corner, two edges, and the number of "
        "sensors along each), as 0,0,0.85:4,0,0:0,3,0:8x6; or --spacing instead of NUxNV",
        a.grid));
  };
  if (parts.size() < 3 || parts.size() > 4) throw wrong();
  Rectangle r{parse_vector("--grid", parts[0]), parse_vector("--grid", parts[1]),
              parse_vector("--grid", parts[2]), 0, 0};
  if (length(cross(r.u, r.v)) == 0)
    throw UsageError(fmt::format("--grid {}: the two edges are parallel", a.grid));
  if (parts.size() == 4) {
    char rest = 0;
    if (std::sscanf(parts[3].c_str(), "%6dx%6d%c", &r.nu, &r.nv, &rest) != 2 || r.nu < 1 ||
        r.nv < 1)
      throw wrong();
  } else {
    if (a.spacing.empty()) throw wrong();
    const float spacing = positive_spacing(a);
    r.nu = cells(length(r.u), spacing), r.nv = cells(length(r.v), spacing);
  }
  return r;
}

/// The plane through the bounding box of the scene, `inset` away from its sides.
Rectangle plane_of(const PlaceArguments& a, const geom::Box3& box, Vec3& up) {
  const std::string axes = "xyz";
  const std::size_t axis = a.plane.size() > 2 && a.plane[1] == '=' ? axes.find(a.plane[0]) : 3;
  if (axis > 2)
    throw UsageError(fmt::format("--plane {}: expected AXIS=VALUE, as z=0.85", a.plane));
  if (a.spacing.empty()) throw UsageError("--plane requires --spacing");
  const float height = parse_length("--plane", a.plane.substr(2), a.meters_per_unit);
  const float inset = a.inset.empty() ? 0 : parse_length("--inset", a.inset, a.meters_per_unit);
  const float spacing = positive_spacing(a);
  if (box.isEmpty())
    throw UsageError("--plane: the scene has no geometry, so the plane has no extent");
  // Such that u x v points along the axis.
  const auto at = static_cast<int>(axis);
  const int first = (at + 1) % 3, second = (at + 2) % 3;
  const Vec3 lo = box.min + Vec3(inset), size = box.max - box.min - Vec3(2 * inset);
  if (!(size[first] > 0 && size[second] > 0))
    throw UsageError(fmt::format("--inset {}: the plane is empty; use a smaller value", a.inset));
  up = Vec3(0);
  up[at] = 1;
  Rectangle r{lo, Vec3(0), Vec3(0), cells(size[first], spacing), cells(size[second], spacing)};
  r.origin[at] = height;
  r.u[first] = size[first];
  r.v[second] = size[second];
  return r;
}

}  // namespace

Vec3 parse_vector(const std::string& option, const std::string& text) {
  const std::vector<std::string> parts = split(text, ',');
  Vec3 v(0);
  bool good = parts.size() == 3;
  for (int k = 0; good && k < 3; ++k) {
    const auto value = number(parts[static_cast<std::size_t>(k)]);
    good = value.has_value();
    if (good) v[k] = *value;
  }
  if (!good) throw UsageError(fmt::format("{} {}: expected three numbers, X,Y,Z", option, text));
  return v;
}

Places find_places(const PlaceArguments& a, const geom::Box3& scene) {
  Vec3 normal(0, 0, 1);
  std::optional<Rectangle> rectangle;
  if (!a.grid.empty()) {
    rectangle = grid_of(a);
    normal = normalize(cross(rectangle->u, rectangle->v));
  } else if (!a.plane.empty()) {
    rectangle = plane_of(a, scene, normal);
  }
  if (!a.normal.empty()) {
    normal = parse_vector("--normal", a.normal);
    if (length(normal) == 0) throw UsageError("--normal 0,0,0: expected a non-zero vector");
    normal = normalize(normal);
  }
  if (rectangle) return lay_out(*rectangle, normal);
  Places places;
  for (const std::string& point : a.points)
    places.sensors.push_back({parse_vector("--at", point), normal});
  return places;
}

}  // namespace oriel::app
