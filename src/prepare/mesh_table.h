// SPDX-License-Identifier: Apache-2.0
// The meshes of a picture: created, displaced, or reused from the previous frame.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "prepare/geometry_cache.h"
#include "prepare/prepare.h"
#include "prepare/prepare_displacement.h"
#include "prepare/tessellation_plan.h"

namespace oriel {

/// One mesh of the world: the mesh of a job with one set of displacement shaders applied.
struct MeshVariant {
  std::size_t job = 0;
  Displacement displacement;
  const scene::Leaf* first = nullptr;  ///< the leaf whose placement its shaders see
  geom::MeshId id{};
};

/// Creates the meshes of a plan in the world's accel, which is that of the previous frame if there
/// is one. Order of calls: slots() to bind materials, add() for the variants, instances, commit().
class MeshTable {
 public:
  MeshTable(const scene::Scene& scene, TessellationPlan plan, World& world, GeometryCache& cache,
            Diagnostics& diagnostics);

  std::size_t size() const { return plan_.jobs.size(); }
  std::uint32_t of_leaf(std::size_t leaf) const { return plan_.job_of_leaf[leaf]; }
  const std::vector<geom::MaterialSlot>& slots(std::size_t job) const;
  /// Whether a mesh of the previous frame may have to be rebuilt at the end.
  bool takes_over() const {
    return std::any_of(kept_.begin(), kept_.end(), [](const auto& k) { return k.has_value(); });
  }
  void add(std::vector<MeshVariant>& variants, PrepareReport& report);
  void commit();

 private:
  class RefinementBudget;
  struct Displaced;

  GeometryCache::Form form_of(const TessellationJob& job) const;
  std::optional<geom::MeshId> kept_mesh(const TessellationJob& job) const;
  /// Triangles of subdivision surfaces, which are known before they are made.
  std::uint64_t subdivided() const;
  /// Tessellates all objects that are not reused. Returns false and stops as soon as their
  /// surfaces have more than `most` triangles.
  bool make_all(std::uint64_t most, Diagnostics& diagnostics);
  /// Limits all surfaces, so that together they stay within the budget.
  void limit_surfaces();
  /// Displaces the variants in parallel, each with at most `most` triangles. `uses`: variants of
  /// each job.
  std::vector<Displaced> displace_all(const std::vector<MeshVariant>& variants,
                                      const std::vector<std::size_t>& uses, std::size_t most);
  /// The mesh as displaced one after the other: `made`, unless its limit `each` affected it.
  geom::Mesh displaced_mesh(const MeshVariant& v, Displaced made, std::size_t each,
                            RefinementBudget& left);
  geom::Mesh make(std::size_t job, Diagnostics& diagnostics) const;
  geom::Mesh with_keys(geom::Mesh mesh) const;

  const scene::Scene& scene_;
  TessellationPlan plan_;
  World& world_;
  GeometryCache& cache_;
  Diagnostics& diagnostics_;
  std::vector<geom::Mesh> meshes_;                 // of the jobs that are not reused
  std::vector<std::optional<geom::MeshId>> kept_;  // from the previous frame
  std::map<geom::MeshId, std::size_t> plain_;      // jobs of undisplaced meshes
  std::uint64_t generated_ = 0;                    // triangles that are not in the file
};

}  // namespace oriel
