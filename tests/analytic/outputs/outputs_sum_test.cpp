// SPDX-License-Identifier: Apache-2.0
// Random materials in random scenes: outputs sum to the image, for any number of threads.
#include <tbb/global_control.h>

#include <random>

#include "image/recombine.h"
#include "support/picture.h"

namespace oriel::testing {
namespace outputs_sum_test {

/// What a random scene is made of, in the language's words.
class RandomScene {
 public:
  explicit RandomScene(unsigned seed) : engine_(seed) {}

  std::string text() {
    static constexpr const char* kFilters[] = {
        "box 1 1",           "gauss 3 3",    "mitchell 4 4",    "lanczos 4 4",
        "clip mitchell 4 4", "triangle 2 2", "clip lanczos 4 4"};
    SceneText scene(fmt::format("trace depth 4 4 6 shadow segments filter {}",
                                kFilters[engine_() % std::size(kFilters)]));
    scene.camera("focal 1 aperture 1 aspect 1.5 resolution 24 16");
    for (const char* name : {"floor", "ball", "inner", "box", "card"})
      scene.material(name, material());
    scene.square("floor", Vec3(0, -.8f, -3), 4, Vec3(0, 1, 0))
        .sphere("ball", Vec3(-.6f, 0, -3), .7f, 10)
        .sphere("inner", Vec3(-.6f, 0, -3), .35f, 8)
        .box("box", Vec3(.1f, -.8f, -3.4f), Vec3(.9f, .2f, -2.6f))
        .square("card", Vec3(.5f, .1f, -2), .4f, Vec3(unit() - .5f, unit() - .5f, 1));
    if (coin()) scene.square("box", Vec3(-.6f, 0, -2), .3f, Vec3(.2f, .3f, 1));
    lights(scene);
    std::string text = scene.str();
    // A third without light that diffuse surfaces send to each other.
    const std::string method = "\"indirect\" \"path\"";
    if (coin(.3f)) text.replace(text.find(method), method.size(), "\"indirect\" \"scene\"");
    return text;
  }

 private:
  float unit() { return static_cast<float>(engine_() % 1001) / 1000; }
  bool coin(float share = .5f) { return unit() < share; }
  std::string color() { return fmt::format("{} {} {}", unit(), unit(), unit()); }

  void lights(SceneText& scene) {
    if (coin(.7f))
      scene.light("point",
                  fmt::format("\"mib_light_point\" ( \"color\" {} ) origin 1 2 -1", color()));
    if (coin(.7f))
      scene.light("area",
                  fmt::format("\"physical_light\" ( \"color\" {0} {0} {0} ) origin -1 2 -2.5 "
                              "rectangle .6 0 0 0 0 .6 2 2",
                              10 + 30 * unit()),
                  coin() ? "visible on" : "");
    switch (engine_() % 3) {
      case 0:
        scene.uniform_sky(unit());
        break;
      case 1:
        scene.light("sun",
                    "\"mia_physicalsun\" ( \"haze\" 1, \"y_is_up\" on ) direction .3 -1 -.4");
        scene.environment(
            "\"mia_physicalsky\" ( \"sun_direction\" -.3 1 .4, \"haze\" 1, \"y_is_up\" on )");
        break;
      default:
        break;
    }
  }

