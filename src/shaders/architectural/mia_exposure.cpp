// SPDX-License-Identifier: Apache-2.0
#include "shaders/architectural/mia_exposure.h"

#include <algorithm>

#include "runtime/shader_node.h"
#include "tone/exposure.h"

namespace oriel {
namespace {

struct Photographic {
  float cm2_factor;
  Rgba whitepoint;
  float film_iso, camera_shutter, f_number, vignetting, burn_highlights, crush_blacks, saturation,
      gamma;
  int side_channel_mode;
  std::string_view side_channel;
  ColorTextureRef preview;
  bool use_preview;
};
struct Simple {
  float pedestal, gain, knee, compression, gamma;
  ColorTextureRef preview;
  bool use_preview;
};

constexpr ParamSpec kPhotographicRows[] = {
    {ORIEL_PARAM(Photographic, cm2_factor), .fallback = {1},
     .doc = "Factor from pixel values to cd/m2; plain gain if film_iso is 0."},
    {ORIEL_PARAM(Photographic, whitepoint), .fallback = {1, 1, 1},
     .doc = "White point: the colour that is mapped to grey."},
    {ORIEL_PARAM(Photographic, film_iso), .fallback = {100}, .min = 0, .unit = "ISO",
     .doc = "Film speed; 0 = plain gain by cm2_factor."},
    {ORIEL_PARAM(Photographic, camera_shutter), .fallback = {100}, .min = 0, .unit = "1/s",
     .doc = "Shutter speed: 100 means 1/100 s."},
    {ORIEL_PARAM(Photographic, f_number), .fallback = {16}, .min = 0,
     .doc = "F-number of the aperture."},
    {ORIEL_PARAM(Photographic, vignetting), .fallback = {1}, .min = 0,
     .doc = "Exponent of the cosine that darkens the image edges."},
    {ORIEL_PARAM(Photographic, burn_highlights), .min = 0, .max = 1,
     .doc = "Highlight compression: 1 linear, 0 never overexposed."},
    {ORIEL_PARAM(Photographic, crush_blacks), .fallback = {.25f}, .min = 0, .max = 1,
     .doc = "Compression of dark values towards black."},
    {ORIEL_PARAM(Photographic, saturation), .fallback = {1}, .min = 0,
     .doc = "Colour saturation of the result."},
    {ORIEL_PARAM(Photographic, gamma), .fallback = {2.2f}, .min = 0, .doc = "Display gamma."},
    {ORIEL_PARAM(Photographic, side_channel_mode), .min = 0, .max = 2,
     .doc = "Side channel use: 1 the output shader maps the input of the lens shader, 2 "
            "the output shader restores it."},
    {ORIEL_PARAM(Photographic, side_channel),
     .doc = "Name of the side channel, shared by lens and output shader.",
     .declared_default = false},
    {ORIEL_PARAM(Photographic, preview), .doc = "Image to map instead of rendering.",
     .declared_default = false},
    {ORIEL_PARAM(Photographic, use_preview),
     .doc = "Whether `preview` is mapped instead of rendering.", .declared_default = false},
};
constexpr ParamSpec kSimpleRows[] = {
    {ORIEL_PARAM(Simple, pedestal), .doc = "Offset, added first."},
    {ORIEL_PARAM(Simple, gain), .fallback = {1}, .doc = "Factor, applied after pedestal."},
    {ORIEL_PARAM(Simple, knee), .fallback = {.5f},
     .doc = "Value above which colours are compressed."},
    {ORIEL_PARAM(Simple, compression), .fallback = {2}, .min = 0,
     .doc = "Compression ratio; 0 = none."},
    {ORIEL_PARAM(Simple, gamma), .fallback = {2.2f}, .min = 0, .doc = "Display gamma."},
    {ORIEL_PARAM(Simple, preview), .doc = "Image to map instead of rendering.",
     .declared_default = false},
    {ORIEL_PARAM(Simple, use_preview), .doc = "Whether `preview` is mapped instead of rendering.",
     .declared_default = false},
};

lens::SimpleParameters simple_parameters(const Simple& p) {
  return {.pedestal = p.pedestal,
          .gain = p.gain,
          .knee = p.knee,
          .compression = p.compression,
          .gamma = p.gamma};
}

/// An exposure with the constant parameters.
template <class Exposure, class Parameters>
struct ExposureState final : ShaderState {
  explicit ExposureState(const Parameters& p) : parameters(p), exposure(p) {}
  /// With the parameters of a call, which differ if any is connected.
  template <class F>
  auto with(const Parameters& now, F&& f) const {
    return now == parameters ? f(exposure) : f(Exposure(now));
  }
  Parameters parameters;
  Exposure exposure;
};
using PhotographicState = ExposureState<lens::PhotographicExposure, lens::PhotographicParameters>;
using SetNumber = std::function<void(const char* name, float value)>;
using SimpleState = ExposureState<lens::SimpleExposure, lens::SimpleParameters>;

}  // namespace

const ShaderSpec kMiaExposurePhotographic = {
    .name = "mia_exposure_photographic",
    .library = "architectural",
    .version = 4,
    .apply = kApplyLens | kApplyOutput,
    .doc = "Photographic exposure by film speed, shutter and aperture for pixels in cd/m2.",
    .params = kPhotographicRows,
    .params_size = sizeof(Photographic),
    .lens = {
        .map_color =
            [](const Call& call, const LensCall& lens, const Rgb& c) {
              return static_cast<const PhotographicState*>(call.state)
                  ->with(photographic_parameters(call.as<Photographic>()),
                         [&](const auto& exposure) {
                           return exposure(c, lens.orthographic ? 1.0f : lens.cos_to_film);
                         });
            },
        .traits =
            [](const ShaderNode& node) {
              const auto& p = node.constants<Photographic>();
              return LensTraits{.preview = p.use_preview ? p.preview.texture : nullptr,
                                .side_channel_mode = std::clamp(p.side_channel_mode, 0, 2),
                                .side_channel = p.side_channel,
                                .luminance = p.film_iso > 0 ? p.cm2_factor : 0,
                                .gamma = p.gamma};
            },
        .settings =
            [](const ShaderNode& node, const SetNumber& set) {
              const auto p = photographic_parameters(node.constants<Photographic>());
              set("cm2_factor", p.cm2_factor);
              set("whitepoint.r", p.whitepoint.x);
              set("whitepoint.g", p.whitepoint.y);
              set("whitepoint.b", p.whitepoint.z);
              set("film_iso", p.film_iso);
              set("camera_shutter", p.camera_shutter);
              set("f_number", p.f_number);
              set("vignetting", p.vignetting);
              set("burn_highlights", p.burn_highlights);
              set("crush_blacks", p.crush_blacks);
              set("saturation", p.saturation);
              set("gamma", p.gamma);
            },
    },
    .binding =
        {
            .prepare = [](const void* params, const World&) -> std::unique_ptr<ShaderState> {
              return std::make_unique<PhotographicState>(
                  photographic_parameters(*static_cast<const Photographic*>(params)));
            },
        },
};

const ShaderSpec kMiaExposureSimple = {
    .name = "mia_exposure_simple",
    .library = "architectural",
    .version = 1,
    .apply = kApplyLens | kApplyOutput,
    .doc = "Tone mapping by gain, knee and gamma.",
    .params = kSimpleRows,
    .params_size = sizeof(Simple),
    .lens = {
        .map_color =
            [](const Call& call, const LensCall&, const Rgb& c) {
              return static_cast<const SimpleState*>(call.state)
                  ->with(simple_parameters(call.as<Simple>()),
                         [&](const auto& exposure) { return exposure(c); });
            },
        .traits =
            [](const ShaderNode& node) {
              const auto& p = node.constants<Simple>();
              return LensTraits{.preview = p.use_preview ? p.preview.texture : nullptr,
                                .gamma = p.gamma};
            },
        .settings =
            [](const ShaderNode& node, const SetNumber& set) {
              const auto& p = node.constants<Simple>();
              set("pedestal", p.pedestal);
              set("gain", p.gain);
              set("knee", p.knee);
              set("compression", p.compression);
              set("gamma", p.gamma);
            },
    },
    .binding =
        {
            .prepare = [](const void* params, const World&) -> std::unique_ptr<ShaderState> {
              return std::make_unique<SimpleState>(
                  simple_parameters(*static_cast<const Simple*>(params)));
            },
        },
};

}  // namespace oriel
