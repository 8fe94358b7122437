// SPDX-License-Identifier: Apache-2.0
// How finely is what made into triangles: `approximate` statements as data, and which one applies.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/vec.h"
#include "scene/value.h"

namespace oriel::scene {

struct PolygonGroup;
struct Instance;
struct Options;

/// `[rays] approximate [kind] technique [min max] [max N] [samples N] "names"...`
///
/// `spatial L` is the criterion length L, `curvature D A` the criteria distance D and angle A; so
/// there are three techniques only.
struct Approximation {
  enum class Kind : std::uint8_t {
    Polygon,  ///< no word: polygons with displacement
    Surface,
    Subdivision,
    CcMesh,
    Displace,
    Curve,
    SpaceCurve,
    Trim,
    Trilist
  };
  enum class Technique : std::uint8_t {
    Parametric,  ///< u * degree and v * degree pieces for each patch (span of the bases)
    Regular,     ///< u and v pieces for the whole surface
    Criteria     ///< subdivided until length, distance and angle are met
  };
  enum class Style : std::uint8_t { Default, Tree, Grid, Delaunay, Fine };
  /// What the statement is for, when words stand before it; several statements may share a surface.
  enum Ray : std::uint8_t { Visible = 1, Trace = 2, Shadow = 4, Caustic = 8, Globillum = 16 };

  Kind kind = Kind::Polygon;
  Technique technique = Technique::Parametric;
  Style style = Style::Default;
  std::uint8_t rays = 0;  ///< set of Ray; 0: all
  /// Parametric and Regular; for curves only u. Never negative.
  float u = 1, v = 1;
  bool percent = false;  ///< Regular: u and v are percent of one piece per degree and patch
  /// Criteria; 0: not asked for. Lengths are in object space, or in pixels when `view`.
  float length = 0, distance = 0;
  float angle = 0;  ///< between normals of neighbouring pieces, radians
  bool view = false, any = false, offscreen = false;
  bool smooth = true;  ///< false: `nosmoothing`
  float sharp = 0;     ///< 0...1, of `fine`: how much normals follow the fine triangles
  float grading = 0;   ///< delaunay: 0 or how fast triangles may grow
  /// Times an edge is at least and at most halved.
  int min_subdivisions = 0, max_subdivisions = 5;
  int max_triangles = 0;  ///< 0: no limit but the renderer's own
  int samples = 0;
  bool all = false;                ///< `all` instead of names, in options
  std::vector<std::string> names;  ///< what it applies to; empty: all of its kind

  /// Whether it counts for what the camera sees.
  bool is_for_camera() const { return rays == 0 || (rays & Visible) != 0; }
  bool operator==(const Approximation&) const = default;
};

/// What stands in an `approximate` statement; nothing when it is bare or names no technique.
///
/// Model:   numbers that mean nothing become 0 (not asked for); subdivisions are kept in
///          [0, kMaxSubdivisions].
/// Source:  the published manual's page on approximations; what it leaves open is marked.
/// Checked: Approximation.*
std::optional<Approximation> approximation_of(const Statement& statement);

/// Halvings beyond this are a slip: 2^12 pieces along one edge of a patch.
inline constexpr int kMaxSubdivisions = 12;

/// Which approximation applies, from the strongest to the weakest: the options' `... all`, an
/// instance that says `override` (the outermost such), the group's own with that name (the last
/// one), the group's own without names, the instance nearest to the object.
class ApproximationRules {
 public:
  ApproximationRules() = default;
  /// Inputs: chain: the instances above the object, outermost first. options: may be null.
  ApproximationRules(const PolygonGroup& group, const std::vector<const Instance*>& chain,
                     const Options* options);
  /// Null: nothing was said. Statements for certain rays only count when no other one applies.
  const Approximation* find(Approximation::Kind kind, std::string_view name) const;

 private:
  /// One source's statements, each known by what it applies to: a surface is looked up among
  /// thousands. An empty name stands for all of a kind.
  struct Level {
    explicit Level(std::vector<Approximation> list);
    std::vector<Approximation> all;
    std::map<std::pair<Approximation::Kind, std::string>, std::size_t, std::less<>> best;
  };
  std::vector<Level> levels_;  // strongest first
};

/// The camera as tessellation sees it, so that `view` lengths can be measured in pixels.
struct TessellationView {
  Mat4 object_to_camera;      ///< camera space: the camera at the origin looks down -z
  float pixels_per_unit = 0;  ///< at distance 1, or at any distance when orthographic; 0: no camera
  bool orthographic = false;

  /// Length of the segment a-b (object space) in the image, in pixel diagonals, as if it lay
  /// parallel to the image; so a surface does not grow coarse at its silhouette. 0 without a
  /// camera.
  float pixels(const Vec3& a, const Vec3& b) const;
};

/// All that decides how finely an object is tessellated, besides the object itself.
struct ApproximationContext {
  std::vector<const Instance*> chain;  ///< above the object, outermost first
  const Options* options = nullptr;
  TessellationView view;

  ApproximationRules rules(const PolygonGroup& group) const { return {group, chain, options}; }
};

/// Whether an element's statements approximate anything.
bool has_approximations(const std::vector<Statement>& statements);

}  // namespace oriel::scene
