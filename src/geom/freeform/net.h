// SPDX-License-Identifier: Apache-2.0
// Curves and surfaces defined by control points: positions, derivatives, normals.
#pragma once

#include <ImathVec.h>

#include "base/vec.h"
#include "geom/freeform/direction.h"
#include "scene/object.h"

namespace oriel::geom::freeform {

// Double precision, so that adjacent surfaces meet at the same float and second differences of
// close points are meaningful.
using V3d = Imath::V3d;
using V4d = Imath::V4d;

/// Control points as vectors of the group; rational ones are stored as (w x, w y, w z, w). Returns
/// nullopt and sets `fault` to the reason if a point does not exist or is not finite. `column`
/// selects an index of the vertex (point or motion step).
std::vector<V4d> control_net(const scene::PolygonGroup& group,
                             const std::vector<scene::ControlPoint>& points,
                             const std::vector<std::uint32_t>& column, std::string& fault);

/// A curve, in space or in the parameter plane of a surface.
class CurveNet {
 public:
  static std::optional<CurveNet> make(const scene::FreeCurve& curve,
                                      const std::vector<scene::Basis>& bases,
                                      const scene::PolygonGroup& group, std::string& fault);
  V3d at(double t) const;
  const Direction& direction() const { return direction_; }

 private:
  CurveNet(Direction direction, std::vector<V4d> points)
      : direction_(std::move(direction)), points_(std::move(points)) {}
  Direction direction_;
  std::vector<V4d> points_;
};

/// A position on a surface with its derivatives by u and v.
struct Jet {
  V3d p, u, v, uu, uv, vv;
};

class SurfaceNet {
 public:
  SurfaceNet(Direction u, Direction v, std::vector<V4d> points)
      : u_(std::move(u)), v_(std::move(v)), points_(std::move(points)) {}
  /// Makes a net of a surface or of a texture surface; both have u, v and points.
  static std::optional<SurfaceNet> make(const scene::BasisUse& u, const scene::BasisUse& v,
                                        const std::vector<scene::ControlPoint>& points,
                                        const std::vector<scene::Basis>& bases,
                                        const scene::PolygonGroup& group, std::string& fault);
  /// A net of another quantity (motion vectors) over the same bases and weights.
  SurfaceNet with(std::vector<V4d> points) const { return {u_, v_, std::move(points)}; }

  Jet jet(double u, double v) const;
  V3d point(double u, double v) const;
  /// Unit normal in the direction of dS/du x dS/dv. If one of the two vanishes (a pole), the limit
  /// from inside the surface; null only if the surface has no area around the point.
  V3d normal(double u, double v) const { return normal(jet(u, v), u, v); }
  V3d normal(const Jet& jet, double u, double v) const;
  const Direction& u() const { return u_; }
  const Direction& v() const { return v_; }

 private:
  Direction u_, v_;
  std::vector<V4d> points_;
};

}  // namespace oriel::geom::freeform
