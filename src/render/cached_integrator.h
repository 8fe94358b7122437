// SPDX-License-Identifier: Apache-2.0
// Path tracing with caches of indirect light: photon maps, final gather points, grids of glossy
// reflections.
#pragma once

#include "render/best_settings.h"
#include "render/indirect_plan.h"
#include "render/integrator.h"
#include "render/learn_light.h"
#include "transport/gather/gather_bounces.h"
#include "transport/gather/gather_cache.h"
#include "transport/gather/gather_passes.h"
#include "transport/indirect_caches.h"
#include "transport/path/glossy_grid.h"
#include "transport/path/lit_surfaces.h"
#include "transport/path/path.h"
#include "transport/photon/photon_file.h"

namespace oriel {

/// Computes the caches that the options ask for, then traces paths that read them.
///
/// Model:   photons first, from each light as its element says. If no element says anything, or a
///          method with photons was chosen by name, the other lights get kPhotonsPerLight.
///          With photons alone, chosen by name, the environment emits as well. Otherwise its light
///          comes by final gathering and portals. Path tracing with `caustic on` reads photons
///          for the caustics that paths hardly find (SharpCaustics), without energy statements and
///          without files; what the camera sees searches for their chains (ManifoldCaustics).
///          Where paths may learn, and pilot paths gain by it, photons bring the caustics of other
///          lights as well.
///          Files: photonmap and finalgather `rebuild` on: computed and written. Off: read if they
///          exist; photons are then not traced, gather points are added; then written.
///          `finalgather rebuild freeze`: read and used unchanged.
/// Errors:  OR-RN-042 a map cannot be read or written (a warning; it is computed), and those of
///          the files (OR-TR-1xx).
/// Checked: tests/cross_method (three methods on the same scenes), MapFiles.* in
///          tests/analytic/gather/map_files_test.cpp, EmulatedReflection.* in tests/analytic
class CachedIntegrator final : public Integrator {
 public:
  explicit CachedIntegrator(const World& world);

  void prepare(const IntegratorPreparation& p) override;
  void help(const IntegratorPreparation& p) override;
  void save(CheckpointWriter& out) override;
  void restore(CheckpointReader& in, const IntegratorPreparation& p) override;
  void trace(const Camera::Ray& eye, Vec2 raster, float paths_of_pixel, PathRecord& record,
             sampling::Sampler& sampler, RayCounts& counts) const override;
  bool has_caches() const override { return plan_.maps() || plan_.sharp_caustics; }
  bool prepares_long(double paths) const override;
  bool is_prepared() const override { return prepared_; }
  bool caches_only() const override;
  std::size_t gather_points() const override { return cache_.records().size(); }
  std::size_t learned_bytes() const override {
    const std::size_t caustics = plan_.sharp_caustics ? photons_.caustic.bytes() : 0;
    return learned_.bytes() + rarely_found_.map.bytes() + caustics + chains_.bytes();
  }
  bool has_unknown_light() const override { return read_files_ || reads_grid(); }

 private:
  template <class Out>
  void save_maps(Out& out);
  template <class In>
  void restore_maps(In& in, const IntegratorPreparation& p);
  void start_helpers(const IntegratorPreparation& p);
  void gather_in_passes(GatherPasses passes, const IntegratorPreparation& p);
  void find_lit_surfaces(const IntegratorPreparation& p, BestSettings& best);
  bool learns() const;
  void trace_sharp_caustics(const IntegratorPreparation& p);
  void use_chains();
  void try_rarely_found(const IntegratorPreparation& p);
  void trace_rarely_found(const IntegratorPreparation& p, SharpCaustics lights, double share);
  void settle_rarely_found(const IntegratorPreparation& p);
  template <class In>
  void restore_rarely_found(In& in);
  void trace_photon_maps(const IntegratorPreparation& p);
  void use_photon_maps();
  GatherPasses gather_passes(std::uint32_t seed);
  void gather(const IntegratorPreparation& p);
  void cache_bounces(const GatherPasses& passes, const IntegratorPreparation& p);
  void use_bounces();
  void use_gather_points(const GatherPasses& passes);
  PathSettings path_settings() const;
  /// The grid's points were found through the middle of the lens; other lens rays see others.
  bool reads_grid() const { return grid_ && !grid_->empty() && world_.lens_rays.empty(); }

  const World& world_;
  IndirectPlan plan_;
  IndirectCaches maps_;
  PathSettings paths_;  ///< behind a diffuse surface
  PhotonMaps photons_;
  SharpCaustics sharp_;
  ManifoldCaustics chains_;
  SharpPhotons rarely_found_;
  Bounces bounces_;
  GatherCache cache_;
  std::optional<GlossyGrid> grid_;
  LitSurfaces lit_;
  LearnedLight learned_;
  bool read_files_ = false;
  bool prepared_ = true;
  bool helped_ = false;  ///< other processes were started, or told that there is nothing to do
};

}  // namespace oriel
