// SPDX-License-Identifier: Apache-2.0
#include "shaders/base/mib_texture.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "runtime/coordinate_footprint.h"
#include "runtime/texture_node.h"
#include "runtime/world.h"

namespace oriel {
namespace {

struct VectorParams {
  int select, selspace, vertex, project;
};
struct RemapParams {
  Vec3 input;
  Mat4 transform;
  Vec3 repeat;
  bool alt_x, alt_y, alt_z, torus_x, torus_y, torus_z;
  Vec3 min, max, offset;
};
struct LookupParams {
  ColorTextureRef tex;
  Vec3 coord;
};

constexpr ParamSpec kVectorRows[] = {
    {ORIEL_PARAM(VectorParams, select), .min = -10, .max = 63,
     .doc = "Source: 0..63 a texture space, or the point if missing; -1 point, -2 normal, "
            "-3 motion, -4 ray, -10 environment ray.",
     .support = Support::Approximated, .declared_default = false},
    {ORIEL_PARAM(VectorParams, selspace),
     .doc = "Target space of the vector: 1 object, 2 world, 3 camera, 4 raster position "
            "0..1.",
     .support = Support::Approximated, .declared_default = false},
    {ORIEL_PARAM(VectorParams, vertex), .doc = "Origin: 0 the point, 1..3 corners of the triangle.",
     .support = Support::Ignored, .declared_default = false},
    {ORIEL_PARAM(VectorParams, project),
     .doc = "Projection: 0 none, 1 xy, 2 xz, 3 yz, 4 spherical, 5 cylindrical.",
     .support = Support::Approximated, .declared_default = false},
};
constexpr ParamSpec kRemapRows[] = {
    {ORIEL_PARAM(RemapParams, input), .doc = "Input coordinate.", .declared_default = false},
    {ORIEL_PARAM(RemapParams, transform),
     .doc = "Matrix applied first; ignored if its last element is 0.", .declared_default = false},
    {ORIEL_PARAM(RemapParams, repeat), .doc = "Number of copies within 0..1; 0 = 1.",
     .declared_default = false},
    {ORIEL_PARAM(RemapParams, alt_x), .doc = "Whether every other copy is mirrored.",
     .declared_default = false},
    {ORIEL_PARAM(RemapParams, alt_y), .doc = "Whether every other copy is mirrored.",
     .declared_default = false},
    {ORIEL_PARAM(RemapParams, alt_z), .doc = "Whether every other copy is mirrored.",
     .declared_default = false},
    {ORIEL_PARAM(RemapParams, torus_x), .doc = "Whether coordinates wrap around.",
     .declared_default = false},
    {ORIEL_PARAM(RemapParams, torus_y), .doc = "Whether coordinates wrap around.",
     .declared_default = false},
    {ORIEL_PARAM(RemapParams, torus_z), .doc = "Whether coordinates wrap around.",
     .declared_default = false},
    {ORIEL_PARAM(RemapParams, min), .doc = "Lower corner of the texture region in use.",
     .declared_default = false},
    {ORIEL_PARAM(RemapParams, max),
     .doc = "Upper corner of the texture region in use; equal to min = the whole texture.",
     .declared_default = false},
    {ORIEL_PARAM(RemapParams, offset), .doc = "Offset, added last.", .declared_default = false},
};
constexpr ParamSpec kLookupRows[] = {
    {ORIEL_PARAM(LookupParams, tex), .doc = "Texture to look up.", .declared_default = false},
    {ORIEL_PARAM(LookupParams, coord),
     .doc = "Texture coordinate; outside 0..1 the result is transparent black.",
     .declared_default = false},
};

Vec3 selected(const VectorParams& p, const ShadingPoint& point) {
  const Mat4* to_object = point.to_object;
  const auto space = [&](const Vec3& v, bool is_point) {
    const auto through = [&](const Mat4& m) {
      return is_point ? transform_point(v, m) : transform_vector(v, m);
    };
    if (p.selspace == 1 && to_object) return through(*to_object);
    if (p.selspace == 3 && point.world) return through(point.world->camera.to_camera);
    return v;
  };
  if (p.selspace == 4 && point.world) {
    const Camera& camera = point.world->camera;
    return {point.raster.x / static_cast<float>(camera.width),
            point.raster.y / static_cast<float>(camera.height), 0};
  }
  switch (p.select) {
    case -2:
      return space(point.normal, false);
    case -3:
      return space(motion_of(point), false);
    case -4:
    case -10:
      return space(point.ray_direction, false);
    default:
      break;
  }
  if (p.select >= 0 && p.select < point.texture_spaces) return point.tex[p.select];
  return space(point.position, true);
}

Vec3 projected(int project, const Vec3& v) {
  switch (project) {
    case 1:
      return Vec3(v.x, v.y, 0);
    case 2:
      return Vec3(v.x, v.z, 0);
    case 3:
      return Vec3(v.y, v.z, 0);
    case 4: {
      const float r = length(v);
      const float elevation = r > 0 ? math::asin(clamp(v.y / r, -1, 1)) : 0;
      return Vec3(0.5f + math::atan2(v.x, v.z) / kTwoPi, 0.5f + elevation / kPi, r);
    }
    case 5:
      return Vec3(0.5f + math::atan2(v.x, v.z) / kTwoPi, v.y, 0);
    default:
      return v;
  }
}

/// Whether the shader modifies the coordinate of a texture space.
bool changes_coordinate(const ShaderNode& node) {
  if (&node.spec() != &kMibTextureVector) return node.spec().result == ParamType::Vector;
  const auto& p = node.constants<VectorParams>();
  return p.select < 0 || p.project != 0;
}

float remap_axis(float x, float repeat, bool alternate, bool torus, float lo, float hi) {
  if (repeat != 0 && x >= 0 && x < 1) {
    x *= repeat;
    const float copy = std::floor(x);
    x -= copy;
    if (alternate && std::fmod(copy, 2.0f) != 0) x = 1 - x;
  }
  if (torus) x -= std::floor(x);
  if (hi != lo) x = lo + x * (hi - lo);
  return x;
}

}  // namespace

const ShaderSpec kMibTextureVector = {
    .name = "mib_texture_vector",
    .library = "base",
    .version = 2,
    .apply = kApplyTexture,
    .doc =
        "Texture coordinate from a texture space, the point, the normal or the ray, "
        "with projection.",
    .params = kVectorRows,
    .params_size = sizeof(VectorParams),
    .result = ParamType::Vector,
    .result_size = sizeof(Vec3),
    .value =
        [](const Call& call, void* result) {
          const auto& p = call.as<VectorParams>();
          // Raster positions and environment directions are not projected.
          const bool as_it_is = p.selspace == 4 || p.select == -10;
          *static_cast<Vec3*>(result) =
              projected(as_it_is ? 0 : p.project, selected(p, call.point));
        },
};

const ShaderSpec kMibTextureRemap = {
    .name = "mib_texture_remap",
    .library = "base",
    .apply = kApplyTexture,
    .doc = "Transformed, repeated, cropped and shifted texture coordinate.",
    .params = kRemapRows,
    .params_size = sizeof(RemapParams),
    .result = ParamType::Vector,
    .result_size = sizeof(Vec3),
    .value =
        [](const Call& call, void* result) {
          const auto& p = call.as<RemapParams>();
          Vec3 v = p.transform[3][3] != 0 ? transform_point(p.input, p.transform) : p.input;
          v = Vec3(remap_axis(v.x, p.repeat.x, p.alt_x, p.torus_x, p.min.x, p.max.x),
                   remap_axis(v.y, p.repeat.y, p.alt_y, p.torus_y, p.min.y, p.max.y),
                   remap_axis(v.z, p.repeat.z, p.alt_z, p.torus_z, p.min.z, p.max.z));
          *static_cast<Vec3*>(result) = v + p.offset;
        },
};

const ShaderSpec kMibTextureLookup = {
    .name = "mib_texture_lookup",
    .library = "base",
    .apply = kApplyTexture,
    .doc = "Texture look-up, filtered over the ray footprint.",
    .params = kLookupRows,
    .params_size = sizeof(LookupParams),
    .value =
        [](const Call& call, void* result) {
          const auto& p = call.as<LookupParams>();
          auto& out = *static_cast<Rgba*>(result);
          out = Rgba(0);
          if (!p.tex.texture) return;
          const TextureSampling how{.wrap_u = Wrap::Black, .wrap_v = Wrap::Black};
          const Vec2 uv(p.coord.x, p.coord.y);
          const ShaderNode* source =
              call.node ? call.node->source(offsetof(LookupParams, coord)) : nullptr;
          out = source && changes_coordinate(*source)
                    ? p.tex.texture->lookup(uv, coordinate_footprint(*source, p.coord, call.point),
                                            call.point, how)
                    : p.tex.texture->lookup(uv, call.point, how);
        },
};

}  // namespace oriel
