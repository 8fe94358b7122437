// SPDX-License-Identifier: Apache-2.0
// Photons that came to rest on surfaces, and the irradiance they tell.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "geom/mesh.h"
#include "scene/render_options.h"
#include "transport/photon/place_table.h"
#include "transport/photon/place_tree.h"

namespace oriel {

struct World;

// Conventions
//   World space. Power is in the unit that times 1 / area is the irradiance of runtime/light.h and
//   already divided by the number of photons that were emitted. A photon belongs to one side of its
//   surface: the one it came from.

struct Photon {
  Vec3 position{0};
  Vec3 direction{0, 0, -1};  ///< unit, the way it travelled
  Rgb power{0};
  Vec3 normal{0, 0, 1};                 ///< unit, geometric, on the side it came from
  std::uint32_t layer = kUnknownLayer;  ///< of its light, see LightLayers

  static constexpr std::uint32_t kUnknownLayer = ~0u;
};

/// How an estimate is made.
struct PhotonLookup {
  int count = 64;    ///< most photons in it; above PhotonMap::kMaxCount that many
  float radius = 1;  ///< they lie no farther than this, scene units
  scene::PhotonOptions::Filter filter = scene::PhotonOptions::Filter::Box;
  float filter_constant = 1.1f;  ///< Cone: larger is blurrier, above 1
  Rgb scale{1};
  /// Photons that the map marks as near a wall are tested for walls of it; null: none are.
  const World* walls_of = nullptr;
};

/// Which of the two maps; they differ in their default radius.
enum class PhotonKind : std::uint8_t { Global, Caustic };

/// Radius for scenes that give none: a tenth of the extent of the scene (the diagonal of its box)
/// for global illumination, a hundredth of its radius for caustics.
/// Source: manual of a host of mental ray, as collected for `accuracy`.
float default_photon_radius(const geom::Box3& scene, PhotonKind kind);

/// The estimate that options ask for.
PhotonLookup photon_lookup(const scene::PhotonOptions& options, const geom::Box3& scene,
                           PhotonKind kind);

/// Photons in a balanced tree. Immutable, so any thread may ask.
///
/// Model:   the nearest photons of a disc on the surface (PlaceTree). When there are more than
///          `count` the first one left out gives the radius, which makes the estimate unbiased
///          where photons lie evenly. Within about a radius of edges and shadow borders it is
///          blurred. At edges part of the disc is beside the surface, so the estimate is too dark
///          there, unless photon_edges.h made up for it.
/// Inputs:  photons in any order: equal sets give equal maps. Those that are not finite are left
///          out. merge: photons nearer than this, of the same side, become one at their mean, with
///          the sum of their power; 0 = none do.
/// Source:  Jensen, "Realistic Image Synthesis Using Photon Mapping", 2001, ch. 6 and 7.
/// Checked: PhotonMap.* in photon_map_test.cpp.
class PhotonMap {
 public:
  static constexpr int kMaxCount = 4096;
  static constexpr float kFlattening = PlaceTree<Photon>::kFlattening;
  static constexpr float kMinAgreement = PlaceTree<Photon>::kMinAgreement;

  PhotonMap() = default;
  explicit PhotonMap(std::vector<Photon> photons, float merge = 0);

  bool empty() const { return photons().empty(); }
  std::size_t size() const { return photons().size(); }
  std::size_t bytes() const { return tree_.bytes() + estimates_.bytes() + nearest_.bytes(); }
  const std::vector<Photon>& photons() const { return tree_.places(); }

  /// Writes the map to a CheckpointWriter, or reads it from a CheckpointReader.
  template <class Checkpoint>
  void visit_state(Checkpoint& checkpoint) {
    tree_.visit_state(checkpoint);
    checkpoint.list(near_wall_);
  }
  /// Whether numbers are finite and directions unit; of a map that was read.
  bool is_valid() const;

  /// Diagonal of the space that photons lie in, without the few that lie apart: of the middle nine
  /// tenths along each axis, divided by .9.
  float extent() const;
  /// Irradiance of the side of the surface that `normal` points to. No allocation.
  /// Inputs:  by_light: where to add it by layers of lights, `unknown` that of photons that do not
  ///          know theirs; null = nowhere. found: where to add how many spoke; null = nowhere.
  Rgb irradiance(const Vec3& position, const Vec3& normal, const PhotonLookup& lookup,
                 Rgb* by_light = nullptr, std::size_t unknown = 0, int* found = nullptr) const;
  /// Estimates the irradiance at half of the photons from the others, for coarse_irradiance().
  void estimate_at_places(const PhotonLookup& lookup);
  /// The estimate of the nearest of these places at most kReachOfEstimates radii away; black
  /// without one. Points of a cell of kCellOfEstimates radii get the same (PlaceTable). Many times
  /// as fast as irradiance(). No layers, filters and walls.
  /// Source:  P. Christensen, "Faster Photon Map Global Illumination", Journal of Graphics Tools
  ///          4(3), 1999.
  /// Checked: PhotonMap.CoarseEstimates*
  Rgb coarse_irradiance(const Vec3& position, const Vec3& normal, const PhotonLookup& lookup) const;
  static constexpr float kReachOfEstimates = 4, kCellOfEstimates = 0.5f;
  /// Radius of the disc of irradiance().
  float radius(const Vec3& position, const Vec3& normal, const PhotonLookup& lookup) const;
  /// Multiplies the power of photon i, as photons() counts.
  void scale_power(std::size_t i, float factor) { tree_.places()[i].power *= factor; }
  /// Marks photons whose disc is cut by a wall: a value for each, other than 0. See walls_of.
  void mark_walls(std::vector<std::uint8_t> near_wall) { near_wall_ = std::move(near_wall); }

 private:
  struct Estimate {
    Vec3 position{0}, normal{0, 0, 1};
    Rgb irradiance{0};
  };

  PlaceTree<Photon> tree_;
  std::vector<std::uint8_t> near_wall_;  // one for each photon; empty: unknown
  PlaceTree<Estimate> estimates_;        // empty: not made
  PlaceTable nearest_;                   // of the estimates
};

/// Whether an opaque surface is between two points that lie as far above a surface.
bool is_walled_off(const World& world, const Vec3& from, const Vec3& to);
/// Height of such a way along a surface, as a share of the radius of an estimate: above small
/// bumps.
inline constexpr float kWayHeight = 0.05f;

}  // namespace oriel
