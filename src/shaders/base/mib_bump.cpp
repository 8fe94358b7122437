// SPDX-License-Identifier: Apache-2.0
#include "shaders/base/mib_bump.h"

#include <algorithm>

#include "base/math.h"
#include "runtime/shade_input.h"
#include "runtime/texture_node.h"

namespace oriel {
namespace {

struct Basis {
  int project, ntex;
};
struct BasisOut {
  Vec3 u, v;
};
struct Map {
  Vec3 u, v, coord, step;
  float factor;
  bool torus_u, torus_v, alpha;
  ColorTextureRef tex;
  bool clamp;
};
struct Map2 {
  float factor, scale;
  ColorTextureRef tex;
  Rgba color;
};

constexpr ParamSpec kBasisRows[] = {
    {ORIEL_PARAM(Basis, project),
     .doc = "Projection: 1 xy, 2 xz, 3 yz, 4 spherical, 6 cylindrical; otherwise the "
            "texture space.",
     .declared_default = false},
    {ORIEL_PARAM(Basis, ntex), .min = 0, .max = 63, .doc = "Number of the texture space.",
     .declared_default = false},
};
constexpr ParamSpec kBasisResults[] = {{ORIEL_PARAM(BasisOut, u)}, {ORIEL_PARAM(BasisOut, v)}};
constexpr ParamSpec kMapRows[] = {
    {ORIEL_PARAM(Map, u), .doc = "Direction of the normal change along u.",
     .declared_default = false},
    {ORIEL_PARAM(Map, v), .doc = "Direction of the normal change along v.",
     .declared_default = false},
    {ORIEL_PARAM(Map, coord), .doc = "Texture coordinate.", .declared_default = false},
    {ORIEL_PARAM(Map, step), .doc = "Offset of the two neighbouring look-ups; 0 = 0.01.",
     .declared_default = false},
    {ORIEL_PARAM(Map, factor), .doc = "Bump strength; 0 = 1.", .declared_default = false},
    {ORIEL_PARAM(Map, torus_u), .doc = "Whether the texture repeats along u.",
     .declared_default = false},
    {ORIEL_PARAM(Map, torus_v), .doc = "Whether the texture repeats along v.",
     .declared_default = false},
    {ORIEL_PARAM(Map, alpha), .doc = "Whether alpha is used instead of the mean of the channels.",
     .declared_default = false},
    {ORIEL_PARAM(Map, tex), .doc = "Texture image.", .declared_default = false},
    {ORIEL_PARAM(Map, clamp), .doc = "Whether coordinates outside 0..1 have no bump.",
     .declared_default = false},
};
constexpr ParamSpec kMap2Rows[] = {
    {ORIEL_PARAM(Map2, factor), .doc = "Bump strength; 0 = 1.", .declared_default = false},
    {ORIEL_PARAM(Map2, scale), .doc = "Scale of the first texture space; 0 = 1.",
     .declared_default = false},
    {ORIEL_PARAM(Map2, tex), .doc = "Texture image.", .declared_default = false},
    {ORIEL_PARAM(Map2, color), .doc = "Colour or material to return.", .declared_default = false,
     .takes_material = true},
};

constexpr float kStep = 0.01f;

/// Unit directions of a texture space; null if it is missing.
BasisOut of_texture_space(const ShadingPoint& point, int space) {
  if (space >= 0 && space < point.texture_spaces && point.bump_u[space] != Vec3(0))
    return {normalize(point.bump_u[space]), normalize(point.bump_v[space])};
  return {normalize(point.dpdu), normalize(point.dpdv)};
}

BasisOut basis_of(const Basis& p, const ShadingPoint& point) {
  const auto world = [&](const Vec3& d) {
    return normalize(point.to_world ? transform_vector(d, *point.to_world) : d);
  };
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  switch (p.project) {
    case 1:
      return {world(x), world(y)};
    case 2:
      return {world(x), world(z)};
    case 3:
      return {world(y), world(z)};
    case 4:
    case 6: {
      const Vec3 at =
          point.to_object ? transform_point(point.position, *point.to_object) : point.position;
      const float r = math::hypot(at.x, at.z);
      if (!(r > 0)) return {world(x), world(y)};
      const Vec3 round(at.z / r, 0, -at.x / r);
      const Vec3 up = p.project == 6 ? y : Vec3(-at.x * at.y / r, r, -at.z * at.y / r);
      return {world(round), world(up)};
    }
    default:
      return of_texture_space(point, p.ntex);
  }
}

/// Texture values around a position.
struct Heights {
  const TextureNode& texture;
  ShadingPoint& point;
  TextureSampling how;
  bool alpha;

