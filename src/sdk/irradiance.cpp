// SPDX-License-Identifier: Apache-2.0
// Indirect light and occlusion at the point.
#include <algorithm>
#include <limits>

#include "base/frame.h"
#include "sampling/warp.h"
#include "sdk/call.h"
#include "sdk/once.h"

namespace oriel::sdk {
namespace {

/// Default number of rays per call; further samples of the pixel reduce the noise.
constexpr int kOcclusionRays = 1;

bool irradiance(miColor* result, miState* state, bool back) {
  Context& c = context(state);
  *result = {0, 0, 0, 0};
  if (!c.tracer()) return false;
  const ShadingPoint point = point_of(state);
  const CallerScope caller(Caller::of_ray(state));
  const Rgb found = c.tracer()->irradiance(point, back ? -point.normal : point.normal);
  *result = as_c(found, 1);
  return true;
}

}  // namespace
}  // namespace oriel::sdk

using namespace oriel;
using namespace oriel::sdk;

extern "C" {

miBoolean mi_compute_irradiance(miColor* result, miState* state) {
  return irradiance(result, state, false) ? miTRUE : miFALSE;
}

miBoolean mi_compute_irradiance_backside(miColor* result, miState* state) {
  return irradiance(result, state, true) ? miTRUE : miFALSE;
}

miBoolean mi_compute_avg_radiance(miColor* result, miState* state, miUchar face,
                                  struct miIrrad_options*) {
  if (!irradiance(result, state, face == 'b')) return miFALSE;
  result->r *= kInvPi, result->g *= kInvPi, result->b *= kInvPi;
  return miTRUE;
}

// Volumes store no photons.
miBoolean mi_compute_volume_irradiance(miColor* result, miState*) {
  warn_no_effect("mi_compute_volume_irradiance", "there are no photons in volumes");
  *result = {0, 0, 0, 0};
  return miFALSE;
}
miBoolean mi_compute_directional_irradiance(miColor* result, miState*, miScalar, miScalar,
                                            miScalar) {
  warn_no_effect("mi_compute_directional_irradiance", "there are no photons in volumes");
  *result = {0, 0, 0, 0};
  return miFALSE;
}

// Final gather points are computed when shaders request irradiance.
miBoolean mi_finalgather_store(miColor* result, miState* state, int mode) {
  return mode == miFG_STORE_COMPUTE ? mi_compute_irradiance(result, state) : miFALSE;
}

miScalar mi_ambient_occlusion(miState* state, struct miAmboccl_options* options, miVector* bent) {
  Context& c = context(state);
  if (bent) *bent = state->normal;
  if (!c.tracer()) return 0;
  const ShadingPoint point = point_of(state);
  const Vec3 axis = options ? vec(options->axis) : point.normal;
  const CallerScope caller(Caller::of_ray(state));
  const Frame frame(normalize(axis));
  const int rays = options && options->rays > 0 ? options->rays : kOcclusionRays;
  const float reach =
      options && options->maxdist > 0 ? options->maxdist : std::numeric_limits<float>::infinity();
  // Cosine-distributed within the spread; default is the hemisphere.
  const float least = options && options->spread > -1 ? std::clamp(options->spread, 0.0f, 1.0f) : 0;
  int met = 0;
  Vec3 open(0);
  for (int i = 0; i < rays; ++i) {
    const Vec3 w = frame.to_world(sampling::sample_cosine_cap(next(state), least));
    if (dot(w, point.geometric_normal) <= 0 || c.tracer()->probe_from(point, w, reach))
      ++met;
    else
      open += w;
  }
  if (bent && length(open) > 0) *bent = as_c(normalize(open));
  return static_cast<float>(met) / static_cast<float>(rays);
}

}  // extern "C"
