// SPDX-License-Identifier: Apache-2.0
#include "models/import_view.h"

#include <assimp/scene.h>

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "models/shader_call.h"

namespace oriel::models {
namespace {

/// Film width of imported cameras in millimetres (full frame); the focal length is set for the
/// model's field of view.
constexpr float kApertureMillimetres = 36;

Vec3 vec_of(const aiVector3D& v) { return Vec3(v.x, v.y, v.z); }

Mat4 place_of(const NodePlaces& nodes, const aiString& name) {
  const auto found = nodes.find(name.C_Str());
  return found == nodes.end() ? Mat4() : found->second;
}

/// Position of the target node; unset if there is none.
std::optional<Vec3> target_of(const NodePlaces& nodes, const aiString& name) {
  const auto found = nodes.find(std::string(name.C_Str()) + ".Target");
  if (found == nodes.end()) return std::nullopt;
  return found->second.translation();
}

/// Transform of an object at p that looks along -z; `up` is in its y-z plane.
Mat4 looking(const Vec3& p, const Vec3& z, const Vec3& up) {
  const Vec3 x = normalize(cross(up, z)), y = cross(z, x);
  return Mat4(x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, p.x, p.y, p.z, 1);
}

/// Rotates towards the target, unless the direction is vertical.
Mat4 turned(const Mat4& to_world, const std::optional<Vec3>& target) {
  if (!target) return to_world;
  const Vec3 p = to_world.translation(), back = p - *target;
  const bool steep = math::hypot(back.x, back.z) <= 1e-6f * length(back);
  return steep ? to_world : looking(p, normalize(back), Vec3(0, 1, 0));
}

}  // namespace

Placed<scene::Camera> camera_of(const aiScene& model, const aiCamera& source,
                                const NodePlaces& nodes) {
  scene::Camera camera;
  const float half = source.mHorizontalFOV / 2;
  camera.aperture = kApertureMillimetres;
  camera.focal = half > 0 && half < kPi / 2 ? kApertureMillimetres / 2 / math::tan(half)
                                            : kApertureMillimetres;
  if (source.mOrthographicWidth > 0) {
    // Half the visible width, in units of the camera space.
    camera.orthographic = true;
    camera.focal.reset();
    camera.aperture = 2 * source.mOrthographicWidth;
  }
  camera.aspect = source.mAspect > 0 ? source.mAspect : kCameraAspect;
  constexpr int kWidth = 960;
  camera.resolution = {
      {kWidth, std::max(1, static_cast<int>(std::lround(kWidth / *camera.aspect)))}};
  // For glTF, assimp 5 applies the translation of the node twice.
  const aiNode* node = model.mRootNode ? model.mRootNode->FindNode(source.mName) : nullptr;
  const bool twice = node && Vec3(node->mTransformation.a4, node->mTransformation.b4,
                                  node->mTransformation.c4) == vec_of(source.mPosition);
  const Vec3 p = twice ? Vec3(0) : vec_of(source.mPosition);
  const Mat4 own = looking(p, normalize(-vec_of(source.mLookAt)), vec_of(source.mUp));
  return {std::move(camera),
          turned(own * place_of(nodes, source.mName), target_of(nodes, source.mName))};
}

namespace {

/// Light that leaves a flat surface along the light's direction.
///
/// Model:   the number of the file is the intensity of a point light of the same flux
///          (light_units), so the flux is 4 pi times it, and the intensity along the normal 1/pi of
///          the flux.
void set_area(const aiLight& source, const Vec3& color, scene::Light& light) {
  constexpr float kOfPoint = 4;  // intensity along the normal, of that of the point light
  const Vec3 normal = normalize(vec_of(source.mDirection));
  const Vec3 written = vec_of(source.mUp), other(normal.y, normal.z, normal.x);
  const Vec3 along = cross(normal, length(cross(normal, written)) > 0 ? written : other);
  const Vec3 u = normalize(along), v = cross(normal, u);
  ShaderCall call("physical_light");
  call.set("color", color * (kOfPoint * kOfPoint));
  light.shaders = {call.use()};
  light.origin = vec_of(source.mPosition);
  light.direction = normal;
  light.area = scene::Statement();
  const bool disc = source.mSize.y <= 0;
  light.area->keyword = disc ? "disc" : "rectangle";
  const auto put = [&](const Vec3& x) {
    for (int k = 0; k < 3; ++k) light.area->values.push_back(numbers({x[k]}));
  };
  if (disc) {
    put(normal);
    light.area->values.push_back(numbers({source.mSize.x / 2}));
  } else {
    put(u * source.mSize.x);
    put(v * source.mSize.y);
  }
}

}  // namespace

std::optional<Placed<scene::Light>> light_of(const aiLight& source, const NodePlaces& nodes) {
  scene::Light light;
  const std::optional<Vec3> target = target_of(nodes, source.mName);
  const Vec3 color(source.mColorDiffuse.r, source.mColorDiffuse.g, source.mColorDiffuse.b);
  const bool spot = source.mType == aiLightSource_SPOT;
  if (source.mType == aiLightSource_DIRECTIONAL) {
    ShaderCall call("mib_light_infinite");
    call.set("color", color / kPi).set("shadow", true);
    light.shaders = {call.use()};
    light.direction = vec_of(source.mDirection);
  } else if (source.mType == aiLightSource_POINT || spot) {
    // Converts intensity over 4 pi to radiance over pi of a facing surface.
    ShaderCall call("physical_light");
    call.set("color", color * 4.0f);
    light.origin = vec_of(source.mPosition);
    if (spot) {
      light.direction = vec_of(source.mDirection);
      light.spread = math::cos(std::min(source.mAngleOuterCone, kPi));
      call.set("cone", math::cos(std::min(source.mAngleInnerCone, kPi)));
    }
    light.shaders = {call.use()};
  } else if (source.mType == aiLightSource_AREA && length(vec_of(source.mDirection)) > 0) {
    set_area(source, color, light);
  } else {
    return std::nullopt;
  }
  Mat4 to_world = place_of(nodes, source.mName);
  if (light.direction && target) {
    to_world = turned(to_world, target);
    light.direction = Vec3(0, 0, -1);
  }
  return Placed<scene::Light>{std::move(light), to_world};
}

}  // namespace oriel::models
