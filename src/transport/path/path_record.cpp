// SPDX-License-Identifier: Apache-2.0
#include "transport/path/path_record.h"

namespace oriel {

void PathRecord::scale(float factor) {
  radiance *= factor;
  for (std::size_t k = 0; k < requested.light_layers; ++k) by_light.of[k] *= factor;
  if (aovs)
    for (Rgb& result : aovs->result) result *= factor;
}

void PathRecord::begin_mean() {
  paths_ = hits_ = 0;
  if (aovs) aovs->occlusion = aovs->dimming = Rgb(0), aovs->opacity = 0;
}

void PathRecord::add_path(const PathRecord& path, const Rgb& weight, float share) {
  radiance += path.radiance * weight * share;
  alpha += path.alpha * share;
  normal += path.normal * share;
  albedo += path.albedo * share;
  if (path.depth > 0) depth += path.depth, irradiance += path.irradiance, ++hits_;
  if (paths_++ == 0) surface_values = path.surface_values;
  note_first_surface(path.first);
  for (std::size_t k = 0; k < requested.light_layers; ++k)
    by_light.of[k] += path.by_light.of[k] * weight * share;
  if (!aovs) return;
  const AovValues& part = *path.aovs;
  for (std::size_t i = 0; i < kAovs; ++i) aovs->result[i] += part.result[i] * weight * share;
  for (std::size_t i = 0; i < kLevels; ++i) aovs->level[i] += part.level[i] * share;
  aovs->occlusion += part.occlusion * share;
  aovs->dimming += part.dimming * share;
  aovs->opacity += part.opacity * share;
}

void PathRecord::end_mean() {
  if (hits_ == 0) return;
  const auto hits = static_cast<float>(hits_);
  depth /= hits, irradiance /= hits;
}

}  // namespace oriel
