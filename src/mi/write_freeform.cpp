// SPDX-License-Identifier: Apache-2.0
// Free-form curves and surfaces.
#include <cmath>

#include "mi/write_parts.h"

namespace oriel::mi {
namespace {

using scene::kNone;

/// Writes a blank and the number with a decimal point, which distinguishes parameters from indices.
void write_parameter(TextSink& out, float value) {
  out.put(' ');
  if (value == std::floor(value))
    out.scalar(value);
  else
    out.number(value);
}

void write_basis_use(TextSink& out, const scene::BasisUse& use) {
  out.put(use.rational ? " rational " : " ");
  out.quoted(use.basis);
}

void write_parameters(TextSink& out, const scene::BasisUse& use) {
  for (const float parameter : use.parameters) write_parameter(out, parameter);
}

void write_points(TextSink& out, const std::vector<scene::ControlPoint>& points) {
  for (const scene::ControlPoint& p : points) {
    out.put(' ');
    out.index(p.vertex);
    if (p.weight == 1) continue;
    out.put(" w");
    write_parameter(out, p.weight);
  }
}

void write_part(TextSink& out, const scene::CurvePart& part) {
  out.put(' ');
  out.quoted(part.curve);
  write_parameter(out, part.min);
  write_parameter(out, part.max);
}

void write_loop(TextSink& out, const scene::SurfaceLoop& loop) {
  using Kind = scene::SurfaceLoop::Kind;
  write_indent(out, 3);
  out.put(loop.kind == Kind::Trim ? "trim" : loop.kind == Kind::Hole ? "hole" : "special");
  for (const scene::CurvePart& part : loop.parts) write_part(out, part);
  for (const std::uint32_t point : loop.points) {
    out.put(' ');
    out.index(point);
  }
  out.put('\n');
}

void write_texture(TextSink& out, const scene::TextureSurface& texture) {
  write_indent(out, 3);
  out.put(texture.volume ? "volume " : "");
  out.put(texture.vector ? "vector " : "");
  out.put("texture");
  write_basis_use(out, texture.u);
  write_parameters(out, texture.u);
  write_basis_use(out, texture.v);
  write_parameters(out, texture.v);
  write_points(out, texture.points);
  out.put('\n');
}

void write_surface(TextSink& out, const scene::FreeSurface& surface,
                   const std::vector<std::string>& materials, bool tagged) {
  write_indent(out, 2);
  out.put("surface ");
  out.quoted(surface.name);
  out.put(' ');
  if (tagged)
    out.index(surface.material == kNone ? 0 : surface.material);
  else
    out.quoted(surface.material < materials.size() ? materials[surface.material] : "");
  write_basis_use(out, surface.u);
  write_parameter(out, surface.u_min);
  write_parameter(out, surface.u_max);
  write_parameters(out, surface.u);
  write_basis_use(out, surface.v);
  write_parameter(out, surface.v_min);
  write_parameter(out, surface.v_max);
  write_parameters(out, surface.v);
  write_points(out, surface.points);
  out.put('\n');
  if (!surface.derivative.empty()) {
    write_indent(out, 3);
    out.put("derivative");
    for (const int which : surface.derivative) {
      out.put(' ');
      out.integer(which);
    }
    out.put('\n');
  }
  for (const scene::TextureSurface& texture : surface.textures) write_texture(out, texture);
  for (const scene::SurfaceLoop& loop : surface.loops) write_loop(out, loop);
}

}  // namespace

void write_bases(TextSink& out, const std::vector<scene::Basis>& bases) {
  static constexpr std::string_view kKinds[] = {"bezier", "bspline", "taylor", "cardinal",
                                                "matrix"};
  for (const scene::Basis& basis : bases) {
    write_indent(out, 1);
    out.put("basis ");
    out.quoted(basis.name);
    out.put(basis.rational ? " rational " : " ");
    out.put(kKinds[static_cast<std::size_t>(basis.kind)]);
    if (basis.kind != scene::Basis::Kind::Cardinal) {
      out.put(' ');
      out.integer(basis.degree);
    }
    if (basis.kind == scene::Basis::Kind::Matrix) {
      out.put(' ');
      out.integer(basis.step);
      for (const float coefficient : basis.matrix) write_parameter(out, coefficient);
    }
    out.put('\n');
  }
}

void write_freeform(TextSink& out, const scene::PolygonGroup& group, bool tagged) {
  for (const scene::FreeCurve& curve : group.freeform.curves) {
    write_indent(out, 2);
    out.put(curve.space ? "space curve " : "curve ");
    out.quoted(curve.name);
    write_basis_use(out, curve.basis);
    write_parameters(out, curve.basis);
    write_points(out, curve.points);
    if (!curve.special.empty()) out.put(" special");
    for (const float parameter : curve.special) write_parameter(out, parameter);
    out.put('\n');
  }
  for (const scene::FreeSurface& surface : group.freeform.surfaces)
    write_surface(out, surface, group.materials, tagged);
  for (const scene::Connection& connection : group.freeform.connections) {
    write_indent(out, 2);
    out.put("connect");
    for (int side = 0; side < 2; ++side) {
      out.put(' ');
      out.quoted(connection.surface[side]);
      write_part(out, connection.part[side]);
    }
    out.put('\n');
  }
}

}  // namespace oriel::mi
