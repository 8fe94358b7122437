// SPDX-License-Identifier: Apache-2.0
// A copy of the film for display: selected layers in half floats.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "render/session.h"

namespace oriel::interactive {

/// Formats of display layers, numbered as in docs/dev/studio-protocol.md.
enum class LayerFormat : std::uint8_t { Rgb16F = 0, Rgba16F = 1, R32F = 2 };

inline constexpr std::size_t bytes_per_pixel(LayerFormat format) {
  constexpr std::array<std::size_t, 3> kBytes = {6, 8, 4};
  return kBytes[static_cast<std::size_t>(format)];
}

/// One layer; rows from the top, without padding.
struct PictureLayer {
  std::string name;
  LayerFormat format = LayerFormat::Rgb16F;
  std::vector<std::byte> pixels;
};

/// A consistent state of a film.
struct Picture {
  std::uint32_t epoch = 0;
  int divider = 1;                 ///< the picture is reduced by this factor
  bool preview = false;            ///< made with other settings than the final picture
  bool first = false;              ///< the first of its epoch
  int width = 0, height = 0;       ///< of the whole picture, reduced
  int x = 0, y = 0, w = 0, h = 0;  ///< the part that is there, from the upper left
  std::uint32_t samples = 0;       ///< per pixel, rounded down
  std::uint64_t number = 0;        ///< of the pictures of a session, increasing
  std::vector<PictureLayer> layers;
};

/// Name of the linear light before lens and output shaders, and of the same after the lens shaders.
inline constexpr const char* kBeautyLayer = "beauty";
inline constexpr const char* kShownLayer = "picture";
/// The beauty without noise, as `oriel render --denoise` makes it.
inline constexpr const char* kDenoisedLayer = "denoised";

/// Names of the layers that sessions of the world can show. Light layers: those that exist.
std::vector<std::string> available_layers(const World& world);

/// What a session has to store for the layers.
void request_layers(const std::vector<std::string>& names, SessionSettings& settings);

/// Copies layers of a film; unknown layers are black.
///
/// Inputs:  denoise: false: the denoised layer is the noisy beauty, which takes no time.
/// Model:   values are rounded to the nearest half and clamped to its range; NaN is 0.
/// Checked: StudioSessionTest.PixelsArriveReducedFirstAndAtFullSizeInTheEnd
std::vector<PictureLayer> copy_layers(const RenderSession& session,
                                      const std::vector<std::string>& names, bool denoise);

}  // namespace oriel::interactive
