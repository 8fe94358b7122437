// SPDX-License-Identifier: Apache-2.0
// What has to be prepared again after an edit.
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "interactive/scene_edit.h"

namespace oriel::interactive {

/// Parts of the prepared scene that an edit changes; bits.
enum EffectBits : std::uint8_t {
  kEffectNone = 0,
  kEffectFilm = 1u << 0,       ///< window, layers, budget: a new session, nothing of the world
  kEffectCamera = 1u << 1,     ///< placement and film of the camera
  kEffectMaterials = 1u << 2,  ///< shaders of materials that refer to EditEffects::materials
  /// everything but meshes: shaders, lights, sky, instances, options. Meshes whose elements did not
  /// change are reused (GeometryCache).
  kEffectWorld = 1u << 3,
};

/// The effects of edits.
struct EditEffects {
  std::uint8_t bits = kEffectNone;
  std::set<std::string> materials;  ///< changed materials and named shaders

  EditEffects& operator|=(const EditEffects& o) {
    bits |= o.bits;
    materials.insert(o.materials.begin(), o.materials.end());
    return *this;
  }
  bool has(EffectBits bit) const { return (bits & bit) != 0; }
};

/// The effects of one edit. The only place that decides them.
///
/// Model:   a constant value of a parameter of a material or a named shader affects materials; what
///          else depends on it (lights, emission, opacity, displacement) is found when they are
///          bound again (bind_materials_again). Camera statements and transforms of instances of
///          cameras affect the camera. All other edits affect the world.
/// Inputs:  changed: the element that the edit changed, see apply_edit().
/// Checked: EditTable.* in tests/interactive
EditEffects effects_of(const scene::Scene& scene, const std::string& changed,
                       const SceneEdit& edit);

}  // namespace oriel::interactive
