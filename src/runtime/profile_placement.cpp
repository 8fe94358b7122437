// SPDX-License-Identifier: Apache-2.0
#include "runtime/profile_placement.h"

#include <fmt/format.h>

#include "photometry/profile_file.h"
#include "scene/asset_path.h"
#include "scene/element_settings.h"

namespace oriel {
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
                                                             const FileAccess& files,
                                                             Diagnostics& diagnostics) {
  const scene::LightProfileSettings settings = settings_of(element);
  if (settings.file.empty()) {
    diagnostics.warning("OR-RT-040", element.where,
                        fmt::format("light profile \"{}\" names no file", element.name),
                        "write `file \"name.ies\"`; without it the light shines evenly");
    return nullptr;
  }
  const std::string path = scene::find_asset(settings.file, element.directory, files);
  try {
    OpenFile file = files.open(path, FileUse::Asset);
    using photometry::ProfileFormat, photometry::Turn;
    using Format = scene::LightProfileSettings::Format;
    const photometry::ProfileData data =
        read_profile(file,
                     settings.format == Format::Ies        ? ProfileFormat::Ies
                     : settings.format == Format::Eulumdat ? ProfileFormat::Eulumdat
                                                           : ProfileFormat::ByContent,
                     (settings.flags & 1) != 0   ? Turn::Clockwise
                     : (settings.flags & 2) != 0 ? Turn::CounterClockwise
                                                 : Turn::AsFormat);
    for (const std::string& note : data.report.notes)
      diagnostics.note("OR-RT-041", element.where,
                       fmt::format("light profile \"{}\": {}", element.name, note));
    const photometry::ProfileGrid grid{.cubic = settings.hermite >= 3,
                                       .azimuth_cells = settings.azimuth_cells,
                                       .polar_cells = settings.polar_cells};
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
