// SPDX-License-Identifier: Apache-2.0
// Rays blended over a material: shaders/base/mib_ray.cpp.
#include <fmt/format.h>

#include "base_stages.h"
#include "cases.h"

namespace oriel::effects {
namespace base_ray {

const Vec3 kFront(0, 0, 1);
/// Radiance of the sky above the plate, and below it.
const Rgb kAbove(1, .8f, .6f), kBelow(.2f, .4f, .1f);

SceneText plate_of(const std::string& call) {
  SceneText scene;
  scene.statement("material \"m\" " + call + " end material").square("m", Vec3(0), 5, kFront);
  return scene.environment(fmt::format("\"test_sky\" ( \"above\" {}, \"below\" {} )",
                                       text_of(Vec3(kAbove)), text_of(Vec3(kBelow))));
}

/// A horizontal plate in that sky, seen at 30 degrees from its normal, from the front or the back.
Stage plate(bool back = false) {
  return [=](const std::string& call) {
    return Probe(plate_of(call).str(), known_shaders())
        .onto(Vec3(0), back ? -kFront : kFront, 30, 2048);
  };
}

const Rgb kInput(.5f, .3f, .9f);
const std::string kInputText = "input .5 .3 .9 1";

/// The input and what the ray sees, blended by k.
Rgb blend(const Rgb& k, const Rgb& seen, const Rgb& input = kInput) {
  return input * (Rgb(1) - k) + seen * k;
}

/// The parameters `input` and `share` of a shader whose ray sees `seen`. `rest`: the ray's share is
/// one minus the parameter.
void add_blend(Cases& all, const std::string& shader, const std::string& share, const Rgb& seen,
               bool rest = false) {
  const auto level = [&](const Rgb& k) { return rest ? Rgb(1) - k : k; };
  const Rgb some = level(Rgb(.25f, .5f, 1)), other(.1f, .8f, .4f);
  all.push_back(gives(shader + ".input", plate(), share + " .25 .5 1 1",
                      {{"0 0 0 0", blend(some, seen, Rgb(0))},
                       {".5 .3 .9 1", blend(some, seen)},
                       {".1 .8 .4 0", blend(some, seen, other)}}));
  all.push_back(gives(fmt::format("{}.{}", shader, share), plate(), kInputText,
                      {{"0 0 0 0", rest ? seen : kInput},
                       {".25 .5 1 1", blend(some, seen)},
                       {".5 .5 .5 1", blend(Rgb(.5f), seen)},
                       {"1 1 1 1", rest ? kInput : seen}}));
}

/// Index of the side entered over that of the side left; 0 is 1.
void add_ior(Cases& all, const std::string& shader, const std::string& others) {
  all.push_back(gives(shader + ".ior", refracted_place(), others,
                      {{"0", snell(1)},
                       {"1", snell(1)},
                       {"1.5", snell(1.5f)},
                       {"2.5", snell(2.5f)},
                       {".9", snell(.9f)}}));
}

void add_reflect(Cases& all) {
  add_blend(all, "mib_reflect", "reflect", kAbove);
  const Stage below_lamp = [](const std::string& call) {
    SceneText scene = plate_of(call);
    scene.emitter("lamp", 7).square("lamp", Vec3(0, 0, 3), 4, -kFront);
    return Probe(scene.str(), known_shaders()).onto(Vec3(0), kFront, 0, 64);
  };
  all.push_back(gives("mib_reflect.notrace", below_lamp, "reflect 1 1 1 1",
                      {{"off", Rgb(7)}, {"on", kAbove}}));
}

void add_refract(Cases& all) {
  add_blend(all, "mib_refract", "refract", kBelow);
  add_ior(all, "mib_refract", "refract 1 1 1 1");
  // On total reflection the ray is mirrored.
  all.back() = both(all.back(), gives("mib_refract.ior", plate(), "refract 1 1 1 1",
                                      {{"1", kBelow}, {".4", kAbove}}));
}

void add_dielectric(Cases& all) {
  const std::string shader = "mib_dielectric.";
  all.push_back(gives(shader + "input", plate(), "refract .25",
                      {{"0 0 0 0", kBelow * .25f}, {".5 .3 .9 1", blend(Rgb(.25f), kBelow)}}));
  all.push_back(gives(shader + "refract", plate(), kInputText,
                      {{"0", kInput}, {".25", blend(Rgb(.25f), kBelow)}, {"1", kBelow}}));
  add_ior(all, "mib_dielectric", "refract 1");
  // Absorption in a slab of 2 units.
  const Stage slab = [](const std::string& call) {
    SceneText scene;
    scene
        .statement("shader \"i\" \"mib_refraction_index\" ( \"mtl_ior\" 1.5 )\nmaterial \"m\" " +
                   call + " end material")
        .box("m", Vec3(-9, -9, -2), Vec3(9, 9, 0))
        .uniform_sky(1);
    return Probe(scene.str(), known_shaders()).onto(Vec3(0), kFront, 0, 64);
  };
  all.push_back(
      gives(shader + "absorb", slab, "refract 1, ior = \"i.ior\"",
            {{"0 0 0 0", Rgb(1)}, {".5 1 0 0", Rgb(std::exp(-1.0f), std::exp(-2.0f), 1)}}));
}

void add_twosided(Cases& all) {
  const std::vector<Given> colors = {{".5 .3 .9 1", kInput}, {"1 0 2 1", Rgb(1, 0, 2)}};
  const std::vector<Given> same = {{".5 .3 .9 1", Rgb(.25f)}, {"1 0 2 1", Rgb(.25f)}};
  const std::string front = "mib_twosided.front", back = "mib_twosided.back";
  const std::string grey = " .25 .25 .25 1";
  all.push_back(both(gives(front, plate(), "back" + grey, colors),
                     gives(front, plate(true), "back" + grey, same)));
  all.push_back(both(gives(back, plate(true), "front" + grey, colors),
                     gives(back, plate(), "front" + grey, same)));
}

/// A member of the result, seen from the front or the back.
Stage index(const std::string& result, bool back) {
  return [=](const std::string& call) {
    SceneText scene;
    scene.statement(shown_as_light(call, {}, result)).square("m", Vec3(0), 5, kFront);
    return Probe(scene.str(), known_shaders()).onto(Vec3(0), back ? -kFront : kFront, 30, 64);
  };
}

void add_index(Cases& all) {
  const std::string name = "mib_refraction_index.mtl_ior";
  all.push_back(
      both(gives(name, index("ior", false), "", {{"0", Rgb(1)}, {"1.5", Rgb(1.5f)}, {"2", Rgb(2)}}),
           gives(name, index("ior", true), "",
                 {{"0", Rgb(1)}, {"1.5", Rgb(1 / 1.5f)}, {"2", Rgb(.5f)}})));
  all.back() = both(all.back(),
                    both(gives(name, index("enter", false), "", {{"1.5", Rgb(1)}, {"2", Rgb(1)}}),
                         gives(name, index("enter", true), "", {{"1.5", Rgb(0)}, {"2", Rgb(0)}})));
}

Cases cases() {
  Cases all;
  add_reflect(all);
  add_refract(all);
  add_blend(all, "mib_transparency", "transp", kBelow);
  add_blend(all, "mib_continue", "transp", kBelow);
  add_blend(all, "mib_opacity", "opacity", kBelow, true);
  add_dielectric(all);
  add_twosided(all);
  add_index(all);
  return all;
}

}  // namespace base_ray

Cases base_ray_cases() { return base_ray::cases(); }

}  // namespace oriel::effects
