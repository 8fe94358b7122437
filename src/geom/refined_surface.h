// SPDX-License-Identifier: Apache-2.0
// A subdivision surface refined alike everywhere, with all its columns. Private to subdivide.cpp
// and what it is made of.
#pragma once

#include <opensubdiv/far/topologyRefiner.h>

#include <memory>
#include <vector>

#include "geom/mesh.h"
#include "geom/subdivision_cage.h"

namespace oriel::geom {

/// Points, motion and texture values of the last level, moved to the limit; those of the cage at
/// level 0.
class RefinedSurface {
 public:
  /// Null where the faces meet in a way that is no surface.
  static std::unique_ptr<RefinedSurface> make(const SubdivisionCage& cage, int level);

  const OpenSubdiv::Far::TopologyLevel& level() const {
    return refiner_->GetLevel(refiner_->GetMaxLevel());
  }
  /// Where in the cage a face of the last level lies.
  struct Origin {
    std::uint32_t face = 0;  ///< number in the scene's list
    int child =
        -1;  ///< at which corner of it, or its middle one (3 of a triangle by Loop); -1: all
  };
  Origin origin(int face) const;

  std::vector<Vec3> positions;
  std::vector<Vec3> tangent_normals;  ///< of the limit; empty at level 0
  std::vector<std::vector<Vec3>> motion;
  std::vector<TextureSpace> channels;

 private:
  RefinedSurface(const SubdivisionCage& cage,
                 std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> refiner);

  const SubdivisionCage& cage_;
  std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> refiner_;
};

}  // namespace oriel::geom
