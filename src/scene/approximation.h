// SPDX-License-Identifier: Apache-2.0
// Tessellation settings: `approximate` statements as data, and the rules that select one.
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
/// `spatial L` sets the criterion length L, `curvature D A` the criteria distance D and angle A.
/// Thus there are only three techniques.
struct Approximation {
  enum class Kind : std::uint8_t {
    Polygon,  ///< no kind word: polygons with displacement
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
    Parametric,  ///< u * degree by v * degree pieces per patch (span of the bases)
    Regular,     ///< u by v pieces for the whole surface
    Criteria     ///< subdivided until length, distance and angle are small enough
  };
  enum class Style : std::uint8_t { Default, Tree, Grid, Delaunay, Fine };
  /// Ray types from the words before `approximate`. A surface can have one statement per type.
  enum Ray : std::uint8_t { Visible = 1, Trace = 2, Shadow = 4, Caustic = 8, Globillum = 16 };

  Kind kind = Kind::Polygon;
  Technique technique = Technique::Parametric;
  Style style = Style::Default;
  std::uint8_t rays = 0;  ///< set of Ray; 0: all
  /// Parametric and Regular; curves use u only. Not negative.
  float u = 1, v = 1;
  bool percent = false;  ///< Regular: u and v are percent of one piece per degree and patch
  /// Criteria; 0: unused. Lengths are in object space, or in pixels if `view`.
  float length = 0, distance = 0;
  float angle = 0;  ///< maximum angle between normals of neighbouring pieces, radians
  bool view = false, any = false, offscreen = false;
  bool smooth = true;  ///< false: `nosmoothing`
  float sharp = 0;     ///< 0...1, with `fine`: weight of the normals of the fine triangles
  float grading = 0;   ///< Delaunay: limit on the growth of triangles, 0: none
  /// Minimum and maximum number of times an edge is halved.
  int min_subdivisions = 0, max_subdivisions = 5;
  int max_triangles = 0;  ///< 0: the limit of the renderer only
  int samples = 0;
  bool all = false;                ///< `all` instead of names, in options
  std::vector<std::string> names;  ///< surfaces or curves; empty: all of the kind

  /// Whether the approximation applies to camera rays.
  bool is_for_camera() const { return rays == 0 || (rays & Visible) != 0; }
  bool operator==(const Approximation&) const = default;
};

/// Parses an `approximate` statement. Returns nullopt if it is bare or names no technique.
///
/// Model:   invalid numbers become 0 (unused); subdivisions are clamped to [0, kMaxSubdivisions].
/// Source:  the published manual's page on approximations; assumptions beyond it are marked.
/// Checked: Approximation.*
std::optional<Approximation> approximation_of(const Statement& statement);

/// Upper limit of subdivisions: 2^12 pieces along one edge of a patch. Larger values are errors.
inline constexpr int kMaxSubdivisions = 12;

/// Selects the approximation of a surface. Priority, highest first: `... all` of the options; an
/// instance with `override` (outermost first); the last statement of the group with the name; the
/// statement of the group without names; the nearest instance.
class ApproximationRules {
 public:
  ApproximationRules() = default;
  /// Inputs: chain: the instances above the object, outermost first. options: may be null.
  ApproximationRules(const PolygonGroup& group, const std::vector<const Instance*>& chain,
                     const Options* options);
  /// Null: no statement applies. A statement for certain ray types applies only if there is no
  /// other.
  const Approximation* find(Approximation::Kind kind, std::string_view name) const;

 private:
  /// The statements of one source, indexed by kind and name, because a group can have thousands of
  /// surfaces. An empty name means all of a kind.
  struct Level {
    explicit Level(std::vector<Approximation> list);
    std::vector<Approximation> all;
    std::map<std::pair<Approximation::Kind, std::string>, std::size_t, std::less<>> best;
  };
  std::vector<Level> levels_;  // highest priority first
};

/// Camera data for tessellation, to measure `view` lengths in pixels.
struct TessellationView {
  Mat4 object_to_camera;      ///< camera space: camera at the origin, view direction -z
  float pixels_per_unit = 0;  ///< at distance 1, or at any distance when orthographic; 0: no camera
  bool orthographic = false;

  /// Length of the segment a-b (object space) in the image, in pixel diagonals, as if it were
  /// parallel to the image plane, so that silhouettes are not tessellated coarsely. 0 without a
  /// camera.
  float pixels(const Vec3& a, const Vec3& b) const;
};

/// Inputs that determine the tessellation of an object, in addition to the object.
struct ApproximationContext {
  std::vector<const Instance*> chain;  ///< above the object, outermost first
  const Options* options = nullptr;
  TessellationView view;
  /// Maximum number of triangles of each subdivision and free-form surface; 0: that of the
  /// renderer.
  std::size_t most_triangles = 0;

  ApproximationRules rules(const PolygonGroup& group) const { return {group, chain, options}; }
};

/// Whether the statements of an element contain an `approximate` statement.
bool has_approximations(const std::vector<Statement>& statements);

}  // namespace oriel::scene
