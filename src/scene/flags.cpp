// SPDX-License-Identifier: Apache-2.0
#include "scene/flags.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace oriel::scene {
namespace {

/// What a layer holds: for each channel two bits, cast (or be seen) and receive (or send).
enum Channel : unsigned {
  kShadow,
  kReflection,
  kRefraction,
  kTransparency,
  kFinalGather,
  kCaustic,
  kGlobillum,
  kVisible,            // the first bit only, here and below
  kCausticTakesPart,   // boolean and integer of photon flags are both meaningful,
  kGlobillumTakesPart  // so the boolean has a place of its own
};

constexpr std::uint32_t bits_of(Channel c, std::uint32_t two_bits) { return two_bits << (2 * c); }
constexpr bool has(std::uint32_t bits, Channel c, std::uint32_t bit) {
  return (bits & bits_of(c, bit)) != 0;
}
constexpr std::uint32_t kCasts = 1, kReceives = 2, kBoth = 3;
constexpr std::uint32_t kTraced =
    bits_of(kReflection, kBoth) | bits_of(kRefraction, kBoth) | bits_of(kFinalGather, kBoth);

/// A flag's keyword, the channels it writes, and the integers that `off` stands for. Photon flags
/// name the channel of their boolean.
struct FlagRow {
  std::string_view keyword;
  std::array<Channel, 3> channels;
  unsigned channel_count;
  std::uint32_t object_off, instance_off;
  std::optional<Channel> boolean = std::nullopt;
};

// Source: reference of the language, Object (shadow and trace off = 2), Instance (shadow off = 6,
// that is off-cast and on-receive; trace off = 12).
constexpr FlagRow kFlagRows[] = {
    {"visible", {kVisible}, 1, 0, 12},
    {"shadow", {kShadow}, 1, 2, 6},
    {"trace", {kReflection, kRefraction, kFinalGather}, 3, 2, 12},
    {"reflection", {kReflection}, 1, 2, 12},
    {"refraction", {kRefraction}, 1, 2, 12},
    {"transparency", {kTransparency}, 1, 2, 12},
    {"finalgather", {kFinalGather}, 1, 2, 12},
    {"caustic", {kCaustic}, 1, 0, 12, kCausticTakesPart},
    {"globillum", {kGlobillum}, 1, 0, 12, kGlobillumTakesPart},
};

const FlagRow* find_row(std::string_view keyword) {
  for (const FlagRow& row : kFlagRows)
    if (row.keyword == keyword) return &row;
  return nullptr;
}

/// A flag's value: a boolean (a bare keyword means on) or a sum of bits.
struct FlagValue {
  bool on = true;
  std::optional<std::uint32_t> integer;
};

std::optional<FlagValue> read_value(const Statement& s) {
  if (s.values.empty()) return FlagValue{};
  const Value& v = s.values[0];
  if (s.values.size() != 1) return std::nullopt;
  if (v.kind == Value::Kind::Boolean) return FlagValue{v.boolean, std::nullopt};
  if (v.kind != Value::Kind::Numbers || v.numbers.size() != 1) return std::nullopt;
  const double n = v.numbers[0];
  if (n != std::floor(n) || n < 0 || n > 15) return std::nullopt;
  return FlagValue{n != 0, static_cast<std::uint32_t>(n)};
}

void put(FlagLayer& layer, Channel channel, std::uint32_t bits, std::uint32_t mask) {
  const std::uint32_t place = bits_of(channel, mask);
  layer.bits = (layer.bits & ~place) | (bits_of(channel, bits) & place);
  layer.mask |= place;
}

void put_flag(FlagLayer& layer, const FlagRow& row, const FlagValue& value, bool in_instance) {
  if (row.boolean && !value.integer) return put(layer, *row.boolean, value.on, 1);
  const std::uint32_t off = in_instance ? row.instance_off : row.object_off;
  const std::uint32_t bits = value.integer.value_or(value.on ? kBoth : off);
  // In an instance bits 4 and 8 switch off what 1 and 2 switch on; an object knows only the latter.
  const std::uint32_t mask = in_instance ? (bits | bits >> 2) & kBoth : kBoth;
  for (unsigned i = 0; i < row.channel_count; ++i) put(layer, row.channels[i], bits & kBoth, mask);
}

/// front, back, both; null for anything else. Readers may hold the word as value or as keyword.
std::optional<Face> read_face(const Statement& s) {
  constexpr std::string_view kNames[] = {"front", "back", "both"};
  std::string_view word = s.values.size() == 1 ? std::string_view(s.values[0].text) : "";
  if (s.values.empty() && s.keyword.size() > 5) word = std::string_view(s.keyword).substr(5);
  for (int i = 0; i < 3; ++i)
    if (word == kNames[i]) return static_cast<Face>(i);
  return std::nullopt;
}

FlagLayer read_layer(const std::vector<Statement>& statements, bool in_instance,
                     Diagnostics& diagnostics) {
  FlagLayer layer;
  for (const Statement& s : statements) {
    const bool is_face = s.keyword == "face" || s.keyword.starts_with("face ");
    const bool is_hide = s.keyword == "hide" && in_instance;
    const FlagRow* row = find_row(s.keyword);
    if (!row && !is_face && !is_hide) continue;
    const auto value = is_face ? std::nullopt : read_value(s);
    const auto face = is_face ? read_face(s) : std::nullopt;
    if (face)
      layer.face = face;
    else if (value && is_hide)
      layer.hidden = value->on;
    else if (value)
      put_flag(layer, *row, *value, in_instance);
    else
      diagnostics.warning("OR-SC-201", s.where, fmt::format("flag '{}' is ignored", s.keyword),
                          is_face ? "expected: face front|back|both"
                                  : fmt::format("expected: {} on|off|flag bits", s.keyword));
  }
  return layer;
}

}  // namespace

