// SPDX-License-Identifier: Apache-2.0
#include "support/scene_text.h"

#include <algorithm>
#include <cmath>

namespace oriel::testing {

SceneText& SceneText::method(const std::string& name) {
  method_ = name;
  return *this;
}

SceneText& SceneText::material(const std::string& name, const std::string& parameters) {
  body_ += fmt::format(
      "shader \"{0}_s\" \"mia_material_x\" ( {1} )\n"
      "material \"{0}\" = \"{0}_s\" shadow = \"{0}_s\" photon = \"{0}_s\" end material\n",
      name, parameters);
  return *this;
}

SceneText& SceneText::lambert(const std::string& name, float albedo, const std::string& more) {
  return material(name, fmt::format("\"reflectivity\" 0, \"diffuse\" {0} {0} {0}{1}{2}", albedo,
                                    more.empty() ? "" : ", ", more));
}

SceneText& SceneText::emitter(const std::string& name, float radiance) {
  return material(name, fmt::format("\"reflectivity\" 0, \"diffuse_weight\" 0, "
                                    "\"additional_color\" {0} {0} {0}",
                                    radiance));
}

SceneText& SceneText::group(const std::string& name, const std::string& flags) {
  body_ += fmt::format(
      "instgroup \"{0}\"{1} end instgroup\ninstance \"{0}_i\" \"{0}\" {2} end instance\n", name,
      members_, flags);
  members_.clear();
  return member(name + "_i");
}

SceneText& SceneText::statement(const std::string& text) {
  body_ += text + '\n';
  return *this;
}

SceneText& SceneText::member(const std::string& instance) {
  members_ += fmt::format(" \"{}\"", instance);
  return *this;
}

SceneText& SceneText::environment(const std::string& shader_call) {
  environment_ = "environment " + shader_call;
  return *this;
}

SceneText& SceneText::uniform_sky(float radiance) {
  return environment(
      fmt::format("\"test_sky\" ( \"above\" {0} {0} {0}, \"below\" {0} {0} {0} )", radiance));
}

SceneText& SceneText::half_sky(float radiance, const Vec3& up) {
  return environment(
      fmt::format("\"test_sky\" ( \"above\" {0} {0} {0}, \"up\" {1} )", radiance, text_of(up)));
}

SceneText& SceneText::light(const std::string& name, const std::string& element,
                            const std::string& flags) {
  body_ += fmt::format("light \"{0}\" {1} end light\ninstance \"{0}_i\" \"{0}\" {2} end instance\n",
                       name, element, flags);
  members_ += fmt::format(" \"{}_i\"", name);
  return *this;
}

SceneText& SceneText::polygon(const std::string& material, const std::vector<Vec3>& corners,
                              const std::string& flags) {
  std::vector<int> face(corners.size());
  for (std::size_t i = 0; i < face.size(); ++i) face[i] = static_cast<int>(i);
  return mesh(material, corners, {face}, {}, flags);
}

SceneText& SceneText::square(const std::string& material, const Vec3& centre, float half,
                             const Vec3& normal) {
  const Vec3 n = normalize(normal);
  const Vec3 u =
      normalize(std::abs(n.x) < 0.9f ? cross(Vec3(1, 0, 0), n) : cross(Vec3(0, 1, 0), n));
  const Vec3 v = cross(n, u);
  return polygon(material, {centre - u * half - v * half, centre + u * half - v * half,
                            centre + u * half + v * half, centre - u * half + v * half});
}

SceneText& SceneText::box(const std::string& material, const Vec3& lo, const Vec3& hi,
                          bool inward) {
  std::vector<Vec3> p;
  for (int i = 0; i < 8; ++i)
    p.emplace_back(i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z);
  std::vector<std::vector<int>> faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  if (inward)
    for (auto& f : faces) std::swap(f[1], f[3]);
  return mesh(material, p, faces, {});
}

SceneText& SceneText::sphere(const std::string& material, const Vec3& centre, float radius, int n,
                             bool inward) {
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

SceneText& SceneText::mesh(const std::string& material, const std::vector<Vec3>& points,
                           const std::vector<std::vector<int>>& faces,
                           const std::vector<Vec3>& normals, const std::string& flags) {
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

SceneText& SceneText::camera(const std::string& statements, const std::string& transform) {
  camera_ = statements;
  camera_transform_ = transform;
  return *this;
}

std::string SceneText::str() const {
  return fmt::format(
      "options \"opt\" object space trace on {} \"indirect\" \"{}\" end options\n{}"
      "camera \"cam\" {} {} end camera\n"
      "instance \"cam_i\" \"cam\" {} end instance\n"
      "instgroup \"world\" \"cam_i\"{} end instgroup\n"
      "render \"world\" \"cam_i\" \"opt\"\n",
      options_, method_, body_, camera_, environment_,
      camera_transform_.empty() ? "" : "transform " + camera_transform_, members_);
}

}  // namespace oriel::testing
