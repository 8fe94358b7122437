// SPDX-License-Identifier: Apache-2.0
#include "shaders/oriel/oriel_vertex_color.h"

namespace oriel {
namespace {

struct VertexColor {
  Rgba color;
  int space;
  int alpha_space;
};

constexpr ParamSpec kOrielVertexColorRows[] = {
    {ORIEL_PARAM(VertexColor, color), .fallback = {1, 1, 1, 1},
     .doc = "Factor of the vertex colour."},
    {ORIEL_PARAM(VertexColor, space), .fallback = {0}, .min = -1, .max = 64,
     .doc = "Texture space that stores red, green and blue; -1 = none."},
    {ORIEL_PARAM(VertexColor, alpha_space), .fallback = {-1}, .min = -1, .max = 64,
     .doc = "Texture space whose first coordinate stores alpha; -1 = none."},
};

/// Coordinates of a texture space; 1 if the surface lacks it.
Vec3 coordinates(const ShadingPoint& point, int space) {
  return space >= 0 && space < point.texture_spaces ? point.tex[space] : Vec3(1);
}

void give_color(const Call& call, void* result) {
  const auto& p = call.as<VertexColor>();
  const Vec3 c = coordinates(call.point, p.space);
  const float a = coordinates(call.point, p.alpha_space).x;
  *static_cast<Rgba*>(result) = {p.color.r * c.x, p.color.g * c.y, p.color.b * c.z, p.color.a * a};
}

}  // namespace

const ShaderSpec kOrielVertexColor = {
    .name = "oriel_vertex_color",
    .library = "oriel",
    .apply = kApplyTexture,
    .doc = "Vertex colours of a mesh.",
    .params = kOrielVertexColorRows,
    .params_size = sizeof(VertexColor),
    .value = give_color,
};

}  // namespace oriel
