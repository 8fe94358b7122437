// SPDX-License-Identifier: Apache-2.0
// Flattens the instance hierarchy: all placed objects, lights and cameras with inherited settings.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "base/vec.h"
#include "scene/flags.h"
#include "scene/scene.h"

namespace oriel::scene {

// Conventions
//   A matrix in a file maps parent space to local space, p_local = p_parent * M. In the product
//   from world to local space, the matrix of the outermost instance is the first factor.

enum class LeafKind : std::uint8_t { Object, Light, Camera, GeometryShader };

/// One placed element. Pointers refer to the scene, which must not change.
struct Leaf {
  LeafKind kind = LeafKind::Object;
  const Element* element = nullptr;    ///< null for a geometry shader, see the innermost instance
  std::vector<const Instance*> chain;  ///< outermost first, never empty
  Mat4 world_to_local, local_to_world;
  /// At the end of the motion interval; unset: static. Interpolation: see motion.h.
  std::optional<Mat4> motion_world_to_local;
  std::size_t first_moving = 0;  ///< index in chain; earlier instances are static (`motion off`)

  /// The instance with the materials of polygons without their own; null: none. With `override`
  /// they apply to all polygons.
  const Instance* material_source = nullptr;
  bool material_override = false;
  const LightLinks* light_links = nullptr;   ///< of the nearest instance; null: no restriction
  const LightLinks* shadow_links = nullptr;  ///< same for shadows
  ResolvedFlags flags;

  const Instance& instance() const { return *chain.back(); }
  const Object* object() const { return element ? std::get_if<Object>(element) : nullptr; }
  const Light* light() const { return element ? std::get_if<Light>(element) : nullptr; }
  const Camera* camera() const { return element ? std::get_if<Camera>(element) : nullptr; }
};

struct FlattenLimits {
  std::uint64_t leaves = 20'000'000;
  /// Mean number of instances above a leaf: chains of deeply nested groups take more memory than
  /// the leaves.
  std::uint64_t mean_depth = 32;
  std::size_t visits = 100'000'000;  ///< of instances; nested groups can multiply without leaves
  std::size_t depth = 1000;          ///< of nested groups
};

/// All leaves below `root`, a group or an instance, in the order of the groups.
///
/// Inputs:  defaults: flags with lower priority than those of objects.
/// Errors:  OR-SC-301 missing root, OR-SC-302 missing member or element, OR-SC-303 element of a
///          kind that is not allowed, OR-SC-304 a group inside itself, OR-SC-305 too many leaves or
///          nested too deeply, or chains too long (returns the leaves found so far), OR-SC-306
///          singular transform (replaced by the identity), OR-SC-307 objects without flags, assumed
///          on (a note). Each location is reported once.
/// Checked: hierarchy_test.cpp
std::vector<Leaf> flatten(const Scene& scene, std::string_view root, Diagnostics& diagnostics,
                          const FlattenLimits& limits = {}, const FlagLayer& defaults = {});

}  // namespace oriel::scene
