// SPDX-License-Identifier: Apache-2.0
// Pictures without fireflies and noise: what outlier handling and the denoiser keep of a render.
// The reference of each test has other random numbers than the picture that is judged. What is
// compared is chosen by the reference alone, so the noise of the picture cancels out in sums.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "denoise/denoise.h"
#include "image/exr.h"
#include "image/files.h"
#include "support/program.h"

namespace oriel {
namespace clean_pictures_test {

const std::string kScenes = std::string(ORIEL_SOURCE_DIR) + "/scenes";

double brightness(const Image& image, int x, int y) {
  const float* p = image.at(x, y);
  return (double{p[0]} + p[1] + p[2]) / 3;
}

double sum_of(const Image& image) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) sum += brightness(image, x, y);
  return sum;
}

class CleanPictures : public ProgramTest {
 protected:
  CleanPictures() { setenv("ORIEL_OIDN_LIBRARY", "", 1); }
  ~CleanPictures() override { unsetenv("ORIEL_OIDN_LIBRARY"); }

  ExrFile rendered(const std::string& name, const std::string& scene,
                   std::vector<std::string> options) const {
    options.insert(options.begin(), {"render", kScenes + "/" + scene, "-q", "-I", kScenes, "--exr",
                                     "float", "-o", name});
    const RunResult r = run(options);
    EXPECT_EQ(r.exit_code, 0) << r.err;
    return read_exr(file(name));
  }
};

/// Pixels that are brighter than all eight pixels around them, and than the reference, by `step`.
int fireflies(const Image& shown, const Image& reference, double step) {
  int count = 0;
  for (int y = 0; y < shown.height; ++y)
    for (int x = 0; x < shown.width; ++x) {
      double limit = brightness(reference, x, y);
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, shown.height - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, shown.width - 1); ++u)
          if (u != x || v != y) limit = std::max(limit, brightness(shown, u, v));
      count += brightness(shown, x, y) > limit + step;
    }
  return count;
}

// acceptance: M7
TEST_F(CleanPictures, TheInteriorHasNoFireflies) {
  // Photons that paths learned to use leave next to no fireflies, so one picture does not learn.
  const std::vector<std::pair<std::string, std::vector<std::string>>> pictures = {
      {"picture", {}}, {"unguided", {"--no-guiding", "--seed", "2"}}};
  std::map<std::string, ExrFile> rendered_files;
  std::map<std::string, Image> noisy;
  for (const auto& [name, more] : pictures) {
    std::vector<std::string> options = {"--size", "72x48",      "--samples",
                                        "400",    "--layers",   "variance,halves,samples",
                                        "-o",     name + ".png"};
    options.insert(options.end(), more.begin(), more.end());
    rendered_files[name] = rendered(name + ".exr", "interior/interior.mi", options);
    const std::string kept = name + "_noisy.png";
    ASSERT_EQ(run({"tonemap", name + ".exr", "--keep-outliers", "-o", kept}).exit_code, 0);
    noisy[name] = read_image(file(kept));
  }
  EXPECT_GT(fireflies(noisy["unguided"], noisy["picture"], .2), 4) << "nothing to remove";
  EXPECT_EQ(fireflies(read_image(file("unguided.png")), noisy["picture"], .2), 0);
  EXPECT_EQ(fireflies(read_image(file("picture.png")), noisy["unguided"], .2), 0);

  for (const auto& [name, picture] : rendered_files) {
    const Image& linear = find_layer(picture.layers, "linear")->image;
    const Image clean =
        spread_outliers({.color = &linear,
                         .half_difference = &find_layer(picture.layers, "halves")->image,
                         .variance = &find_layer(picture.layers, "variance")->image});
    EXPECT_NEAR(sum_of(clean) / sum_of(linear), 1, .005) << name;
  }
}

/// A scene with light groups.
struct DenoiseCase {
  const char* scene;
  std::vector<std::string> groups;
};
void PrintTo(const DenoiseCase& c, std::ostream* out) { *out << c.scene; }

class DenoisedPictures : public CleanPictures, public ::testing::WithParamInterface<DenoiseCase> {};

/// The sum over pixels that the reference has among its brightest hundredth.
double highlights(const Image& image, const Image& reference) {
  std::vector<double> order;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) order.push_back(brightness(reference, x, y));
  const auto rank = order.end() - static_cast<std::ptrdiff_t>(order.size() / 100);
  std::nth_element(order.begin(), rank, order.end());
  double sum = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (brightness(reference, x, y) >= *rank) sum += brightness(image, x, y);
  return sum;
}

