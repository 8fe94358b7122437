// SPDX-License-Identifier: Apache-2.0
// Test support: prepares `.mi` text for rendering and records its messages.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "mi/reader.h"
#include "prepare/prepare.h"
#include "shaders/registry.h"

namespace oriel::testing {

/// A parsed and prepared scene. `world` is null if nothing can be rendered.
struct PreparedScene {
  Diagnostics diagnostics;
  scene::Scene scene;
  PrepareReport report;
  std::unique_ptr<World> world;

  /// Inputs:  name: file name of the text; includes are relative to it.
  explicit PreparedScene(std::string_view text, const Registry& registry = builtin_shaders(),
                         const PrepareOptions& options = {}, const std::string& name = "scene.mi") {
    mi::ReadOptions read;
    read.packages = builtin_packages();
    read.knows_shader = [&](std::string_view n) { return registry.find(n) != nullptr; };
    scene = mi::read_text(text, read, diagnostics, name);
    if (!scene.renders.empty())
      world = prepare(scene, scene.renders.back(), registry, options, diagnostics, report);
  }

  /// All messages as printed to users, for the output of a failing test.
  std::string messages() const {
    std::string all;
    for (const Diagnostic& d : diagnostics.all()) all += diagnostics.format(d) + "\n";
    return all;
  }
  /// The only message with that code, or null.
  const Diagnostic* only(std::string_view code) const {
    const Diagnostic* found = nullptr;
    for (const Diagnostic& d : diagnostics.all())
      if (d.code == code) {
        if (found) return nullptr;
        found = &d;
      }
    return found;
  }
  /// The bound material of that name, or null.
  const Material* material(std::string_view name) const {
    if (world)
      for (const Material& m : world->materials)
        if (m.name == name) return &m;
    return nullptr;
  }
};

/// A complete scene around `elements`: a camera at the origin that looks down -z (16 x 12 pixels,
/// with a view as wide as it is deep), a square of 20 units at z = -5 with material "m", and the
/// lights `members`. `elements` must define "m"; `camera` contains further statements of the
/// camera.
inline std::string scene_text(std::string_view elements, std::string_view members = {},
                              std::string_view camera = {}, std::string_view options = {}) {
  std::string text = "options \"opt\" trace depth 4 4 8 object space ";
  text.append(options).append(" end options camera \"cam\" focal 1 aperture 1 aspect 1.333333 ");
  text.append("resolution 16 12 ").append(camera).append(" end camera\n");
  text.append("instance \"cam_inst\" \"cam\" end instance\n").append(elements);
  text.append(
      "\nobject \"square\" visible trace shadow tagged group "
      "-10 -10 -5  10 -10 -5  10 10 -5  -10 10 -5  0 0 0  1 0 0  1 1 0  0 1 0 "
      "v 0 t 4 v 1 t 5 v 2 t 6 v 3 t 7 p 0 0 1 2 3 end group end object\n"
      "instance \"square_inst\" \"square\" material [ \"m\" ] end instance\n"
      "instgroup \"root\" \"cam_inst\" \"square_inst\" ");
  return text.append(members).append(" end instgroup\nrender \"root\" \"cam_inst\" \"opt\"\n");
}

}  // namespace oriel::testing
