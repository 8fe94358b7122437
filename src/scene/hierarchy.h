// SPDX-License-Identifier: Apache-2.0
// From the root group to its leaves: every placed object, light and camera with what it inherits.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "base/vec.h"
#include "scene/flags.h"
#include "scene/scene.h"

namespace oriel::scene {

// Conventions
//   A file's matrix maps the parent's space to the local one, p_local = p_parent * M; so from world
//   to local the outermost instance's matrix stands first.

enum class LeafKind : std::uint8_t { Object, Light, Camera, GeometryShader };

/// One placed element. Pointers are into the scene, which must not change meanwhile.
struct Leaf {
  LeafKind kind = LeafKind::Object;
  const Element* element = nullptr;    ///< null for a geometry shader: see the innermost instance
  std::vector<const Instance*> chain;  ///< outermost first, never empty
  Mat4 world_to_local, local_to_world;
  /// At the end of the motion interval; unset: does not move. See motion.h for the way there.
  std::optional<Mat4> motion_world_to_local;
  std::size_t first_moving = 0;  ///< of the chain; `motion off` holds those before and itself

  /// The instance whose materials apply to polygons without their own; null: none. Where it says
  /// `override` they apply to all polygons.
  const Instance* material_source = nullptr;
  bool material_override = false;
  const LightLinks* light_links = nullptr;   ///< the nearest instance's; null: no restriction
  const LightLinks* shadow_links = nullptr;  ///< likewise
  ResolvedFlags flags;

  const Instance& instance() const { return *chain.back(); }
  const Object* object() const { return element ? std::get_if<Object>(element) : nullptr; }
  const Light* light() const { return element ? std::get_if<Light>(element) : nullptr; }
  const Camera* camera() const { return element ? std::get_if<Camera>(element) : nullptr; }
};

struct FlattenLimits {
  std::size_t leaves = 20'000'000;
  std::size_t visits = 100'000'000;  ///< of instances; groups can multiply without any leaf
  std::size_t depth = 1000;          ///< of nested groups
};

/// All leaves below `root`, a group or an instance, in the order the groups name them.
///
/// Inputs:  defaults: flags that objects lie over.
/// Errors:  OR-SC-301 no such root, OR-SC-302 a member or element that nothing defines, OR-SC-303
///          one of a kind that cannot stand there, OR-SC-304 a group inside itself, OR-SC-305 too
///          many leaves or too deep (what was found so far is returned), OR-SC-306 singular
///          transform (identity instead), OR-SC-307 objects without flags, taken as on (a note).
///          Each place is reported once, however often it is reached.
/// Checked: hierarchy_test.cpp
std::vector<Leaf> flatten(const Scene& scene, std::string_view root, Diagnostics& diagnostics,
                          const FlattenLimits& limits = {}, const FlagLayer& defaults = {});

}  // namespace oriel::scene
