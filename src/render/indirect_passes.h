// SPDX-License-Identifier: Apache-2.0
// What is worked out before the picture: photons, then points where light is gathered.
#pragma once

#include <atomic>
#include <functional>

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
/// Checked: IndirectPasses.* in tests/analytic/gather_test.cpp
class IndirectPasses {
 public:
  /// `progress` gets the name of the pass; `cancel` ends soon, with what is there.
  IndirectPasses(const World& world, const Window& window, std::uint32_t seed, RayCounts& counts,
                 const std::function<void(const char* pass)>& progress = {},
                 const std::atomic<bool>* cancel = nullptr);
  IndirectPasses(const IndirectPasses&) = delete;
  IndirectPasses& operator=(const IndirectPasses&) = delete;

  /// Null when there is nothing to read.
  const IndirectMaps* maps() const { return plan_.any() ? &maps_ : nullptr; }
  const GatherCache& cache() const { return cache_; }
  const PhotonMaps& photons() const { return photons_; }

 private:
  void gather(const World& world, const Window& window, std::uint32_t seed, RayCounts& counts,
              const std::function<void(const char* pass)>& progress,
              const std::atomic<bool>* cancel);

  IndirectPlan plan_;
  IndirectMaps maps_;
  PhotonMaps photons_;
  GatherCache cache_;
};

}  // namespace oriel
