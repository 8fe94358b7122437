// SPDX-License-Identifier: Apache-2.0
// The physical and the CIE skies: shaders/architectural/mia_physicalsky.cpp and mia_ciesky.cpp.
// Figures of the physical sky are those of Preetham, Shirley and Smits 1999 at turbidity 2 + haze;
// an environment shows pi times the luminance times the unit conversion.
#include <fmt/format.h>

#include <array>

#include "base/math.h"
#include "cases.h"
#include "color/luminance.h"
#include "mia_stages.h"

namespace oriel::effects {
namespace mia_sky {

/// The sun at 45 degrees, in lux.
std::string sky_at(float elevation = 45, float azimuth = 0) {
  return "rgb_unit_conversion 1 1 1, sun_direction " + text_of(toward(elevation, azimuth));
}
/// Numbers and a colour to connect.
SceneText with_values() {
  SceneText scene;
  return scene.statement("shader \"one\" \"test_show\" ( \"scalar\" 1 )")
      .statement("shader \"stars\" \"test_show\" ( \"color\" .1 .2 .3 )");
}
/// 80 degrees from the zenith, below the sun: cd/m2 at the azimuth of the sun, at 90 degrees and
/// opposite.
const Vec3 kLow = toward(10);
constexpr float kUnderSun = 25919.56f, kBeside = 12639.49f, kOpposite = 11859.77f;
constexpr float kZenith = 4469.6f;

/// Lux of the sun on a surface that faces it, and of 25 directions of the sky (as the historic
/// ground has it) with the sun on a level one, at 45 degrees in clear air.
const Rgb kSun(97918, 92459, 75174);
constexpr float kLevel = 22769 + 65317;

Stage gradient(const Vec3& direction, SceneText scene = SceneText()) {
  return luminance_of(seen_by(RayKind::FinalGather, direction, std::move(scene)));
}
Rgb shown(float luminance) { return Rgb(kPi * luminance); }

/// Suns of that name at 45 degrees and several azimuths.
SceneText with_suns() {
  SceneText scene;
  for (const int azimuth : {0, 90, 180})
    scene.light(fmt::format("sun{}", azimuth),
                "\"mib_light_infinite\" ( \"color\" 0 0 0 ) direction " +
                    text_of(-toward(45, float(azimuth))));
  return scene;
}

/// Cases of what both skies have alike; `stage` shows `seen` with the sun at azimuth 0, 90, 180.
void add_sun(Cases& all, const std::string& name, const std::vector<Rgb>& seen) {
  const Stage stage = gradient(kLow, with_suns());
  const std::string lux = "rgb_unit_conversion 1 1 1";
  std::vector<Given> directions, lights;
  for (const int i : {0, 1, 2}) {
    const auto azimuth = float(i) * 90;
    directions.push_back({text_of(toward(45, azimuth)), seen[std::size_t(i)]});
    lights.push_back({fmt::format("\"sun{}_i\"", azimuth), seen[std::size_t(i)]});
  }
  all.push_back(gives_about(name + "sun_direction", stage, lux, directions));
  // The light's instance counts, the direction is ignored.
  all.push_back(gives_about(name + "sun", stage, sky_at(45, 45), lights));
}

/// The same sky with another axis upward, and which way is down.
void add_up(Cases& all, const std::string& name, const Rgb& seen, const Rgb& ground) {
  all.push_back(shows(name + "y_is_up", [=] {
    const auto at = [&](const Vec3& direction, const Vec3& sun, const char* up) {
      return measured_with(name + "y_is_up", gradient(direction),
                           "rgb_unit_conversion 1 1 1, sun_direction " + text_of(sun), up)
          .mean;
    };
    const auto swapped = [](const Vec3& d) { return Vec3(d.x, d.z, d.y); };
    const Vec3 sun = toward(45);
    expect_about(at(kLow, sun, "off"), seen);
    expect_about(at(swapped(kLow), swapped(sun), "on"), seen);
    expect_about(at(-kUp, sun, "off"), ground);
    expect_about(at(-swapped(kUp), swapped(sun), "on"), ground);
  }));
}

void add_units(Cases& all, const std::string& name) {
  // 0 0 0 means 80000 lux.
  all.push_back(makes(name + "rgb_unit_conversion", seen_by(RayKind::FinalGather, kLow), sky_at(),
                      "1 1 1",
                      {{".318 .318 .318", [](const Rgb& c) { return c * .318f; }},
                       {"2 1 .5", [](const Rgb& c) { return c * Rgb(2, 1, .5f); }},
                       {"0 0 0", [](const Rgb& c) { return c / 80000.0f; }}}));
}

void add_strength(Cases& all) {
  const std::string name = "mia_physicalsky.";
  const Stage low = gradient(kLow);
  all.push_back(
      gives_about(name + "on", low, sky_at(), {{"on", shown(kUnderSun)}, {"off", Rgb(0)}}));
  all.push_back(
      gives_about(name + "multiplier", low, sky_at(),
                  {{"0", Rgb(0)}, {"1", shown(kUnderSun)}, {"2.5", shown(2.5f * kUnderSun)}}));
  add_units(all, name);
  all.push_back(both(gives_about(name + "haze", gradient(kUp), sky_at(),
                                 {{"0", shown(kZenith)},
                                  {"1", shown(7320.4f)},
                                  {"8", shown(22869)},
                                  {"15", shown(31614)}}),
                     gives_about(name + "haze", gradient(kLow, with_values()), sky_at(),
                                 {{"0", shown(kUnderSun)}, {"= \"one\"", shown(17239.70f)}})));
  all.push_back(makes(name + "redblueshift", seen_by(RayKind::FinalGather, kLow), sky_at(), "0",
                      {{".3", [](const Rgb& c) { return c * Rgb(1.3f, 1, .7f); }},
                       {"-.3", [](const Rgb& c) { return c * Rgb(.7f, 1, 1.3f); }}}));
  const auto saturated = [](float by) {
    return [by](const Rgb& c) { return Rgb(luminance(c)) * (1 - by) + c * by; };
  };
  all.push_back(makes(name + "saturation", seen_by(RayKind::FinalGather, kLow), sky_at(), "1",
                      {{"0", saturated(0)}, {".5", saturated(.5f)}, {"1.5", saturated(1.5f)}}));
}

void add_ground(Cases& all) {
  const std::string name = "mia_physicalsky.";
  // Black ground begins where z is a tenth of the height, from straight down to the zenith.
  all.push_back(shows(name + "horizon_height", [=] {
    const auto at = [&](float height, float z) {
      const Vec3 d(std::sqrt(1 - sqr(z)), 0, z);
      return measured_with(name + "horizon_height", gradient(d),
                           sky_at() + ", horizon_blur 0, ground_color 0 0 0",
                           fmt::format("{}", height))
          .mean.x;
    };
    for (const float height : {-5.0f, -2.0f, 0.0f, 2.0f, 5.0f}) {
      EXPECT_GT(at(height, height / 10 + .001f), 0) << height;
      EXPECT_EQ(at(height, height / 10 - .001f), 0) << height;
    }
    EXPECT_GT(at(-10, -.999f), 0);
    EXPECT_EQ(at(10, .999f), 0);
  }));
  // Half of the way through its width of a tenth it is half sky, half (black) ground.
  all.push_back(shows(name + "horizon_blur", [=] {
    const auto at = [&](const char* blur, float z) {
      return measured_with(name + "horizon_blur", gradient(Vec3(std::sqrt(1 - sqr(z)), 0, z)),
                           sky_at() + ", ground_color 0 0 0", blur)
          .mean;
    };
    const Rgb horizon = at("0", 1e-5f);
    ASSERT_GT(horizon.x, 0);
    EXPECT_EQ(at("0", -1e-5f), Rgb(0));
    expect_about(at(".2", -.01f), horizon * .5f, 1e-3f);
    EXPECT_EQ(at(".2", -.021f), Rgb(0));
    expect_about(at("10", -.5f), horizon * .5f, 1e-3f);
    EXPECT_GT(at("10", -.9f).x, 0);
  }));
  all.push_back(gives_about(
      name + "ground_color", gradient(-kUp), sky_at(),
      {{"0 0 0", Rgb(0)}, {".2 .2 .2", Rgb(.2f * kLevel)}, {".5 .5 .5", Rgb(.5f * kLevel)}}));
  all.back() = both(all.back(),
                    makes(name + "ground_color", seen_by(RayKind::FinalGather, -kUp), sky_at(),
                          "1 1 1", {{"1 .5 0", [](const Rgb& c) { return c * Rgb(1, .5f, 0); }}}));
  // After the end of twilight there is nothing else; by day the sky is brighter.
  all.push_back(both(
      gives(name + "night_color", seen_by(RayKind::FinalGather, kUp, with_values()), sky_at(-19),
            {{"0 0 0", Rgb(0)},
             {".1 .2 .3", Rgb(.1f, .2f, .3f)},
             {"= \"stars\"", Rgb(.1f, .2f, .3f)}}),
      gives_about(name + "night_color", gradient(kUp), sky_at(),
                  {{"0 0 0", shown(kZenith)},
                   {"100 100 100", shown(kZenith)},
                   {"90000 90000 90000", Rgb(90000)}})));
}

/// What the eye sees beyond gather rays, so many radii of a sun of scale 4 beside the sun.
Rgb beside_sun(const World& world, float radii) {
  const float angle = radii * 4 * .00465f;
  const Vec3 d = toward(45) * math::cos(angle) + Vec3(0, 1, 0) * math::sin(angle);
  const auto seen = [&](RayKind kind) {
    return rgb(environment_radiance(world.environment, world, Vec3(0), d, kind));
  };
  return seen(RayKind::Eye) - seen(RayKind::FinalGather);
}
Probe under(const std::string& sky) {
  SceneText scene;
  return Probe(scene.environment(sky).str(), known_shaders(), kCoarse);
}
Stage disc_and_glow(float radii) {
  return [=](const std::string& call) {
    const Probe probe = under(call);
    return exactly(beside_sun(probe.world(), radii));
  };
}

/// All that light, per lux of the sun's.
float energy_of_disc(const std::string& call) {
  const Probe probe = under(call);
  constexpr int kSteps = 1000;
  double sum = 0;  // double: many terms
  // The halo of a sun of scale 4 ends at ten radii.
  for (int i = 0; i < kSteps; ++i) {
    const float radii = 10 * (float(i) + .5f) / kSteps;
    sum += double(beside_sun(probe.world(), radii).y * radii);
  }
  return float(sum * double(kTwoPi * sqr(4 * .00465f) * 10 / kSteps)) / kSun.y;
}

void add_disc(Cases& all) {
  const std::string name = "mia_physicalsky.";
  // NVIDIA's MDL-SDK base.mdl: 2 glow (f / 10)^3 + 100 disc smoothstep(8.5, 9.54, f) times the
  // sun's illuminance, with f = 10 - radii.
  all.push_back(gives_about(name + "sun_disk_intensity", disc_and_glow(0), sky_at(),
                            {{"0", kSun * 2}, {"1", kSun * 102}, {"3", kSun * 302}}));
  all.push_back(gives_about(name + "sun_glow_intensity", disc_and_glow(5), sky_at(),
                            {{"0", Rgb(0)}, {"1", kSun * .25f}, {"4", kSun}}));
  all.push_back(gives_about(name + "sun_disk_scale", disc_and_glow(2), sky_at(),
                            {{"2", kSun * .432f}, {"4", kSun * 1.024f}, {"8", kSun * 48.575f}}));
  // Energy of the physical sun; the historic disc has a fixed energy for any sun.
  all.push_back(shows(name + "physically_scaled_sun", [=] {
    const auto energy = [&](const std::string& more) {
      return energy_of_disc(call_of("mia_physicalsky", sky_at() + ", " + more));
    };
    const std::string on = "physically_scaled_sun on";
    EXPECT_NEAR(energy(on), kPi, .1f * kPi);
    EXPECT_NEAR(energy(on + ", sun_disk_intensity 3"), 3 * kPi, .1f * 3 * kPi);
    // 100 over a disc of radius .01860, and the glow's 24 pi g^2 / 120 at g ten times as wide.
    const float disc = 100 * kPi * sqr(.0186f), glow = 24 * kPi * sqr(.186f) / 120;
    EXPECT_NEAR(energy("physically_scaled_sun off"), disc + glow, .1f * (disc + glow));
  }));
}

void add_background(Cases& all) {
  const std::string name = "mia_physicalsky.";
  SceneText plates;
  plates.statement("shader \"red\" \"test_show\" ( \"color\" 1 0 0 )")
      .statement("shader \"blue\" \"test_show\" ( \"color\" 0 0 1 )");
  const Stage eye = seen_by(RayKind::Eye, kUp, plates);
  all.push_back(shows(name + "use_background", [=] {
    for (const RayKind kind : {RayKind::Eye, RayKind::Reflect, RayKind::Refract}) {
      const auto with = [&](const std::string& others) {
        return measured_with(name + "use_background", luminance_of(seen_by(kind, kUp, plates)),
                             sky_at() + ", background " + others, "on")
            .mean;
      };
      const Rgb sky = shown(kZenith);
      expect_about(with("\"red\", on off"), kind == RayKind::Eye ? Rgb(.2126f) : Rgb(0));
      expect_about(with("\"red\""), kind == RayKind::Eye ? Rgb(.2126f) : sky);
      expect_about(with("\"\""), kind == RayKind::Eye ? Rgb(0) : sky);
    }
    expect_about(measured_with(name + "use_background", luminance_of(eye), sky_at(), "off").mean,
                 shown(kZenith));
    // Transparent black without a shader.
    const auto alpha = [&](const char* on) {
      return measured_with(name + "use_background", environment(kUp), sky_at(), on).alpha;
    };
    EXPECT_EQ(alpha("off"), 1);
    EXPECT_EQ(alpha("on"), 0);
  }));
  all.push_back(gives(name + "background", eye, sky_at() + ", use_background on",
                      {{"\"red\"", Rgb(1, 0, 0)}, {"\"blue\"", Rgb(0, 0, 1)}}));
}

/// A black wall 10 units away along x through the shader in the camera's volume or lens, as a
/// share of the sky on the horizon there.
Stage wall_through(const std::string& role) {
  return [=](const std::string& call) {
    SceneText scene;
    scene.camera("focal 1 aperture 1 aspect 1 resolution 32 32 " + role + " " + call)
        .lambert("black", 0)
        .square("black", Vec3(10, 0, 0), 5, Vec3(-1, 0, 0));
    const Rgb wall = Probe(scene.str(), known_shaders()).ray(Vec3(0), Vec3(1, 0, 0), 64).mean;
    return exactly(wall / seen_by(RayKind::FinalGather, Vec3(1, 0, 1e-5f))(call).mean);
  };
}

void add_flags(Cases& all) {
  const std::string name = "mia_physicalsky.flags";
  // 1: the ground is lit by this sun and all of this sky: with haze 15, 94227 and 8181 lux.
  all.push_back(gives_about(name, gradient(-kUp), sky_at() + ", ground_color 1 1 1, haze 15",
                            {{"0", Rgb(kLevel)}, {"1", Rgb(94227 + 8181)}}, .02f));
  // 2: the chromaticity x of the paper.
  all.back() =
      both(all.back(), shows(name, [=] {
             const auto x = [&](const char* flags) {
               const Rgb c =
                   measured_with(name, seen_by(RayKind::FinalGather, kLow), sky_at(), flags).mean;
               // Linear sRGB to XYZ, IEC 61966-2-1.
               const Vec3 xyz(.4124f * c.x + .3576f * c.y + .1805f * c.z,
                              .2126f * c.x + .7152f * c.y + .0722f * c.z,
                              .0193f * c.x + .1192f * c.y + .9505f * c.z);
               return xyz.x / (xyz.x + xyz.y + xyz.z);
             };
             EXPECT_NEAR(x("0"), .27915f, 1e-3f);
             EXPECT_NEAR(x("2"), .28701f, 1e-3f);
           }));
  // 4: more than 90 degrees from the sun it is as at 90.
  const auto indicatrix = [](float gamma) {
    return 1 + 5.279718f * math::exp(-2.335758f * gamma) + .236341f * sqr(math::cos(gamma));
  };
  const float ratio = indicatrix(kPi / 2) / indicatrix(125 * kPi / 180);
  all.back() =
      both(all.back(), gives_about(name, gradient(toward(10, 180)), sky_at(),
                                   {{"0", shown(kOpposite)}, {"4", shown(kOpposite * ratio)}}));
}

/// Perez, Seals and Michalsky 1993: luminance relative to the zenith's, cosines of the view's
/// zenith angle, its angle from the sun and the sun's zenith angle.
float perez(const std::array<float, 5>& k, float theta, float gamma, float sun) {
  const auto form = [&](float cos_theta, float cos_gamma) {
    return (1 + k[0] * math::exp(k[1] / cos_theta)) *
           (1 + k[2] * math::exp(k[3] * math::acos(cos_gamma)) + k[4] * sqr(cos_gamma));
  };
  return form(theta, gamma) / form(1, sun);
}

void add_given(Cases& all) {
  const std::string name = "mia_physicalsky.";
  const std::string mode = sky_at() + ", sky_luminance_mode 1";
  all.push_back(gives_about(name + "sky_luminance_mode", gradient(kUp),
                            sky_at() + ", zenith_luminance 1000",
                            {{"0", shown(kZenith)}, {"1", shown(1000)}}));
  all.push_back(gives_about(name + "zenith_luminance", gradient(kUp),
                            mode + ", diffuse_horizontal_illuminance 9000",
                            {{"500", shown(500)}, {"7000", shown(7000)}}));
  all.push_back(gives_about(name + "diffuse_horizontal_illuminance", luminance_of(level_card()),
                            mode, {{"9000", Rgb(9000)}, {"60000", Rgb(60000)}}));
  // The CIE clear sky's coefficients, one of them another.
  const std::array<float, 5> clear = {-1, -.32f, 10, -3, .45f}, other = {-.5f, -.6f, 4, -1.5f, .9f};
  const char* letters = "abcde";
  std::string list = mode + ", zenith_luminance 1000";
  for (std::size_t i = 0; i < 5; ++i) list += fmt::format(", {} {}", letters[i], clear[i]);
  const Vec3 view = toward(30, 60), sun = toward(45);
  for (std::size_t i = 0; i < 5; ++i) {
    std::vector<Given> values;
    for (const float v : {clear[i], other[i]}) {
      std::array<float, 5> k = clear;
      k[i] = v;
      values.push_back(
          {fmt::format("{}", v), shown(1000 * perez(k, view.z, dot(view, sun), sun.z))});
    }
    all.push_back(gives_about(name + letters[i], gradient(view), list, values));
  }
}

/// CIE clear and overcast skies, relative to their zenith.
float clear_sky(const Vec3& view, const Vec3& sun) {
  return perez({-1, -.32f, 10 / .91f, -3, .45f / .91f}, view.z, dot(view, sun), sun.z);
}
float overcast_sky(const Vec3& view) { return (1 + 2 * view.z) / 3; }

void add_cie(Cases& all) {
  const std::string name = "mia_ciesky.";
  const Vec3 sun = toward(45);
  const float sine = sun.z;
  // Of the zenith by the sun's height, as Radiance's gensky has it (turbidity 2.45).
  const float clear = 1000 * ((1.376f * 2.45f - 1.81f) + .38f),
              overcast = 1000 * (8.6f * sine + .123f);
  const Stage zenith = gradient(kUp);
  all.push_back(gives_about(name + "on", zenith, sky_at() + ", zenith_luminance 1000",
                            {{"on", shown(1000)}, {"off", Rgb(0)}}));
  add_units(all, name);
  all.push_back(gives_about(name + "auto_luminance", zenith, sky_at(),
                            {{"on", shown(clear)}, {"off", Rgb(0)}}));
  all.back() =
      both(all.back(), gives_about(name + "auto_luminance", zenith, sky_at() + ", overcast 1",
                                   {{"on", shown(overcast)}, {"off", Rgb(0)}}));
  for (const char* automatic : {"on", "off"}) {
    const std::string list = sky_at() + ", auto_luminance " + automatic;
    Case given = gives_about(name + "zenith_luminance", zenith,
                             list + ", diffuse_horizontal_illuminance 9000",
                             {{"500", shown(500)}, {"7000", shown(7000)}});
    // Of the clear sky at 45 degrees 4.8486 times the zenith's, of the overcast one 7 pi / 9.
    Case level = gives_about(name + "diffuse_horizontal_illuminance", luminance_of(level_card()),
                             list, {{"9000", Rgb(9000)}, {"60000", Rgb(60000)}});
    level = both(level,
                 gives_about(level.parameter, zenith, list,
                             {{"9000", shown(9000 / 4.8486f)}, {"60000", shown(60000 / 4.8486f)}}));
    level =
        both(level,
             gives_about(level.parameter, zenith, list + ", overcast 1",
                         {{"9000", shown(9000 / 2.443461f)}, {"60000", shown(60000 / 2.443461f)}}));
    if (automatic == std::string("on")) {
      all.push_back(given);
      all.push_back(level);
    } else {
      all[all.size() - 2] = both(all[all.size() - 2], given);
      all.back() = both(all.back(), level);
    }
  }
  const float here = clear_sky(kLow, sun), grey = overcast_sky(kLow);
  all.push_back(gives_about(name + "overcast", gradient(kLow, with_values()),
                            sky_at() + ", zenith_luminance 1000",
                            {{"0", shown(1000 * here)},
                             {".25", shown(250 * (3 * here + grey))},
                             {"= \"one\"", shown(1000 * grey)},
                             {"1", shown(1000 * grey)}}));
  std::vector<Rgb> seen;
  for (const float azimuth : {0.0f, 90.0f, 180.0f})
    seen.push_back(shown(clear * clear_sky(kLow, toward(45, azimuth))));
  add_sun(all, name, seen);
  add_up(all, name, seen[0], Rgb(0));
}

}  // namespace mia_sky

Cases mia_sky_cases() {
  using namespace mia_sky;
  Cases all;
  const std::string name = "mia_physicalsky.";
  add_strength(all);
  add_ground(all);
  add_sun(all, name, {shown(kUnderSun), shown(kBeside), shown(kOpposite)});
  add_up(all, name, shown(kUnderSun), Rgb(.2f * kLevel));
  add_disc(all);
  add_background(all);
  // A tenth of haze at the distance: the transmittance is .9 to the power of 10 over the distance.
  for (const char* role : {"volume", "lens"}) {
    const Case c = gives_about(
        name + "visibility_distance", wall_through(role), sky_at(),
        {{"0", Rgb(0)}, {"10", Rgb(.1f)}, {"5", Rgb(.19f)}, {"20", Rgb(1 - std::sqrt(.9f))}});
    if (role == std::string("volume"))
      all.push_back(c);
    else
      all.back() = both(all.back(), c);
  }
  add_flags(all);
  add_given(all);
  add_cie(all);
  return all;
}

}  // namespace oriel::effects
