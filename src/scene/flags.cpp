// SPDX-License-Identifier: Apache-2.0
#include "scene/flags.h"

#include <array>

namespace oriel::scene {
namespace {

/// Slots of a layer: two bits each, cast (or visible) and receive (or emit).
enum FlagSlot : unsigned {
  kShadow,
  kReflection,
  kRefraction,
  kTransparency,
  kFinalGather,
  kCaustic,
  kGlobillum,
  kVisible,          // first bit only, also for the next two
  kCausticEnabled,   // photon flags have a boolean and an integer, which are
  kGlobillumEnabled  // independent, so the boolean has a slot of its own
};

constexpr std::uint32_t bits_of(FlagSlot c, std::uint32_t two_bits) { return two_bits << (2 * c); }
constexpr bool has(std::uint32_t bits, FlagSlot c, std::uint32_t bit) {
  return (bits & bits_of(c, bit)) != 0;
}
constexpr std::uint32_t kCasts = 1, kReceives = 2, kBoth = 3;
constexpr std::uint32_t kTraced =
    bits_of(kReflection, kBoth) | bits_of(kRefraction, kBoth) | bits_of(kFinalGather, kBoth);

/// The slots that a flag sets, and the integers that `off` means. Photon flags have a separate slot
/// for their boolean.
struct FlagRow {
  std::array<FlagSlot, 3> slots;
  unsigned slot_count;
  std::uint32_t object_off, instance_off;
  std::optional<FlagSlot> boolean = std::nullopt;
};

// In the order of Flag. Source: reference of the language, Object (shadow and trace off = 2),
// Instance (shadow off = 6, that is off-cast and on-receive; trace off = 12).
constexpr FlagRow kFlagRows[] = {
    {{kVisible}, 1, 0, 12},
    {{kShadow}, 1, 2, 6},
    {{kReflection, kRefraction, kFinalGather}, 3, 2, 12},
    {{kReflection}, 1, 2, 12},
    {{kRefraction}, 1, 2, 12},
    {{kTransparency}, 1, 2, 12},
    {{kFinalGather}, 1, 2, 12},
    {{kCaustic}, 1, 0, 12, kCausticEnabled},
    {{kGlobillum}, 1, 0, 12, kGlobillumEnabled},
};

void put(FlagLayer& layer, FlagSlot slot, std::uint32_t bits, std::uint32_t mask) {
  const std::uint32_t place = bits_of(slot, mask);
  layer.bits = (layer.bits & ~place) | (bits_of(slot, bits) & place);
  layer.mask |= place;
}

}  // namespace

void set_flag(FlagLayer& layer, Flag flag, const StatementValues& values, bool in_instance) {
  const FlagRow& row = kFlagRows[static_cast<int>(flag)];
  const bool is_integer = values.is_number(0), on = values.is_on();
  if (row.boolean && !is_integer) return put(layer, *row.boolean, on, 1);
  const std::uint32_t off = in_instance ? row.instance_off : row.object_off;
  const std::uint32_t bits =
      is_integer ? static_cast<std::uint32_t>(values.integer(0)) : (on ? kBoth : off);
  // Bits 4 and 8 of an instance clear bits 1 and 2. An object has only bits 1 and 2.
  const std::uint32_t mask = in_instance ? (bits | bits >> 2) & kBoth : kBoth;
  for (unsigned i = 0; i < row.slot_count; ++i) put(layer, row.slots[i], bits & kBoth, mask);
}

FlagLayer photon_flags(std::optional<int> caustic, std::optional<int> globillum) {
  FlagLayer layer;
  const auto set = [&](FlagSlot slot, std::optional<int> value) {
    const auto bits = static_cast<std::uint32_t>(value.value_or(0));
    put(layer, slot, bits & kBoth, (bits | bits >> 2) & kBoth);
  };
  set(kCaustic, caustic);
  set(kGlobillum, globillum);
  return layer;
}

FlagLayer overlay(const FlagLayer& higher, const FlagLayer& lower) {
  return {(higher.bits & ~lower.mask) | (lower.bits & lower.mask), higher.mask | lower.mask,
          lower.face ? lower.face : higher.face, higher.hidden || lower.hidden};
}

ResolvedFlags resolve(const FlagLayer& object, const FlagLayer& instances) {
  const FlagLayer written = overlay(object, instances);
  constexpr std::uint32_t kDecisive = bits_of(kVisible, 1) | bits_of(kShadow, kBoth) | kTraced;
  // If visible, shadow or trace is written, the documented default of the others is off, with
  // receive on. If none is written, this default would hide the object entirely.
  const bool assumed_on = (written.mask & kDecisive) == 0;
  const std::uint32_t default_off = bits_of(kVisible, 1) | bits_of(kShadow, kCasts) |
                                    bits_of(kReflection, kCasts) | bits_of(kRefraction, kCasts) |
                                    bits_of(kFinalGather, kCasts);
  const std::uint32_t defaults = assumed_on ? ~0u : ~default_off;
  const std::uint32_t bits = (written.bits & written.mask) | (defaults & ~written.mask);

  const auto rays = [&](FlagSlot c) {
    return RayFlags{has(bits, c, kCasts), has(bits, c, kReceives)};
  };
  const auto photons = [&](FlagSlot c, FlagSlot enabled) {
    return PhotonFlags{!has(bits, enabled, 1), has(bits, c, kCasts), has(bits, c, kReceives)};
  };
  return {.visible = has(bits, kVisible, 1),
          .casts_shadow = has(bits, kShadow, kCasts),
          .receives_shadow = has(bits, kShadow, kReceives),
          .reflection = rays(kReflection),
          .refraction = rays(kRefraction),
          .transparency = rays(kTransparency),
          .finalgather = rays(kFinalGather),
          .caustic = photons(kCaustic, kCausticEnabled),
          .globillum = photons(kGlobillum, kGlobillumEnabled),
          .face = written.face,
          .hidden = written.hidden,
          .assumed_on = assumed_on};
}

}  // namespace oriel::scene
