// SPDX-License-Identifier: Apache-2.0
// The meshes that a picture needs: objects, refinement and placements.
#pragma once

#include <vector>

#include "runtime/camera.h"
#include "scene/approximation.h"
#include "scene/hierarchy.h"

namespace oriel {

/// One mesh to create.
struct TessellationJob {
  const scene::Object* object = nullptr;
  scene::ApproximationContext context;
  bool approximated = false;  ///< an approximation applies; otherwise the context is irrelevant
};

struct TessellationPlan {
  std::vector<TessellationJob> jobs;
  std::vector<std::uint32_t> job_of_leaf;  ///< scene::kNone: no object, or a hidden one
};

/// An object becomes one mesh for all its placements, or one for each chain of instances with
/// approximation settings. Lengths in pixels are measured where the object appears largest.
/// Checked: TessellationPlan.*
TessellationPlan plan_tessellation(const std::vector<scene::Leaf>& leaves,
                                   const scene::Options* options, const Camera& camera);

}  // namespace oriel
