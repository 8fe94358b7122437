// SPDX-License-Identifier: Apache-2.0
// What a light of the scene says of shadow maps, for shaders that ask; shadows are traced.
#include "sdk/made_record.h"

namespace oriel::sdk {

void store_shadow_map(const scene::ShadowMap& from, miLight& out) {
  out.use_shadow_maps = from.on;
  if (from.detail) out.shadowmap_flags |= miSHADOWMAP_DETAIL;
  if (from.merge) out.shadowmap_flags |= miSHADOWMAP_MERGE;
  if (from.trace) out.shadowmap_flags |= miSHADOWMAP_TRACE;
  if (from.window) out.shadowmap_flags |= miSHADOWMAP_WINDOW;
  if (from.camera) out.shadowmap_flags |= miSHADOWMAP_CAMERA;
  out.shadowmap_resolution = from.resolution;
  out.shadowmap_samples = from.samples;
  out.shadowmap_softness = from.softness;
  out.shadowmap_bias = from.bias;
  out.shmap.accuracy = from.accuracy;
  out.shmap.samples = from.detail_samples;
  out.shmap.type = from.type;
  out.shmap.filter = from.filter;
}

}  // namespace oriel::sdk
