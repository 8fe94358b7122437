// SPDX-License-Identifier: Apache-2.0
// From the film to files: the picture as lens and output shaders make it, and linear layers.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "image/files.h"
#include "image/pixel_buffer.h"
#include "image/view.h"
#include "render/session.h"
#include "transport/path/resolve_outputs.h"

namespace oriel {

// Conventions
//   Files cover the whole picture; what lies outside the rendered window is 0, so that pictures of
//   several windows add up to the whole one.

/// A layer beside the beauty. Names: depth, normal, albedo, variance, samples, display, halves,
/// luminance, illuminance, motion, tag, coverage.
using LayerSet = std::uint64_t;
enum LayerBit : LayerSet {
  kLayerDepth = 1u << 0,
  kLayerNormal = 1u << 1,
  kLayerAlbedo = 1u << 2,
  kLayerVariance = 1u << 3,  ///< of the mean of the beauty
  kLayerSamples = 1u << 4,   ///< how many samples each pixel got
  kLayerDisplay = 1u << 5,   ///< after lens shaders, where there are any; of unmapped files
  kLayerHalves = 1u << 6,  ///< half the difference of two halves of the samples, from 8 samples on
  kFilmLayers = (1u << 7) - 1,
  kLayerLuminance = 1u << 7,    ///< of the beauty, cd/m2
  kLayerIlluminance = 1u << 8,  ///< lux of the first surface; only where the session keeps it
  kPhotometricLayers = kLayerLuminance | kLayerIlluminance,
  /// Way of the first sample's surface on the picture while the shutter is open; a closed one: in
  /// one motion interval. X and Y in pixels, Z the distance that is gained; where the session
  /// keeps it.
  kLayerMotion = 1u << 9,
  kLayerTag = 1u << 10,          ///< label of what covers most of the pixel; with mattes alone
  kLayerCoverage = 1u << 11,     ///< its share of the pixel; likewise
  kLayerLights = 1u << 12,       ///< `light.NAME` for each layer of lights that the session keeps
  kLayerUserBuffers = 1u << 13,  ///< what users' shaders left in frame buffers
  kLayerMattes = 1u << 14        ///< Cryptomattes, where the session keeps mattes
};
/// The outputs of materials follow, one bit each in the order of material_output_names().
inline constexpr int kFirstOutputBit = 16;
inline constexpr LayerSet kOutputLayers = ((LayerSet{1} << kMaterialOutputs) - 1)
                                          << kFirstOutputBit;

/// The bit of a layer's name, 0 when there is no such layer ("beauty" is always there).
LayerSet layer_bit(std::string_view name);
/// All names, the film's layers first.
const std::vector<std::string>& layer_names();

/// What of the picture a file without layers shows.
/// Intensity: by the luminance weights of the options. Bit: 1 where alpha is at least .5, else 0.
enum class PixelView {
  ColorAlpha,
  Color,
  Alpha,
  Depth,
  Normal,
  Motion,
  Intensity,
  Bit,
  Tag,
  Coverage
};

/// One file to write.
struct PictureFile {
  std::string path;
  std::string format = {};  ///< file type as an extension ("png"); empty: as the path says
  PixelView view = PixelView::ColorAlpha;
  SampleFormat samples = SampleFormat::Float;  ///< of EXR; of others the nearest they have
  bool float_pixels = false;      ///< no view: gamma, clipping and dither of the options do not act
  bool unmapped = false;          ///< linear: without lens and output shaders, as side channels are
  LayerSet layers = kFilmLayers;  ///< of EXR
  std::string shown_layer = {};   ///< an output in place of the beauty; empty = none
  /// A buffer of World::user_buffers in place of the beauty, -1 = none; where it stands beside
  /// another meaning of the file it counts once a shader has written it.
  int user_buffer = -1;
  bool only_user_buffer = false;  ///< the file has no other meaning
  NodeList shaders = {};          ///< output shaders that run over what the file shows
  int quality = 95;               ///< of JPEG
};

/// A file for `path` as `-o` means it: EXR float, HDR linear, TIFF 16 bit, others 8 bit.
PictureFile picture_file(const std::string& path);

/// Beauty (R, G, B, A) first, then the layers asked for: Z, normal.X ... albedo.R ... variance.R
/// ... samples, display.R ..., halves.R ..., luminance, illuminance, motion.X ...
/// ... then the outputs by their names, which are left out when the film does not keep them.
/// ... then light.NAME.R ... of the groups of lights and of light.rest, which sum to the beauty;
/// light.indirect where some light does not know its group.
/// ... then tag, coverage; CryptoObject00.r ... and the further Cryptomattes.
/// ... then users' buffers: fbN.R, G, B, A by number; those with a name by it, where shaders wrote
/// them, as fb.NAME where the film has a layer of that name. One number: fbN; vectors: X, Y, Z.
std::vector<Layer> film_layers(const RenderSession& session, LayerSet layers);

/// The beauty without noise, RGB: what the film knows goes through denoise() (denoise/denoise.h).
Image denoised_beauty(const RenderSession& session);

/// What is looked at: the display buffer when lens shaders map colours, else the film; then through
/// output shaders in the order of the list, those that map colours and those that work on whole
/// pictures alike. Premultiplied RGBA, not yet a view.
///
/// Checked: OutputOrder.* in tests/user_shaders/output_order_test.cpp
/// Inputs:  denoised: of denoised_beauty(), in place of the film's colours; null = the film's.
Image shown_image(const RenderSession& session, const NodeList& output_shaders,
                  const Image* denoised = nullptr);

/// Whether lens or output shaders change what the file shows of the picture.
bool is_mapped(const PictureFile& file, const World& world);

/// Whether the file shows anything that the film must keep outputs, irradiance or motion for.
bool needs_outputs(const PictureFile& file);
bool needs_irradiance(const PictureFile& file);
bool needs_motion(const PictureFile& file);
/// Whether it shows labels or coverage, which sessions know that keep mattes.
bool needs_mattes(const PictureFile& file);
/// Whether layers of lights stand in it: in EXR files of the beauty.
bool holds_light_layers(const PictureFile& file);

/// How the options make integers of it.
ViewOptions view_options(const scene::RenderOptions& options);

/// Writes one file.
///
/// Model:   every file shows the picture after lens shaders and `shaders`, unless it is unmapped.
///          Where that changes colours, EXR has the film's beauty (RGBA) as the layer `linear`; all
///          other layers are linear too (ADR 5). Layers of lights, Cryptomattes (with their header)
///          and users' buffers are in all EXR files of the beauty. A file of a user's buffer shows
///          what `shaders` made of it.
/// Inputs:  metadata: goes into the header of EXR files. denoised: linear; what other files than
///          EXR show, mapped; EXR has it as the layer `denoised` beside the noisy beauty.
/// Errors:  std::runtime_error with path and reason.
/// Checked: Output.* in output_test.cpp
void write_picture(const PictureFile& file, const RenderSession& session,
                   const std::map<std::string, std::string>& metadata,
                   const Image* denoised = nullptr);

}  // namespace oriel