  std::string material() {
    std::string m = fmt::format(
        "\"diffuse\" {}, \"diffuse_roughness\" {}, \"reflectivity\" {}, \"refl_color\" {}, "
        "\"refl_gloss\" {}, \"refl_gloss_samples\" {}, \"anisotropy\" {}, "
        "\"hl_vs_refl_balance\" {}, \"refr_ior\" {}, \"brdf_0_degree_refl\" {}",
        color(), unit(), unit(), color(), coin() ? 1 : unit(), coin(.2f) ? 0 : 8, .3f + 2 * unit(),
        coin() ? 1 : 2 * unit(), 1 + unit(), unit());
    const auto maybe = [&](float share, const std::string& text) {
      if (coin(share)) m += ", " + text;
    };
    maybe(.2f, "\"multiple_outputs\" off");
    maybe(.3f, "\"refl_is_metal\" on");
    maybe(.3f, "\"brdf_fresnel\" on");
    maybe(.15f, "\"refl_hl_only\" on");
    maybe(.3f, "\"thin_walled\" on");
    maybe(.2f, "\"no_visible_area_hl\" off");
    maybe(.3f, "\"skip_inside_refl\" off");
    maybe(.2f, "\"single_env_sample\" on");
    maybe(.15f, "\"backface_cull\" on");
    maybe(.25f, fmt::format("\"refl_interpolate\" on, \"intr_grid_density\" {}", engine_() % 6));
    maybe(.15f, "\"refr_interpolate\" on");
    maybe(.1f, "\"brdf_conserve_energy\" off");
    maybe(.2f, fmt::format("\"indirect_multiplier\" {}", 2 * unit()));
    maybe(.2f, fmt::format("\"fg_quality\" {}, \"fg_quality_w\" 0", 3 * unit()));
    maybe(.2f, fmt::format("\"additional_color\" {}", color()));
    maybe(.3f, fmt::format("\"cutout_opacity\" {}", unit()));
    maybe(.3f, fmt::format("\"refl_base\" {}, \"refl_base_color\" {}, \"refl_base_gloss\" {}",
                           unit(), color(), unit()));
    maybe(.4f, fmt::format("\"ao_on\" on, \"ao_do_details\" {}, \"ao_samples\" {}, "
                           "\"ao_distance\" {}, \"ao_dark\" {}, \"ao_ambient\" {}",
                           engine_() % 3, engine_() % 20, coin(.2f) ? 0 : 2 * unit(),
                           coin(.2f) ? "0 0 0" : color(), coin() ? "0 0 0" : color()));
    maybe(.2f, fmt::format("\"refl_falloff_on\" on, \"refl_falloff_dist\" {}, "
                           "\"refl_falloff_color_on\" {}, \"refl_falloff_color\" {}",
                           2 * unit(), coin() ? "on" : "off", color()));
    maybe(.3f, fmt::format("\"bump_mode\" {}, \"standard_bump\" {} {} {}, \"no_diffuse_bump\" {}",
                           1 + engine_() % 8, unit() - .5f, unit() - .5f, unit() + .3f,
                           coin() ? "on" : "off"));
    if (coin(.4f)) {
      m += fmt::format(", \"transparency\" {}, \"refr_gloss\" {}, \"refr_color\" {}", unit(),
                       coin() ? 1 : unit(), color());
      maybe(.5f, fmt::format("\"refr_translucency\" on, \"refr_trans_weight\" {}", unit()));
      maybe(.4f, fmt::format("\"refr_falloff_on\" on, \"refr_falloff_dist\" {}, "
                             "\"refr_falloff_color_on\" {}, \"refr_falloff_color\" {}",
                             .2f + unit(), coin() ? "on" : "off", color()));
    }
    return m;
  }

