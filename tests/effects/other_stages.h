// SPDX-License-Identifier: Apache-2.0
// Stages for materials, lights and volumes in scenes composed by the case.
#pragma once

#include "effects.h"

namespace oriel::effects::other_stages {

/// A colour as a shader, known in the scenes of composed() as "tint". Its mean is .3.
inline const std::string kTint =
    "shader \"tint\" \"mib_color_mix\" ( \"color_base\" .6 .2 .1 1 )\n";
inline const Rgb kTinted(.6f, .2f, .1f);

/// Adds a shader's call, and all that it is measured with, to an empty scene.
using Compose = std::function<void(SceneText& scene, const std::string& call)>;

/// From where a point of a surface is seen that faces +z.
struct View {
  float degrees = 0;  ///< from its normal
  int samples = 256;
  Vec3 at{0};
  bool indirect = true;
};

/// That scene, seen from above.
inline Stage composed(Compose compose, View view = {}) {
  return [=](const std::string& call) {
    SceneText scene;
    compose(scene.statement(kTint), call);
    Probe probe(scene.str());
    if (!view.indirect) probe.direct_only();
    return probe.onto(view.at, Vec3(0, 0, 1), view.degrees, view.samples);
  };
}

/// The call as shader "s" of material "m", which filters its own shadow as well.
inline void add_material(SceneText& scene, const std::string& call,
                         const std::string& elements = {}) {
  scene.statement(fmt::format(
      "{}\nshader \"s\" {}\nmaterial \"m\" = \"s\" shadow = \"s\" photon = \"s\" end material",
      elements, call));
}

/// The call as the material of a square at z = 0, in light that `lit` adds.
inline Stage square_in(std::function<void(SceneText&)> lit, View view = {},
                       const std::string& elements = {}) {
  return composed(
      [=](SceneText& scene, const std::string& call) {
        add_material(scene, call, elements);
        scene.plate("m");
        lit(scene);
      },
      view);
}

/// A sun of colour 1 from straight above.
inline void sun_above(SceneText& scene) {
  scene.light("sun", "\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" on ) direction 0 0 -1");
}

/// The call as shader "inner", called by the shader `outer`, which is displayed as by value().
inline Stage inside(const std::string& outer, const std::string& elements = {},
                    Vec2 place = Vec2(.5f, .5f)) {
  return [=](const std::string& call) {
    return value(elements + "\nshader \"inner\" " + call, place)(outer);
  };
}

/// A square before the one that value() shows, whose two texture spaces are the same everywhere.
inline std::string square_of_spaces(const Vec3& first, const Vec3& second) {
  return fmt::format(
      "object \"spaces\" visible trace shadow tagged group "
      "-10 -10 -4  10 -10 -4  10 10 -4  -10 10 -4  {}  {} "
      "v 0 t 4 t 5 v 1 t 4 t 5 v 2 t 4 t 5 v 3 t 4 t 5 p 0 0 1 2 3 end group end object\n"
      "instance \"spaces_inst\" \"spaces\" material [ \"m\" ] end instance\n",
      text_of(first), text_of(second));
}

}  // namespace oriel::effects::other_stages
