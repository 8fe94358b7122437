// SPDX-License-Identifier: Apache-2.0
// What a path brings, apart by the part of the first material it came through.
#pragma once

#include <array>
#include <cstdint>

#include "base/vec.h"

namespace oriel {

/// Parts of the light of a path; their sum is its radiance.
enum class Aov : std::uint8_t {
  Diffuse,       ///< light sources on the diffuse component
  Specular,      ///< highlights of light sources
  Reflection,    ///< what reflection rays see
  Refraction,    ///< what lies behind, through transparency
  Translucency,  ///< light from the other side
  Indirect,      ///< surfaces and environment on the diffuse component, ambient light
  Added,         ///< emission of the material
  Background,    ///< what shows through a cut-out
  Other          ///< no material with outputs: environment and lights seen directly
};
inline constexpr std::size_t kAovs = 9;
/// The first of them have levels: results divided by them are raw.
inline constexpr std::size_t kLevels = 5;

/// The outputs of one path, or means of many.
///
/// Model:   levels are those of the first material times the share of it that exists, so that means
///          over a pixel recombine: raw = mean of results / mean of levels.
/// Source:  manual 1.6.11.
/// Checked: Outputs.* in tests/analytic/outputs_test.cpp
struct AovValues {
  std::array<Rgb, kAovs> result;
  std::array<Rgb, kLevels> level;
  Rgb occlusion{1};   ///< of the first material, whatever it acts on; 1 where it asks for none
  Rgb dimming{1};     ///< the factor that it is of indirect light
  float opacity = 1;  ///< of the first material; 1 where there is none

  AovValues() {
    result.fill(Rgb(0));
    level.fill(Rgb(0));
  }
  Rgb& operator[](Aov c) { return result[static_cast<std::size_t>(c)]; }
  Rgb& level_of(Aov c) { return level[static_cast<std::size_t>(c)]; }
};

}  // namespace oriel
