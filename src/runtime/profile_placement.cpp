// SPDX-License-Identifier: Apache-2.0
#include "runtime/profile_placement.h"

#include <fmt/format.h>

#include "photometry/profile_file.h"
#include "scene/asset_path.h"

namespace oriel {
namespace {

using scene::Value;

/// The n-th number of a statement, over all its values.
int whole_number(const scene::Statement* statement, std::size_t n, int missing) {
  if (!statement) return missing;
  for (const Value& value : statement->values) {
    if (n < value.numbers.size())
      return static_cast<int>(clamp(static_cast<float>(value.numbers[n]), -2.0e9f, 2.0e9f));
    n -= value.numbers.size();
  }
  return missing;
}

std::string word(const scene::Statement* statement) {
  if (statement)
    for (const Value& value : statement->values)
      if (!value.text.empty()) return value.text;
  return {};
}

}  // namespace

ProfilePlacement place_profile(const photometry::LightProfile* profile, const Mat4& to_world,
                               const Vec3& direction) {
  ProfilePlacement placed;
  placed.profile = profile;
  placed.nadir = direction;
  const auto across = [&](const Vec3& axis) {
    const Vec3 a = normalize(transform_vector(axis, to_world));
    return a - direction * dot(a, direction);
  };
  const Vec3 along_x = across(Vec3(1, 0, 0)), along_y = across(Vec3(0, 1, 0));
  constexpr float kNearlyParallel = 1e-4f;
  placed.x = normalize(dot(along_x, along_x) > kNearlyParallel ? along_x : along_y);
  placed.y = cross(-direction, placed.x);
  const Vec3 x = transform_vector(Vec3(1, 0, 0), to_world),
             y = transform_vector(Vec3(0, 1, 0), to_world),
             z = transform_vector(Vec3(0, 0, 1), to_world);
  if (dot(cross(x, y), z) < 0) placed.y = -placed.y;
  return placed;
}

std::unique_ptr<photometry::LightProfile> open_light_profile(const scene::LightProfile& element,
                                                             Diagnostics& diagnostics) {
  const auto statement = [&](std::string_view keyword) {
    return find_last(element.statements, keyword);
  };
  const std::string file = word(statement("file"));
  if (file.empty()) {
    diagnostics.warning("OR-RT-040", element.where,
                        fmt::format("light profile \"{}\" names no file", element.name),
                        "write `file \"name.ies\"`; without it the light shines evenly");
    return nullptr;
  }
  const std::string path = scene::find_asset(file, element.directory);
  const std::string format = word(statement("format"));
  const int flags = whole_number(statement("flags"), 0, 0);
  try {
    using photometry::ProfileFormat, photometry::Turn;
    const photometry::ProfileData data =
        read_profile(path,
                     format == "ies"        ? ProfileFormat::Ies
                     : format == "eulumdat" ? ProfileFormat::Eulumdat
                                            : ProfileFormat::ByContent,
                     (flags & 1) != 0   ? Turn::Clockwise
                     : (flags & 2) != 0 ? Turn::CounterClockwise
                                        : Turn::AsFormat);
    for (const std::string& note : data.report.notes)
      diagnostics.note("OR-RT-041", element.where,
                       fmt::format("light profile \"{}\": {}", element.name, note));
    const scene::Statement* resolution = statement("resolution");
    const photometry::ProfileGrid grid{.cubic = whole_number(statement("hermite"), 0, 1) >= 3,
                                       .azimuth_cells = whole_number(resolution, 0, 0),
                                       .polar_cells = whole_number(resolution, 1, 0)};
    return std::make_unique<photometry::LightProfile>(data.table, grid);
  } catch (const photometry::ProfileError& e) {
    SourceLocation where = element.where;
    if (e.line > 0) {
      where = {};
      where.file = diagnostics.add_file(path, element.where);
      where.line = static_cast<std::uint32_t>(e.line);
    }
    const std::string place = e.line > 0 ? std::string() : fmt::format(" ({})", path);
    diagnostics.warning(
        "OR-RT-040", where,
        fmt::format("light profile \"{}\"{} cannot be used: {}", element.name, place, e.what()),
        fmt::format("{}; without it the light shines evenly", e.hint));
    return nullptr;
  }
}

}  // namespace oriel
