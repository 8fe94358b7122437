// SPDX-License-Identifier: Apache-2.0
#include "output/exposure_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>

#include "base/math.h"
#include "render/unit_luminance.h"
#include "runtime/color_mapping.h"

namespace oriel {
namespace {

/// Smaller factors between units may be intended: lux instead of candela is a factor of pi.
constexpr float kWrongFactor = 10;

/// The shaders and options that apply gamma to the file, in order.
std::vector<std::string> gammas(const World& world, const PictureFile& file) {
  std::vector<std::string> who;
  const auto add = [&](const ShaderNode& node, const char* role) {
    if (lens_traits(node).gamma != 1)
      who.push_back(fmt::format("the {} shader {}", role, node.spec().name));
  };
  for (const ShaderNode* node : world.lens) add(*node, "lens");
  for (const ShaderNode* node : file.shaders) {
    const LensTraits traits = lens_traits(*node);
    const bool side = traits.side_channel_mode > 0 && has_side_channel(world, traits.side_channel);
    if (side) who.clear();
    if (!side || traits.side_channel_mode == 1) add(*node, "output");
  }
  if (world.options.gamma != 1 && !file.float_pixels)
    who.push_back(fmt::format("the options ({})", world.options.gamma));
  return who;
}

bool shows_colors(const PictureFile& file) {
  return !file.unmapped && file.shown_layer.empty() &&
         (file.view == PixelView::ColorAlpha || file.view == PixelView::Color);
}

void note_mapped_floats(const World& world, const std::vector<PictureFile>& files,
                        Diagnostics& diagnostics) {
  if (diagnostics.has("OR-RN-066")) return;
  const auto mapped = std::find_if(files.begin(), files.end(), [&](const PictureFile& file) {
    return file.float_pixels && is_mapped(file, world);
  });
  if (mapped == files.end()) return;
  const NodeList& shaders = world.lens.empty() ? mapped->shaders : world.lens;
  diagnostics.note(
      "OR-RN-066", {},
      fmt::format("{} contains colours after the {} shader {}, as defined by the scene",
                  std::filesystem::path(mapped->path).filename().string(),
                  world.lens.empty() ? "output" : "lens", shaders.front()->spec().name),
      "the layer \"linear\" of EXR files is linear; --linear writes linear files only");
}

void check_gamma(const World& world, const std::vector<PictureFile>& files,
                 Diagnostics& diagnostics) {
  for (const PictureFile& file : files) {
    if (!shows_colors(file)) continue;
    const std::vector<std::string> who = gammas(world, file);
    if (who.size() < 2) continue;
    return diagnostics.warning(
        "OR-RN-041", {},
        fmt::format("gamma is applied {}, by {}", who.size() == 2 ? "twice" : "several times",
                    fmt::join(who, " and by ")),
        "apply gamma once: set the others to 1");
  }
}

void check_units(const World& world, const std::vector<PictureFile>& files,
                 Diagnostics& diagnostics) {
  std::set<const ShaderNode*> exposures(world.lens.begin(), world.lens.end());
  for (const PictureFile& file : files) exposures.insert(file.shaders.begin(), file.shaders.end());
  for (const ShaderNode* exposure : exposures) {
    const float taken = lens_traits(*exposure).luminance;
    if (!(taken > 0)) continue;
    for (const auto& node : world.nodes) {
      const std::optional<float> put = luminance_of_unit(*node);
      if (!put) continue;
      const float stops = math::log2(taken / *put);
      if (std::abs(stops) < math::log2(kWrongFactor)) continue;
      return diagnostics.warning(
          "OR-RN-044", {},
          fmt::format("{} assumes {:.4g} cd/m2 per pixel unit, but {} uses {:.4g}: the "
                      "picture is {:.1f} stops too {}",
                      exposure->spec().name, taken, node->spec().name, *put, std::abs(stops),
                      stops < 0 ? "dark" : "bright"),
          fmt::format("set cm2_factor to {:.4g}, or rgb_unit_conversion to {:.4g} (or film_iso 0 "
                      "for pixels without a unit)",
                      *put, kInvPi / taken));
    }
  }
}

}  // namespace

void check_exposures(const World& world, const std::vector<PictureFile>& files,
                     Diagnostics& diagnostics) {
  note_mapped_floats(world, files, diagnostics);
  check_gamma(world, files, diagnostics);
  check_units(world, files, diagnostics);
}

}  // namespace oriel
