// SPDX-License-Identifier: Apache-2.0
// Visibility and shadow flags of objects, resolved over the instances above them.
#pragma once

#include <optional>

#include "scene/render_options.h"
#include "scene/statement_table.h"

namespace oriel::scene {

// Conventions
//   A chain lists instances outermost first. Flags are inherited: a lower instance overrides a
//   higher one, and any instance overrides the object. Only `hide` cannot be overridden.

/// Visibility flags for one ray type: whether the object is visible to it and can emit it.
struct RayFlags {
  bool seen = true, sends = true;
  bool operator==(const RayFlags&) const = default;
};

/// Flags for one photon type: whether the object scatters photons and stores them.
struct PhotonFlags {
  bool excluded = false;  ///< photons ignore the object
  bool casts = true, receives = true;
  bool operator==(const PhotonFlags&) const = default;
};

struct ResolvedFlags {
  bool visible = true;  ///< seen by primary rays
  bool casts_shadow = true, receives_shadow = true;
  RayFlags reflection, refraction, transparency, finalgather;
  PhotonFlags caustic, globillum;
  std::optional<Face> face;  ///< unset: from the options
  bool hidden = false;
  /// No visible, shadow or trace flag on the object or its instances; assumed on. By the reference
  /// of the language such an object is invisible.
  bool assumed_on = false;
  bool operator==(const ResolvedFlags&) const = default;
};

/// Flags from statements: `mask` marks the bits that were written, `bits` contains their values.
struct FlagLayer {
  std::uint32_t bits = 0, mask = 0;
  std::optional<Face> face;
  bool hidden = false;
  bool operator==(const FlagLayer&) const = default;
};

enum class Flag : std::uint8_t {
  Visible,
  Shadow,
  Trace,
  Reflection,
  Refraction,
  Transparency,
  FinalGather,
  Caustic,
  Globillum
};

/// Applies `[on|off|flag_bits]`. Flag bits of an object: 1 cast or visible, 2 receive or emit;
/// `off` leaves receive on. Flag bits of an instance: 1 and 2 set the two, 4 and 8 clear them.
void set_flag(FlagLayer& layer, Flag flag, const StatementValues& values, bool in_instance);
/// Default flags of objects from the options; integers as in an instance.
FlagLayer photon_flags(std::optional<int> caustic, std::optional<int> globillum);
/// Overrides `higher` by the written flags of `lower`.
FlagLayer overlay(const FlagLayer& higher, const FlagLayer& lower);
/// Overrides `object` by `instances` and applies defaults to the remaining flags.
/// Source:  reference of the language, sections Object and Instance.
/// Checked: flags_test.cpp
ResolvedFlags resolve(const FlagLayer& object, const FlagLayer& instances);

}  // namespace oriel::scene
