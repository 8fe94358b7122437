// SPDX-License-Identifier: Apache-2.0
// oriel diff: how far two pictures are apart, in numbers and as an exit code.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "color/srgb.h"
#include "command.h"
#include "image/compare.h"
#include "image/files.h"
#include "image/flip.h"
#include "pictures.h"
#include "scene_file.h"
#include "suggest.h"

namespace oriel::app {
namespace {

struct DiffArguments {
  std::string test, reference;
  std::vector<std::string> thresholds;
  std::string flip_map;
  bool json = false;
};

constexpr const char* kMetrics[] = {"rmse", "relmse", "mean", "max", "flip"};

/// Colour channels only: grey stays one channel, alpha goes.
Image colours_of(const Image& image) {
  const int colours = image.channels >= 3 ? 3 : 1;
  Image out(image.width, image.height, colours);
  for (std::size_t i = 0; i < image.pixel_count(); ++i)
    std::copy_n(&image.pixels[i * static_cast<std::size_t>(image.channels)], colours,
                &out.pixels[i * static_cast<std::size_t>(colours)]);
  return out;
}

/// What a screen would show: linear pictures are encoded, with values past 1 cut.
Image as_shown(Image image, const std::string& path) {
  if (is_linear_file(path))
    for (float& v : image.pixels) v = std::isfinite(v) ? srgb_encode(clamp01(v)) : 0.0f;
  return image;
}

struct Threshold {
  std::string metric;
  double value;
};

Threshold parse_threshold(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string metric = text.substr(0, equals);
  char* end = nullptr;
  const double value =
      equals == std::string::npos ? 0 : std::strtod(text.c_str() + equals + 1, &end);
  const bool known =
      std::find(std::begin(kMetrics), std::end(kMetrics), metric) != std::end(kMetrics);
  if (!known)
    throw UsageError(
        fmt::format("--threshold {}: {}", text,
                    expected_one_of(metric, {std::begin(kMetrics), std::end(kMetrics)})));
  if (!end || end == text.c_str() + equals + 1 || *end || !(value >= 0))
    throw UsageError(
        fmt::format("--threshold {}: expected METRIC=VALUE with a value of 0 or more", text));
  return {metric, value};
}

int run_diff(const DiffArguments& a) {
  std::vector<Threshold> thresholds;
  for (const std::string& text : a.thresholds) thresholds.push_back(parse_threshold(text));
  const Image test = colours_of(read_named_picture(a.test));
  const Image reference = colours_of(read_named_picture(a.reference));
  if (test.width != reference.width || test.height != reference.height ||
      test.channels != reference.channels)
    throw UserError(fmt::format(
        "the pictures differ in size: {} x {} with {} channels, {} x {} with {}", test.width,
        test.height, test.channels, reference.width, reference.height, reference.channels));

  const Difference d = compare(test, reference);
  const Image flip_map = flip_error(as_shown(test, a.test), as_shown(reference, a.reference));
  const double flip = mean_value(flip_map);
  if (!a.flip_map.empty()) write_image(a.flip_map, flip_map, {.format = SampleFormat::Float});
  nlohmann::json values = {{"rmse", d.rmse},
                           {"relmse", d.relative_mse},
                           {"mean", d.mean_abs},
                           {"max", d.max_abs},
                           {"flip", flip}};
  int exit_code = kExitDone;
  nlohmann::json exceeded = nlohmann::json::array();
  for (const Threshold& t : thresholds)
    // Written so that a difference that is no number exceeds every threshold.
    if (!(values[t.metric].get<double>() <= t.value)) {
      exceeded.push_back(t.metric);
      exit_code = kExitFailed;
    }
  if (d.not_finite > 0 && !thresholds.empty()) exit_code = kExitFailed;

  if (a.json) {
    values["max_x"] = d.max_x, values["max_y"] = d.max_y;
    values["not_finite"] = d.not_finite;
    values["exceeded"] = exceeded;
    print_json(values);
    return exit_code;
  }
  fmt::print(
      "rmse    {:.6g}\nrelmse  {:.6g}\nmean    {:.6g}\nmax     {:.6g} at {}, {}\nflip    {:.6g}\n",
      d.rmse, d.relative_mse, d.mean_abs, d.max_abs, d.max_x, d.max_y, flip);
  if (d.not_finite > 0) fmt::print("{} values are not finite and were left out\n", d.not_finite);
  for (const auto& metric : exceeded)
    fmt::print("{} exceeds its threshold\n", metric.get<std::string>());
  return exit_code;
}

}  // namespace

Command add_diff_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand("diff", "Compare two pictures");
  auto a = std::make_shared<DiffArguments>();
  app->add_option("A", a->test, "Picture to compare")->required();
  app->add_option("B", a->reference, "The reference")->required();
  app->add_option("--threshold", a->thresholds,
                  "Exit with code 1 if the metric (rmse, relmse, mean, max, flip) is larger")
      ->allow_extra_args(false)
      ->type_name("METRIC=VALUE");
  app->add_option("--flip", a->flip_map,
                  "Grey picture to write: FLIP error per pixel, 0 (equal) to 1")
      ->type_name("FILE");
  app->add_flag("--json", a->json, "Print one line of JSON");
  return {app, [a] { return run_diff(*a); }};
}

}  // namespace oriel::app
