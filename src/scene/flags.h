// SPDX-License-Identifier: Apache-2.0
// Who sees an object: its flags and those of the instances above it, resolved.
#pragma once

#include <optional>

#include "scene/render_options.h"
#include "scene/statement_table.h"

namespace oriel::scene {

// Conventions
//   A chain lists instances outermost first. Flags pass down; a lower instance overrides a higher
//   one, and any instance overrides what the object itself says. Only `hide` cannot be taken back.

/// One kind of ray: whether it meets the object, and whether it may leave from it.
struct RayFlags {
  bool seen = true, sends = true;
  bool operator==(const RayFlags&) const = default;
};

/// One kind of photon: whether the object scatters it on and whether it stores it.
struct PhotonFlags {
  bool excluded = false;  ///< photons pass as if the object were not there
  bool casts = true, receives = true;
  bool operator==(const PhotonFlags&) const = default;
};

struct ResolvedFlags {
  bool visible = true;  ///< seen by primary rays
  bool casts_shadow = true, receives_shadow = true;
  RayFlags reflection, refraction, transparency, finalgather;
  PhotonFlags caustic, globillum;
  std::optional<Face> face;  ///< unset: as the options say
  bool hidden = false;
  /// Neither the object nor an instance says visible, shadow or trace; taken as on. Strictly such
  /// an object is seen by nothing.
  bool assumed_on = false;
  bool operator==(const ResolvedFlags&) const = default;
};

/// Flags read from statements, ready to be laid over each other: `mask` says which bits were
/// written, `bits` their values.
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

/// Writes `[on|off|flag_bits]`. Integers of an object: 1 casts or is seen, 2 receives or sends;
/// `off` keeps receiving. Integers of an instance: 1, 2 switch the two on; 4, 8 off.
void set_flag(FlagLayer& layer, Flag flag, const StatementValues& values, bool in_instance);
/// What options say for objects that do not: integers as in an instance.
FlagLayer photon_flags(std::optional<int> caustic, std::optional<int> globillum);
/// `lower` laid over `higher`.
FlagLayer overlay(const FlagLayer& higher, const FlagLayer& lower);
/// `instances` laid over `object`, and what is still open decided.
/// Source:  reference of the language, sections Object and Instance.
/// Checked: flags_test.cpp
ResolvedFlags resolve(const FlagLayer& object, const FlagLayer& instances);

}  // namespace oriel::scene
