// SPDX-License-Identifier: Apache-2.0
// Each parameter of the base and physics libraries' shaders, and of the hosts' stand-ins, acts:
// some change of it changes some result. What is reported as ignored need not.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "../contract/random_params.h"
#include "render/testing/prepared_scene.h"
#include "runtime/closure.h"
#include "runtime/tracer.h"

namespace oriel::sensitivity {
namespace {

using testing::ParamBlock;

/// Numbers and hits that are the same each time.
class SteadyTracer final : public Tracer {
 public:
  std::optional<Met> probe(const Vec3&, const Vec3&, float) override { return std::nullopt; }
  std::optional<Met> probe_from(const ShadingPoint&, const Vec3& way, float reach) override {
    Met met;
    met.distance = 1 + way.x;
    return met.distance < reach ? std::optional(met) : std::nullopt;
  }
  std::optional<Arriving> light(int, ShadingPoint& point) override {
    return Arriving{Rgb(1 + std::abs(point.position.z)), normalize(Vec3(.3f, .5f, 1))};
  }
  Vec2 next() override {
    ++drawn_;
    const float x = .37f * static_cast<float>(drawn_), y = .61f * static_cast<float>(drawn_);
    return Vec2(x - std::floor(x), y - std::floor(y));
  }
  Levels levels() const override { return {1, 1, .5f}; }
  Seen trace(const ShadingPoint&, const SubRay&) override { return {Rgba(.3f, .2f, .1f, 1), {}}; }
  Rgb irradiance(const ShadingPoint&, const Vec3&) override { return Rgb(.4f); }
  Rgba shade(const NodeList&, ShadingPoint&, MaterialOutputs*) override {
    return Rgba(.2f, .3f, .4f, 1);
  }
  bool write_buffer(std::size_t, const Rgba&) override { return false; }
  std::optional<Rgba> read_buffer(std::size_t) const override { return std::nullopt; }

