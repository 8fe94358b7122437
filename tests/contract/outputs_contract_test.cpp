// SPDX-License-Identifier: Apache-2.0
// Ten thousand random architectural materials, in and a bit beyond their ranges: numbers stay
// numbers, no light comes from nowhere, and outputs put every path together.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mi/reader.h"
#include "output/output_names.h"
#include "prepare/prepare.h"
#include "random_params.h"
#include "shaders/architectural/mia_material.h"
#include "shaders/registry.h"
#include "transport/lobes.h"
#include "transport/path/path.h"
#include "transport/path/resolve_outputs.h"

namespace oriel {
namespace outputs_contract_test {

using testing::ParamBlock;

constexpr int kMaterials = 10000;
/// How far beyond its bounds a parameter may be written, as a share of the range.
constexpr float kBeyond = 0.1f;

/// Random parameters, a fifth of the numbers of `beyond` sets outside their ranges.
ParamBlock random_params(std::mt19937& engine, bool beyond) {
  ParamBlock params(kMiaMaterialX);
  params.randomize(engine);
  std::uniform_real_distribution<float> unit(0, 1);
  // Half of the materials are opaque, solid and of one layer, as most are.
  if (unit(engine) < 0.5f) params.set("cutout_opacity", 1.0f);
  if (unit(engine) < 0.5f) params.set("transparency", 0.0f);
  if (unit(engine) < 0.5f) params.set("refl_base", 0.0f);
  if (unit(engine) < 0.5f) params.set("refl_gloss", 1.0f);
  params.set("anisotropy_channel", static_cast<int>(engine() % 5) - 3);
  params.set("ao_samples", static_cast<int>(engine() % 5));
  if (!beyond) return params;
  for (const ParamSpec& row : kMiaMaterialX.params) {
    if (unit(engine) > 0.2f) continue;
    if (row.type == ParamType::Color) {
      const auto value = [&] { return unit(engine) * (1 + 2 * kBeyond) - kBeyond; };
      const float r = value(), g = value(), b = value();
      params.set(row.name, Rgba(r, g, b, 1));
    } else if (row.type == ParamType::Scalar && std::isfinite(row.min) && std::isfinite(row.max)) {
      const float range = row.max - row.min;
      params.set(row.name, unit(engine) < 0.5f ? row.min - kBeyond * range * unit(engine)
                                               : row.max + kBeyond * range * unit(engine));
    } else if (row.type == ParamType::Scalar && std::isfinite(row.min)) {
      params.set(row.name, row.min - kBeyond * unit(engine));
    } else if (row.type == ParamType::Integer) {
      params.set(row.name, static_cast<int>(row.min) - 1);
    }
  }
  return params;
}

/// A point of the plane z = 0 seen at that cosine.
ShadingPoint seen_at(float cosine, float phi, bool back_side, const World& world) {
  ShadingPoint point;
  const float sine = std::sqrt(1 - cosine * cosine);
  point.ray_direction = -Vec3(sine * std::cos(phi), sine * std::sin(phi), cosine);
  point.back_side = back_side;
  point.dpdu = Vec3(1, 0.2f, 0);
  point.dpdv = Vec3(0, 1, 0);
  point.world = &world;
  return point;
}

bool is_number(const Rgb& c) { return is_finite(Vec3(c.x, c.y, c.z)); }

/// Mean weight of draws of one lobe alone of level 1: its own directional albedo.
double lobe_albedo(const Closure& closure, int index, const ShadingPoint& point, int draws,
                   int stream) {
  LobeChoice choice;
  choice.rays[index] = 1;
  choice.any = true;
  Closure alone;
  for (int i = 0; i < closure.count; ++i) {
    const Lobe& lobe = closure.lobes[i];
    alone.add(lobe.kind, lobe.type, Rgb(i == index ? 1.0f : 0.0f), lobe.frame) = lobe;
    alone.lobes[i].weight = Rgb(i == index ? 1.0f : 0.0f);
  }
  double sum = 0;
  for (int k = 0; k < draws; ++k) {
    sampling::Sampler s(stream, index, static_cast<std::uint32_t>(k), 9);
    const Vec2 u2 = s.next_2d();
    const auto drawn = sample_lobe(alone, choice, index, point, point.wo(), s.next_1d(), u2);
    if (drawn) sum += drawn->weight.x;
  }
  return sum / draws;
}

// acceptance: E1
TEST(RandomArchitecturalMaterial, LevelsNeverExceedOneAtAnyAngle) {
  std::mt19937 engine(21);
  std::uniform_real_distribution<float> unit(0, 1);
  const World world;
  float most = 0, most_lobe = 0;
  for (int n = 0; n < kMaterials; ++n) {
    ParamBlock params = random_params(engine, n % 2);
    // What the promise is made for.
    params.set("brdf_conserve_energy", true);
    params.set("cutout_opacity", 1.0f);
    for (const float cosine : {1.0f, 0.9f, 0.7f, 0.5f, 0.3f, 0.1f, 0.02f, unit(engine)}) {
      ShadingPoint point =
          seen_at(std::max(cosine, 1e-3f), kTwoPi * unit(engine), unit(engine) < 0.3f, world);
      Closure closure;
      kMiaMaterialX.material.fill(Call{params.data(), nullptr, point}, closure);
      make_ready(closure, point.wo());
      ASSERT_LE(closure.count, Closure::kMaxLobes);
      Rgb sum(0);
      for (int i = 0; i < closure.count; ++i) {
        const Lobe& lobe = closure.lobes[i];
        ASSERT_TRUE(is_number(lobe.weight)) << n;
        if (lobe.controls.mirrored) continue;  // a highlight beside a mirror is the mirror's
        for (int k = 0; k < 3; ++k) ASSERT_GE(lobe.weight[k], 0) << n << " lobe " << i;
        sum += lobe.weight;
      }
      for (int k = 0; k < 3; ++k) ASSERT_LE(sum[k], 1 + 1e-5f) << n << " cosine " << cosine;
      most = std::max(most, max_component(sum));

      // At one of the angles: what each lobe does with a level of 1.
      if (cosine != 0.5f) continue;
      for (int i = 0; i < closure.count; ++i) {
        double albedo = lobe_albedo(closure, i, point, 32, n);
        if (albedo > 1.002) albedo = lobe_albedo(closure, i, point, 4096, n);
        if (albedo > 1.002) albedo = lobe_albedo(closure, i, point, 65536, n);
        ASSERT_LE(albedo, 1.005) << n << " lobe " << i << " kind "
                                 << static_cast<int>(closure.lobes[i].kind);
        most_lobe = std::max(most_lobe, static_cast<float>(albedo));
      }
    }
  }
  RecordProperty("largest_sum", std::to_string(most));
  RecordProperty("largest_lobe", std::to_string(most_lobe));
}

/// The parameters that "random_mia" shades with.
const ParamBlock* current = nullptr;

constexpr ShaderSpec kRandomMia = {
    .name = "random_mia",
    .library = "test",
    .apply = kApplyMaterial | kApplyShadow,
    .material = {
        .fill =
            [](const Call& call, Closure& closure) {
              kMiaMaterialX.material.fill(Call{current->data(), nullptr, call.point}, closure);
            },
        .may_transmit = [](const ShaderNode&) { return true; },
    },
};

/// A ball, a plate and a floor of the current material, two lights and a sky, made ready once.
const World& tiny_world() {
  static const Registry registry([] {
    std::vector<const ShaderSpec*> specs = builtin_shaders().all();
    specs.push_back(&kRandomMia);
    return specs;
  }());
  static scene::Scene scene;
  static const std::unique_ptr<World> world = [] {
    Diagnostics diagnostics;
    mi::ReadOptions options;
    options.packages = builtin_packages();
    options.knows_shader = [](std::string_view n) { return registry.find(n) != nullptr; };
    scene = mi::read_text(R"(
options "opt" object space trace on trace depth 3 3 5 shadow segments "indirect" "path" end options
camera "cam" focal 1 aperture 1 aspect 1 resolution 8 8
  environment "mia_physicalsky" ( "sun_direction" .3 .2 1, "haze" 1 ) end camera
instance "cam_i" "cam" end instance
shader "s" "random_mia" ()
material "m" = "s" shadow = "s" end material
shader "g" "mia_material_x" ( "reflectivity" .2, "diffuse" .8 .6 .4 )
material "grey" = "g" shadow = "g" end material
object "box" visible on shadow on trace on group
 -.5 -.5 -2.5 .5 -.5 -2.5 .5 .5 -2.5 -.5 .5 -2.5 -.5 -.5 -2 .5 -.5 -2 .5 .5 -2 -.5 .5 -2
 v 0 v 1 v 2 v 3 v 4 v 5 v 6 v 7
 p 4 5 6 7 p 0 3 2 1 p 0 1 5 4 p 2 3 7 6 p 0 4 7 3 p 1 2 6 5 end group end object
object "floor" visible on shadow on trace on group
 -4 -.6 -6 4 -.6 -6 4 -.6 2 -4 -.6 2 v 0 v 1 v 2 v 3 p 3 2 1 0 end group end object
object "sheet" visible on shadow on trace on group
 .2 -.6 -1.8 .9 -.6 -1.6 .9 .6 -1.6 .2 .6 -1.8 v 0 v 1 v 2 v 3 p 0 1 2 3 end group end object
instance "box_i" "box" material "m" end instance
instance "floor_i" "floor" material "grey" end instance
instance "sheet_i" "sheet" material "m" end instance
light "lamp" "physical_light" ( "color" 30 30 30 ) origin 1 1.5 -1
  rectangle .5 0 0 0 0 .5 2 2 end light
instance "lamp_i" "lamp" visible on end instance
light "point" "mib_light_point" ( "color" .5 .6 .7, "shadow" on ) origin -1 1 0 end light
instance "point_i" "point" end instance
instgroup "root" "cam_i" "box_i" "floor_i" "sheet_i" "lamp_i" "point_i" end instgroup
render "root" "cam_i" "opt"
)",
                          options, diagnostics);
    PrepareReport report;
    static const ParamBlock defaults(kMiaMaterialX);
    current = &defaults;
    auto made = prepare(scene, scene.renders.back(), registry, {}, diagnostics, report);
    for (const Diagnostic& d : diagnostics.all()) ADD_FAILURE() << diagnostics.format(d);
    return made;
  }();
  return *world;
}

std::size_t output_index(const std::string& name) {
  return static_cast<std::size_t>(material_output_index(name));
}

// acceptance: U2, U3, E1
TEST(RandomArchitecturalMaterial, OutputsOfEveryPathAreItsRadiance) {
  const World& world = tiny_world();
  std::mt19937 engine(22);
  std::uniform_real_distribution<float> unit(0, 1);
  double worst_product = 0, worst_sum = 0, worst_raw = 0;
  const auto relative = [](double a, double b, double scale) {
    return std::abs(a - b) / std::max(scale, 1e-12);
  };
  int bright = 0;
  for (int n = 0; n < kMaterials; ++n) {
    const ParamBlock params = random_params(engine, n % 2);
    current = &params;
    for (std::uint32_t path = 0; path < 6; ++path) {
      sampling::Sampler sampler(n, 5, path);
      const Vec2 raster(8 * unit(engine), 8 * unit(engine));
      PathRecord r(RecordRequest{.aovs = true});
      RayCounts counts;
      const PathSettings settings{.paths_of_pixel = 16};
      trace_path(world, world.camera.ray(raster), raster, settings, r, sampler, counts);
      ASSERT_TRUE(is_number(r.radiance)) << n;
      ASSERT_TRUE(is_number(r.albedo) && std::isfinite(r.alpha)) << n;
      const auto all = resolve_outputs(*r.aovs, r.radiance);
      for (const Rgb& c : all) ASSERT_TRUE(is_number(c)) << n;
      const auto at = [&](const std::string& name) { return all[output_index(name)]; };
      bright += !is_black(r.radiance);
      for (int k = 0; k < 3; ++k) {
        double simple = 0, raw = 0, scale = 0;
        for (const std::string part : {"diffuse", "spec", "refl", "refr", "tran"}) {
          const double result = double(at(part + "_result")[k]);
          const double product = double(at(part + "_raw")[k]) * double(at(part + "_level")[k]);
          worst_product = std::max(worst_product, relative(product, result, std::abs(result)));
          simple += result;
          raw += product;
          scale += std::abs(result);
        }
        const double indirect = double(at("indirect_result")[k]);
        const double rebuilt = double(at("diffuse_level")[k]) * double(at("indirect_post_ao")[k]);
        worst_product = std::max(worst_product, relative(rebuilt, indirect, std::abs(indirect)));
        const double background = double(at("opacity_result")[k]);
        simple += indirect + background + double(at("add_result")[k]) + double(at("other")[k]);
        raw += rebuilt + (1 - double(at("opacity")[k])) * double(at("opacity_raw")[k]) +
               double(at("add_result")[k]) + double(at("other")[k]);
        scale += std::abs(indirect) + std::abs(background) + std::abs(double(at("add_result")[k])) +
                 std::abs(double(at("other")[k]));
        worst_sum = std::max(worst_sum, relative(simple, double(r.radiance[k]), scale));
        worst_raw = std::max(worst_raw, relative(raw, double(r.radiance[k]), scale));
      }
      ASSERT_LE(worst_product, 1e-5) << n;
      ASSERT_LE(worst_sum, 1e-5) << n;
      ASSERT_LE(worst_raw, 1e-5) << n;
    }
  }
  EXPECT_GT(bright, kMaterials);
  RecordProperty("largest_product_difference", std::to_string(worst_product));
  RecordProperty("largest_sum_difference", std::to_string(worst_sum));
}

}  // namespace outputs_contract_test
}  // namespace oriel
