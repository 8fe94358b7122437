// SPDX-License-Identifier: Apache-2.0
// The result of a material at a point: weighted lobes with the manual's controls, for light
// transport.
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
  /// Oren-Nayar, `roughness` in radians; with inverse_albedo Burley's lobe, with his roughness
  Diffuse,
  Mirror,  ///< perfect reflection
  /// anisotropic microfacets, white, multiple scattering compensated. With eta other than 1: facets
  /// of a dielectric that scatter once, times inverse_albedo
  GlossyReflection,
  ClearRefraction,  ///< through the interface, total reflection beyond the critical angle
  GlossyRefraction,
  ThinTransmission,  ///< straight through a thin wall
  GlossyThin,        ///< blurred, through a thin wall
  Translucency,      ///< diffuse to the other side
  Sheen,             ///< fibres of cloth; `roughness` is alpha of bsdf::Sheen
  // Light sources only, as in mental ray's illumination shaders; see bsdf/highlights.h:
  PhongHighlight,     ///< cos^`roughness` about the mirrored view
  TorranceHighlight,  ///< microfacets: `roughness` is their slope, `eta` the index
  WardHighlight,      ///< alpha_x, alpha_y: slopes
  HairHighlight       ///< cos^`roughness` about the cone around frame.s
};
inline bool is_highlight(LobeKind kind) { return kind >= LobeKind::PhongHighlight; }

/// The output of the material that a lobe belongs to.
enum class LobeType : std::uint8_t { Diffuse, Reflection, Refraction, Translucency };

/// Limits of the rays of a lobe, as in the manual.
struct LobeControls {
  float samples = 1;                ///< maximum number of rays at the first hit, integer above 1
  int depth = 0;                    ///< trace depth of the material; 0 = the scene's
  float cutoff = 0;                 ///< rays with a smaller share of the pixel are not traced
  bool highlights_only = false;     ///< no rays: light sources only
  bool emulated = false;            ///< highlights only, and blurred reflections of gathered light
  bool mirrored = false;            ///< highlights only, while a mirror lobe shows visible lights
  bool falloff_to_color = false;    ///< else to the environment
  bool single_environment = false;  ///< rays that hit nothing look up the mirror direction only
  float falloff_distance = 0;       ///< rays end there, with a linear fade; 0 = unlimited
  Rgb falloff_color{0};
  bool interpolate = false;   ///< rays are traced on a grid over the picture and smoothed
  int grid_density = 2;       ///< 0..5: 2, 1, 1/2, 1/3, 1/4, 1/5 points per pixel
  int neighbours = 2;         ///< points looked up along each side
  float detail_distance = 0;  ///< nearer surfaces are traced instead; 0 = none
};

/// Linear fade: the remaining fraction at t; a distance of 0 means no fade.
inline float linear_fade(float t, float distance) {
  return distance > 0 ? std::max(0.0f, 1 - t / distance) : 1.0f;
}

/// Ambient occlusion: of light from diffuse surfaces and the environment, and of an ambient light.
/// Source: manual 1.4.6.1, 1.6.7.1.
struct Occlusion {
  int samples = 0;     ///< maximum number of rays at the first hit; 0 = no occlusion
  float distance = 0;  ///< scene units; 0 = unlimited
  Rgb dark{0};         ///< factor at full occlusion
  Rgb ambient{0};      ///< ambient light, attenuated by occlusion
  /// 0 ambient only; 1 attenuates indirect light; 2 replaces it by the neighbours' colour
  int details = 1;
};

/// A lobe with weight; its own directional albedo is at most 1.
struct Lobe {
  LobeKind kind = LobeKind::Diffuse;
  LobeType type = LobeType::Diffuse;
  Rgb weight{0};        ///< per view direction; includes energy conservation and the angle curve
  Frame frame;          ///< z = shading normal on the viewer's side, x = stretch direction
  float roughness = 0;  ///< Diffuse: sigma; of highlights see LobeKind
  float alpha_x = 0, alpha_y = 0;
  /// of glossy lobes for this viewer; set by transport, for facets and Burley's lobe by the shader
  float inverse_albedo = 0;
  /// refractive index on the far side divided by that on the viewer's side
  float eta = 1;
  LobeControls controls;
};

/// Absorption between a surface of the material and the next, on the inner side.
struct Medium {
  Rgb absorption{0};         ///< per scene unit: transmittance exp(-absorption * d)
  float black_distance = 0;  ///< > 0: fades linearly to black at this distance, where rays end
  bool clear() const { return is_black(absorption) && black_distance == 0; }
};

/// Storage for lobes that is not initialised until they are added.
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

/// The result of a material at a point. Fixed size, allocated on the stack.
struct Closure {
  static constexpr int kMaxLobes = 8;
  LobeStorage<kMaxLobes> lobes;  ///< only the first `count` exist
  int count = 0;

  Rgb emission{0};                   ///< independent of lights
  float alpha = 1;                   ///< of camera samples of the surface
  float opacity = 1;                 ///< opaque fraction of the surface (cut-outs)
  const NodeList* volume = nullptr;  ///< volume shaders of the object behind the surface
  /// Of the solid behind the surface; of a thin wall, up to the next surface behind it.
  Medium inside;
  bool thin_walled = true;  ///< false: a boundary of a solid, `inside` and eta apply
  /// light is refracted behind the surface, and shadows are opaque
  bool refractive_caustics = false;
  bool propagate_alpha = false;
  bool seen_from_back = true;  ///< false: back faces are invisible to the camera
  float highlight_scale = 1;   ///< hl_vs_refl_balance: light sources in reflecting lobes
  /// no_visible_area_hl off: both highlight and reflection
  bool highlights_of_visible_lights = false;
  float glossiness = -1;  ///< as ShadingPoint::glossiness
  int light_mode = 4;     ///< 0 list or linked or all, 1 the list, 2 all others, 4 linked or all
  ArrayView<LightRef> lights;
  Rgb albedo{0};  ///< for the albedo layer: sum of the weights
  Occlusion occlusion;
  float indirect_scale = 1;  ///< factor of light from diffuse surfaces and the environment
  bool outputs = true;       ///< false: the result is the only output of the material

  /// Whether a lobe fulfils the predicate.
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

/// Whether the lobe transmits light straight (unrefracted) for shadows.
inline bool transmits(LobeKind kind) {
  return kind == LobeKind::ClearRefraction || kind == LobeKind::GlossyRefraction ||
         kind == LobeKind::ThinTransmission || kind == LobeKind::GlossyThin;
}

}  // namespace oriel
