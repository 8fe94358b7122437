// SPDX-License-Identifier: Apache-2.0
#include "transport/path/occlusion.h"

#include <limits>

#include "sampling/warp.h"
#include "transport/scene_tracer.h"

namespace oriel {
float free_share(const World& world, const ShadingPoint& point, const Vec3& normal, float distance,
                 int samples, sampling::Sampler& sampler, RayCounts& counts) {
  /// Tells these streams from those of lobes, which number from 0.
  constexpr std::uint32_t kBranch = 1000;
  const Frame frame(normal);
  const float reach = distance > 0 ? distance : std::numeric_limits<float>::infinity();
  float free = 0;
  for (int i = 0; i < samples; ++i) {
    auto stream =
        sampler.split(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(samples), kBranch);
    const Vec3 w = frame.to_world(sampling::sample_cosine_hemisphere(stream.next_2d()));
    // Below the flat triangle there is nothing but the surface itself.
    if (dot(w, point.geometric_normal) <= 0) continue;
    const auto met = SceneTracer(world, stream, counts).probe_from(point, w, reach);
    free += !met ? 1.0f : distance > 0 ? met->distance / distance : 0.0f;
  }
  return free / static_cast<float>(samples);
}

}  // namespace oriel
