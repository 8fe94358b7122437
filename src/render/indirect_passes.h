// SPDX-License-Identifier: Apache-2.0
// What is worked out before the picture: photons, then points where light is gathered.
#pragma once

#include <atomic>

#include "render/window.h"
#include "transport/gather_points.h"
#include "transport/photon_trace.h"

namespace oriel {

/// Which maps a picture needs. None: paths find indirect light themselves.
struct IndirectPlan {
  bool gather = false, global = false, caustic = false;
  bool any() const { return gather || global || caustic; }
};

/// The plan of the options. A scene that asks for final gathering or photons and names no method is
/// path traced.
IndirectPlan plan_indirect(const scene::RenderOptions& options);

/// Photon maps and gather points of one picture.
///
/// Model:   photons first. Gather points in passes over ever finer grids of the picture: a pass
///          asks the cache as it stands, gathers where it knows nothing within its error, and adds
///          all new records in the order of pixels; so the result does not depend on threads.
/// Checked: tests/keystone (three methods on the same scenes), EmulatedReflection.* in
///          tests/analytic
class IndirectPasses {
 public:
  /// `cancel` ends gathering soon, with what is there; may be null.
  IndirectPasses(const World& world, const Window& window, std::uint32_t seed, RayCounts& counts,
                 const std::atomic<bool>* cancel);
  IndirectPasses(const IndirectPasses&) = delete;
  IndirectPasses& operator=(const IndirectPasses&) = delete;

  /// Null when there is nothing to read.
  const IndirectMaps* maps() const { return plan_.any() ? &maps_ : nullptr; }

 private:
  void gather(const World& world, const Window& window, std::uint32_t seed, RayCounts& counts,
              const std::atomic<bool>* cancel);

  IndirectPlan plan_;
  IndirectMaps maps_;
  PhotonMaps photons_;
  GatherCache cache_;
};

}  // namespace oriel