  std::mt19937 engine_;
};

/// Largest |result - raw x level| over |result| of all pixels, of those above rounding.
float product_error(const Picture& p, const std::string& result, const std::string& raw,
                    const std::string& level) {
  const Image &r = p.layer(result), &a = p.layer(raw), &b = p.layer(level);
  float worst = 0;
  for (std::size_t i = 0; i < r.pixels.size(); ++i)
    if (std::abs(r.pixels[i]) > 1e-30f)
      worst = std::max(worst,
                       std::abs(r.pixels[i] - a.pixels[i] * b.pixels[i]) / std::abs(r.pixels[i]));
    else
      EXPECT_LE(std::abs(a.pixels[i] * b.pixels[i]), 1e-30f) << raw << " of nothing";
  return worst;
}

/// Rounding of parts that cancel where a filter is negative, relative to the difference's divisor.
float rounding_of_parts(const Picture& p, const RebuiltDifference& d) {
  constexpr float kUlps = 4 * 6e-8f;
  float sum = 0;
  for (const char* name : kResults) sum += std::abs(p.at(name, d.x, d.y)[d.channel]);
  return kUlps * sum / std::max(std::abs(d.beauty), d.floor);
}

// acceptance: U2, U3
TEST(Outputs, LayersSumToTheImage) {
  constexpr int kScenes = 60;
  float worst_product = 0, worst_simple = 0, worst_complex = 0;
  for (int n = 0; n < kScenes; ++n) {
    RandomScene random(static_cast<unsigned>(n) + 100);
    const std::string text = random.text();
    const Picture p(text, n % 3 ? 8 : 3);
    for (const Layer& layer : p.layers())
      for (const float v : layer.image.pixels)
        ASSERT_TRUE(std::isfinite(v)) << layer.name << " of scene " << n;
    for (const std::string part : {"diffuse", "spec", "refl", "refr", "tran"}) {
      const float e = product_error(p, part + "_result", part + "_raw", part + "_level");
      EXPECT_LE(e, 1e-4f) << part << " of scene " << n;
      worst_product = std::max(worst_product, e);
    }
    const float indirect = product_error(p, "indirect_result", "indirect_post_ao", "diffuse_level");
    EXPECT_LE(indirect, 1e-4f) << "indirect of scene " << n;
    worst_product = std::max(worst_product, indirect);

    const Recombination r = recombine(p.layers());
    const RebuiltDifference simple = compare_rebuilt(r.simple, p.layer(""), 1e-4f);
    const RebuiltDifference complex = compare_rebuilt(r.complex, p.layer(""), 1e-4f);
    // Clipping filters make pixels black whose parts are bright and cancel.
    const bool clips = text.find("filter clip") != std::string::npos;
    for (const auto& [form, d] : {std::pair("simple", simple), std::pair("complex", complex)})
      EXPECT_LE(d.largest, 1e-4f + rounding_of_parts(p, d))
          << form << " form of scene " << n << ", pixel " << d.x << ' ' << d.y;
    if (!clips) worst_simple = std::max(worst_simple, simple.largest);
    if (!clips) worst_complex = std::max(worst_complex, complex.largest);
    EXPECT_EQ(p.layer("result").pixels.size() / 3, p.layer("").pixels.size() / 4);
  }
  figure("outputs: worst of raw x level", 0, worst_product, 0);
  figure("outputs: worst of the simple form", 0, worst_simple, 0);
  figure("outputs: worst of the complex form", 0, worst_complex, 0);
}

// acceptance: U1
TEST(Outputs, DoNotChangeThePicture) {
  for (unsigned n = 0; n < 12; ++n) {
    const std::string text = RandomScene(n + 7).text();
    EXPECT_EQ(Picture(text, 4, true).layer("").pixels, Picture(text, 4, false).layer("").pixels);
    EXPECT_EQ(Picture(text, 4, false).layers().size(), 1u);
  }
}

TEST(Outputs, AreTheSameForAnyNumberOfThreads) {
  for (unsigned n = 0; n < 8; ++n) {
    const std::string text = RandomScene(n + 31).text();
    const auto with_threads = [&](std::size_t threads) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      return Picture(text, 8);
    };
    const Picture one = with_threads(1), four = with_threads(4);
    for (const Layer& layer : one.layers())
      EXPECT_EQ(layer.image.pixels, four.layer(layer.name).pixels)
          << layer.name << " of scene " << n;
  }
}

// acceptance: U3
TEST(Outputs, ClippedPixelsAreTheSumOfTheirPartsToo) {
  // What a filter clips to black, of parts thousands of times as bright as the limit is dark.
  const FilterSampler filter({scene::FilterKind::ClipMitchell, 4, 4});
  Film film(1, 1, filter, {}, {.aovs = true});
  PathRecord records[]{PathRecord(RecordRequest{.aovs = true}),
                       PathRecord(RecordRequest{.aovs = true})};
  AovValues &plain = *records[0].aovs, &ring = *records[1].aovs;
  plain[Aov::Diffuse] = Rgb(.1234567f);
  ring[Aov::Diffuse] = Rgb(.3333333f), ring[Aov::Reflection] = Rgb(777.7777f);
  FilmSample a, b;
  a.beauty = Rgb(.1234567f), a.record = &records[0];
  b.beauty = Rgb(.3333333f) + Rgb(777.7777f), b.record = &records[1], b.negative = true;
  film.add(0, 0, a);
  film.add(0, 0, b);
  AovValues o = film.outputs(0, 0);
  // As a compositor adds them, `other` last.
  Rgb sum(0);
  for (const Aov c : {Aov::Diffuse, Aov::Indirect, Aov::Specular, Aov::Reflection, Aov::Refraction,
                      Aov::Translucency, Aov::Added, Aov::Background, Aov::Other})
    sum += o[c];
  EXPECT_EQ(film.pixel(0, 0).beauty.r, 0);
  EXPECT_EQ(sum.x, 0);
  EXPECT_EQ(o[Aov::Other].x, 0) << "no light out of nowhere in a black pixel";
}

}  // namespace outputs_sum_test
}  // namespace oriel::testing
