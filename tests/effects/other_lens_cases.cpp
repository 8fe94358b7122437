// SPDX-License-Identifier: Apache-2.0
// Lenses that bend rays: shaders/oriel/oriel_lens.cpp, physical_lens_dof of
// shaders/architectural/mia_lens_bokeh.cpp.
#include "cases.h"
#include "other_stages.h"
#include "render/eye_rays.h"

namespace oriel::effects {
namespace other_lenses {
namespace {

using namespace other_stages;

/// What the camera sees at a place of its picture (0 to 1 from the lower left corner), with the
/// error of the mean of batches.
Measured seen_by_camera(const SceneText& scene, Vec2 place, int samples) {
  const Probe probe(scene.str());
  const World& world = probe.world();
  const Vec2 raster(place.x * static_cast<float>(world.camera.width),
                    place.y * static_cast<float>(world.camera.height));
  constexpr int kBatches = 16;
  Measured m;
  std::vector<Rgb> means(kBatches, Rgb(0));
  for (int b = 0; b < kBatches; ++b) {
    for (int s = 0; s < samples / kBatches; ++s) {
      sampling::Sampler sampler(b, 7, static_cast<std::uint32_t>(s));
      means[b] += trace_eye_rays(world, raster, sampler, m.counts).radiance *
                  (static_cast<float>(kBatches) / static_cast<float>(samples));
    }
    m.mean += means[b] / kBatches;
  }
  for (const Rgb& v : means) m.error += (v - m.mean) * (v - m.mean);
  for (int k = 0; k < 3; ++k) m.error[k] = std::sqrt(m.error[k] / (kBatches - 1.0f) / kBatches);
  return m;
}

/// Where the ray of that place goes, as "test_direction" shows it; black where there is none.
/// `picture`: aspect and resolution.
Stage direction(Vec2 place, const std::string& picture, const std::string& transform = {}) {
  return [=](const std::string& call) {
    SceneText scene;
    scene.environment("\"test_direction\" ( )")
        .camera("focal 1 aperture 1 " + picture + " lens " + call, transform);
    return seen_by_camera(scene, place, 16);
  };
}

const std::string kWide = "aspect 2 resolution 72 36", kSquare = "aspect 1 resolution 40 40";

float radians(float degrees) { return degrees * kPi / 180; }
Rgb along(const Vec3& v) { return Rgb(normalize(v) * .5f + Vec3(.5f)); }
/// To the right of the view, then up, in degrees.
Rgb toward(float longitude, float latitude = 0) {
  const float a = radians(longitude), b = radians(latitude);
  return along(Vec3(std::sin(a) * std::cos(b), std::sin(b), -std::cos(a) * std::cos(b)));
}

void add_panorama(Cases& all) {
  const std::string name = "oriel_lens_panorama.";
  const Vec2 right(.75f, .5f), above(.5f, .75f);
  // Half of the way to the rim. Places of a cylinder's wall are as high as tangents.
  all.push_back(both(gives(name + "projection", direction(above, kWide), "vertical 90",
                           {{"0", toward(0, 22.5f)}, {"1", along(Vec3(0, .5f, -1))}}),
                     gives(name + "projection", direction(Vec2(.75f, .75f), kWide), "vertical 90",
                           {{"0", toward(90, 22.5f)}, {"1", along(Vec3(1, .5f, 0))}})));
  for (const char* projection : {"projection 0", "projection 1"}) {
    const Case each = gives(name + "horizontal", direction(right, kWide), projection,
                            {{"360", toward(90)}, {"180", toward(45)}, {"90", toward(22.5f)}});
    if (projection[11] == '0')
      all.push_back(each);
    else
      all.back() = both(all.back(), each);
  }
  // 0 makes the middle square: 360 degrees over twice as many pixels as are high.
  all.push_back(
      both(gives(name + "vertical", direction(above, kWide), "",
                 {{"180", toward(0, 45)}, {"90", toward(0, 22.5f)}, {"0", toward(0, 45)}}),
           gives(name + "vertical", direction(above, kWide), "horizontal 180",
                 {{"90", toward(0, 22.5f)}, {"0", toward(0, 22.5f)}})));
}

void add_fisheye(Cases& all) {
  const std::string name = "oriel_lens_fisheye.";
  const Stage half = direction(Vec2(.75f, .5f), kSquare);
  const auto degrees = [](double angle) { return static_cast<float>(angle * 180 / kPi); };
  // Angles to the axis half way to the rim, by the laws of their names.
  all.push_back(gives(name + "mapping", half, "angle 160",
                      {{"0", toward(40)},
                       {"1", toward(degrees(2 * std::asin(.5 * std::sin(radians(40)))))},
                       {"2", toward(degrees(2 * std::atan(.5 * std::tan(radians(40)))))},
                       {"3", toward(degrees(std::asin(.5 * std::sin(radians(80)))))}}));
  all.push_back(gives(name + "angle", half, "",
                      {{"180", toward(45)}, {"90", toward(22.5f)}, {"360", toward(90)}}));
  const float diagonal = std::sqrt(.5f);
  all.push_back(both(
      gives(name + "full_frame", half, "", {{"off", toward(45)}, {"on", toward(45 * diagonal)}}),
      gives(
          name + "full_frame", direction(Vec2(.95f, .95f), kSquare), "",
          {{"off", Rgb(0)}, {"on", along(Vec3(diagonal, diagonal, -1 / std::tan(radians(81))))}})));
}

void add_cube(Cases& all) {
  // A tenth, 3.3 and 1.65 faces from the left; .6 of a face, .1 and .2 from the top.
  all.push_back(gives("oriel_lens_cube.layout", direction(Vec2(.55f, .9f), kSquare), "",
                      {{"0", along(Vec3(-1, -.2f, -.1f))},
                       {"1", along(Vec3(-.4f, 1, .8f))},
                       {"2", along(Vec3(1, .6f, .3f))}}));
}

void add_shift(Cases& all) {
  const std::string name = "oriel_lens_shift.";
  // The film is as wide as it is far.
  const Stage middle = direction(Vec2(.5f), kSquare);
  all.push_back(gives(
      name + "horizontal", middle, "",
      {{"0", toward(0)}, {".25", along(Vec3(.25f, 0, -1))}, {"-.5", along(Vec3(-.5f, 0, -1))}}));
  all.push_back(gives(
      name + "vertical", middle, "",
      {{"0", toward(0)}, {".25", along(Vec3(0, .25f, -1))}, {"-.5", along(Vec3(0, -.5f, -1))}}));
  // Tilted up by the angle with tangent .75: vertical lines are in image columns.
  const std::string tilted = "1 0 0 0  0 .8 -.6 0  0 .6 .8 0  0 0 0 1";
  const Vec3 ahead(0, .6f, -.8f), above(0, .8f, .6f), right(1, 0, 0), up(0, 1, 0);
  const Stage corner = direction(Vec2(.8f), kSquare, tilted);
  all.push_back(gives(
      name + "keep_verticals", corner, "",
      {{"off", along(ahead + (right + above) * .3f)}, {"on", along(Vec3(.3f, .75f + .3f, -1))}}));
  // The same tilt of vertical lines, for a level camera.
  all.push_back(gives(name + "up", direction(Vec2(.8f), kSquare), "keep_verticals on",
                      {{"0 1 0", along(Vec3(.3f, .3f, -1))},
                       {"0 .8 -.6", along(right * .3f + Vec3(0, -.6f, -.8f) +
                                          Vec3(0, .8f, -.6f) * (.75f + .3f))}}));
}

/// Share of a disc of that radius on the bright side of an edge at `inside` from its middle.
Rgb share_of_disc(float inside, float radius) {
  if (radius <= inside) return Rgb(1);
  const float t = inside / radius;
  return Rgb((std::acos(-t) + t * std::sqrt(1 - t * t)) / kPi);
}

void add_depth_of_field(Cases& all) {
  // The image position is .1 inside the edge of the emitter, 4 units away.
  const Stage edge = [](const std::string& call) {
    SceneText scene;
    scene.emitter("glow", 1).square("glow", Vec3(10, 0, -4), 10, Vec3(0, 0, 1));
    scene.camera("focal 1 aperture 1 aspect 1 resolution 40 40 lens " + call);
    return seen_by_camera(scene, Vec2(.525f, .5f), 4096);
  };
  // Blurred by discs of radius x |1 - 4 / plane|.
  all.push_back(gives("physical_lens_dof.radius", edge, "plane 2",
                      {{"0", Rgb(1)},
                       {".09", Rgb(1)},
                       {".2", share_of_disc(.1f, .2f)},
                       {".4", share_of_disc(.1f, .4f)}}));
  all.push_back(gives("physical_lens_dof.plane", edge, "radius .2",
                      {{"1", share_of_disc(.1f, .6f)},
                       {"2", share_of_disc(.1f, .2f)},
                       {"-2", share_of_disc(.1f, .2f)},
                       {"4", Rgb(1)},
                       {"12", share_of_disc(.1f, .2f * 2 / 3)}}));
}

Cases cases() {
  Cases all;
  add_panorama(all);
  add_fisheye(all);
  add_cube(all);
  add_shift(all);
  add_depth_of_field(all);
  return all;
}

}  // namespace
}  // namespace other_lenses

Cases other_lens_cases() { return other_lenses::cases(); }

}  // namespace oriel::effects
