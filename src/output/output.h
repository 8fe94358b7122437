// SPDX-License-Identifier: Apache-2.0
// From the film to files: the picture as lens and output shaders make it, and linear layers.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "image/files.h"
#include "image/pixel_buffer.h"
#include "image/view.h"
#include "output/layer_table.h"
#include "render/session.h"
#include "transport/path/resolve_outputs.h"

namespace oriel {

// Conventions
//   Files cover the whole picture; what lies outside the rendered window is 0, so that pictures of
//   several windows add up to the whole one.

/// One file to write.
struct PictureFile {
  std::string path;
  std::string format = {};  ///< file type as an extension ("png"); empty: as the path says
  PixelView view = PixelView::ColorAlpha;
  SampleFormat samples = SampleFormat::Float;  ///< of EXR; of others the nearest they have
  bool float_pixels = false;  ///< no view: gamma, clipping and dither of the options do not act
  bool unmapped = false;      ///< linear: without lens and output shaders, as side channels are
  LayerSet layers{LayerGroup::Film};  ///< of EXR
  std::string shown_layer = {};       ///< an output in place of the beauty; empty = none
  /// A buffer of World::user_buffers in place of the beauty, -1 = none; where it stands beside
  /// another meaning of the file it counts once a shader has written it.
  int user_buffer = -1;
  bool only_user_buffer = false;  ///< the file has no other meaning
  NodeList shaders = {};          ///< output shaders that run over what the file shows
  int quality = 95;               ///< of JPEG
};

/// A file for `path` as `-o` means it: EXR float, HDR linear, TIFF 16 bit, others 8 bit.
PictureFile picture_file(const std::string& path);

/// The beauty (R, G, B, A) first, then the layers in the order of layer_table(), without those that
/// the session does not store.
std::vector<Layer> film_layers(const RenderSession& session, const LayerSet& layers);

/// The beauty without noise, RGB: what the film knows goes through denoise() (denoise/denoise.h).
Image denoised_beauty(const RenderSession& session);

/// The linear colours that pictures for display show without denoising: spread_outliers() of the
/// beauty. Empty below 16 samples per pixel.
Image beauty_without_outliers(const RenderSession& session);

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

/// Whether the session has to store this for the file.
bool needs(const PictureFile& file, LayerNeed need);
SurfaceValues surface_values(const PictureFile& file);
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
