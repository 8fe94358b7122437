// SPDX-License-Identifier: Apache-2.0
// Grids of interpolated reflections: computing their points, and looking them up.
#include "transport/path/glossy_grid.h"
#include "transport/path/path_walk.h"
#include "transport/shadow.h"

namespace oriel {

void Path::tabulate(const Camera::Ray& eye, int density, GridPoint& point) {
  task_.grid_point = &point;
  task_.grid_density = density;
  run(eye);
}

/// At the first surface of a grid point's ray: traces its interpolated lobes with weight 1.
void Path::fill_grid_point(Closure& closure, const Material& material, ShadingPoint& point) {
  GridPoint& out = *task_.grid_point;
  LobeChoice choice;
  make_ready(closure, point.wo());
  choose_lobes(closure, choice, point, indirect());
  for (int i = 0; i < closure.count; ++i) {
    if (choice.rays[i] <= 0 || !closure.lobes[i].controls.interpolate ||
        closure.lobes[i].controls.grid_density != task_.grid_density)
      continue;
    // Only this lobe, with weight 1.
    Closure alone = closure;
    for (int k = 0; k < alone.count; ++k) alone.lobes[k].weight = Rgb(k == i ? 1.0f : 0.0f);
    const Lobe& lobe = alone.lobes[i];
    const auto rays =
        is_delta(lobe.kind) ? 1u : std::max(1u, static_cast<std::uint32_t>(lobe.controls.samples));
    LobeChoice only;
    only.any = true;
    only.rays[i] = static_cast<float>(rays);
    const bool refracts = transmits(lobe.kind);
    PathRecord seen({}, record_->user_buffers);
    seen.alpha = 1;
    for (std::uint32_t j = 0; j < rays; ++j) {
      Path branch = *this;
      branch.task_.grid_point = nullptr;
      branch.eye_hit_.alpha_open = true;
      branch.record_ = &seen;
      branch.sampler_ = sampler_.split(j, rays, static_cast<std::uint32_t>(i));
      // Reflecting lobes show lights without a visible shape by their highlights; refracting lobes
      // include them here.
      branch.from_.lights.environment_samples = 0;
      if (refracts) {
        std::construct_at(&branch.from_.lights, world_, point, alone);
        branch.from_.lights.environment_samples = environment_samples(material);
        branch.light_.throughput = Rgb(1 / static_cast<float>(rays));
        branch.take_direct(alone, only, point, true);
        branch.light_.throughput = Rgb(1);
      }
      if (needs_origin()) branch.from_.point = point;
      branch.from_.shadows = receives_shadows(world_, point);
      branch.from_.visible = branch.from_.invisible = {1, 0};
      if (branch.continue_path(alone, only, material, point, i, branch.sampler_.next_1d(),
                               refracts)) {
        ++branch.depth_.vertex;
        branch.walk();
      }
    }
    out.instance = point.instance;
    out.material = &material;
    out.normal = point.normal;
    (refracts ? out.refraction : out.reflection) = seen.radiance;
    if (refracts) out.alpha = seen.alpha;
  }
}

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
