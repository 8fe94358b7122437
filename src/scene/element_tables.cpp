// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "scene/element_settings.h"

namespace oriel::scene {
namespace {

using V = const StatementValues&;
using C = CameraSettings;
using L = LightSettings;
using Profile = LightProfileSettings;
using Group = PolygonGroupSettings;
using S = ShadowMap;
using enum Support;

template <class T>
void set_label(T& t, V v) {
  t.label = static_cast<std::uint32_t>(std::clamp(v.number_or(0, 0), 0.0, 4294967295.0));
}

template <class T>
void set_data(T& t, V v) {
  t.data = v.word();
}

template <class T>
void set_file(T& t, V v) {
  t.file = v.word();
}

/// Assigns the first value to a member, by the type of the member. Values other than numbers count
/// as 0; a switch without a value is on.
template <auto... kPath, class T>
void first(T& t, V v) {
  auto& target = (t.*....*kPath);
  using Member = std::remove_reference_t<decltype(target)>;
  if constexpr (std::is_same_v<Member, bool>)
    target = v.is_on();
  else
    target = static_cast<Member>(v.number_or(0, 0));
}

/// Turns the switch on for any value.
template <auto... kPath, class T>
void switch_on(T& t, V) {
  (t.*....*kPath) = true;
}

template <Flag kFlag>
void set_flag_of(ObjectSettings& o, V v) {
  set_flag(o.flags, kFlag, v, false);
}
template <Flag kFlag>
void set_flag_of(InstanceSettings& i, V v) {
  set_flag(i.flags, kFlag, v, true);
}

template <class T>
void set_face(T& t, V v) {
  t.flags.face = static_cast<Face>(v.choice(0));
}

// Camera --------------------------------------------------------------------------------------

void set_offset(C& c, V v) {
  c.offset = Vec2(static_cast<float>(v.number_or(0, 0)), static_cast<float>(v.number_or(1, 0)));
}

void set_clip(C& c, V v) {
  c.clip_near = static_cast<float>(v.number_or(0, 0));
  c.clip_far = static_cast<float>(v.number_or(1, 0));
}

void set_window(C& c, V v) {
  const std::vector<double> n = v.numbers();
  c.window.reset();
  if (n.size() == 4) std::copy(n.begin(), n.end(), c.window.emplace().begin());
}

void set_frame(C& c, V v) {
  const std::vector<double> n = v.numbers();
  c.frame = n.empty() ? 0 : static_cast<int>(n[0]);
  c.frame_time = n.size() > 1 ? static_cast<float>(n[1]) : 0;
  c.frame_field = n.size() > 2 ? static_cast<int>(n[2]) : 0;
}

void set_stereo(C& c, V v) {
  std::string word = v.size() == 0 || v.is_on() ? "offaxis" : v.word();
  std::erase_if(word, [](char ch) { return ch == ' ' || ch == '_' || ch == '-'; });
  c.stereo = word.empty()        ? Stereo::None
             : word == "offaxis" ? Stereo::OffAxis
             : word == "toein"   ? Stereo::ToeIn
                                 : Stereo::Offset;
}

template <auto kMember>
void set_length(C& c, V v) {
  constexpr double kLargest = 1e9;
  const double length = v.number_or(0, 0);
  c.*kMember = std::abs(length) < kLargest ? static_cast<float>(length) : 0;
}

// Light ---------------------------------------------------------------------------------------

void set_exponent(L& l, V v) { l.exponent = static_cast<float>(v.number_or(0, 2)); }

template <auto kPhotons>
void set_light_photons(L& l, V v) {
  const auto whole = [&](std::size_t i) {
    return static_cast<std::uint64_t>(clamp(static_cast<float>(v.number_or(i, 0)), 0.0f, 1e12f));
  };
  l.*kPhotons = {whole(0), whole(1)};
}

void set_energy(L& l, V v) {
  const auto component = [&](std::size_t i) { return static_cast<float>(v.number_or(i, 0)); };
  l.energy = Rgb(component(0), component(1), component(2));
}

void set_profile(L& l, V v) {
  l.profile.reset();
  if (v.size() > 0) l.profile = {v.word(), v.where()};
}

void set_shadow_map(L& l, V v) { l.shadow_map.on = !v.is_off(); }

template <char kType>
void set_shadow_map_type(L& l, V) {
  l.shadow_map.type = kType;
}

void set_shadow_map_filter(L& l, V v) {
  if (const std::string word = v.word(); !word.empty()) l.shadow_map.filter = word[0];
}

// Light profile -------------------------------------------------------------------------------

std::string first_word(V v) {
  for (std::size_t i = 0; i < v.size(); ++i)
    if (!v.text(i).empty()) return v.text(i);
  return {};
}

void set_format(Profile& p, V v) {
  const std::string word = first_word(v);
  p.format = word == "ies"        ? Profile::Format::Ies
             : word == "eulumdat" ? Profile::Format::Eulumdat
                                  : Profile::Format::ByContent;
}

void set_profile_file(Profile& p, V v) { p.file = first_word(v); }

int whole_number(V v, std::size_t i, int missing) {
  const std::vector<double> n = v.numbers();
  return i < n.size() ? static_cast<int>(clamp(static_cast<float>(n[i]), -2.0e9f, 2.0e9f))
                      : missing;
}

void set_profile_flags(Profile& p, V v) { p.flags = whole_number(v, 0, 0); }
void set_hermite(Profile& p, V v) { p.hermite = whole_number(v, 0, 1); }
void set_resolution(Profile& p, V v) {
  p.azimuth_cells = whole_number(v, 0, 0);
  p.polar_cells = whole_number(v, 1, 0);
}

// Object, instance ----------------------------------------------------------------------------

void set_merge(Group& g, V v) {
  const double distance = v.number_or(0, 0);
  g.merge = distance > 0 && distance < 1e18 ? static_cast<float>(distance) : 0;
}

void set_visible(InstanceSettings& i, V v) {
  set_flag_of<Flag::Visible>(i, v);
  i.visible_light = v.is_on();
}

void set_hide(InstanceSettings& i, V v) { i.flags.hidden = v.is_on(); }

void set_motion(InstanceSettings& i, V v) {
  if (v.size() == 1 && v.is_off()) i.motion_off = true;
}

constexpr std::string_view kFlag = "[on|off|flag_bits]", kFace = "front|back|both",
                           kSides = "sides that rays see", kShaders = "for shaders that ask",
                           kMappedMeaning = "shadows are traced instead of mapped",
                           kLabel = "number for shaders and mattes", kData = "user data",
                           kSeenMeaning = "1 is seen, 2 sends rays",
                           kCastMeaning = "1 casts, 2 receives", kBounds = "bounds",
                           kGpu = "graphics hardware", kRasteriser = "rasteriser";
constexpr auto kMap = &L::shadow_map;

// One row per statement; clang-format would break rows.
// clang-format off
constexpr Row<C> kCameraRows[] = {
    {"offset", "... float float", Effective, "of the film, pixels", set_offset},
    {"window", "... int int int int", Effective, "first x y, last x y; pixels", set_window},
    {"clip", "... float float", Effective, "near, far", set_clip},
    {"dof", "... float float", Uninterpreted, "depth of field"},
    {"frame", "... int float int", Effective, "number, time, field; for shaders", set_frame},
    {"field", "... int", Uninterpreted, "half pictures"},
    {"stereo", "... bool|offset|toein|toe_in|offaxis|off_axis string", Effective,
     "a picture for each eye", set_stereo},
    {"eye separation", "... float", Effective, "distance of the eyes",
     set_length<&C::eye_separation>},
    {"parallax distance", "... float", Effective, "where both eyes see the same",
     set_length<&C::parallax_distance>},
    {"tag", "... int", Effective, kLabel, set_label},
    {"shift", "... float float", Uninterpreted, "of the film"},
    {"motion", "... bool", Uninterpreted, "motion blur of the camera"},
    {"motion off", "...", Uninterpreted, "no motion blur of the camera"},
    {"data", "<name>", Effective, kData, set_data},
};

constexpr Row<L> kLightRows[] = {
    {"exponent", "... float", Effective, "fall-off of photons", set_exponent},
    {"caustic photons", "... int int", Effective, "to store, to emit", set_light_photons<&L::caustic>},
    {"globillum photons", "... int int", Effective, "to store, to emit",
     set_light_photons<&L::globillum>},
    {"photons only", "... bool", Effective, "no direct light", first<&L::photons_only>},
    {"visible", "... bool", Effective, "rays see an area light", first<&L::visible>},
    {"shadowmap", "... bool", Harmless, kMappedMeaning, set_shadow_map},
    {"shadowmap resolution", "... int", Harmless, kShaders, first<kMap, &S::resolution>},
    {"shadowmap softness", "... float", Harmless, kShaders, first<kMap, &S::softness>},
    {"shadowmap samples", "... int", Harmless, kShaders, first<kMap, &S::samples>},
    {"shadowmap file", "... string", Harmless, kMappedMeaning},
    {"shadowmap filter", "... box|triangle|gauss|mitchell|lanczos", Harmless, kShaders,
     set_shadow_map_filter},
    {"shadowmap bias", "... float", Harmless, kShaders, first<kMap, &S::bias>},
    {"shadowmap accuracy", "... float", Harmless, kShaders, first<kMap, &S::accuracy>},
    {"shadowmap color", "...", Harmless, kShaders, set_shadow_map_type<'c'>},
    {"shadowmap alpha", "...", Harmless, kShaders, set_shadow_map_type<'a'>},
    {"shadowmap detail", "...", Harmless, kShaders, switch_on<kMap, &S::detail>},
    {"shadowmap detail samples", "... int", Harmless, kShaders, first<kMap, &S::detail_samples>},
    {"shadowmap merge", "...", Harmless, kShaders, switch_on<kMap, &S::merge>},
    {"shadowmap trace", "...", Harmless, kShaders, switch_on<kMap, &S::trace>},
    {"shadowmap window", "...", Harmless, kShaders, switch_on<kMap, &S::window>},
    {"shadowmap camera", "... string", Harmless, kShaders, switch_on<kMap, &S::camera>},
    {"lightprofile", "... string", Effective, "photometric distribution", set_profile},
    {"energy", "... float float float spectrum string", Effective, "flux of photons", set_energy},
    {"shadow", "... bool", Uninterpreted, "shaders of lights ask for shadows"},
    {"tag", "... int", Effective, kLabel, set_label},
    {"data", "<name>", Effective, kData, set_data},
};

constexpr Row<Profile> kLightProfileRows[] = {
    {"format", "... ies|eulumdat", Effective, "of the file", set_format},
    {"file", "... string", Effective, "photometric file", set_profile_file},
    {"flags", "... int", Effective, "1 clockwise, 2 counter-clockwise", set_profile_flags},
    {"hermite", "... int", Effective, "1 linear, 3 cubic", set_hermite},
    {"resolution", "... int int", Effective, "cells of azimuth and height", set_resolution},
};

constexpr Row<ObjectSettings> kObjectRows[] = {
    {"visible", kFlag, Effective, "seen by eye rays", set_flag_of<Flag::Visible>},
    {"shadow", kFlag, Effective, kCastMeaning, set_flag_of<Flag::Shadow>},
    {"trace", kFlag, Effective, kSeenMeaning, set_flag_of<Flag::Trace>},
    {"reflection", kFlag, Effective, kSeenMeaning, set_flag_of<Flag::Reflection>},
    {"refraction", kFlag, Effective, kSeenMeaning, set_flag_of<Flag::Refraction>},
    {"transparency", kFlag, Effective, kSeenMeaning, set_flag_of<Flag::Transparency>},
    {"finalgather", kFlag, Effective, kSeenMeaning, set_flag_of<Flag::FinalGather>},
    {"caustic", kFlag, Effective, kCastMeaning, set_flag_of<Flag::Caustic>},
    {"globillum", kFlag, Effective, kCastMeaning, set_flag_of<Flag::Globillum>},
    {"face", kFace, Effective, kSides, set_face},
    {"select", "... bool", Uninterpreted, "selection of the host"},
    {"tagged", "... bool", Effective, "polygons begin with a label", first<&ObjectSettings::tagged>},
    {"shadowmap", "... bool", Harmless, kMappedMeaning},
    {"transform", "... float", Uninterpreted, "matrix of the object"},
    {"box", "... float", Harmless, kBounds},
    {"motion box", "... float", Harmless, kBounds},
    {"max displace", "... float", Effective, "greatest displacement",
     first<&ObjectSettings::max_displace>},
    {"ray offset", "... float", Uninterpreted, "distance from which rays start"},
    {"samples", "... int int", Harmless, kRasteriser},
    {"shading samples", "... float", Harmless, kRasteriser},
    {"volume group", "... int", Uninterpreted, "volumes that do not nest"},
    {"tag", "... int", Effective, kLabel, set_label},
    {"hardware", "... int", Harmless, kGpu},
    {"file", "... string", Effective, "file with the object's geometry", set_file},
    {"photonmap file", "... string", Uninterpreted, "photon map of the object"},
    {"finalgather file", "... string", Uninterpreted, "final gather points of the object"},
    {"data", "<name>", Effective, kData, set_data},
    {"approximate", "<approximation>", Uninterpreted, "those of groups, instances, options act"},
};

constexpr Row<Group> kPolygonGroupRows[] = {
    {"merge", "... float", Effective, "vertices nearer than this become one", set_merge},
    {"approximate", "<approximation>", Effective, "tessellation"},
};

constexpr Row<InstanceSettings> kInstanceRows[] = {
    {"hide", kFlag, Effective, "takes it out of the scene", set_hide},
    {"visible", kFlag, Effective, "seen by eye rays", set_visible},
    {"shadow", kFlag, Effective, kCastMeaning, set_flag_of<Flag::Shadow>},
    {"shadowmap", "... bool", Harmless, kMappedMeaning},
    {"trace", kFlag, Effective, kSeenMeaning, set_flag_of<Flag::Trace>},
    {"reflection", kFlag, Effective, kSeenMeaning, set_flag_of<Flag::Reflection>},
    {"refraction", kFlag, Effective, kSeenMeaning, set_flag_of<Flag::Refraction>},
    {"transparency", kFlag, Effective, kSeenMeaning, set_flag_of<Flag::Transparency>},
    {"finalgather", kFlag, Effective, kSeenMeaning, set_flag_of<Flag::FinalGather>},
    {"caustic", kFlag, Effective, kCastMeaning, set_flag_of<Flag::Caustic>},
    {"globillum", kFlag, Effective, kCastMeaning, set_flag_of<Flag::Globillum>},
    {"face", kFace, Effective, kSides, set_face},
    {"select", "... bool", Uninterpreted, "selection of the host"},
    {"override", "... bool", Effective, "wins over instances below",
     switch_on<&InstanceSettings::overrides>},
    {"shading samples", "... float", Harmless, kRasteriser},
    {"hardware", "... int", Harmless, kGpu},
    {"tag", "... int", Effective, kLabel, set_label},
    {"motion", "<off|on>", Effective, "off: no motion of or above the instance", set_motion},
    {"data", "<name>", Effective, kData, set_data},
    {"approximate", "<approximation>", Effective, "tessellation below"},
};

constexpr Row<InstanceGroupSettings> kInstanceGroupRows[] = {
    {"merge", "<float>", Uninterpreted, "joins surfaces"},
    {"tag", "<int>", Effective, kLabel, set_label},
    {"data", "<name>", Effective, kData, set_data},
};

constexpr Row<AssemblySettings> kAssemblyRows[] = {
    {"box", "... float", Harmless, kBounds},
    {"motion box", "... float", Harmless, kBounds},
    {"file", "... string", Effective, "scene file with the content", set_file},
    {"tag", "... int", Uninterpreted, kLabel, set_label},
    {"data", "<name>", Uninterpreted, kData, set_data},
};
// clang-format on

template <class T>
const ElementTable<T>& table(std::span<const Row<T>> rows) {
  static const ElementTable<T> table(rows);
  return table;
}

}  // namespace

const ElementTable<C>& camera_table() { return table<C>(kCameraRows); }
const ElementTable<L>& light_table() { return table<L>(kLightRows); }
const ElementTable<Profile>& light_profile_table() { return table<Profile>(kLightProfileRows); }
const ElementTable<ObjectSettings>& object_table() { return table<ObjectSettings>(kObjectRows); }
const ElementTable<Group>& polygon_group_table() { return table<Group>(kPolygonGroupRows); }
const ElementTable<InstanceSettings>& instance_table() {
  return table<InstanceSettings>(kInstanceRows);
}
const ElementTable<InstanceGroupSettings>& instance_group_table() {
  return table<InstanceGroupSettings>(kInstanceGroupRows);
}
const ElementTable<AssemblySettings>& assembly_table() {
  return table<AssemblySettings>(kAssemblyRows);
}

CameraSettings settings_of(const Camera& camera) { return camera_table().read(camera.other); }
LightSettings settings_of(const Light& light) { return light_table().read(light.other); }
LightProfileSettings settings_of(const LightProfile& profile) {
  return light_profile_table().read(profile.statements);
}
ObjectSettings settings_of(const Object& object, Diagnostics* diagnostics) {
  return object_table().read(object.flags, diagnostics);
}
PolygonGroupSettings settings_of(const PolygonGroup& group) {
  return polygon_group_table().read(group.settings);
}
InstanceSettings settings_of(const Instance& instance, Diagnostics* diagnostics) {
  return instance_table().read(instance.flags, diagnostics);
}
InstanceGroupSettings settings_of(const InstanceGroup& group) {
  return instance_group_table().read(group.settings);
}
AssemblySettings settings_of(const Assembly& assembly) {
  return assembly_table().read(assembly.statements);
}

}  // namespace oriel::scene
