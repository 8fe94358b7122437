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
     .doc = "cd/m2 per unit of the pixels; with film_iso 0 the plain gain."},
    {ORIEL_PARAM(Photographic, whitepoint), .fallback = {1, 1, 1},
     .doc = "The colour shown as grey."},
    {ORIEL_PARAM(Photographic, film_iso), .fallback = {100}, .min = 0, .unit = "ISO",
     .doc = "Film speed; 0 = arbitrary mode."},
    {ORIEL_PARAM(Photographic, camera_shutter), .fallback = {100}, .min = 0, .unit = "1/s",
     .doc = "Shutter: 100 is 1/100 s."},
    {ORIEL_PARAM(Photographic, f_number), .fallback = {16}, .min = 0, .doc = "Aperture number."},
    {ORIEL_PARAM(Photographic, vignetting), .fallback = {1}, .min = 0,
     .doc = "Exponent of the cosine that darkens the edges."},
    {ORIEL_PARAM(Photographic, burn_highlights), .min = 0, .max = 1,
     .doc = "1 linear, 0 never over-exposed."},
    {ORIEL_PARAM(Photographic, crush_blacks), .fallback = {.25f}, .min = 0, .max = 1,
     .doc = "Pushes dark values toward black."},
    {ORIEL_PARAM(Photographic, saturation), .fallback = {1}, .min = 0, .doc = "Of the result."},
    {ORIEL_PARAM(Photographic, gamma), .fallback = {2.2f}, .min = 0, .doc = "Display gamma."},
    {ORIEL_PARAM(Photographic, side_channel_mode), .min = 0, .max = 2,
     .doc = "1: the output shader maps what the lens shader was given, 2: puts it back."},
    {ORIEL_PARAM(Photographic, side_channel), .doc = "Name that both share.",
     .declared_default = false},
    {ORIEL_PARAM(Photographic, preview), .doc = "Picture to map instead of rendering.",
     .declared_default = false},
    {ORIEL_PARAM(Photographic, use_preview), .doc = "Use it.", .declared_default = false},
};
constexpr ParamSpec kSimpleRows[] = {
    {ORIEL_PARAM(Simple, pedestal), .doc = "Added first."},
    {ORIEL_PARAM(Simple, gain), .fallback = {1}, .doc = "Multiplies then."},
    {ORIEL_PARAM(Simple, knee), .fallback = {.5f}, .doc = "Above it values are compressed."},
    {ORIEL_PARAM(Simple, compression), .fallback = {2}, .min = 0,
     .doc = "Compression ratio, 0 none."},
    {ORIEL_PARAM(Simple, gamma), .fallback = {2.2f}, .min = 0, .doc = "Display gamma."},
    {ORIEL_PARAM(Simple, preview), .doc = "Picture to map instead of rendering.",
     .declared_default = false},
    {ORIEL_PARAM(Simple, use_preview), .doc = "Use it.", .declared_default = false},
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
using SimpleState = ExposureState<lens::SimpleExposure, lens::SimpleParameters>;

}  // namespace

const ShaderSpec kMiaExposurePhotographic = {
    .name = "mia_exposure_photographic",
    .library = "architectural",
    .version = 4,
    .apply = kApplyLens | kApplyOutput,
    .doc = "Exposes as a camera: film speed, shutter and aperture on pixels in cd/m2.",
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
    .doc = "Maps colours by gain, knee and gamma.",
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
