// SPDX-License-Identifier: Apache-2.0
// What is worked out before the picture: photons, then points where light is gathered; or read from
// files.
#pragma once

#include <functional>
#include <string>

#include "base/diagnostic.h"
#include "runtime/window.h"
#include "runtime/world.h"
#include "transport/gather/gather_bounces.h"
#include "transport/gather/gather_cache.h"
#include "transport/indirect_caches.h"
#include "transport/path/path.h"
#include "transport/photon/photon_file.h"
#include "transport/progress_monitor.h"

namespace oriel {

/// Which maps a picture needs, and how its paths go on without.
struct IndirectPlan {
  bool gather = false, global = false, caustic = false;
  bool by_name = false;   ///< a method was chosen, not left to the scene's statements
  bool indirect = false;  ///< diffuse surfaces light each other, by rays or by maps
  bool maps() const { return gather || global || caustic; }
  /// As the command line names methods; "none" where diffuse surfaces get direct light alone.
  const char* name() const;
};

/// The plan of the options: a method chosen by name, else as the scene's statements say. Of a
/// method chosen by name caustics are part where `caustic` is on.
IndirectPlan plan_indirect(const scene::RenderOptions& options);

/// Files of maps as the options name them, allowed ones alone; relative names are resolved.
struct MapFiles {
  std::string photons;
  std::vector<std::string> gather;  ///< the first is also written
};

/// Photon maps and gather points of one picture.
///
/// Model:   photons first: of lights as their elements say. Where none of them says anything, or
///          a method with photons was chosen by name, lights that do not say get kPhotonsPerLight.
///          With photons alone, by name, the environment emits as well; as the scene's own
///          statements go it does not, and is left to final gathering and to portals.
///          Files: photonmap and finalgather `rebuild` on: made anew and written. Off: read where
///          they exist; photons then are not traced, gather points are added to; then written.
///          `finalgather rebuild freeze`: read and used as they are.
/// Errors:  OR-RN-042 a map cannot be read or written (a warning; it is made anew), and those of
///          the files (OR-TR-1xx).
/// Checked: tests/cross_method (three methods on the same scenes), MapFiles.* in
///          tests/analytic/map_files_test.cpp, EmulatedReflection.* in tests/analytic
class IndirectPasses {
 public:
  explicit IndirectPasses(const World& world);
  IndirectPasses(const IndirectPasses&) = delete;
  IndirectPasses& operator=(const IndirectPasses&) = delete;

  /// `after_pass`: called when there is more to see than before.
  void run(const World& world, const Window& window, std::uint32_t seed, RayCounts& counts,
           const MapFiles& files, Diagnostics& diagnostics, const ProgressMonitor& monitor,
           const std::function<void()>& after_pass);

  const IndirectPlan& plan() const { return plan_; }
  /// What paths of the picture go by.
  PathSettings path_settings() const;
  std::size_t gather_points() const { return cache_.records().size(); }
  /// Whether some of it was read from files.
  bool read_files() const { return read_files_; }

 private:
  void shoot(const World& world, std::uint32_t seed, RayCounts& counts, const MapFiles& files,
             Diagnostics& diagnostics, const ProgressMonitor& monitor);
  void gather(const World& world, const Window& window, std::uint32_t seed, RayCounts& counts,
              const MapFiles& files, Diagnostics& diagnostics, const ProgressMonitor& monitor,
              const std::function<void()>& after_pass);

  IndirectPlan plan_;
  IndirectCaches maps_;
  PathSettings paths_;  ///< behind a diffuse surface
  PhotonMaps photons_;
  Bounces bounces_;
  GatherCache cache_;
  bool read_files_ = false;
};

}  // namespace oriel
