// SPDX-License-Identifier: Apache-2.0
// Free-form curves and surfaces in a scene: bases, control points, trims, connections.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/diagnostic.h"

namespace oriel::scene {

// Conventions
//   Control points are vertices of the group; in a surface, u varies fastest. Points in the
//   parameter plane of a surface (of trimming curves, special points) are vertices with u and v in
//   x and y. The data are not validated: indices may be out of range, names unknown, parameters
//   unsorted. geom/freeform reports these errors during tessellation.

/// basis "name" [rational] kind degree ...
struct Basis {
  enum class Kind : std::uint8_t { Bezier, BSpline, Taylor, Cardinal, Matrix };
  std::string name;
  Kind kind = Kind::Bezier;
  bool rational = false;
  int degree = 3;
  int step = 1;               ///< Matrix: control points from one segment to the next
  std::vector<float> matrix;  ///< (degree + 1)^2; row i: coefficients of t^0, t^1... for point i
  bool operator==(const Basis&) const = default;

  /// Number of control points for this number of parameters; 0: too few parameters.
  std::size_t control_points(std::size_t parameters) const;
};

/// Basis and parameters of one direction of a curve or surface.
struct BasisUse {
  bool rational = false;
  std::string basis;
  std::vector<float> parameters;  ///< knots of a B-spline; otherwise segment boundaries
  bool operator==(const BasisUse&) const = default;
};

struct ControlPoint {
  std::uint32_t vertex = 0;
  float weight = 1;
  bool operator==(const ControlPoint&) const = default;
};

/// [space] curve "name" ...
struct FreeCurve {
  std::string name;
  bool space = false;
  BasisUse basis;
  std::vector<ControlPoint> points;
  std::vector<float> special;  ///< parameters that a tessellation must include
  SourceLocation where;
  bool operator==(const FreeCurve&) const = default;
};

/// The part of a curve with parameters from `min` to `max`.
struct CurvePart {
  std::string curve;
  float min = 0, max = 1;
  bool operator==(const CurvePart&) const = default;
};

/// trim | hole | special "curve" min max ...: consecutive parts of curves.
struct SurfaceLoop {
  enum class Kind : std::uint8_t { Trim, Hole, Special };
  Kind kind = Kind::Trim;
  std::vector<CurvePart> parts;
  std::vector<std::uint32_t> points;  ///< Special: vertices with u and v in x and y
  bool operator==(const SurfaceLoop&) const = default;
};

/// [volume] [vector] texture ...: texture surface of the preceding surface.
struct TextureSurface {
  bool volume = false;  ///< three-dimensional coordinates; no seam handling
  bool vector = false;  ///< first of two with bump basis vectors; see vertices' X, Y
  BasisUse u, v;
  std::vector<ControlPoint> points;
  bool operator==(const TextureSurface&) const = default;
};

/// surface "name" material ...
struct FreeSurface {
  std::string name;
  std::uint32_t material = 0xffffffffu;  ///< as PolygonList::material
  BasisUse u, v;
  float u_min = 0, u_max = 1, v_min = 0, v_max = 1;
  std::vector<ControlPoint> points;
  std::vector<int> derivative;  ///< requested derivative orders, 1 and 2
  std::vector<TextureSurface> textures;
  std::vector<SurfaceLoop> loops;
  SourceLocation where;
  bool operator==(const FreeSurface&) const = default;
};

/// connect "surface" "curve" min max "surface" "curve" min max: the common edge of two surfaces.
struct Connection {
  std::string surface[2];
  CurvePart part[2];
  SourceLocation where;
  bool operator==(const Connection&) const = default;
};

/// Free-form geometry of a group.
struct FreeForm {
  std::vector<FreeCurve> curves;
  std::vector<FreeSurface> surfaces;
  std::vector<Connection> connections;
  bool empty() const { return curves.empty() && surfaces.empty() && connections.empty(); }
  bool operator==(const FreeForm&) const = default;
};

}  // namespace oriel::scene
