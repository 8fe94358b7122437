// SPDX-License-Identifier: Apache-2.0
// Photometric profiles of lights: profile and orientation in the world.
#pragma once

#include <memory>
#include <string>

#include "base/diagnostic.h"
#include "base/file_access.h"
#include "photometry/light_profile.h"
#include "scene/elements.h"

namespace oriel {

// Conventions
//   The profile's nadir (photometry/light_profile.h) is the light's direction, or -z of its space
//   for lights without direction. Its +x is the x axis of the light's space, orthogonalised to the
//   direction; if these are parallel, the y axis is used.
struct ProfilePlacement {
  const photometry::LightProfile* profile = nullptr;  ///< null = none
  Vec3 x{1, 0, 0}, y{0, 1, 0}, nadir{0, 0, -1};       ///< unit, world
  explicit operator bool() const { return profile != nullptr; }

  Vec3 to_profile(const Vec3& world) const {
    return {dot(world, x), dot(world, y), -dot(world, nadir)};
  }
  Vec3 to_world(const Vec3& local) const { return x * local.x + y * local.y - nadir * local.z; }
  /// Intensity in a world direction, cd.
  float candela(const Vec3& direction) const { return profile->evaluate(to_profile(direction)); }
};

/// Inputs:  direction: of the light, unit, world. A mirrored space mirrors the profile.
/// Checked: PhotometricLights.AProfileTurnsWithItsLight.
ProfilePlacement place_profile(const photometry::LightProfile* profile, const Mat4& to_world,
                               const Vec3& direction);

/// Reads the file of a lightprofile element.
///
/// Model:   `format` (default: detected from the content), `file` (relative to the scene file),
///          `flags` (1: angles run clockwise, 2: counter-clockwise, otherwise as in the format),
///          `hermite` 3 (cubic, otherwise linear), `resolution` (cells of the cubic's table).
/// Errors:  OR-RT-040 with the line; returns null: the file cannot be used. OR-RT-041: a note.
/// Checked: PhotometricLights.* in tests/shader_binding/photometric_test.cpp.
std::unique_ptr<photometry::LightProfile> open_light_profile(const scene::LightProfile& element,
                                                             const FileAccess& files,
                                                             Diagnostics& diagnostics);

}  // namespace oriel
