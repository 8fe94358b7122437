// SPDX-License-Identifier: Apache-2.0
#include "shaders/oriel/oriel_normal_map.h"

#include "runtime/bump.h"
#include "runtime/texture_direction.h"
#include "runtime/texture_node.h"

namespace oriel {
namespace {

struct NormalMap {
  VectorTextureRef tex;
  float factor;
  int bump_mode;
  Rgba color;
  int space;
};

constexpr ParamSpec kOrielNormalMapRows[] = {
    {ORIEL_PARAM(NormalMap, tex), .doc = "Normal map; red along u, green along v, blue outward."},
    {ORIEL_PARAM(NormalMap, factor), .fallback = {1},
     .doc = "Factor of red and green; 0 = flat, below 0 = inverted."},
    {ORIEL_PARAM(NormalMap, bump_mode), .fallback = {5}, .min = 0, .max = 8,
     .doc = "bump_mode of mia_material_x, which defines the returned vector; 0 changes the "
            "normal and returns nothing."},
    {ORIEL_PARAM(NormalMap, color), .fallback = {.5f, .5f, 1, 1},
     .doc = "Colour of the map where tex is null, such as the result of other shaders."},
    {ORIEL_PARAM(NormalMap, space), .fallback = {0}, .min = 0, .max = kMaxTextureSpaces - 1,
     .doc = "Texture space of the tangent, and of the coordinate of tex."},
};

/// The normal from the picture, on the viewer's side like that of the point.
Vec3 mapped_normal(const NormalMap& p, ShadingPoint& point) {
  if ((p.tex.texture && p.tex.texture->missing()) || p.space < 0 || p.space >= point.texture_spaces)
    return point.normal;
  const auto space = static_cast<std::size_t>(p.space);
  Vec3 along_u = point.bump_u[space], along_v = point.bump_v[space];
  if (along_u == Vec3(0)) {
    const TextureDirections own = p.space == 0 ? TextureDirections{point.dpdu, point.dpdv}
                                               : texture_directions(point, p.space);
    along_u = own.by_u, along_v = own.by_v;
  }
  const Vec3 front = point.back_side ? -point.normal : point.normal;
  const Vec3 tangent = normalize(along_u - front * dot(front, along_u));
  if (tangent == Vec3(0)) return point.normal;
  Vec3 bitangent = cross(front, tangent);
  if (dot(bitangent, along_v) < 0) bitangent = -bitangent;
  const Vec3& at = point.tex[space];
  const Rgba c = p.tex.texture ? p.tex.texture->lookup(Vec2(at.x, at.y), point, {}) : p.color;
  const Vec3 n = tangent * ((2 * c.r - 1) * p.factor) + bitangent * ((2 * c.g - 1) * p.factor) +
                 front * (2 * c.b - 1);
  if (!(dot(n, n) > 0)) return point.normal;
  return point.back_side ? -normalize(n) : normalize(n);
}

void give_normal(const Call& call, void* result) {
  const auto& p = call.as<NormalMap>();
  ShadingPoint& point = call.point;
  auto& out = *static_cast<Vec3*>(result);
  out = Vec3(0);
  const Vec3 normal = mapped_normal(p, point);
  if (p.bump_mode < 1 || p.bump_mode > 8)
    point.normal = normal;
  else
    out = bump_vector(point, point.normal, normal, p.bump_mode);
}

}  // namespace

const ShaderSpec kOrielNormalMap = {
    .name = "oriel_normal_map",
    .library = "oriel",
    .apply = kApplyTexture,
    .doc = "Normal map that changes the shading normal.",
    .params = kOrielNormalMapRows,
    .params_size = sizeof(NormalMap),
    .result = ParamType::Vector,
    .result_size = sizeof(Vec3),
    .value = give_normal,
    .material = {
        .fill =
            [](const Call& call, Closure&) {
              call.point.normal = mapped_normal(call.as<NormalMap>(), call.point);
            },
        .max_lobes = [](const ShaderNode&) { return 0; },
    },
};

}  // namespace oriel
