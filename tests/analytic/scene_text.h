// SPDX-License-Identifier: Apache-2.0
// Composes small .mi scenes from shapes and materials whose exact pictures are known.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/vec.h"

namespace oriel::analytic {

inline std::string text_of(const Vec3& v) { return fmt::format("{} {} {}", v.x, v.y, v.z); }

/// A scene under composition; every call adds one element and its instance.
class SceneText {
 public:
  /// Statements of the options block beside "trace on" and the method.
  explicit SceneText(std::string options = "trace depth 8 8 12 shadow segments")
      : options_(std::move(options)) {}

  /// The method of indirect light; "scene" as the options say. Paths leave shadows of glass
  /// transparent even with caustics on, the others close them.
  SceneText& method(const std::string& name) {
    method_ = name;
    return *this;
  }
  /// A mia_material_x of those parameters that stands for its shadows as well. Without
  /// "reflectivity" it would reflect: declared defaults hold.
  SceneText& material(const std::string& name, const std::string& parameters) {
    body_ += fmt::format(
        "shader \"{0}_s\" \"mia_material_x\" ( {1} )\n"
        "material \"{0}\" = \"{0}_s\" shadow = \"{0}_s\" photon = \"{0}_s\" end material\n",
        name, parameters);
    return *this;
  }
  /// A Lambert surface.
  SceneText& lambert(const std::string& name, float albedo, const std::string& more = {}) {
    return material(name, fmt::format("\"reflectivity\" 0, \"diffuse\" {0} {0} {0}{1}{2}", albedo,
                                      more.empty() ? "" : ", ", more));
  }
  /// A surface that only glows, on both sides.
  SceneText& emitter(const std::string& name, float radiance) {
    return material(name, fmt::format("\"reflectivity\" 0, \"diffuse_weight\" 0, "
                                      "\"additional_color\" {0} {0} {0}",
                                      radiance));
  }
  /// Puts all instances so far into a group, and that into the root group by an instance of those
  /// flags.
  SceneText& group(const std::string& name, const std::string& flags) {
    body_ += fmt::format(
        "instgroup \"{0}\"{1} end instgroup\ninstance \"{0}_i\" \"{0}\" {2} end instance\n", name,
        members_, flags);
    members_.clear();
    return member(name + "_i");
  }
  /// Any statement at the top level of the file.
  SceneText& statement(const std::string& text) {
    body_ += text + '\n';
    return *this;
  }
  /// Puts an instance that a statement made into the root group.
  SceneText& member(const std::string& instance) {
    members_ += fmt::format(" \"{}\"", instance);
    return *this;
  }
  SceneText& environment(const std::string& shader_call) {
    environment_ = "environment " + shader_call;
    return *this;
  }
  SceneText& uniform_sky(float radiance) {
    return environment(
        fmt::format("\"test_sky\" ( \"above\" {0} {0} {0}, \"below\" {0} {0} {0} )", radiance));
  }
  /// Light and below 0 in direction `up`, dark.
  SceneText& half_sky(float radiance, const Vec3& up) {
    return environment(
        fmt::format("\"test_sky\" ( \"above\" {0} {0} {0}, \"up\" {1} )", radiance, text_of(up)));
  }

  /// A light element and its instance in world space.
  SceneText& light(const std::string& name, const std::string& element,
                   const std::string& flags = {}) {
    body_ +=
        fmt::format("light \"{0}\" {1} end light\ninstance \"{0}_i\" \"{0}\" {2} end instance\n",
                    name, element, flags);
    members_ += fmt::format(" \"{}_i\"", name);
    return *this;
  }

