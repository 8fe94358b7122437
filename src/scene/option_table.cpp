// SPDX-License-Identifier: Apache-2.0
#include "scene/option_table.h"

#include <algorithm>
#include <type_traits>

#include "color/luminance.h"

namespace oriel::scene {
namespace {

using O = RenderOptions;
using V = const StatementValues&;
using P = PhotonOptions;
using F = FinalGatherOptions;
using M = MotionOptions;
using enum Support;

/// One number r: (r, r, 2r); two: (r, t, r + t); three: as written.
TraceDepth depth_of(V v) {
  const int r = v.integer(0), t = v.size() > 1 ? v.integer(1) : r;
  return {r, t, v.size() > 2 ? v.integer(2) : r + t};
}

/// Assigns the values to a member, by the type of the member. An enumeration gets the index of the
/// alternative; a switch without a value is on.
template <auto... kPath>
void to(O& o, V v) {
  auto& target = (o.*....*kPath);
  using T = std::remove_reference_t<decltype(target)>;
  if constexpr (std::is_same_v<T, bool>)
    target = v.size() == 0 || v.on(0);
  else if constexpr (std::is_same_v<T, int>)
    target = v.integer(0);
  else if constexpr (std::is_same_v<T, float>)
    target = v.number(0);
  else if constexpr (std::is_same_v<T, Rgba>)
    target = v.color();
  else if constexpr (std::is_same_v<T, TraceDepth>)
    target = depth_of(v);
  else
    target = static_cast<T>(v.choice(0));
}

template <auto kMember, auto kEnumerator>
void is(O& o, V) {
  o.*kMember = kEnumerator;
}

void set_samples(O& o, V v) {
  const bool range = v.size() > 1;
  o.samples_max = v.integer(range ? 1 : 0);
  o.samples_min = range ? v.integer(0) : o.samples_max - 2;
}

/// Without a fourth number, the threshold of alpha is the mean of the others.
template <auto kMember>
void set_contrast(O& o, V v) {
  const Rgba c = v.color();
  o.*kMember = v.size() == 4 ? c : Rgba(c.r, c.g, c.b, (c.r + c.g + c.b) / 3);
}

// Sampling since mental ray 3.11: sample counts per pixel instead of levels of 4^n.
int level_of_count(float samples) {
  int level = 0;
  for (float most = 1.5f; samples > most && level < 9; most *= 4) ++level;
  return level;
}
void set_fewest_samples(O& o, V v) { o.samples_min = level_of_count(v.number(0)); }
void set_most_samples(O& o, V v) { o.samples_max = level_of_count(v.number(0)); }
/// The contrast threshold is inversely proportional to the quality; quality 1 is the default
/// contrast.
void set_quality(O& o, V v) {
  const float quality = v.number(0);
  if (quality > 0) o.contrast = O{}.contrast * (1 / quality);
}
void set_error_cutoff(O& o, V v) {
  const float least = v.number(0);
  Rgba& c = o.contrast;
  c = Rgba(std::max(c.r, least), std::max(c.g, least), std::max(c.b, least), std::max(c.a, least));
}

/// Selects path tracing unless a method was chosen.
void trace_paths(O& o) {
  if (o.indirect == IndirectMethod::Scene) o.indirect = IndirectMethod::Path;
}
void set_gi(O& o, V v) {
  if (v.choice(0) == 0 ? v.on(0) : v.number(0) != 0) trace_paths(o);
}
void set_environment_lighting(O& o, V v) {
  if (v.choice(0) > 0) trace_paths(o);
}

template <bool clipped>
void set_filter(O& o, V v) {
  const auto kind = clipped ? (v.choice(0) ? FilterKind::ClipLanczos : FilterKind::ClipMitchell)
                            : static_cast<FilterKind>(v.choice(0));
  const auto extent = [&](std::size_t i, float otherwise) {
    return i < v.size() && v.number(i) > 0 ? v.number(i) : otherwise;
  };
  const float width = extent(1, default_filter_width(kind));
  o.filter = {kind, width, extent(2, width)};
}

template <ShadowMode kMode>
void set_shadow_switch(O& o, V v) {
  o.shadow = v.size() == 0 || v.on(0) ? kMode : ShadowMode::Simple;
}

/// Parsed by approximation.h.
void set_elsewhere(O&, V) {}

void set_shutter(O& o, V v) {
  if (v.size() > 1) o.motion.delay = v.number(0);
  o.motion.shutter = v.number(v.size() - 1);
  o.motion.on = o.motion.shutter > 0;
}

template <auto kPhotons>
void set_photons(O& o, V v) {
  if (v.choice(0) == 0)
    (o.*kPhotons).on = v.on(0);
  else
    (o.*kPhotons).object_flags = v.integer(0);
}

template <auto kPhotons>
void set_accuracy(O& o, V v) {
  (o.*kPhotons).accuracy = v.integer(0);
  (o.*kPhotons).radius = v.size() > 1 ? v.number(1) : 0;
}

template <auto kPhotons>
void set_photon_filter(O& o, V v) {
  (o.*kPhotons).filter = static_cast<P::Filter>(v.choice(0));
  (o.*kPhotons).filter_constant = v.size() > 1 ? v.number(1) : P{}.filter_constant;
}

void set_photonmap_file(O& o, V v) { o.photonmap_file = v.choice(0) ? v.text(0) : ""; }

void set_gather(O& o, V v) {
  o.finalgather.on = v.choice(0) != 0 || v.on(0);
  o.finalgather.only = v.choice(0) == 1;
  o.finalgather.fast_lookup = v.choice(0) == 2;
}

template <bool pixels>
void set_gather_accuracy(O& o, V v) {
  o.finalgather.radius_in_pixels = pixels;
  o.finalgather.rays = v.integer(0);
  o.finalgather.max_radius = v.size() > 1 ? v.number(1) : 0;
  o.finalgather.min_radius = v.size() > 2 ? v.number(2) : 0;
}

// Source: published grammar. Of three numbers the third is used for both diffuse and sum.
void set_gather_depth(O& o, V v) {
  const int r = v.integer(0), t = v.size() > 1 ? v.integer(1) : r;
  const int diffuse = v.size() > 2 ? v.integer(2) : r + t;
  o.finalgather.depth = F::Depth{r, t, diffuse, v.size() > 3 ? v.integer(3) : diffuse};
}

void set_gather_falloff(O& o, V v) {
  o.finalgather.falloff_start = v.number(0);
  o.finalgather.falloff_stop = v.number(v.size() - 1);
}

void set_gather_files(O& o, V v) {
  o.finalgather.files.clear();
  if (v.choice(0) == 0)
    for (const Value& name : v.value(0).items) o.finalgather.files.push_back(name.text);
  if (v.choice(0) == 2) o.finalgather.files.push_back(v.text(0));
}

void set_frame_buffer(O& o, V v) {
  UserFrameBuffer b{v.integer(0), v.size() > 1 ? v.text(1) : "", true};
  if (b.type.starts_with('+') || b.type.starts_with('-')) {
    b.interpolate = b.type[0] == '+';
    b.type.erase(0, 1);
  }
  std::erase_if(o.frame_buffers, [&](const UserFrameBuffer& old) { return old.index == b.index; });
  o.frame_buffers.push_back(std::move(b));
}

void set_mattes(O& o, V v) {
  if (v.choice(0) == 0)
    o.matte_ranks = v.on(0) ? O::kDefaultMatteRanks : 0;
  else
    o.matte_ranks = std::max(v.integer(0), 0);
}

/// Read before all other statements: see interpret_options.
void set_unified_sampling(O& o, V v) {
  o.unified_sampling = v.choice(0) == 0 ? v.on(0) : v.number(0) != 0;
}

void set_luminance(O& o, V v) { o.luminance_weight = {v.number(0), v.number(1), v.number(2)}; }
void set_luminance_ntsc(O& o, V) { o.luminance_weight = kNtscLuminance; }

constexpr std::string_view kDepth = "int [int [int]]", kColor = "float [float float [float]]",
                           kDepthMeaning = "reflection, refraction, sum",
                           kMapsUnused = "shadows are traced instead of mapped",
                           kAcceleration = "acceleration structure",
                           kImportance = "importance and reach of rays",
                           kOcclusion = "ambient occlusion of the whole scene",
                           kEnvironment = "light from the environment",
                           kDiagnostic = "pictures of the method";
constexpr auto kCausticFlags = &O::caustic, kGlobillumFlags = &O::globillum,
               kPhotonvol = &O::photonvol;
constexpr auto kGather = &O::finalgather;
constexpr auto kMotion = &O::motion;

// One row per statement; clang-format would break rows.
// clang-format off
constexpr Row<O> kOptionRows[] = {
    // Sampling
    {"samples", "int [int [int int]]", Effective, "max, or min max: levels n of 4^n", set_samples},
    {"samples collect", "int", Harmless, "rasteriser"},
    {"samples motion", "int", Harmless, "rasteriser"},
    {"shading samples", "float", Harmless, "rasteriser"},
    {"contrast", "float float float [float]", Effective, "difference that asks for more samples",
     set_contrast<&O::contrast>},
    {"time contrast", "float float float [float]", Uninterpreted, "for motion blur; contrast decides",
     set_contrast<&O::time_contrast>},
    {"filter", "box|triangle|gauss|mitchell|lanczos [float [float]]", Effective,
     "kind, width and height in pixels", set_filter<false>},
    {"filter (clip)", "mitchell|lanczos [float [float]]", Effective, "no negative results",
     set_filter<true>},
    {"jitter", "float", Effective, "0 none, 1 the whole cell", to<&O::jitter>},
    {"samplelock", "bool", Effective, "same pattern in every frame", to<&O::samplelock>},
    {"task size", "int", Harmless, "tile edge", to<&O::task_size>},
    // Rays
    {"trace", "bool", Effective, "secondary rays", to<&O::trace>},
    {"trace depth", kDepth, Effective, kDepthMeaning, to<&O::trace_depth>},
    {"trace importance", "...", Uninterpreted, kImportance},
    {"trace falloff", "...", Uninterpreted, kImportance},
    {"trace accuracy", "...", Uninterpreted, kImportance},
    {"scanline", "bool|rast|rapid|opengl", Harmless, "first hit method"},
    {"shadow", "off|on|sort|segments", Effective, "how blockers are met", to<&O::shadow>},
    {"shadow (sort)", "[bool]", Effective, "older form", set_shadow_switch<ShadowMode::Sort>},
    {"shadow (segments)", "[bool]", Effective, "older form", set_shadow_switch<ShadowMode::Segments>},
    {"shadowmap", "off|on|only|opengl|detail", Harmless, kMapsUnused, to<&O::shadowmap>},
    {"shadowmap trace", "...", Harmless, kMapsUnused},
    {"shadowmap window", "...", Harmless, kMapsUnused},
    {"shadowmap bias", "...", Harmless, kMapsUnused},
    {"shadowmap motion", "...", Harmless, kMapsUnused},
    {"shadowmap rebuild", "... merge", Harmless, kMapsUnused},
    {"face", "front|back|both", Effective, "sides that primary rays see", to<&O::face>},
    {"acceleration", "... bsp|bsp2|large_bsp|grid|raycl", Harmless, kAcceleration},
    {"bsp: size|depth|memory|shadow", "...", Harmless, kAcceleration},
    {"grid: size|depth|resolution", "...", Harmless, kAcceleration},
    {"object space", "", Effective, "geometry is local", is<&O::space, Space::Object>},
    {"camera space", "", NotYet, "geometry is in camera space", is<&O::space, Space::Camera>},
    {"mixed space", "", NotYet, "geometry local, instances camera", is<&O::space, Space::Mixed>},
    {"world space", "", NotYet, "geometry is in world space", is<&O::space, Space::World>},
    // Geometry and motion
    {"displace", "bool", Effective, "displacement shaders", to<&O::displace>},
    {"displace presample", "bool", Harmless, "looks for bounds first", to<&O::displace_presample>},
    {"max displace", "float", Effective, "greatest displacement", to<&O::max_displace>},
    {"approximate", "<approximation>", Effective, "tessellation of every object", set_elsewhere},
    {"motion", "bool", Effective, "motion blur", to<kMotion, &M::on>},
    {"motion steps", "int", Effective, "points of a path", to<kMotion, &M::steps>},
    {"shutter", "float [float]", Effective, "close, or delay close", set_shutter},
    {"shutter delay", "float", Effective, "opens at", to<kMotion, &M::delay>},
    {"field", "off|even|odd", Uninterpreted, "half pictures"},
    {"inheritance", "... string", Uninterpreted, "function that inherits parameters"},
    {"traversal", "<name>", Uninterpreted, "function that inherits parameters"},
    {"data", "<name>", Uninterpreted, "user data"},
    {"hardware", "... all|force|cg|native|fast", Harmless, "graphics hardware"},
    {"attribute", "<text>", Uninterpreted, "overrides of attributes"},
    // Switches
    {"lens", "bool", Effective, "lens shaders", to<&O::lens>},
    {"volume", "bool", Effective, "volume shaders of the camera", to<&O::volume>},
    {"geometry", "bool", NotYet, "geometry shaders", to<&O::geometry>},
    {"output", "bool", Effective, "output shaders and files", to<&O::output>},
    {"merge", "bool", Harmless, "joins surfaces", to<&O::merge>},
    {"hair", "bool", Effective, "hair geometry", to<&O::hair>},
    {"pass", "bool", NotYet, "sample passes", to<&O::pass>},
    {"autovolume", "bool", NotYet, "finds the volumes around the eye", to<&O::autovolume>},
    {"lightmap", "off|on|only", NotYet, "light map shaders", to<&O::lightmap>},
    // Photons
    {"caustic", "bool|int", Effective, "photons; flags of objects", set_photons<kCausticFlags>},
    {"globillum", "bool|int", Effective, "photons; flags of objects", set_photons<kGlobillumFlags>},
    {"caustic accuracy", "int [float]", Effective, "photons, radius", set_accuracy<kCausticFlags>},
    {"globillum accuracy", "int [float]", Effective, "photons, radius", set_accuracy<kGlobillumFlags>},
    {"photonvol accuracy", "int [float]", NotYet, "photons, radius", set_accuracy<kPhotonvol>},
    {"caustic filter", "box|cone|gauss [float]", Effective, "weight within the radius",
     set_photon_filter<kCausticFlags>},
    {"globillum filter", "box|cone|gauss [float]", Effective, "weight within the radius",
     set_photon_filter<kGlobillumFlags>},
    {"caustic scale", kColor, Effective, "factor", to<kCausticFlags, &P::scale>},
    {"globillum scale", kColor, Effective, "factor", to<kGlobillumFlags, &P::scale>},
    {"photonvol scale", kColor, NotYet, "factor", to<kPhotonvol, &P::scale>},
    {"photon trace depth", kDepth, Effective, kDepthMeaning, to<&O::photon_depth>},
    {"photon autovolume", "bool", NotYet, "volumes around lights", to<&O::photon_autovolume>},
    {"photonmap file", "off|string", Effective, "kept photon map", set_photonmap_file},
    {"photonmap rebuild", "bool", Effective, "start over", to<&O::photonmap_rebuild>},
    {"photonmap only", "[bool]", Effective, "no picture", to<&O::photonmap_only>},
    {"caustic importance", "...", Uninterpreted, kImportance},
    {"globillum importance", "...", Uninterpreted, kImportance},
    {"caustic falloff", "...", Uninterpreted, kImportance},
    {"globillum falloff", "...", Uninterpreted, kImportance},
    // Final gathering
    {"finalgather", "bool|only|fastlookup", Effective, "final gathering", set_gather},
    {"finalgather accuracy", "int [float [float]]", Effective, "rays, max and min radius",
     set_gather_accuracy<false>},
    {"finalgather accuracy (view)", "int [float [float]]", Effective, "radii in pixels",
     set_gather_accuracy<true>},
    {"finalgather trace depth", "int [int [int [int]]]", Effective,
     "reflection, refraction, diffuse, sum", set_gather_depth},
    {"finalgather presample density", "float", Effective, "points before the picture",
     to<kGather, &F::presample_density>},
    {"finalgather filter", "int", Effective, "against speckles", to<kGather, &F::filter>},
    {"finalgather falloff", "float [float]", Effective, "reach: start, stop", set_gather_falloff},
    {"finalgather scale", kColor, Effective, "factor", to<kGather, &F::scale>},
    {"finalgather secondary scale", kColor, Effective, "factor of further bounces",
     to<kGather, &F::secondary_scale>},
    {"finalgather file", "list|off|string", Effective, "kept points", set_gather_files},
    {"finalgather rebuild", "off|on|freeze", Effective, "start over", to<kGather, &F::rebuild>},
    {"finalgather importance", "...", Uninterpreted, kImportance},
    {"ambientocclusion", "...", Uninterpreted, kOcclusion},
    {"ambientocclusion: importance|falloff|accuracy", "...", Uninterpreted, kOcclusion},
    {"ibl", "...", Uninterpreted, kEnvironment},
    {"ibl: importance|falloff|accuracy", "...", Uninterpreted, kEnvironment},
    // Output
    {"frame buffer", "int [string]", NotYet, "buffer by number", set_frame_buffer},
    {"gamma", "float", Effective, "of integer files", to<&O::gamma>},
    {"desaturate", "bool", Effective, "too bright colours fade to white", to<&O::desaturate>},
    {"dither", "bool", Effective, "noise below one step", to<&O::dither>},
    {"premultiply", "bool", Effective, "colours times alpha", to<&O::premultiply>},
    {"colorclip", "rgb|alpha|raw", Effective, "which of colour and alpha yields", to<&O::colorclip>},
    {"luminance weight", "float float float", Effective, "red, green, blue", set_luminance},
    {"luminance weight (ntsc)", "", Effective, ".299 .587 .114", set_luminance_ntsc},
    {"colorprofile", "... string", Uninterpreted, "render space"},
    {"contour store", "<text>", Uninterpreted, "contours"},
    {"contour contrast", "<text>", Uninterpreted, "contours"},
    {"diagnostic: samples|finalgather", "...", Uninterpreted, kDiagnostic},
    {"diagnostic: photon", "... density|irradiance", Uninterpreted, kDiagnostic},
    {"diagnostic: grid", "... object|world|camera", Uninterpreted, kDiagnostic},
    {"diagnostic: bsp", "... depth|size", Uninterpreted, kDiagnostic},
    {"diagnostic: hardware", "... grid|window|light|solid", Uninterpreted, kDiagnostic},
    // String options
    {"\"cryptomatte\"", "bool|int", Effective, "mattes of EXR files; ranks of a pixel",
     set_mattes},
    {"\"indirect\"", "scene|path|path+cache|fg|photons|fg+photons", Effective, "how light is gathered",
     to<&O::indirect>},
    {"\"guiding\"", "bool", Effective, "whether paths learn where light comes from",
     to<&O::guiding>},
    {"\"unified sampling\"", "bool|float", Effective, "off: the other \"samples\" options do not act",
     set_unified_sampling},
    {"\"samples min\"", "float", Effective, "fewest samples of a pixel, as level 4^n",
     set_fewest_samples},
    {"\"samples max\"", "float", Effective, "most samples of a pixel, as level 4^n",
     set_most_samples},
    {"\"samples quality\"", "float [float [float [float]]]", Effective,
     "contrast .1 divided by it", set_quality},
    {"\"samples error cutoff\"", "float [float [float [float]]]", Effective, "least contrast",
     set_error_cutoff},
    {"\"gi\"", "bool|float", Effective, "on: path tracing", set_gi},
    {"\"environment lighting mode\"", "off|automatic|light|approximate|on", Effective,
     "not off: path tracing, which samples the environment", set_environment_lighting},
    {"\"light importance sampling\"", "...", Harmless, "lights are always chosen by importance"},
    {"\"light relative scale\"", "...", Harmless, "lights keep the scale that their shaders give"},
    {"\"ray differentials\"", "...", Harmless, "textures are always filtered by footprints"},
    {"\"trace camera clip\"", "...", Harmless, "clip planes always act on eye rays"},
    {"\"trace camera motion vectors\"", "...", Harmless, "the layer motion has them"},
    {"\"contrast all buffers\"", "bool", NotYet, "contrast of user buffers too",
     to<&O::contrast_all_buffers>},
    {"\"finalgather mode\"", "automatic|multiframe|3.4|strict_3.4", Effective,
     "how points are weighted", to<kGather, &F::mode>},
    {"\"finalgather points\"", "int", Effective, "interpolated points", to<kGather, &F::points>},
    {"\"finalgather rays\"", "int", Effective, "rays", to<kGather, &F::rays>},
    {"\"finalgather normal tolerance\"", "float", Effective, "degrees",
     to<kGather, &F::normal_tolerance>},
    {"\"caustic merge\"", "float", Effective, "distance", to<kCausticFlags, &P::merge>},
    {"\"globillum merge\"", "float", Effective, "distance", to<kGlobillumFlags, &P::merge>},
    {"\"photonvol merge\"", "float", NotYet, "distance", to<kPhotonvol, &P::merge>},
};
// clang-format on

}  // namespace

const ElementTable<RenderOptions>& option_table() {
  static const ElementTable<RenderOptions> table(kOptionRows);
  return table;
}

}  // namespace oriel::scene
