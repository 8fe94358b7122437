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
  kEffectFilm = 1u << 0,      ///< window, layers, budget: a new session, nothing of the world
  kEffectCamera = 1u << 1,    ///< placement and film of the camera
  kEffectElements = 1u << 2,  ///< what depends on EditEffects::elements, see update_world()
  /// everything but meshes. Meshes whose elements did not change are reused (GeometryCache).
  kEffectWorld = 1u << 3,
};

/// The effects of edits.
struct EditEffects {
  std::uint8_t bits = kEffectNone;
  std::set<std::string> elements = {};  ///< that changed

  EditEffects& operator|=(const EditEffects& o) {
    bits |= o.bits;
    elements.insert(o.elements.begin(), o.elements.end());
    return *this;
  }
  bool has(EffectBits bit) const { return (bits & bit) != 0; }
};

/// The effects of one edit. The only place that decides them.
///
/// Model:   camera statements and transforms of instances of cameras affect the camera. Edits of
///          materials, named shaders, lights, instances and textures affect what depends on the
///          element (update_world). All other edits affect the world, and so does the unit of a
///          sky, which is searched among all shaders.
/// Inputs:  changed: the element that the edit changed, see apply_edit().
/// Checked: EditTable.* in tests/interactive
EditEffects effects_of(const scene::Scene& scene, const std::string& changed,
                       const SceneEdit& edit);

}  // namespace oriel::interactive
