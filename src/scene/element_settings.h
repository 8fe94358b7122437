// SPDX-License-Identifier: Apache-2.0
// Typed settings of cameras, lights, objects, instances etc., with their defaults.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "base/vec.h"
#include "scene/elements.h"
#include "scene/flags.h"
#include "scene/statement_table.h"

namespace oriel::scene {

/// Settings common to several kinds of elements.
struct Attachments {
  std::uint32_t label = 0;  ///< `tag N`; 0: none
  std::string data;         ///< name of the attached data element
  bool operator==(const Attachments&) const = default;
};

enum class Stereo : std::uint8_t { None, Offset, OffAxis, ToeIn };

struct CameraSettings : Attachments {
  Vec2 offset{0, 0};  ///< film offset, pixels
  float clip_near = 0, clip_far = 0;
  std::optional<std::array<float, 4>> window;  ///< first x y, last x y; pixels
  Stereo stereo = Stereo::None;
  float eye_separation = 0, parallax_distance = 0;
  int frame = 0, frame_field = 0;
  float frame_time = 0;
  bool operator==(const CameraSettings&) const = default;
};

/// `shadowmap ...`. Shadows are always traced; shaders can query the values.
struct ShadowMap {
  bool on = false;
  bool detail = false, merge = false, trace = false, window = false, camera = false;
  int resolution = 0, samples = 0, detail_samples = 0;
  float softness = 0, bias = 0, accuracy = 0;
  char filter = 0, type = 0;  ///< first letters; type: `color` or `alpha`
  bool operator==(const ShadowMap&) const = default;
};

struct LightSettings : Attachments {
  struct Photons {
    std::uint64_t store = 0, emit = 0;
    bool operator==(const Photons&) const = default;
  };
  float exponent = 2;
  bool visible = false;
  Photons caustic, globillum;
  bool photons_only = false;
  std::optional<Rgb> energy;
  struct Profile {
    std::string name;
    SourceLocation where;
    bool operator==(const Profile&) const = default;
  };
  std::optional<Profile> profile;
  ShadowMap shadow_map;
  bool operator==(const LightSettings&) const = default;
};

struct LightProfileSettings {
  enum class Format : std::uint8_t { ByContent, Ies, Eulumdat } format = Format::ByContent;
  std::string file;
  int flags = 0;  ///< 1 clockwise, 2 counter-clockwise
  int hermite = 1, azimuth_cells = 0, polar_cells = 0;
  bool operator==(const LightProfileSettings&) const = default;
};

struct ObjectSettings : Attachments {
  FlagLayer flags;
  bool tagged = false;     ///< polygons have a label
  float max_displace = 0;  ///< 0: from the options
  std::string file;        ///< scene file of a placeholder; empty: not a placeholder
  bool operator==(const ObjectSettings&) const = default;
};

struct PolygonGroupSettings {
  float merge = 0;  ///< vertices within this distance are merged
  bool operator==(const PolygonGroupSettings&) const = default;
};

struct InstanceSettings : Attachments {
  FlagLayer flags;
  bool overrides = false;      ///< takes precedence over materials and approximations below
  bool motion_off = false;     ///< `motion off`
  bool visible_light = false;  ///< `visible` on the instance of an area light
  bool operator==(const InstanceSettings&) const = default;
};

struct InstanceGroupSettings : Attachments {
  bool operator==(const InstanceGroupSettings&) const = default;
};

struct AssemblySettings : Attachments {
  std::string file;
  bool operator==(const AssemblySettings&) const = default;
};

const ElementTable<CameraSettings>& camera_table();
const ElementTable<LightSettings>& light_table();
const ElementTable<LightProfileSettings>& light_profile_table();
const ElementTable<ObjectSettings>& object_table();
const ElementTable<PolygonGroupSettings>& polygon_group_table();
const ElementTable<InstanceSettings>& instance_table();
const ElementTable<InstanceGroupSettings>& instance_group_table();
const ElementTable<AssemblySettings>& assembly_table();

/// Reads the statements of an element; later ones override earlier ones.
///
/// Errors:  OR-SC-201 invalid values of a flag (the statement is skipped).
/// Source:  reference of the language, sections Camera, Light, Object, Instance.
/// Checked: element_settings_test.cpp, flags_test.cpp, element_tables_test.cpp in src/mi
CameraSettings settings_of(const Camera& camera);
LightSettings settings_of(const Light& light);
LightProfileSettings settings_of(const LightProfile& profile);
ObjectSettings settings_of(const Object& object, Diagnostics* diagnostics = nullptr);
PolygonGroupSettings settings_of(const PolygonGroup& group);
InstanceSettings settings_of(const Instance& instance, Diagnostics* diagnostics = nullptr);
InstanceGroupSettings settings_of(const InstanceGroup& group);
AssemblySettings settings_of(const Assembly& assembly);

}  // namespace oriel::scene
