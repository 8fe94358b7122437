// SPDX-License-Identifier: Apache-2.0
// Test support: random scenes for round-trip tests of writer and reader.
#pragma once

#include <array>
#include <utility>

#include "mi/testing/random_geometry.h"

namespace oriel::mi {

/// Random scenes from a seed, with all elements and all kinds of values.
///
/// A scene has the form that a reader produces: names are indexed in the order of their first use,
/// and columns without an entry are empty.
class RandomScene : private RandomGeometry {
 public:
  explicit RandomScene(std::uint32_t seed) : RandomGeometry(seed) {}

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
    if (chance()) c.uninterpreted = {{"pass", "\"p\" read", {}}};
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
    if (chance()) b.uninterpreted = {{"deep", "[ 1 ( 2 ) ]", {}}};
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
    if (chance()) d.uninterpreted = {{"gui", "\"g\" { control \"x\" ( \"h\" ) }", {}}};
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
};

}  // namespace oriel::mi
