// SPDX-License-Identifier: Apache-2.0
// How the light along camera rays is computed: the methods that --gi and the option "indirect"
// name.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "runtime/camera.h"
#include "runtime/window.h"
#include "runtime/world.h"
#include "sampling/sampler.h"
#include "transport/counts.h"
#include "transport/path/path_record.h"
#include "transport/progress_monitor.h"
#include "transport/work_share.h"

namespace oriel {

class CheckpointReader;
class CheckpointWriter;

/// Files of caches that the options name; only allowed ones. Relative names are resolved.
struct MapFiles {
  std::string photons;
  std::vector<std::string> gather;  ///< the first one is also written
  bool read_only = false;           ///< none is written
};

/// Arguments of Integrator::prepare().
struct IntegratorPreparation {
  Window window;  ///< the part of the picture that maps are computed for
  /// The picture without a crop, and the number of camera paths that it would get. What paths learn
  /// refers to it, so that a crop has the same pixels.
  Window picture;
  double paths = 0;
  float noise = 0;  ///< relative noise that ends the picture, with fewer paths; 0: none
  std::uint32_t seed = 0;
  const MapFiles& files;
  Diagnostics& diagnostics;
  const ProgressMonitor& monitor;
  std::function<void()> after_pass;  ///< called when trace() finds more light than before
  RayCounts& counts;
  /// Processes that prepare the same picture. The leader calls Integrator::prepare(), the others
  /// Integrator::help(). Null: this process alone.
  WorkShare* share = nullptr;
};

/// Computes the light along camera rays.
///
/// Model:   prepare() runs once, before the picture; trace() is then called from many threads. A
///          new method is a class and a row of integrators().
class Integrator {
 public:
  Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;
  virtual ~Integrator() = default;

  virtual void prepare(const IntegratorPreparation&) {}
  /// Computes a share of prepare() of the leading process. restore() has to follow.
  virtual void help(const IntegratorPreparation&) {}
  /// Traces one camera ray and records its light.
  /// Inputs:  raster: where the sample is on the picture; paths_of_pixel: the number of paths that
  ///          the pixel gets in all; record: empty, as after reset().
  virtual void trace(const Camera::Ray& eye, Vec2 raster, float paths_of_pixel, PathRecord& record,
                     sampling::Sampler& sampler, RayCounts& counts) const = 0;

  /// Writes what prepare() computed to a checkpoint.
  virtual void save(CheckpointWriter&) {}
  /// Reads it instead of prepare().
  /// Errors:  CheckpointError.
  virtual void restore(CheckpointReader&, const IntegratorPreparation&) {}

  /// False if prepare() was cancelled.
  virtual bool is_prepared() const { return true; }
  /// Whether prepare() computes caches.
  virtual bool has_caches() const { return false; }
  /// Whether prepare() may take long for a picture of that many camera paths.
  virtual bool prepares_long(double paths) const {
    (void)paths;
    return has_caches();
  }
  /// Whether the options ask for the caches only, without a picture.
  virtual bool caches_only() const { return false; }
  /// Number of final gather points in the caches.
  virtual std::size_t gather_points() const { return 0; }
  /// Memory of what paths learned of the light before the picture; 0 = they learned nothing.
  virtual std::size_t learned_bytes() const { return 0; }
  /// Whether some light may have no light layer, since it comes from files or interpolation.
  virtual bool has_unknown_light() const { return false; }
};

/// A method of indirect light.
struct IntegratorSpec {
  scene::IndirectMethod method;
  const char* name;   ///< on the command line
  const char* about;  ///< for the help
  std::unique_ptr<Integrator> (*make)(const World& world);
};

/// All methods, in the order of the help.
std::span<const IntegratorSpec> integrators();
/// Null if no method has the name.
const IntegratorSpec* find_integrator(std::string_view name);
/// The integrator of the world's options. The world outlives it.
std::unique_ptr<Integrator> make_integrator(const World& world);

}  // namespace oriel
