// SPDX-License-Identifier: Apache-2.0
// Test support: random scenes, to see whether writing and reading lose anything.
#pragma once

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <utility>

#include "scene/scene.h"

namespace oriel::mi {

/// Scenes made of every element and every kind of value, from a seed.
///
/// They are what a reader could have made: names count in the order of their first use, columns
/// without an entry are empty.
class RandomScene {
 public:
  explicit RandomScene(std::uint32_t seed) : random_(seed) {}

  scene::Scene make() {
    scene::Scene s;
    for (int i = pick(3); i > 0; --i) s.declarations.push_back(declaration());
    for (int i = pick(2); i > 0; --i) s.phenomena.push_back(phenomenon());
    if (chance()) s.packages = {"base.mi"};
    s.add(options());
    for (int i = pick(3); i > 0; --i) {
      scene::ShaderElement e;
      e.name = name();
      e.functions = shaders(1);
      s.add(std::move(e));
      s.add(texture());
      s.add(material());
      s.add(light());
      s.add(object());
      s.add(instance());
      s.add(camera());
      scene::InstanceGroup g;
      g.name = name();
      g.members = {name(), name()};
      s.add(std::move(g));
    }
    s.renders = {{name(), name(), name(), {}}};
    return s;
  }

 private:
  int pick(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
  bool chance() { return pick(2) == 0; }
  template <std::size_t N>
  const char* one_of(const char* const (&words)[N]) {
    return words[pick(static_cast<int>(N))];
  }

  /// Any float but what has no spelling.
  float real() {
    for (;;) {
      const float x = std::bit_cast<float>(static_cast<std::uint32_t>(random_()));
      if (chance()) return static_cast<float>(pick(200) - 100) / 8;
      if (std::isfinite(x)) return x;
    }
  }
  double wide() {
    for (;;) {
      const std::uint64_t high = random_();
      const double x = std::bit_cast<double>(high << 32 | random_());
      if (std::isfinite(x)) return x;
    }
  }

  std::string name() {
    static constexpr const char* kOdd[] = {"a b",        "A|B(C 01)", ":Root", "n:shader",
                                           "say \"hi\"", "C:\\x",     "end",   "\xc3\xa4",
                                           "x#y",        "$z"};
    return fmt::format("{}{}", one_of(kOdd), ++names_);
  }

  scene::Value numbers(int count) {
    scene::Value v;
    v.kind = scene::Value::Kind::Numbers;
    v.integral = chance();
    for (int i = 0; i < count; ++i)
      v.numbers.push_back(v.integral ? static_cast<double>(random_()) - 2147483648.0
                          : chance() ? wide()
                                     : pick(9));
    return v;
  }
  scene::Value words(std::string text, bool bare) {
    scene::Value v;
    v.kind = scene::Value::Kind::Text;
    v.text = std::move(text);
    v.bare = bare;
    return v;
  }

  scene::Value value(int depth) {
    scene::Value v;
    const int kinds = depth > 3 ? 6 : 8;
    switch (pick(kinds)) {
      case 0:
        return v;
      case 1:
        v.kind = scene::Value::Kind::Boolean;
        v.boolean = chance();
        return v;
      case 2:
        return numbers(1 + pick(4));
      case 3:
        return words(chance() ? name() : "", false);
      case 4:
        v.kind = scene::Value::Kind::Connection;
        v.text = name() + ".out";
        return v;
      case 5:
        v.kind = scene::Value::Kind::Interface;
        v.text = name();
        return v;
      case 6:
        v.kind = scene::Value::Kind::Struct;
        v.members = arguments(depth + 1);
        return v;
      default:
        v.kind = scene::Value::Kind::Array;
        for (int i = pick(4); i > 0; --i) v.items.push_back(value(depth + 1));
        return v;
    }
  }
  std::vector<scene::Argument> arguments(int depth) {
    std::vector<scene::Argument> list;
    for (int i = pick(4); i > 0; --i) list.push_back({name(), value(depth), {}});
    return list;
  }
  scene::ShaderList shaders(int least) {
    scene::ShaderList list;
    for (int i = least + pick(2); i > 0; --i) {
      scene::ShaderUse use;
      if (chance()) {
        use.reference = name();
      } else {
        use.type = name();
        use.arguments = arguments(0);
      }
      list.push_back(std::move(use));
    }
    return list;
  }

  scene::Statement statement(std::string keyword, std::vector<scene::Value> values,
                             bool quoted = false) {
    return {std::move(keyword), quoted, std::move(values), {}};
  }
  scene::Value boolean() {
    scene::Value v;
    v.kind = scene::Value::Kind::Boolean;
    v.boolean = chance();
    return v;
  }

  scene::Options options() {
    scene::Options o;
    o.name = name();
    for (int i = pick(12); i > 0; --i) switch (pick(6)) {
        case 0:
          o.statements.push_back(statement("contrast", {numbers(4)}));
          break;
        case 1:
          o.statements.push_back(
              statement("filter", {words(chance() ? "gauss" : "clip mitchell", true), numbers(2)}));
          break;
        case 2:
          o.statements.push_back(statement("photonmap file", {words(name(), false)}));
          break;
        case 3:
          o.statements.push_back(statement("trace", {boolean()}));
          break;
        case 4:
          o.statements.push_back(statement("frame buffer", {numbers(1), words("-rgba_fp", false)}));
          break;
        default:
          o.statements.push_back(
              statement(name(), {chance() ? numbers(1 + pick(4)) : words(name(), false)}, true));
      }
    if (chance()) o.state = shaders(1);
    return o;
  }

  scene::Camera camera() {
    scene::Camera c;
    c.name = name();
    if (chance())
      c.focal = real();
    else
      c.orthographic = chance();
    if (chance()) c.aperture = real();
    if (chance()) c.aspect = real();
    if (chance()) c.resolution = std::array<int, 2>{pick(5000), pick(5000)};
    for (int i = pick(4); i > 0; --i) {
      scene::Output o;
      static constexpr const char* kTypes[] = {"", "rgba", "rgb", "+rgba,z", "fb0", "bit"};
      static constexpr const char* kFormats[] = {"", "tif", "rgb", "pic", "exr", "unheard"};
      o.types = one_of(kTypes);
      if (pick(4) == 0) {
        o.shaders = shaders(1);
      } else {
        o.format = one_of(kFormats);
        o.file = name() + (chance() ? ".rgb" : ".tif");
        if (chance()) o.modifiers = {statement("quality", {numbers(1)}), statement("even", {})};
      }
      c.outputs.push_back(std::move(o));
    }
    c.lens = shaders(0);
    c.environment = shaders(0);
    if (chance()) c.other = {statement("clip", {numbers(2)}), statement("frame", {numbers(1)})};
    for (int i = pick(3); i > 0; --i) c.frame_buffers.push_back(frame_buffer());
    if (chance()) c.kept = {{"pass", "\"p\" read", {}}};
    return c;
  }

  scene::FrameBuffer frame_buffer() {
    scene::FrameBuffer b;
    b.name = name();
    if (chance()) b.datatype = "rgba_fp";
    if (chance()) b.filename = name() + ".exr";
    if (chance()) b.filetype = "exr";
    if (chance()) b.filtering = chance();
    if (chance()) b.primary = chance();
    if (chance()) b.user = chance();
    if (chance()) b.modifiers = {statement("dpi", {numbers(2)}), statement("tiled", {})};
    if (chance()) b.kept = {{"deep", "[ 1 ( 2 ) ]", {}}};
    return b;
  }

  scene::Light light() {
    scene::Light l;
    l.name = name();
    l.shaders = shaders(0);
    l.emitters = shaders(0);
    if (chance()) l.origin = Vec3(real(), real(), real());
    if (chance()) l.direction = Vec3(real(), real(), real());
    if (chance()) l.spread = real();
    if (chance()) l.area = statement("disc", {numbers(7)});
    if (chance()) l.other = {statement("visible", {}), statement("exponent", {numbers(1)})};
    return l;
  }

  scene::Material material() {
    scene::Material m;
    m.name = name();
    m.opaque = chance();
    m.nocontour = chance();
    m.shaders = shaders(0);
    for (const char* slot : {"displace", "shadow", "photon"})
      if (chance()) m.slots.push_back({slot, shaders(0)});
    return m;
  }

  scene::Texture texture() {
    scene::Texture t;
    t.name = name();
    t.type = chance() ? scene::ParamType::ColorTexture : scene::ParamType::ScalarTexture;
    t.local = chance();
    t.writable = chance();
    if (chance()) t.filter = real();
    switch (pick(3)) {
      case 0:
        t.procedure = shaders(1);
        break;
      case 1:
        t.size = {7, 5, 1};
        for (int i = 0; i < 35; ++i) t.pixels.push_back(static_cast<std::uint8_t>(pick(256)));
        break;
      default:
        t.file = name();
        if (chance()) t.format = "raw";
    }
    return t;
  }

  /// A column with an entry for each vertex, with gaps or not at all.
  std::vector<std::uint32_t> column(std::size_t vertices, int vectors, bool gaps) {
    std::vector<std::uint32_t> c;
    bool any = false;
    for (std::size_t i = 0; i < vertices; ++i) {
      c.push_back(gaps && chance() ? scene::kNone : static_cast<std::uint32_t>(pick(vectors)));
      any |= c.back() != scene::kNone;
    }
    return any ? c : std::vector<std::uint32_t>{};
  }

  scene::PolygonGroup group(bool tagged) {
    scene::PolygonGroup g;
    if (chance()) g.name = name();
    if (chance()) g.settings.push_back(statement("approximate", {words("fine", true)}));
    const int vectors = 3 + pick(50);
    for (int i = 0; i < vectors; ++i) g.vectors.emplace_back(real(), real(), real());
    const std::size_t n = 3 + static_cast<std::size_t>(pick(40));
    g.vertices.point = column(n, vectors, false);
    if (chance()) g.vertices.normal = column(n, vectors, true);
    if (chance()) g.vertices.derivative = {column(n, vectors, false), column(n, vectors, false)};
    for (int i = pick(3); i > 0; --i) {
      scene::TextureColumn& t = g.vertices.textures.emplace_back();
      t.coordinate = column(n, vectors, false);
      if (!chance()) continue;
      t.basis_u = column(n, vectors, true);
      for (const std::uint32_t u : t.basis_u)
        t.basis_v.push_back(u == scene::kNone ? scene::kNone
                                              : static_cast<std::uint32_t>(pick(vectors)));
    }
    if (auto motion = column(n, vectors, true); !motion.empty()) g.vertices.motion = {motion};
    for (int i = pick(3); i > 0; --i) g.vertices.user.push_back(column(n, vectors, false));
    polygons(g, static_cast<int>(n), tagged);
    for (int i = pick(3); i > 0; --i) {
      scene::FreeCurve& c = g.freeform.curves.emplace_back();
      c.name = name();
      c.space = chance();
      c.basis = basis_use();
      c.points = control_points(vectors);
      for (int k = pick(3); k > 0; --k) c.special.push_back(real());
    }
    for (int i = pick(3); i > 0; --i) g.freeform.surfaces.push_back(surface(g, tagged, vectors));
    if (chance())
      g.freeform.connections.push_back(
          {{name(), name()}, {{name(), real(), real()}, {name(), real(), real()}}, {}});
    return g;
  }

  scene::BasisUse basis_use() {
    scene::BasisUse use{chance(), name(), {}};
    for (int i = 2 + pick(6); i > 0; --i) use.parameters.push_back(real());
    return use;
  }

  std::vector<scene::ControlPoint> control_points(int vertices) {
    std::vector<scene::ControlPoint> points;
    for (int i = pick(9); i > 0; --i)
      points.push_back({static_cast<std::uint32_t>(pick(vertices)), chance() ? real() : 1});
    return points;
  }

  scene::FreeSurface surface(scene::PolygonGroup& g, bool tagged, int vertices) {
    scene::FreeSurface s;
    s.name = name();
    s.material =
        static_cast<std::uint32_t>(tagged ? pick(9) : static_cast<int>(g.materials.size()));
    if (!tagged) g.materials.push_back(name());
    s.u = basis_use();
    s.v = basis_use();
    s.u_min = real();
    s.v_max = real();
    s.points = control_points(vertices);
    if (chance()) s.derivative = {1, 2};
    for (int i = pick(3); i > 0; --i)
      s.textures.push_back(
          {chance(), chance(), basis_use(), basis_use(), control_points(vertices)});
    for (int i = pick(4); i > 0; --i) {
      scene::SurfaceLoop& loop = s.loops.emplace_back();
      loop.kind = static_cast<scene::SurfaceLoop::Kind>(pick(3));
      for (int k = 1 + pick(3); k > 0; --k) loop.parts.push_back({name(), real(), real()});
      if (loop.kind == scene::SurfaceLoop::Kind::Special) loop.points = {7, 8};
    }
    return s;
  }

  void polygons(scene::PolygonGroup& g, int vertices, bool tagged) {
    scene::PolygonList& list = g.polygons;
    const auto loop = [&] {
      for (int i = 3 + pick(4); i > 0; --i)
        list.indices.push_back(static_cast<std::uint32_t>(pick(vertices)));
    };
    for (int i = pick(20); i > 0; --i) {
      if (list.first.empty()) list.first.push_back(0);
      loop();
      for (int holes = pick(3); holes > 0; --holes) {
        list.holes.push_back(static_cast<std::uint32_t>(list.indices.size()));
        loop();
      }
      list.first.push_back(static_cast<std::uint32_t>(list.indices.size()));
      // A new name is used at once: names count in the order of their first use.
      if (tagged) {
        list.material.push_back(static_cast<std::uint32_t>(pick(9)));
      } else if (g.materials.empty() || pick(4) == 0) {
        list.material.push_back(static_cast<std::uint32_t>(g.materials.size()));
        g.materials.push_back(name());
      } else {
        const int named = static_cast<int>(g.materials.size());
        const int choice = pick(named + 1);
        list.material.push_back(choice == named ? scene::kNone
                                                : static_cast<std::uint32_t>(choice));
      }
    }
  }

  scene::Object object() {
    scene::Object o;
    o.name = name();
    const bool tagged = chance();
    o.flags = {statement("visible", {}), statement("shadow", {numbers(1)}),
               statement("trace", {boolean()})};
    if (tagged) o.flags.push_back(statement("tagged", {}));
    for (int i = pick(3); i > 0; --i) {
      scene::Basis& b = o.bases.emplace_back();
      b = {name(), static_cast<scene::Basis::Kind>(pick(5)), chance(), 3, 1, {}};
      if (b.kind == scene::Basis::Kind::Matrix) b.matrix = {real(), real(), real(), real()};
    }
    for (int i = pick(3); i > 0; --i) o.groups.push_back(group(tagged));
    return o;
  }

  Mat4 matrix() {
    Mat4 m;
    m[3][0] = real();
    m[3][1] = real();
    m[0][1] = static_cast<float>(pick(100)) / 64;
    return m;
  }

  scene::Instance instance() {
    scene::Instance i;
    i.name = name();
    if (chance())
      i.element = name();
    else
      i.geometry = shaders(1);
    for (const char* flag : {"hide", "visible", "shadow", "trace", "caustic", "finalgather"})
      if (chance()) i.flags.push_back(statement(flag, {chance() ? boolean() : numbers(1)}));
    if (chance()) i.flags.push_back(statement("face", {words("both", true)}));
    if (chance()) i.flags.push_back(statement("override", {}));
    if (chance()) i.transform = matrix();
    if (chance()) i.motion_transform = matrix();
    i.material_list = chance();
    for (int n = i.material_list ? pick(4) : pick(2); n > 0; --n) i.materials.push_back(name());
    if (chance()) i.light_links = scene::LightLinks{chance(), {name()}};
    if (chance()) i.shadow_links = scene::LightLinks{chance(), {}};
    if (chance()) i.parameters = arguments(0);
    return i;
  }

  scene::ParamDecl parameter(int depth) {
    scene::ParamDecl p;
    static constexpr scene::ParamType kPlain[] = {
        scene::ParamType::Color, scene::ParamType::Scalar, scene::ParamType::Boolean,
        scene::ParamType::ColorTexture, scene::ParamType::Shader};
    p.type = kPlain[pick(5)];
    p.name = name();
    if (depth < 3 && pick(4) == 0) {
      p.type = scene::ParamType::Struct;
      for (int i = 1 + pick(3); i > 0; --i) p.members.push_back(parameter(depth + 1));
    } else if (depth < 3 && pick(4) == 0) {
      p.type = scene::ParamType::Array;
      p.members = {parameter(depth + 1)};
      p.name = p.members[0].name;
    } else if (p.type == scene::ParamType::Color && chance()) {
      p.default_value = numbers(3);
    }
    return p;
  }

  scene::ShaderDeclaration declaration() {
    scene::ShaderDeclaration d;
    d.name = name();
    scene::ParamDecl result;
    result.type = scene::ParamType::Color;
    d.results = {result};
    if (chance()) d.results = {parameter(3), parameter(3)};
    for (int i = pick(5); i > 0; --i) d.parameters.push_back(parameter(0));
    d.old_form = pick(4) == 0;
    if (d.old_form) return d;
    d.requirements = {statement("version", {numbers(1)}),
                      statement("apply", {words("material", true), words("texture", true)})};
    if (chance()) d.kept = {{"gui", "\"g\" { control \"x\" ( \"h\" ) }", {}}};
    return d;
  }

  scene::Phenomenon phenomenon() {
    scene::Phenomenon p;
    p.declaration = declaration();
    p.declaration.old_form = false;
    p.requirements = std::exchange(p.declaration.requirements, {});
    scene::ShaderElement s;
    s.name = name();
    s.functions = shaders(1);
    p.shaders = {s};
    p.materials = {material()};
    p.lights = {light()};
    p.instances = {instance()};
    p.roots = {{"root material", name(), {}}, {"root", "", shaders(1)}, {"lens", "", shaders(1)}};
    return p;
  }

  std::mt19937 random_;
  int names_ = 0;
};

}  // namespace oriel::mi