  /// A polygon, front where it runs counter-clockwise.
  SceneText& polygon(const std::string& material, const std::vector<Vec3>& corners,
                     const std::string& flags = {}) {
    std::vector<int> face(corners.size());
    for (std::size_t i = 0; i < face.size(); ++i) face[i] = static_cast<int>(i);
    return mesh(material, corners, {face}, {}, flags);
  }
  /// A square of side 2 `half` around `centre`; its front looks along `normal`.
  SceneText& square(const std::string& material, const Vec3& centre, float half,
                    const Vec3& normal) {
    const Vec3 n = normalize(normal);
    const Vec3 u =
        normalize(std::abs(n.x) < 0.9f ? cross(Vec3(1, 0, 0), n) : cross(Vec3(0, 1, 0), n));
    const Vec3 v = cross(n, u);
    return polygon(material, {centre - u * half - v * half, centre + u * half - v * half,
                              centre + u * half + v * half, centre - u * half + v * half});
  }
  /// A box with its front outside, or inside for rooms.
  SceneText& box(const std::string& material, const Vec3& lo, const Vec3& hi, bool inward = false) {
    std::vector<Vec3> p;
    for (int i = 0; i < 8; ++i)
      p.emplace_back(i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z);
    std::vector<std::vector<int>> faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    if (inward)
      for (auto& f : faces) std::swap(f[1], f[3]);
    return mesh(material, p, faces, {});
  }
  /// A sphere of n rings with vertex normals, front outside or inside.
  SceneText& sphere(const std::string& material, const Vec3& centre, float radius, int n = 48,
                    bool inward = false) {
    std::vector<Vec3> p, normals;
    std::vector<std::vector<int>> faces;
    const int m = 2 * n;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j < m; ++j) {
        const float theta = kPi * static_cast<float>(i) / static_cast<float>(n);
        const float phi = kTwoPi * static_cast<float>(j) / static_cast<float>(m);
        const Vec3 d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                     std::cos(theta));
        p.push_back(centre + d * radius);
        normals.push_back(inward ? -d : d);
      }
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < m; ++j) {
        const int a = i * m + j, b = i * m + (j + 1) % m, c = a + m, d = b + m;
        std::vector<int> f = i == 0       ? std::vector<int>{a, c, d}
                             : i == n - 1 ? std::vector<int>{a, c, b}
                                          : std::vector<int>{a, c, d, b};
        if (inward) std::reverse(f.begin(), f.end());
        faces.push_back(f);
      }
    return mesh(material, p, faces, normals);
  }
  SceneText& mesh(const std::string& material, const std::vector<Vec3>& points,
                  const std::vector<std::vector<int>>& faces, const std::vector<Vec3>& normals,
                  const std::string& flags = {}) {
    const std::string name = fmt::format("shape{}", shapes_++);
    body_ += fmt::format("object \"{}\" visible on shadow on trace on\n group\n", name);
    for (const Vec3& p : points) body_ += text_of(p) + '\n';
    for (const Vec3& n : normals) body_ += text_of(n) + '\n';
    for (std::size_t i = 0; i < points.size(); ++i)
      body_ += normals.empty() ? fmt::format("v {}\n", i)
                               : fmt::format("v {} n {}\n", i, points.size() + i);
    for (const auto& face : faces) body_ += fmt::format("c {}\n", fmt::join(face, " "));
    body_ += fmt::format(
        " end group\nend object\ninstance \"{0}_i\" \"{0}\" material \"{1}\" {2} end instance\n",
        name, material, flags);
    members_ += fmt::format(" \"{}_i\"", name);
    return *this;
  }

  /// Camera at the origin looking down -z unless a transform (world to camera) is given.
  SceneText& camera(const std::string& statements, const std::string& transform = {}) {
    camera_ = statements;
    camera_transform_ = transform;
    return *this;
  }

  std::string str() const {
    return fmt::format(
        "options \"opt\" object space trace on {} \"indirect\" \"{}\" end options\n{}"
        "camera \"cam\" {} {} end camera\n"
        "instance \"cam_i\" \"cam\" {} end instance\n"
        "instgroup \"world\" \"cam_i\"{} end instgroup\n"
        "render \"world\" \"cam_i\" \"opt\"\n",
        options_, method_, body_, camera_, environment_,
        camera_transform_.empty() ? "" : "transform " + camera_transform_, members_);
  }

 private:
  std::string options_, body_, members_, environment_, camera_transform_, method_ = "path";
  std::string camera_ = "focal 1 aperture 1 aspect 1 resolution 32 32";
  int shapes_ = 0;
};

}  // namespace oriel::analytic
