// SPDX-License-Identifier: Apache-2.0
// What do features of the architectural material cost that are switched on and have nothing to do?
//
// The same rooms are rendered with a shader that has a diffuse and a glossy component and nothing
// else, with mia_material_x as scenes write it, and with every feature of it written and inactive
// by value. They take turns; printed are medians of their ratios by processor time.
#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "base/parallel.h"
#include "bench_scenes.h"
#include "bsdf/fresnel.h"
#include "bsdf/gloss.h"
#include "prepare/testing/prepared_scene.h"
#include "runtime/bump.h"
#include "runtime/closure.h"
#include "shaders/registry.h"
#include "timing.h"
#include "transport/path/path.h"

namespace {

using namespace oriel;

/// Switched on, and without effect.
constexpr const char* kInactive =
    "\"diffuse_roughness\" 0, \"refl_is_metal\" off, \"refr_gloss\" .5, \"refr_translucency\" on, "
    "\"refr_trans_weight\" .5, \"anisotropy\" 1, \"anisotropy_rotation\" .3, "
    "\"anisotropy_channel\" 0, \"single_env_sample\" off, \"refl_falloff_on\" on, "
    "\"refl_falloff_dist\" 0, \"refl_falloff_color_on\" on, \"refr_falloff_on\" on, "
    "\"refr_falloff_dist\" 1, \"refr_falloff_color_on\" on, \"refr_falloff_color\" .5 .5 1, "
    "\"indirect_multiplier\" 1, \"fg_quality\" 1, \"ao_on\" on, \"ao_do_details\" 0, "
    "\"ao_ambient\" 0 0 0, \"skip_inside_refl\" on, \"do_refractive_caustics\" on, "
    "\"propagate_alpha\" on, \"hl_vs_refl_balance\" 1, \"cutout_opacity\" 1, "
    "\"additional_color\" 0 0 0, \"no_diffuse_bump\" on, \"bump_mode\" 2, \"overall_bump\" 0 0 0, "
    "\"standard_bump\" 0 0 0, \"multiple_outputs\" on, \"refl_base\" 0, ";

/// Nothing but a diffuse and a glossy component that share the light by Fresnel.
struct Plain {
  Rgba diffuse;
  float reflectivity, refl_gloss, refr_ior;
};
constexpr ParamSpec kPlainRows[] = {{ORIEL_PARAM(Plain, diffuse), .fallback = {.5f, .5f, .5f}},
                                    {ORIEL_PARAM(Plain, reflectivity), .fallback = {.6f}},
                                    {ORIEL_PARAM(Plain, refl_gloss), .fallback = {1}},
                                    {ORIEL_PARAM(Plain, refr_ior), .fallback = {1.4f}}};

void shade_plain(const Call& call, Closure& closure) {
  const auto& p = call.as<Plain>();
  const Frame frame(facing_viewer(call.point.normal, call.point));
  const Frame reflecting(reflecting_outward(frame.n, call.point));
  const float cosine = clamp01(dot(frame.n, call.point.wo()));
  const float level =
      p.reflectivity > 0 ? p.reflectivity * bsdf::fresnel_dielectric(cosine, p.refr_ior) : 0;
  const Rgb diffuse = rgb(p.diffuse) * (1 - level);
  closure.add(LobeKind::Diffuse, LobeType::Diffuse, diffuse, frame);
  closure.albedo = diffuse + Rgb(level);
  if (level <= 0) return;
  const bsdf::Roughness roughness = bsdf::gloss_to_roughness(p.refl_gloss, 1);
  Lobe& lobe = closure.add(roughness.is_mirror() ? LobeKind::Mirror : LobeKind::GlossyReflection,
                           LobeType::Reflection, Rgb(level), reflecting);
  lobe.alpha_x = roughness.ax;
  lobe.alpha_y = roughness.ay;
  lobe.controls.cutoff = 0.01f;
  lobe.controls.depth = 5;
}

constexpr ShaderSpec kPlainGlossy = {.name = "plain_glossy",
                                     .library = "bench",
                                     .apply = kApplyMaterial,
                                     .params = kPlainRows,
                                     .params_size = sizeof(Plain),
                                     .material = {.fill = shade_plain}};

const Registry& registry() {
  static const Registry registry([] {
    std::vector<const ShaderSpec*> specs = builtin_shaders().all();
    specs.push_back(&kPlainGlossy);
    return specs;
  }());
  return registry;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

struct Room : oriel::testing::PreparedScene {
  explicit Room(const std::string& text)
      : PreparedScene(text, registry(), {.width = 300, .height = 200}) {
    for (const Diagnostic& d : diagnostics.all())
      if (d.severity != Severity::Note) fmt::print(stderr, "{}\n", diagnostics.format(d));
  }

  /// Mean brightness of the picture.
  double render(int samples) const {
    std::vector<double> lines(static_cast<std::size_t>(world->camera.height));
    parallel_for(lines.size(), [&](std::size_t line) {
      const int y = static_cast<int>(line);
      RayCounts counts;
      for (int x = 0; x < world->camera.width; ++x)
        for (int s = 0; s < samples; ++s) {
          sampling::Sampler sampler(x, y, static_cast<std::uint32_t>(s));
          const Vec2 raster =
              Vec2(static_cast<float>(x), static_cast<float>(y)) + sampler.next_2d();
          lines[line] += static_cast<double>(
              trace_path(*world, world->camera.ray(raster), raster, {}, sampler, counts)
                  .radiance.y);
        }
    });
    double sum = 0;
    for (const double line : lines) sum += line;
    return sum / (static_cast<double>(samples) * static_cast<double>(world->camera.width) *
                  static_cast<double>(world->camera.height));
  }
};

void compare(const char* name, std::string text, int samples) {
  constexpr int kRounds = 15;
  const ThreadLimit limit(1);
  // Glass has no plain counterpart.
  replace_all(text, "= \"glass_s\" shadow = \"glass_s\"", "= \"gloss_s\"");
  std::string plain = text, full = text;
  replace_all(plain, "\"gloss_s\" \"mia_material_x\"", "\"gloss_s\" \"plain_glossy\"");
  replace_all(plain, "\"refl_gloss\" .6, \"brdf_fresnel\" on", "\"refl_gloss\" .6");
  for (const char* wall : {"white", "red", "green"})
    replace_all(plain, fmt::format("\"{}_s\" \"mia_material_x\"", wall),
                fmt::format("\"{}_s\" \"plain_glossy\"", wall));
  replace_all(full, "\"mia_material_x\" (", std::string("\"mia_material_x\" ( ") + kInactive);
  // The plain one runs twice: the ratio of its times differs from 1 by noise alone.
  const Room rooms[] = {Room(plain), Room(plain), Room(text), Room(full)};
  std::vector<double> ratio[4];
  double mean[4] = {};
  for (int round = 0; round < kRounds; ++round) {
    double seconds[4];
    for (int i = 0; i < 4; ++i)
      seconds[i] = bench::timed([&] { mean[i] = rooms[i].render(samples); }).cpu;
    for (int i = 0; i < 4; ++i) ratio[i].push_back(seconds[i] / seconds[0]);
  }
  fmt::print("{}: against a plain diffuse and glossy shader\n", name);
  const char* const kinds[] = {"plain", "plain again", "mia_material_x as written",
                               "every feature, inactive"};
  for (int i = 0; i < 4; ++i) {
    const auto [low, high] = std::minmax_element(ratio[i].begin(), ratio[i].end());
    fmt::print("  {:26} {:.3f} ({:.3f} to {:.3f})   mean of the picture {:.6f}\n", kinds[i],
               bench::median(ratio[i]), *low, *high, mean[i]);
  }
  std::fflush(stdout);
}

}  // namespace

int main() {
  compare("small room", bench::small_room(), 4);
  compare("big room", bench::big_room(), 2);
  return EXIT_SUCCESS;
}