/// The sum of the steps, relative to the reference, between neighbours of different albedo or
/// normal; the reference has the signs.
double edges(const Image& image, const Image& reference, const Image& albedo, const Image& normal) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x + 1 < image.width; ++x) {
      const float *a = albedo.at(x, y), *b = albedo.at(x + 1, y);
      const float *n = normal.at(x, y), *m = normal.at(x + 1, y);
      const double cosine = double{n[0]} * m[0] + double{n[1]} * m[1] + double{n[2]} * m[2];
      if (std::abs(a[1] - b[1]) < .2 && cosine > .7) continue;
      const double left = brightness(reference, x, y), right = brightness(reference, x + 1, y);
      const double step = brightness(image, x + 1, y) - brightness(image, x, y);
      sum += (right > left ? step : -step) / std::max(left + right, 1e-9);
    }
  return sum;
}

/// Mean squared relative error without the worst hundredth of the pixels.
double error_of(const Image& image, const Image& reference) {
  const double mean = sum_of(reference) / static_cast<double>(reference.pixel_count());
  std::vector<double> errors;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double r = brightness(reference, x, y), d = brightness(image, x, y) - r;
      errors.push_back(d * d / (r * r + .01 * mean * mean));
    }
  std::sort(errors.begin(), errors.end());
  errors.resize(errors.size() * 99 / 100);
  double sum = 0;
  for (const double e : errors) sum += e;
  return sum / static_cast<double>(errors.size());
}

// acceptance: M8
TEST_P(DenoisedPictures, KeepMeanEdgesHighlightsAndLightGroups) {
  // Paths that learn leave so little noise that the reference would have to have many more samples.
  std::vector<std::string> options = {"--linear", "--size", "96x64", "--no-guiding"};
  for (const std::string& group : GetParam().groups)
    options.insert(options.end(), {"--light-group", group});
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), options.begin(), options.end());
    return more;
  };
  const ExrFile noisy =
      rendered("noisy.exr", GetParam().scene,
               with({"--samples", "64", "--layers", "variance,halves,albedo,normal,depth"}));
  const ExrFile reference =
      rendered("reference.exr", GetParam().scene, with({"--samples", "160", "--seed", "7"}));
  ASSERT_EQ(run({"denoise", "noisy.exr", "-o", "clean.exr"}).exit_code, 0);
  const ExrFile clean = read_exr(file("clean.exr"));
  const Image &in = noisy.layers[0].image, &out = clean.layers[0].image,
              &truth = reference.layers[0].image;

  EXPECT_NEAR(sum_of(out) / sum_of(in), 1, .005);
  EXPECT_LT(error_of(out, truth), .7 * error_of(in, truth));
  EXPECT_NEAR(highlights(out, truth) / highlights(in, truth), 1, .05);
  const Image &albedo = find_layer(noisy.layers, "albedo")->image,
              &normal = find_layer(noisy.layers, "normal")->image;
  // Blurred edges would have smaller steps; outliers beside an edge reduce those of the input.
  const double kept = edges(out, truth, albedo, normal) / edges(in, truth, albedo, normal);
  EXPECT_GT(kept, .9);
  EXPECT_LT(kept, 1.25);

  int groups = 0;
  Image sum(out.width, out.height, 3);
  for (const Layer& layer : clean.layers) {
    if (!layer.name.starts_with("light_")) continue;
    ++groups;
    const Layer* before = find_layer(noisy.layers, layer.name);
    ASSERT_TRUE(before) << layer.name;
    EXPECT_NEAR(sum_of(layer.image), sum_of(before->image), .005 * sum_of(in)) << layer.name;
    for (int y = 0; y < out.height; ++y)
      for (int x = 0; x < out.width; ++x)
        for (int c = 0; c < 3; ++c) sum.at(x, y)[c] += layer.image.at(x, y)[c];
  }
  EXPECT_GT(groups, static_cast<int>(GetParam().groups.size()));
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(sum.at(x, y)[c], out.at(x, y)[c], 1e-3 * (out.at(x, y)[c] + 1e-6))
            << x << ' ' << y;
}

INSTANTIATE_TEST_SUITE_P(Scenes, DenoisedPictures,
                         ::testing::Values(DenoiseCase{"interior/interior.mi", {"sun=*sun*"}},
                                           DenoiseCase{"guide/room.mi",
                                                       {"sun=*sun*", "lamp=*lamp*"}},
                                           DenoiseCase{"round-corners.mi", {"sun=*sun*"}}));

}  // namespace clean_pictures_test
}  // namespace oriel