FlagLayer object_flags(const Object& object, Diagnostics& diagnostics) {
  return read_layer(object.flags, false, diagnostics);
}

FlagLayer instance_flags(const Instance& instance, Diagnostics& diagnostics) {
  return read_layer(instance.flags, true, diagnostics);
}

FlagLayer photon_flags(std::optional<int> caustic, std::optional<int> globillum) {
  FlagLayer layer;
  const auto set = [&](Channel channel, std::optional<int> value) {
    const auto bits = static_cast<std::uint32_t>(value.value_or(0));
    put(layer, channel, bits & kBoth, (bits | bits >> 2) & kBoth);
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
  const FlagLayer said = overlay(object, instances);
  constexpr std::uint32_t kDecisive = bits_of(kVisible, 1) | bits_of(kShadow, kBoth) | kTraced;
  // Where one of visible, shadow, trace is written the others' documented default is off, which
  // leaves receiving on. Where none is, the default would hide the object altogether.
  const bool assumed_on = (said.mask & kDecisive) == 0;
  const std::uint32_t unsaid_off = bits_of(kVisible, 1) | bits_of(kShadow, kCasts) |
                                   bits_of(kReflection, kCasts) | bits_of(kRefraction, kCasts) |
                                   bits_of(kFinalGather, kCasts);
  const std::uint32_t defaults = assumed_on ? ~0u : ~unsaid_off;
  const std::uint32_t bits = (said.bits & said.mask) | (defaults & ~said.mask);

  const auto rays = [&](Channel c) {
    return RayFlags{has(bits, c, kCasts), has(bits, c, kReceives)};
  };
  const auto photons = [&](Channel c, Channel takes_part) {
    return PhotonFlags{!has(bits, takes_part, 1), has(bits, c, kCasts), has(bits, c, kReceives)};
  };
  return {.visible = has(bits, kVisible, 1),
          .casts_shadow = has(bits, kShadow, kCasts),
          .receives_shadow = has(bits, kShadow, kReceives),
          .reflection = rays(kReflection),
          .refraction = rays(kRefraction),
          .transparency = rays(kTransparency),
          .finalgather = rays(kFinalGather),
          .caustic = photons(kCaustic, kCausticTakesPart),
          .globillum = photons(kGlobillum, kGlobillumTakesPart),
          .face = said.face,
          .hidden = said.hidden,
          .assumed_on = assumed_on};
}

ResolvedFlags resolve_flags(const Object& object, std::span<const Instance* const> chain,
                            Diagnostics& diagnostics) {
  FlagLayer instances;
  for (const Instance* i : chain) instances = overlay(instances, instance_flags(*i, diagnostics));
  return resolve(object_flags(object, diagnostics), instances);
}

}  // namespace oriel::scene
