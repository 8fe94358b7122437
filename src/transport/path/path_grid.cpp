// SPDX-License-Identifier: Apache-2.0
// Interpolated reflections at a vertex, from their grids.
#include "transport/path/glossy_grid.h"
#include "transport/path/path_walk.h"

namespace oriel {

/// Adds the light of the grid for interpolated lobes. They keep their highlights, and rays within
/// the detail distance.
void Path::interpolate(Closure& closure, const Material& material, const ShadingPoint& point,
                       LobeChoice& choice) {
  if (!grid_ || !at_eye_surface()) return;
  for (int i = 0; i < closure.count; ++i) {
    Lobe& lobe = closure.lobes[i];
    LobeControls& controls = lobe.controls;
    if (choice.rays[i] > 0 && controls.interpolate) {
      const bool refracts = transmits(lobe.kind);
      const auto smooth =
          refracts ? grid_->refraction(raster_, controls.grid_density, controls.neighbours,
                                       point.instance, material, point.normal)
                   : grid_->reflection(raster_, controls.grid_density, controls.neighbours,
                                       point.instance, material, point.normal);
      if (smooth && controls.detail_distance > 0) {
        controls.falloff_distance = controls.detail_distance;
        controls.falloff_to_color = true;
        controls.falloff_color = smooth->light;
      } else if (smooth) {
        add(aov_.at_vertex(refracts ? Aov::Refraction : Aov::Reflection),
            light_.throughput * lobe.weight * smooth->light, world_.light_layers.unknown());
        if (refracts && eye_hit_.alpha_open && closure.propagate_alpha)
          record_->alpha -= (1 - smooth->alpha) * mean_of(light_.throughput * lobe.weight);
        choice.rays[i] = 0;
        // The grid includes visible lights.
        controls.highlights_only = controls.mirrored = true;
        if (refracts) lobe.weight = Rgb(0);
      }
    }
  }
  choice.share_one_ray(closure.count);
}

}  // namespace oriel
