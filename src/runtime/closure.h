// SPDX-License-Identifier: Apache-2.0
// What a material says it is at a point: weighted lobes with the manual's controls. Transport reads
// it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

#include "base/assert.h"
#include "base/frame.h"
#include "runtime/param.h"

namespace oriel {

using NodeList = std::vector<const ShaderNode*>;

enum class LobeKind : std::uint8_t {
  Diffuse,           ///< Oren-Nayar; `roughness` in radians
  Mirror,            ///< perfect reflection
  GlossyReflection,  ///< anisotropic microfacets, white, multiple scattering compensated
  ClearRefraction,   ///< through the interface, total reflection beyond the critical angle
  GlossyRefraction,
  ThinTransmission,  ///< straight through a thin wall
  GlossyThin,        ///< blurred, through a thin wall
  Translucency,      ///< diffuse to the other side
  // Light sources only, as mental ray's illumination shaders show them; see bsdf/highlights.h:
  PhongHighlight,     ///< cos^`roughness` of the mirrored view
  TorranceHighlight,  ///< facets: `roughness` their slope, `eta` the index
  WardHighlight,      ///< alpha_x, alpha_y: slopes
  HairHighlight       ///< cos^`roughness` of the cone about frame.s
};
inline bool is_highlight(LobeKind kind) { return kind >= LobeKind::PhongHighlight; }

/// The output of the material a lobe belongs to.
enum class LobeType : std::uint8_t { Diffuse, Reflection, Refraction, Translucency };

/// How the manual lets rays of a lobe be limited.
struct LobeControls {
  float samples = 1;              ///< most rays at the first hit, whole numbers above 1
  int depth = 0;                  ///< trace depth of the material, 0 = the scene's
  float cutoff = 0;               ///< rays contributing less to the pixel are not traced
  bool highlights_only = false;   ///< no rays: light sources only
  bool emulated = false;          ///< highlights only, and soft reflections of what was gathered
  bool mirrored = false;          ///< highlights only, but a mirror lobe shows lights that are seen
  bool falloff_to_color = false;  ///< else to the environment
  bool single_environment = false;  ///< rays that find nothing look up one direction, the mirror's
  float falloff_distance = 0;       ///< rays end there, what they find fades linearly; 0 = none
  Rgb falloff_color{0};
  bool interpolate = false;   ///< rays are traced on a grid over the picture and smoothed
  int grid_density = 2;       ///< 0..5: 2, 1, 1/2, 1/3, 1/4, 1/5 points for a pixel
  int neighbours = 2;         ///< points looked up along each side
  float detail_distance = 0;  ///< nearer things are traced all the same; 0 = none
};

/// Share that is left at t of what fades linearly over a distance; a distance of 0 fades nothing.
inline float linear_fade(float t, float distance) {
  return distance > 0 ? std::max(0.0f, 1 - t / distance) : 1.0f;
}

/// Occlusion by what lies near: on light from diffuse surfaces and the environment, and on an
/// ambient light of its own.
/// Source: manual 1.4.6.1, 1.6.7.1.
struct Occlusion {
  int samples = 0;     ///< most rays at the first hit; 0 = no occlusion
  float distance = 0;  ///< scene units, 0 = any
  Rgb dark{0};         ///< factor where all is occluded
  Rgb ambient{0};      ///< light that is there without a source, attenuated by occlusion
  int details = 1;     ///< 0 ambient only, 1 dims indirect light, 2 replaces it by the neighbours'
};

/// Weight times a lobe whose own directional albedo is at most 1.
struct Lobe {
  LobeKind kind = LobeKind::Diffuse;
  LobeType type = LobeType::Diffuse;
  Rgb weight{0};        ///< per view direction; includes energy conservation and the angle curve
  Frame frame;          ///< z = shading normal on the viewer's side, x = stretch direction
  float roughness = 0;  ///< Diffuse: sigma; of highlights see LobeKind
  float alpha_x = 0, alpha_y = 0;
  float inverse_albedo = 0;  ///< of glossy lobes for this viewer, filled in by transport
  float eta = 1;             ///< index on the far side over index on the viewer's side
  LobeControls controls;
};

/// What light meets between a surface of the material and the next, on the inner side.
struct Medium {
  Rgb absorption{0};         ///< per scene unit: transmittance exp(-absorption * d)
  float black_distance = 0;  ///< > 0: fades linearly to black there, rays stop
  bool clear() const { return is_black(absorption) && black_distance == 0; }
};

/// Room for lobes that costs nothing until they are added.
template <int N>
class LobeStorage {
 public:
  Lobe& operator[](int i) { return *reinterpret_cast<Lobe*>(bytes_ + i * sizeof(Lobe)); }
  const Lobe& operator[](int i) const {
    return *reinterpret_cast<const Lobe*>(bytes_ + i * sizeof(Lobe));
  }

 private:
  alignas(Lobe) std::byte bytes_[N * sizeof(Lobe)];
};

/// A material at a point. Fixed size, lives on the stack.
struct Closure {
  static constexpr int kMaxLobes = 8;
  LobeStorage<kMaxLobes> lobes;  ///< only the first `count` exist
  int count = 0;

  Rgb emission{0};                   ///< added, whatever lights are there
  float alpha = 1;                   ///< of the picture where the eye sees the surface
  float opacity = 1;                 ///< cut-out: share of the surface that exists
  const NodeList* volume = nullptr;  ///< volume shaders of the object behind the surface
  /// Of the solid behind the surface; of a thin wall, of what is seen through it up to the next
  /// surface.
  Medium inside;
  bool thin_walled = true;           ///< false: a boundary of a solid, `inside` and eta apply
  bool refractive_caustics = false;  ///< light reaches what lies behind refracted, shadows opaque
  bool propagate_alpha = false;
  bool seen_from_back = true;  ///< false: the camera looks through when it sees the back
  float highlight_scale = 1;   ///< hl_vs_refl_balance: light sources in reflecting lobes
  bool highlights_of_visible_lights = false;  ///< no_visible_area_hl off: highlight and reflection
  float glossiness = -1;                      ///< as ShadingPoint::glossiness
  int light_mode = 4;  ///< 0 list or linked or all, 1 the list, 2 all but it, 4 linked or all
  ArrayView<LightRef> lights;
  Rgb albedo{0};  ///< for the albedo layer: sum of the weights
  Occlusion occlusion;
  float indirect_scale = 1;  ///< on light from diffuse surfaces and the environment
  bool outputs = true;       ///< false: the material has no outputs but its result

  /// Whether some lobe is so.
  template <class F>
  bool any(F&& is_so) const {
    for (int i = 0; i < count; ++i)
      if (is_so(lobes[i])) return true;
    return false;
  }

  Lobe& add(LobeKind kind, LobeType type, const Rgb& weight, const Frame& frame) {
    ORIEL_ASSERT(count < kMaxLobes);
    Lobe& lobe = *new (&lobes[count++]) Lobe{};
    lobe.kind = kind;
    lobe.type = type;
    lobe.weight = weight;
    lobe.frame = frame;
    return lobe;
  }
};

/// Whether light passes straight through this lobe for shadows (not bent by it).
inline bool transmits(LobeKind kind) {
  return kind == LobeKind::ClearRefraction || kind == LobeKind::GlossyRefraction ||
         kind == LobeKind::ThinTransmission || kind == LobeKind::GlossyThin;
}

}  // namespace oriel
