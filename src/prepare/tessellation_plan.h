// SPDX-License-Identifier: Apache-2.0
// Which meshes a picture needs: which objects, how finely, for which placements.
#pragma once

#include <vector>

#include "runtime/camera.h"
#include "scene/approximation.h"
#include "scene/hierarchy.h"

namespace oriel {

/// One mesh to make.
struct TessellationJob {
  const scene::Object* object = nullptr;
  scene::ApproximationContext context;
  bool approximated = false;  ///< something says how finely; else the context does not matter
};

struct TessellationPlan {
  std::vector<TessellationJob> jobs;
  std::vector<std::uint32_t> job_of_leaf;  ///< scene::kNone: no object, or a hidden one
};

/// An object becomes one mesh for all its placements, or one for each chain of instances that say
/// something of approximations. Lengths in pixels are measured where the object looks largest.
/// Checked: TessellationPlan.*
TessellationPlan plan_tessellation(const std::vector<scene::Leaf>& leaves,
                                   const scene::Options* options, const Camera& camera);

}  // namespace oriel