 private:
  int drawn_ = 0;
};

/// A world with a texture, a light and an environment.
const testing::PreparedScene& surroundings() {
  static const testing::PreparedScene scene(testing::scene_text(
      "color texture \"t\" [4 4 4] '00000000' '4080c0ff' 'ff803040' '80ff2080' '10203040' "
      "'50607080' '90a0b0c0' 'd0e0f0ff' '01120334' 'a4556677' '8899aabb' 'ccddeeff' 'f0e0d0c0' "
      "'b0a09080' '70605040' '30201000'\n"
      "light \"l\" \"mib_light_point\" ( \"color\" 1 1 1 ) origin 1 2 3 end light\n"
      "instance \"l_i\" \"l\" end instance\n"
      "material \"m\" \"mib_texture_lookup\" ( \"tex\" \"t\" ) end material\n",
      "\"l_i\"",
      "environment \"mib_texture_wave\" ( \"coord\" = shader \"way\" "
      "\"mib_texture_vector\" ( \"select\" -4 ), \"amplitude_x\" 1, \"amplitude_z\" 2, "
      "\"offset\" 4 )"));
  return scene;
}

ShadingPoint random_point(std::mt19937& engine) {
  std::uniform_real_distribution<float> unit(0, 1);
  const auto any = [&] { return Vec3(unit(engine), unit(engine), unit(engine)) - Vec3(.5f); };
  ShadingPoint point;
  point.world = surroundings().world.get();
  point.position = any();
  point.ray_origin = any() * .2f;
  point.ray_direction = normalize(any() - Vec3(0, 0, 1));
  point.ray_length = 3 * unit(engine);
  point.back_side = unit(engine) < .3f;
  point.texture_spaces = 2;
  for (int i = 0; i < 2; ++i) {
    point.tex[i] = any() + Vec3(.5f);
    point.bump_u[i] = normalize(any());
    point.bump_v[i] = normalize(any());
  }
  point.dpdu = Vec3(1, .2f, 0);
  point.dpdv = Vec3(0, 1, .1f);
  point.dpdx = Vec3(.3f, 0, 0) * unit(engine);
  point.dpdy = Vec3(0, .1f, 0) * unit(engine);
  static const Mat4 turned(0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 3, 4, 5, 1);
  static const Mat4 back = turned.inverse();
  point.to_world = &turned;
  point.to_object = &back;
  point.raster = Vec2(16 * unit(engine), 12 * unit(engine));
  return point;
}

void add(std::vector<float>& all, const Rgb& c) { all.insert(all.end(), {c.x, c.y, c.z}); }
void add(std::vector<float>& all, const Vec3& v) { all.insert(all.end(), {v.x, v.y, v.z}); }

void add(std::vector<float>& all, const Closure& c) {
  for (int i = 0; i < c.count; ++i) {
    const Lobe& l = c.lobes[i];
    add(all, l.level);
    add(all, l.frame.n);
    add(all, l.frame.s);
    all.insert(all.end(), {static_cast<float>(l.kind), l.roughness, l.alpha_x, l.alpha_y, l.eta,
                           l.controls.samples, l.controls.falloff_distance,
                           l.controls.single_environment ? 1.0f : 0.0f});
  }
  add(all, c.emission);
  add(all, c.inside.absorption);
  all.insert(all.end(), {c.inside.black_distance, c.opacity, static_cast<float>(c.light_mode),
                         c.thin_walled ? 1.0f : 0.0f});
}

/// All that a shader says at a point.
std::vector<float> answer(const ShaderSpec& spec, const ParamBlock& params, ShadingPoint point) {
  SteadyTracer tracer;
  point.tracer = &tracer;
  const World& world = *surroundings().world;
  const auto state = spec.prepare ? spec.prepare(params.data(), world) : nullptr;
  const Call call{params.data(), state.get(), point};
  std::vector<float> all;
  if (spec.value) {
    alignas(16) float result[64] = {};
    spec.value(call, result);
    all.assign(std::begin(result), std::end(result));
  }
  if (spec.material) {
    Closure closure;
    spec.material(call, closure);
    add(all, closure);
  }
  if (spec.volume) {
    const AirValue air = spec.volume(call);
    add(all, air.kept);
    add(all, air.added);
  }
  if (spec.lens) add(all, spec.lens(call, {}, Rgb(.1f, .4f, 1.2f)));
  if (spec.shadow) add(all, spec.shadow(call, Rgb(1)));
  add(all, point.normal);
  return all;
}

bool is_plain(ParamType type) {
  return type == ParamType::Boolean || type == ParamType::Integer || type == ParamType::Scalar ||
         type == ParamType::Color || type == ParamType::Vector;
}

/// Whether one of many changes of that parameter changes an answer.
bool acts(const ShaderSpec& spec, const ParamSpec& row) {
  std::mt19937 engine(7);
  const TextureNode* texture = surroundings().world->textures[0].get();
  for (int n = 0; n < 3000; ++n) {
    ParamBlock params(spec);
    params.randomize(engine);
    // Much acts only where something else was not written.
    const ParamBlock unwritten(spec);
    for (const ParamSpec& each : spec.params)
      if (engine() % 5 == 0) params.take(unwritten, each);
    params.set_textures(texture);
    const ShadingPoint point = random_point(engine);
    const std::vector<float> before = answer(spec, params, point);
    ParamBlock other(spec);
    other.randomize(engine);
    params.take(other, row);
    if (answer(spec, params, point) != before) return true;
  }
  return false;
}

TEST(BaseLibrary, EachParameterActsOrIsReportedAsIgnored) {
  // What this cannot see, and where it is shown.
  const std::set<std::string> elsewhere = {
      "mib_texture_remap.alt_z",  // numbers here stay within the first copy: Textures.*
      "mib_texture_remap.torus_z",
      "mib_shadow_transparency.mode",  // needs lists: ShadowShader.*
      "mib_illum_cooktorr.ior",        // below 1 here: Illumination.CookTorranceShifts*
      "mib_blackbody.temperature",     // a few kelvin here: BaseColors.Temperatures*
      "mib_cie_d.temperature",
      "mib_color_alpha.input",     // opaque here: BaseColors.GreysAreCopied*
      "mib_ray_marcher.distance",  // need a shader to march through: RayMarcher.* in analytic
      "mib_ray_marcher.num",          "mib_ray_marcher.subdiv", "mib_ray_marcher.contrast",
      "mib_volume.lightrays",  // acts between lights and surfaces: tests/analytic/volume_test.cpp
  };
  for (const ShaderSpec* spec : builtin_shaders().all()) {
    const std::string_view library = spec->library;
    // Stand-ins are approximations by what is public; HostShaders.* in tests/binding show them.
    if (library == "architectural" || spec->stands_in) continue;
    if (!spec->value && !spec->material && !spec->volume && !spec->lens && !spec->shadow) continue;
    for (const ParamSpec& row : spec->params) {
      const std::string name = fmt::format("{}.{}", spec->name, row.name);
      if (!is_plain(row.type) || row.takes_material || row.support == Support::Ignored ||
          elsewhere.count(name))
        continue;
      EXPECT_TRUE(acts(*spec, row)) << name;
    }
  }
}

}  // namespace
}  // namespace oriel::sensitivity