  float at(float x, float y) const {
    const Rgba c = texture.lookup(Vec2(x, y), point, how);
    return alpha ? c.a : (c.r + c.g + c.b) / 3;
  }
};

/// The normal displaced by the differences along u and v.
Vec3 turned(const Vec3& normal, const BasisOut& basis, const Vec2& at, const Vec2& step,
            float factor, const Heights& heights) {
  const float strength = factor != 0 ? factor : 1;
  const float here = heights.at(at.x, at.y);
  const float along_u = heights.at(at.x + step.x, at.y) - here;
  const float along_v = heights.at(at.x, at.y + step.y) - here;
  const Vec3 sum = normal + (basis.u * along_u + basis.v * along_v) * strength;
  return dot(sum, sum) > 0 ? normalize(sum) : normal;
}

float or_step(float s) { return s != 0 ? s : kStep; }

void move_normal(const Map& p, ShadingPoint& point) {
  if (!p.tex.texture) return;
  const auto outside = [](float x) { return x < 0 || x > 1; };
  if (p.clamp && (outside(p.coord.x) || outside(p.coord.y))) return;
  const Heights heights{*p.tex.texture,
                        point,
                        {.wrap_u = p.torus_u ? Wrap::Periodic : Wrap::Clamp,
                         .wrap_v = p.torus_v ? Wrap::Periodic : Wrap::Clamp},
                        p.alpha};
  point.normal = turned(point.normal, {p.u, p.v}, Vec2(p.coord.x, p.coord.y),
                        Vec2(or_step(p.step.x), or_step(p.step.y)), p.factor, heights);
}

void move_normal(const Map2& p, ShadingPoint& point) {
  if (!p.tex.texture || point.texture_spaces == 0) return;
  const Vec3 at = point.tex[0] * (p.scale != 0 ? p.scale : 1);
  point.normal = turned(point.normal, of_texture_space(point, 0), Vec2(at.x, at.y), Vec2(kStep),
                        p.factor, {*p.tex.texture, point, {}, false});
}

/// As a shader in the list before a material.
void move_for_list(const Call& call, Closure&) { move_normal(call.as<Map>(), call.point); }

}  // namespace

const ShaderSpec kMibBumpBasis = {
    .name = "mib_bump_basis",
    .library = "base",
    .version = 2,
    .apply = kApplyTexture,
    .doc = "Basis of the directions for bump mapping.",
    .params = kBasisRows,
    .params_size = sizeof(Basis),
    .result = ParamType::Struct,
    .results = kBasisResults,
    .result_size = sizeof(BasisOut),
    .value =
        [](const Call& call, void* result) {
          *static_cast<BasisOut*>(result) = basis_of(call.as<Basis>(), call.point);
        },
};

const ShaderSpec kMibBumpMap = {
    .name = "mib_bump_map",
    .library = "base",
    .version = 2,
    .apply = kApplyTexture,
    .doc = "Bump map that changes the normal and returns it.",
    .params = kMapRows,
    .params_size = sizeof(Map),
    .result = ParamType::Vector,
    .result_size = sizeof(Vec3),
    .value =
        [](const Call& call, void* result) {
          ShadingPoint& point = call.point;
          move_normal(call.as<Map>(), point);
          *static_cast<Vec3*>(result) = point.back_side ? -point.normal : point.normal;
        },
    .material = {.fill = move_for_list, .max_lobes = [](const ShaderNode&) { return 0; }},
};

const ShaderSpec kMibPassthroughBumpMap = {
    .name = "mib_passthrough_bump_map",
    .library = "base",
    .version = 2,
    .apply = kApplyTexture | kApplyMaterial,
    .doc = "Bump map for the following shaders of a list.",
    .params = kMapRows,
    .params_size = sizeof(Map),
    .value =
        [](const Call& call, void* result) {
          move_normal(call.as<Map>(), call.point);
          *static_cast<Rgba*>(result) = Rgba(0);
        },
    .material = {.fill = move_for_list, .max_lobes = [](const ShaderNode&) { return 0; }},
};

const ShaderSpec kMibBumpMap2 = {
    .name = "mib_bump_map2",
    .library = "base",
    .apply = kApplyTexture | kApplyMaterial,
    .doc = "Bump map for a material.",
    .params = kMap2Rows,
    .params_size = sizeof(Map2),
    .value =
        [](const Call& call, void* result) {
          move_normal(call.as<Map2>(), call.point);
          *static_cast<Rgba*>(result) = call.as<Map2>().color;
        },
    .material = {
        .fill =
            [](const Call& call, Closure& closure) {
              const auto& p = call.as<Map2>();
              move_normal(p, call.point);
              shade_input(call, offsetof(Map2, color), p.color, Rgb(1), closure);
            },
        .may_transmit = [](const ShaderNode& node) { return node.inputs_may_transmit(); },
        .max_lobes = [](const ShaderNode&) { return 0; },
    },
};

}  // namespace oriel
