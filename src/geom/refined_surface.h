// SPDX-License-Identifier: Apache-2.0
// A uniformly refined subdivision surface with all columns. Private to subdivide.cpp and its parts.
#pragma once

#include <opensubdiv/far/topologyRefiner.h>

#include <memory>
#include <vector>

#include "geom/mesh.h"
#include "geom/subdivision_cage.h"

namespace oriel::geom {

/// Points, motion and texture values of the last level at the limit surface; those of the cage at
/// level 0.
class RefinedSurface {
 public:
  /// Returns null if the topology of the faces is invalid.
  static std::unique_ptr<RefinedSurface> make(const SubdivisionCage& cage, int level);

  const OpenSubdiv::Far::TopologyLevel& level() const {
    return refiner_->GetLevel(refiner_->GetMaxLevel());
  }
  /// Origin of a face of the last level in the cage.
  struct Origin {
    std::uint32_t face = 0;  ///< index in the list of the scene
    /// Corner of that face; 3 of a triangle (Loop) is the middle one, -1 the whole face.
    int child = -1;
  };
  Origin origin(int face) const;

  std::vector<Vec3> positions;
  std::vector<Vec3> tangent_normals;  ///< normals of the limit surface; empty at level 0
  std::vector<std::vector<Vec3>> motion;
  std::vector<TextureSpace> channels;

 private:
  RefinedSurface(const SubdivisionCage& cage,
                 std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> refiner);

  const SubdivisionCage& cage_;
  std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> refiner_;
};

}  // namespace oriel::geom
