// SPDX-License-Identifier: Apache-2.0
// Maya's layers, shading engine, use-background and shadow shader: shaders/maya/maya_layers.cpp.
#include <numeric>

#include "cases.h"
#include "maya_stages.h"

namespace oriel::effects {
namespace maya_layers {
namespace {

/// "surface" shows .5 x (.2, .4, .6) under a sun or a sky of 1, "veil" half of that and what lies
/// behind it.
const std::string kSurfaces =
    "shader \"surface\" \"maya_lambert\" ( \"color\" .2 .4 .6, \"diffuse\" .5 )\n"
    "shader \"veil\" \"maya_lambert\" ( \"color\" .2 .4 .6, \"diffuse\" .5, "
    "\"transparency\" .5 .5 .5 )";
const Rgb kShown(.1f, .2f, .3f);

/// The shader on a plate under a sun of 1, or under a sky of 1 alone.
Stage plate(bool sky) {
  return [=](const std::string& call) {
    SceneText scene;
    scene.statement(kMayaSources + kSurfaces)
        .statement("shader \"s\" " + call + "\nmaterial \"m\" = \"s\" shadow = \"s\" end material")
        .square("m", Vec3(0), 5, Vec3(0, 0, 1));
    if (sky)
      scene.uniform_sky(1);
    else
      scene.light("sun",
                  "\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" on ) direction 0 0 -1");
    return Probe(scene.str()).onto(Vec3(0), Vec3(0, 0, 1), 0, 64);
  };
}

/// Layers, the first on top.
struct Layer {
  Rgb color, transparency;
};
std::vector<Layer> stack() {
  std::vector<Layer> all;
  for (int i = 0; i < 8; ++i)
    all.push_back({Rgb(.1f * float(i), .8f - .1f * float(i), i % 2 ? .5f : 0),
                   Rgb(.9f, .8f, .7f + .03f * float(i))});
  return all;
}
/// The sum of their colours and of `behind`, each times the transparencies of the layers above.
Rgb seen(const std::vector<Layer>& layers, const Rgb& behind) {
  return std::accumulate(
      layers.rbegin(), layers.rend(), behind,
      [](const Rgb& below, const Layer& l) { return l.color + l.transparency * below; });
}
std::string text_of_layers(const std::vector<Layer>& layers) {
  std::string text = fmt::format("inputs[] {}", layers.size());
  for (std::size_t i = 0; i < layers.size(); ++i)
    text += fmt::format(", inputs[{0}].color {1}, inputs[{0}].transparency {2}", i,
                        text_of(layers[i].color), text_of(layers[i].transparency));
  return text;
}

void add_layered(Cases& all) {
  const std::string name = "maya_layeredshader.";
  const std::vector<Layer> layers = stack();
  const std::string list = text_of_layers(layers);
  const Stage sun = plate(false), sky = plate(true);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const auto with = [&](const Layer& layer, const Rgb& behind) {
      std::vector<Layer> changed = layers;
      changed[i] = layer;
      return seen(changed, behind);
    };
    const Rgb color = layers[i].color, transparency = layers[i].transparency;
    const std::string row = fmt::format("{}inputs[{}].", name, i);
    const Case color_case =
        gives(row + "color", sun, list,
              {{"0 0 0", with({Rgb(0), transparency}, Rgb(0))},
               {"1 2 4", with({Rgb(1, 2, 4), transparency}, Rgb(0))},
               {"= \"tint\"", with({kMayaTint, transparency}, Rgb(0))},
               {"= \"surface.outColor\"", with({kShown, transparency}, Rgb(0))}});
    // How far the layer is seen through is its own transparency, not that of the surface.
    all.push_back(both(
        color_case, gives(row + "color", sky, list,
                          {{"= \"surface.outColor\"", with({kShown, transparency}, Rgb(1))},
                           {"= \"veil.outColor\"", with({kShown * .5f, transparency}, Rgb(1))}})));
    all.push_back(gives(row + "transparency", sky, list,
                        {{"0 0 0", with({color, Rgb(0)}, Rgb(1))},
                         {".5 .25 1", with({color, Rgb(.5f, .25f, 1)}, Rgb(1))},
                         {"= \"tint\"", with({color, kMayaTint}, Rgb(1))}}));
  }
  std::vector<Given> counts;
  for (const int count : {1, 2, 5, 8})
    counts.push_back(
        {std::to_string(count), seen({layers.begin(), layers.begin() + count}, Rgb(1))});
  const Case count = gives(name + "inputs[]", sky, list, counts);
  all.push_back(both(count, shows(count.parameter, [sun] {
                       // As scenes write it.
                       const std::string call =
                           "\"maya_layeredshader\" ( \"inputs\" [ { \"color\" = "
                           "\"surface.outColor\", \"transparency\" .5 .25 1 }, "
                           "{ \"color\" 1 2 4, \"transparency\" 0 0 0 } ] )";
                       analytic::expect_exact("array", sun(call), kShown + Rgb(.5f, .5f, 4));
                     })));
}

/// Seen through the plate is a sky of .25, mirrored in it one of 1. The plate is measured in the
/// light or, `shadowed`, below a black blocker.
Stage before_sky(bool shadowed) {
  return [=](const std::string& call) {
    SceneText scene;
    scene.statement("material \"plate\" " + call + " end material")
        .square("plate", Vec3(0), 10, Vec3(0, 0, 1))
        .lambert("dark", 0)
        .square("dark", Vec3(5, 0, 4), 4, Vec3(0, 0, -1))
        .light("sun", "\"mib_light_infinite\" ( \"color\" 3 3 3, \"shadow\" on ) direction 0 0 -1")
        .environment("\"test_sky\" ( \"above\" 1 1 1, \"below\" .25 .25 .25 )");
    return Probe(scene.str()).onto(Vec3(shadowed ? 5 : -5, 0, 0), Vec3(0, 0, 1), 0, 16384);
  };
}

void add_background(Cases& all) {
  const std::string name = "maya_usebackground.";
  const auto mirror = [](const Rgb& share) { return share + (Rgb(1) - share) * .25f; };
  all.push_back(gives(name + "specularColor", before_sky(false), "reflectivity .5",
                      {{"0 0 0", Rgb(.25f)},
                       {".5 .25 1", mirror(Rgb(.25f, .125f, .5f))},
                       {"1 1 1", mirror(Rgb(.5f))}}));
  all.push_back(gives(
      name + "reflectivity", before_sky(false), "specularColor .5 .25 1",
      {{"0", Rgb(.25f)}, {".5", mirror(Rgb(.25f, .125f, .5f))}, {"1", mirror(Rgb(.5f, .25f, 1))}}));
  const std::string plain = "specularColor 0 0 0";
  const Case in_shadow = gives(name + "shadowMask", before_sky(true), plain,
                               {{"0", Rgb(.25f)}, {".25", Rgb(.1875f)}, {"1", Rgb(0)}});
  const Case lit = gives(name + "shadowMask", before_sky(false), plain,
                         {{"0", Rgb(.25f)}, {".25", Rgb(.25f)}, {"1", Rgb(.25f)}});
  all.push_back(both(in_shadow, lit));
}

/// A white floor under a sun of 1, in the shadow of a plate whose shadow shader is called.
Measured shaded(const std::string& call) {
  SceneText scene;
  scene
      .statement(kMayaSources + "material \"m\" \"maya_lambert\" ( ) shadow " + call +
                 " end material")
      .lambert("white", 1)
      .square("white", Vec3(0), 5, Vec3(0, 0, 1))
      .square("m", Vec3(0, 0, 1), 1, Vec3(0, 0, 1))
      .light("sun", "\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" on ) direction 0 0 -1");
  return Probe(scene.str()).direct_only().onto(Vec3(0), Vec3(0, 0, 1), 0, 64);
}

}  // namespace
}  // namespace maya_layers

Cases maya_layers_cases() {
  using namespace maya_layers;
  Cases all;
  all.push_back(gives(
      "maya_shadingengine.surfaceShader", plate(false), "",
      {{"1 2 4", Rgb(1, 2, 4)}, {"= \"tint\"", kMayaTint}, {"= \"surface.outColor\"", kShown}}));
  add_layered(all);
  add_background(all);
  all.push_back(
      gives("maya_shadow.transparency", shaded, "",
            {{"0 0 0", Rgb(0)}, {".5 .25 1", Rgb(.5f, .25f, 1)}, {"= \"tint\"", kMayaTint}}));
  return all;
}

}  // namespace oriel::effects
