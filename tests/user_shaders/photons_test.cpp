// SPDX-License-Identifier: Apache-2.0
// User shaders and indirect light: gathering, photons at surfaces and from lights.
#include <array>
#include <cmath>

#include "lights/photon_source.h"
#include "support/picture.h"
#include "transport/photon/photon_trace.h"
#include "user_picture.h"

namespace oriel {
namespace photons_test {

using testing::expect_near;
using testing::mean_of;
using testing::ShaderFolder;
using testing::UserScene;

const std::string kExamples = ORIEL_SOURCE_DIR "/examples/shaders/";

/// A floor with material "m" under a light, between white walls.
std::string room(const std::string& material, const std::string& lamp) {
  return lamp +
         " end light instance \"lamp_i\" \"lamp\" end instance "
         "material \"wall\" \"mia_material\" ( \"diffuse_weight\" 1, \"diffuse\" .8 .8 .8 1, "
         "\"reflectivity\" 0 ) end material material \"m\" " +
         material +
         " end material object \"walls\" visible shadow trace group -5 -5 0 -5 5 0 -5 5 6 -5 -5 6 "
         "5 -5 0 5 5 0 5 5 6 5 -5 6 v 0 v 1 v 2 v 3 v 4 v 5 v 6 v 7 c 0 1 2 3 c 4 7 6 5 end group "
         "end object instance \"walls_i\" \"walls\" material \"wall\" end instance " +
         UserScene::square("m");
}
const std::string kMembers = "\"lamp_i\" \"walls_i\" \"square_i\"";
const std::string kPoint =
    "light \"lamp\" \"mib_light_point\" ( \"color\" 4 4 4, \"shadow\" on ) origin 0 0 3 ";
const std::string kBuiltIn =
    "\"mia_material\" ( \"diffuse_weight\" 1, \"diffuse\" .8 .5 .2 1, \"reflectivity\" 0 )";

/// Mean of pictures with different seeds, and the standard error of it.
struct Measured {
  Rgb mean{0}, error{0};
};

Measured measure(UserScene& scene, scene::IndirectMethod method, int seeds) {
  scene.world->options.indirect = method;
  Rgb sum(0), squares(0);
  for (int seed = 0; seed < seeds; ++seed) {
    SessionSettings settings;
    settings.budget.samples = 16;
    settings.seed = static_cast<std::uint32_t>(seed);
    RenderSession session(*scene.world, settings);
    session.run();
    const Rgb mean = mean_of(session.film());
    sum += mean;
    squares += mean * mean;
  }
  Measured m;
  const auto n = static_cast<float>(seeds);
  m.mean = sum / n;
  for (int k = 0; k < 3; ++k)
    m.error[k] = std::sqrt(std::max(0.0f, squares[k] / n - sqr(m.mean[k])) / (n - 1));
  return m;
}

/// Within three standard errors, which a right renderer fails once in 370 tries.
void expect_same(const Measured& a, const Measured& b) {
  for (int k = 0; k < 3; ++k) {
    const float error = std::sqrt(sqr(a.error[k]) + sqr(b.error[k]));
    EXPECT_NEAR(a.mean[k], b.mean[k], 3 * error + 1e-5f) << "channel " << k << " error " << error;
    EXPECT_LT(error, .03f * a.mean[k]);
  }
}

TEST(UserPhotons, IrradianceOfGatherPointsShadesAsTheBuiltInMaterial) {
  const ShaderFolder folder;
  folder.compile("lamb",
                 "#include <shader.h>\n"
                 "struct lamb { miColor c; };"
                 "DLLEXPORT miBoolean lamb(miColor *r, miState *state, struct lamb *p) {"
                 "  miColor c = *mi_eval_color(&p->c), l, e; miVector d; float nl; int i, n;"
                 "  miTag *lights; miColor sum = {0, 0, 0, 0};"
                 "  n = mi_global_lights_info(&lights);"
                 "  for (i = 0; i < n; i++) { int s = 0;"
                 "    while (mi_sample_light(&l, &d, &nl, state, lights[i], &s)) {"
                 "      sum.r += l.r * nl; sum.g += l.g * nl; sum.b += l.b * nl; } }"
                 "  if (!mi_compute_irradiance(&e, state)) return miFALSE;"
                 "  r->r = c.r * (sum.r + e.r / M_PI); r->g = c.g * (sum.g + e.g / M_PI);"
                 "  r->b = c.b * (sum.b + e.b / M_PI); r->a = 1; return miTRUE; }");
  UserScene own(folder,
                "link \"lamb.so\" declare shader color \"lamb\" ( color \"c\" ) apply material end "
                "declare " +
                    room("\"lamb\" ( \"c\" .8 .5 .2 1 )", kPoint),
                kMembers, "finalgather on");
  UserScene built_in(folder, room(kBuiltIn, kPoint), kMembers, "finalgather on");
  const Measured by_user = measure(own, scene::IndirectMethod::FinalGather, 6);
  expect_same(by_user, measure(built_in, scene::IndirectMethod::FinalGather, 6));
  EXPECT_EQ(own.messages(), "");
}

TEST(UserPhotons, PhotonShadersScatterAsTheBuiltInMaterial) {
  const ShaderFolder folder;
  folder.compile_file("photon", kExamples + "photon/ex_lacquer_photon.c");
  const std::string declared =
      "link \"photon.so\" declare shader color \"ex_lacquer_photon\" ( color \"diffuse\" default "
      ".6 .05 .03, color \"mirror\" default .04 .04 .04 ) version 1 apply photon end declare ";
  const std::string lamp = kPoint + "globillum photons 8000 ";
  UserScene own(folder,
                declared + room(kBuiltIn + " photon \"ex_lacquer_photon\" ( \"diffuse\" .8 .5 .2, "
                                           "\"mirror\" 0 0 0 )",
                                lamp),
                kMembers);
  UserScene built_in(folder, room(kBuiltIn, lamp), kMembers);
  const Measured by_user = measure(own, scene::IndirectMethod::Photons, 12);
  expect_same(by_user, measure(built_in, scene::IndirectMethod::Photons, 12));
  EXPECT_EQ(own.messages(), "");
}

TEST(UserPhotons, MirrorsOfPhotonShadersMakeCausticsAsTheBuiltInMaterial) {
  const ShaderFolder folder;
  folder.compile_file("photon", kExamples + "photon/ex_lacquer_photon.c");
  const std::string declared =
      "link \"photon.so\" declare shader color \"ex_lacquer_photon\" ( color \"diffuse\", color "
      "\"mirror\" ) version 1 apply photon end declare ";
  const std::string mirror =
      "\"mia_material\" ( \"diffuse_weight\" 0, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1 )";
  UserScene own(folder,
                declared + room(mirror + " photon \"ex_lacquer_photon\" ( \"diffuse\" 0 0 0, "
                                         "\"mirror\" 1 1 1 )",
                                kPoint),
                kMembers, "caustic on");
  UserScene built_in(folder, room(mirror, kPoint), kMembers, "caustic on");
  const auto caustics = [](const UserScene& scene) {
    RayCounts counts;
    const PhotonMaps maps = trace_photons(
        *scene.world, {.globillum = false, .each = {.caustic = {.emit = 1 << 16}}}, counts);
    double power = 0;
    for (const Photon& p : maps.caustic.photons()) power += p.power.y;
    return power;
  };
  const double wanted = caustics(built_in);
  EXPECT_GT(wanted, 0);
  EXPECT_NEAR(caustics(own), wanted, .02 * wanted);
  EXPECT_EQ(own.messages(), "");
}

/// A light of energy 40 with an emitter that sends photons into a cone of 40 degrees.
std::string floodlight(const std::string& energy = "energy 40 40 40 ") {
  return "link \"photon_emitter.so\" declare shader color \"ex_floodlight_photons\" ( scalar "
         "\"angle\" default 30 ) version 1 apply emitter end declare "
         "light \"lamp\" \"mib_light_point\" ( \"color\" 4 4 4, \"shadow\" on ) emitter "
         "\"ex_floodlight_photons\" ( \"angle\" 40 ) origin 0 0 3 direction 0 0 -1 " +
         energy + "globillum photons 8000 ";
}

TEST(UserPhotons, EmittersSendTheEnergyOfTheLightTheirOwnWay) {
  const ShaderFolder folder;
  folder.compile_file("photon_emitter", kExamples + "photon_emitter/ex_floodlight_photons.c");
  UserScene scene(folder, room(kBuiltIn, floodlight()), kMembers);
  const Light& light = scene.world->lights.at(0);
  const PhotonSource source(*scene.world, light, light.photons.emission);
  constexpr int kCount = 4096;
  const float edge = std::cos(40 * kPi / 180);
  float cosines = 0, least = 1;
  for (int i = 0; i < kCount; ++i) {
    sampling::Sampler s(0, 0, static_cast<std::uint32_t>(i));
    const Vec2 u = s.next_2d();
    const EmittedPhoton photon = source.emit(u, s.next_2d());
    EXPECT_EQ(photon.origin, Vec3(0, 0, 3));
    // pi times the energy at any distance, like physical_light of that colour.
    expect_near(source.power(photon, 1.5f), Rgb(40 * kPi), 1e-3f);
    cosines += -photon.direction.z / kCount;
    least = std::min(least, -photon.direction.z);
  }
  // Even over the solid angle cosines are even between that of the edge and 1.
  EXPECT_NEAR(cosines, (1 + edge) / 2, 3 * (1 - edge) / std::sqrt(12.0f * kCount));
  EXPECT_NEAR(least, edge, 1e-3f);
  EXPECT_EQ(scene.messages(), "");
}

TEST(UserPhotons, AnEmitterWithoutAnEnergyIsGivenTheFluxOfTheLight) {
  const ShaderFolder folder;
  folder.compile_file("photon_emitter", kExamples + "photon_emitter/ex_floodlight_photons.c");
  UserScene scene(folder, room(kBuiltIn, floodlight("")), kMembers);
  const Light& light = scene.world->lights.at(0);
  const PhotonSource source(*scene.world, light, light.photons.emission);
  UserScene plain(folder, room(kBuiltIn, kPoint + "direction 0 0 -1"), kMembers);
  const Rgb flux = PhotonSource(*plain.world, plain.world->lights.at(0)).estimate_flux(256);
  const Rgb power = source.power(source.emit(Vec2(.3f), Vec2(.6f)), 2);
  EXPECT_GT(flux.x, 1);
  expect_near(power, flux, 1e-3f * flux.x);
}

TEST(UserPhotons, PhotonsOfAnEmitterLightThePictureAsThoseOfASpot) {
  const ShaderFolder folder;
  folder.compile_file("photon_emitter", kExamples + "photon_emitter/ex_floodlight_photons.c");
  UserScene own(folder, room(kBuiltIn, floodlight()), kMembers);
  // Direct light of both is that of the point light; only photons have the cone.
  const std::string edge = std::to_string(std::cos(40 * kPi / 180));
  UserScene spot(folder,
                 room(kBuiltIn,
                      "light \"lamp\" \"mib_light_point\" ( \"color\" 4 4 4, \"shadow\" on ) "
                      "origin 0 0 3 direction 0 0 -1 spread " +
                          edge + " energy 40 40 40 globillum photons 8000 "),
                 kMembers);
  for (UserScene* scene : {&own, &spot}) scene->world->lights.at(0).photons.only = true;
  const Measured by_user = measure(own, scene::IndirectMethod::Photons, 12);
  expect_same(by_user, measure(spot, scene::IndirectMethod::Photons, 12));
  EXPECT_GT(by_user.mean.x, .01f);
}

}  // namespace photons_test
}  // namespace oriel
