// SPDX-License-Identifier: Apache-2.0
// Composes small .mi scenes from shapes and materials with known exact images.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "base/vec.h"

namespace oriel::testing {

inline std::string text_of(const Vec3& v) { return fmt::format("{} {} {}", v.x, v.y, v.z); }

inline const Vec3 kUp(0, 0, 1);

/// A scene under composition; every call adds one element and its instance.
class SceneText {
 public:
  /// Statements of the options block in addition to "trace on" and the method.
  explicit SceneText(std::string options = "trace depth 8 8 12 shadow segments")
      : options_(std::move(options)) {}

  /// The method of indirect light; "scene" as the options say.
  SceneText& method(const std::string& name);
  /// A mia_material_x of those parameters that stands for its shadows as well. Without
  /// "reflectivity" it would reflect: declared defaults hold.
  SceneText& material(const std::string& name, const std::string& parameters);
  /// A Lambert surface.
  SceneText& lambert(const std::string& name, float albedo, const std::string& more = {});
  /// A surface that only emits, on both sides.
  SceneText& emitter(const std::string& name, float radiance);
  /// Puts all instances so far into a group, and that into the root group by an instance of those
  /// flags.
  SceneText& group(const std::string& name, const std::string& flags);
  /// Any statement at the top level of the file.
  SceneText& statement(const std::string& text);
  /// Puts an instance that a statement made into the root group.
  SceneText& member(const std::string& instance);
  SceneText& environment(const std::string& shader_call);
  SceneText& uniform_sky(float radiance);
  /// Light and below 0 in direction `up`, dark.
  SceneText& half_sky(float radiance, const Vec3& up);

  /// A light element and its instance in world space.
  SceneText& light(const std::string& name, const std::string& element,
                   const std::string& flags = {});

  /// A polygon, front where it runs counter-clockwise.
  SceneText& polygon(const std::string& material, const std::vector<Vec3>& corners,
                     const std::string& flags = {});
  /// A square of side 2 `half` around `centre`; its front looks along `normal`.
  SceneText& square(const std::string& material, const Vec3& centre, float half,
                    const Vec3& normal);
  /// A square of side 10 around the origin that looks up.
  SceneText& plate(const std::string& material) { return square(material, Vec3(0), 5, kUp); }
  /// A box with its front outside, or inside for rooms.
  SceneText& box(const std::string& material, const Vec3& lo, const Vec3& hi, bool inward = false);
  /// A sphere of n rings with vertex normals, front outside or inside.
  SceneText& sphere(const std::string& material, const Vec3& centre, float radius, int n = 48,
                    bool inward = false);
  SceneText& mesh(const std::string& material, const std::vector<Vec3>& points,
                  const std::vector<std::vector<int>>& faces, const std::vector<Vec3>& normals,
                  const std::string& flags = {});

  /// Camera at the origin looking down -z unless a transform (world to camera) is given.
  SceneText& camera(const std::string& statements, const std::string& transform = {});

  std::string str() const;

 private:
  std::string options_, body_, members_, environment_, camera_transform_, method_ = "path";
  std::string camera_ = "focal 1 aperture 1 aspect 1 resolution 32 32";
  int shapes_ = 0;
};

}  // namespace oriel::testing
