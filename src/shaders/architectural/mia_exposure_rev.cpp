// SPDX-License-Identifier: Apache-2.0
// mia_exposure_photographic_rev: inverse of the photographic exposure, so that a photograph in the
// background is unchanged by the exposure.
#include <algorithm>

#include "runtime/world.h"
#include "shaders/architectural/mia_exposure.h"
#include "tone/exposure_reverse.h"

namespace oriel {
namespace {

struct MiaExposureRevParams {
  Rgba input;
  float cm2_factor;
  Rgba whitepoint;
  float film_iso, camera_shutter, f_number, vignetting, burn_highlights, crush_blacks, saturation,
      gamma;
};

constexpr ParamSpec kMiaExposureRevRows[] = {
    {ORIEL_PARAM(MiaExposureRevParams, input),
     .doc = "Colour of the image. The name of this parameter is Oriel's own.",
     .support = Support::Approximated, .declared_default = false},
    {ORIEL_PARAM(MiaExposureRevParams, cm2_factor), .fallback = {1},
     .doc = "Same as for mia_exposure_photographic, like all parameters below."},
    {ORIEL_PARAM(MiaExposureRevParams, whitepoint), .fallback = {1, 1, 1},
     .doc = "White point: the colour that is mapped to grey."},
    {ORIEL_PARAM(MiaExposureRevParams, film_iso), .fallback = {100}, .min = 0, .unit = "ISO",
     .doc = "Film speed; 0 = plain gain by cm2_factor."},
    {ORIEL_PARAM(MiaExposureRevParams, camera_shutter), .fallback = {100}, .min = 0, .unit = "1/s",
     .doc = "Shutter speed: 100 means 1/100 s."},
    {ORIEL_PARAM(MiaExposureRevParams, f_number), .fallback = {16}, .min = 0,
     .doc = "F-number of the aperture."},
    {ORIEL_PARAM(MiaExposureRevParams, vignetting), .fallback = {1}, .min = 0,
     .doc = "Exponent of the cosine that darkens the image edges."},
    {ORIEL_PARAM(MiaExposureRevParams, burn_highlights), .min = 0, .max = 1,
     .doc = "Highlight compression: 1 linear, 0 never overexposed."},
    {ORIEL_PARAM(MiaExposureRevParams, crush_blacks), .fallback = {.25f}, .min = 0, .max = 1,
     .doc = "Compression of dark values towards black."},
    {ORIEL_PARAM(MiaExposureRevParams, saturation), .fallback = {1}, .min = 0,
     .doc = "Colour saturation of the result."},
    {ORIEL_PARAM(MiaExposureRevParams, gamma), .fallback = {2.2f}, .min = 0,
     .doc = "Display gamma of the input; 1 if its texture is already linear."},
};

struct State final : ShaderState {
  explicit State(const lens::PhotographicParameters& p) : parameters(p), reverse(p) {}
  lens::PhotographicParameters parameters;
  lens::ReversePhotographicExposure reverse;
};

/// Cosine between the ray and the optical axis, limited to that of the film corner, where
/// vignetting is strongest.
float cos_to_film(const Camera& camera, const Vec3& direction) {
  if (camera.orthographic || !(camera.focal > 0)) return 1;
  const float width = camera.aperture / (2 * camera.focal);
  const float height = camera.aspect > 0 ? width / camera.aspect : 0;
  const float corner = 1 / std::sqrt(1 + sqr(width) + sqr(height));
  return std::max(-normalize(transform_vector(direction, camera.to_camera)).z, corner);
}

}  // namespace

const ShaderSpec kMiaExposurePhotographicRev = {
    .name = "mia_exposure_photographic_rev",
    .library = "architectural",
    .apply = kApplyTexture | kApplyEnvironment,
    .doc = "Inverse photographic exposure: radiance from a finished image.",
    .params = kMiaExposureRevRows,
    .params_size = sizeof(MiaExposureRevParams),
    .value =
        [](const Call& call, void* result) {
          const auto& p = call.as<MiaExposureRevParams>();
          const World* world = call.point.world;
          const float cosine =
              world && p.vignetting != 0 ? cos_to_film(world->camera, call.point.ray_direction) : 1;
          const auto& state = *static_cast<const State*>(call.state);
          const lens::PhotographicParameters now = photographic_parameters(p);
          const Rgb c = now == state.parameters
                            ? state.reverse(rgb(p.input), cosine)
                            : lens::ReversePhotographicExposure(now)(rgb(p.input), cosine);
          *static_cast<Rgba*>(result) = Rgba(c.x, c.y, c.z, p.input.a);
        },
    .binding =
        {
            .prepare = [](const void* params, const World&) -> std::unique_ptr<ShaderState> {
              return std::make_unique<State>(
                  photographic_parameters(*static_cast<const MiaExposureRevParams*>(params)));
            },
        },
};

}  // namespace oriel
