// SPDX-License-Identifier: Apache-2.0
#include "runtime/bump.h"
#include "runtime/world.h"
#include "shaders/maya/host_rows.h"
#include "shaders/maya/maya_utility.h"

namespace oriel {
namespace {

struct Sampled {
  float facingRatio;
  Vec3 pointWorld, pointObj, pointCamera, normalCamera, uvCoord, rayDirection;
  bool flippedNormal;
};
constexpr ParamSpec kSampledResults[] = {
    {ORIEL_PARAM(Sampled, facingRatio), .doc = "Cosine between normal and view direction."},
    {ORIEL_PARAM(Sampled, pointWorld), .doc = "Point in world space."},
    {ORIEL_PARAM(Sampled, pointObj), .doc = "Point in object space."},
    {ORIEL_PARAM(Sampled, pointCamera), .doc = "Point in camera space."},
    {ORIEL_PARAM(Sampled, normalCamera), .doc = "Normal in camera space."},
    {ORIEL_PARAM(Sampled, uvCoord), .doc = "Texture coordinate of the surface."},
    {ORIEL_PARAM(Sampled, rayDirection), .doc = "Ray direction in camera space."},
    {ORIEL_PARAM(Sampled, flippedNormal), .doc = "Whether the back face is visible."},
};

void sample(const Call& call, void* result) {
  const ShadingPoint& point = call.point;
  auto& out = *static_cast<Sampled*>(result);
  const Mat4* camera = point.world ? &point.world->camera.to_camera : nullptr;
  out.facingRatio = clamp01(dot(point.normal, point.wo()));
  out.pointWorld = point.position;
  out.pointObj =
      point.to_object ? transform_point(point.position, *point.to_object) : point.position;
  out.pointCamera = camera ? transform_point(point.position, *camera) : point.position;
  out.normalCamera = bump_vector(point, Vec3(0), point.back_side ? -point.normal : point.normal, 4);
  out.uvCoord = point.texture_spaces > 0 ? point.tex[0] : Vec3(0);
  out.rayDirection = camera ? transform_vector(point.ray_direction, *camera) : point.ray_direction;
  out.flippedNormal = point.back_side;
}

struct Three {
  float first, second, third;
};
struct Whole {
  Vec3 whole;
};
constexpr ParamSpec part(const char* name, std::size_t i, const char* doc) {
  return {.name = name,
          .type = ParamType::Scalar,
          .element = ParamType::Scalar,
          .offset = i * sizeof(float),
          .doc = doc,
          .support = Support::Approximated};
}
constexpr ParamSpec kRgb[] = {part("r", 0, "Red component."), part("g", 1, "Green component."),
                              part("b", 2, "Blue component.")};
constexpr ParamSpec kXyz[] = {part("x", 0, "Component x."), part("y", 1, "Component y."),
                              part("z", 2, "Component z.")};
constexpr ParamSpec kUvw[] = {part("u", 0, "Component u."), part("v", 1, "Component v."),
                              part("w", 2, "Component w.")};
constexpr auto kColor = about({{.name = "color",
                                .type = ParamType::Vector,
                                .element = ParamType::Vector,
                                .offset = offsetof(Whole, whole),
                                .doc = "Value to split."}});
constexpr auto kVector = about({{.name = "vector",
                                 .type = ParamType::Vector,
                                 .element = ParamType::Vector,
                                 .offset = offsetof(Whole, whole),
                                 .doc = "Value to split."}});

constexpr ShaderSpec joining(const char* name, std::span<const ParamSpec> parts) {
  return {.name = name,
          .library = "hosts",
          .apply = kApplyTexture,
          .doc = "Fallback: vector from three components.",
          .params = parts,
          .params_size = sizeof(Three),
          .result = ParamType::Vector,
          .result_size = sizeof(Vec3),
          .value =
              [](const Call& call, void* result) {
                const auto& p = call.as<Three>();
                *static_cast<Vec3*>(result) = Vec3(p.first, p.second, p.third);
              },
          .fallback = {.is_fallback = true}};
}
constexpr ShaderSpec parting(const char* name, std::span<const ParamSpec> whole,
                             std::span<const ParamSpec> parts) {
  return {.name = name,
          .library = "hosts",
          .apply = kApplyTexture,
          .doc = "Fallback: components of a vector.",
          .params = whole,
          .params_size = sizeof(Whole),
          .result = ParamType::Struct,
          .results = parts,
          .result_size = sizeof(Three),
          .value =
              [](const Call& call, void* result) {
                const Vec3& v = call.as<Whole>().whole;
                *static_cast<Three*>(result) = {v.x, v.y, v.z};
              },
          .fallback = {.is_fallback = true}};
}

constexpr ShaderSpec kNodes[] = {
    {.name = "maya_samplerinfo",
     .library = "hosts",
     .apply = kApplyTexture,
     .doc = "Fallback for Maya's samplerInfo.",
     .result = ParamType::Struct,
     .results = kSampledResults,
     .result_size = sizeof(Sampled),
     .value = sample,
     .fallback = {.is_fallback = true}},
    joining("maya_rgb_to_color", kRgb),
    joining("maya_xyz_to_vector", kXyz),
    joining("maya_uvw_to_vector", kUvw),
    parting("maya_color_to_rgb", kColor, kRgb),
    parting("maya_vector_to_xyz", kVector, kXyz),
    parting("maya_vector_to_uvw", kVector, kUvw),
};

}  // namespace

std::span<const ShaderSpec> maya_conversions() { return kNodes; }

}  // namespace oriel
