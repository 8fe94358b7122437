// SPDX-License-Identifier: Apache-2.0
// Writes the film to files: the picture after lens and output shaders, and linear layers.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "denoise/denoise.h"
#include "image/exr.h"
#include "image/files.h"
#include "image/pixel_buffer.h"
#include "image/view.h"
#include "output/layer_table.h"
#include "render/session.h"
#include "transport/path/resolve_outputs.h"

namespace oriel {

// Conventions
//   Files cover the full frame. Pixels outside of the rendered window are 0, so that pictures of
//   several windows can be added; in EXR files they are outside of the data window.

/// One file to write.
struct PictureFile {
  std::string path;
  std::string format = {};  ///< file type as an extension ("png"); empty: from the path
  PixelView view = PixelView::ColorAlpha;
  /// for types other than EXR, which use the nearest format that they support
  SampleFormat samples = SampleFormat::Float;
  bool float_pixels = false;  ///< disables the view: gamma, clipping and dither of the options
  bool unmapped = false;      ///< linear: without lens and output shaders, for side channels
  LayerSet layers{LayerGroup::Film};  ///< for EXR
  std::string shown_layer = {};       ///< material output shown instead of the beauty; empty = none
  /// Index in World::user_buffers shown instead of the beauty, -1 = none. If the file has other
  /// content too, the buffer is used only if a shader has written it.
  int user_buffer = -1;
  bool only_user_buffer = false;  ///< the file has no other content
  NodeList shaders = {};          ///< output shaders that run on the content of the file
  int quality = 95;               ///< for JPEG
  ExrPrecision precision = ExrPrecision::Float;
  ExrCompression compression = ExrCompression::Zip;
};

/// File for `path` with the defaults of `-o`: EXR with colour in half (float where a layer exceeds
/// its range), HDR linear, TIFF 16 bit, others 8 bit.
PictureFile picture_file(const std::string& path);

/// The beauty (R, G, B, A) first, then the layers in the order of layer_table(), without those that
/// the session does not store.
std::vector<Layer> film_layers(const RenderSession& session, const LayerSet& layers);

/// The denoised beauty, RGB; passes the film data to denoise_with_parts() (denoise/denoise.h).
DenoisedPicture denoised_beauty(const RenderSession& session, Denoiser denoiser);

/// Minimum samples per pixel to find outliers; with fewer, errors are too uncertain.
inline constexpr float kMinOutlierSamples = 16;

/// The linear colours that pictures for display show without denoising: spread_outliers() of the
/// beauty. Empty below kMinOutlierSamples.
Image beauty_without_outliers(const RenderSession& session);

/// The picture for display: the display buffer if lens shaders map colours, else the film; then the
/// output shaders in order, both those that map single colours and those that process whole
/// pictures. Premultiplied RGBA before the view transform.
///
/// Checked: OutputOrder.* in tests/user_shaders/output_order_test.cpp
/// Inputs:  denoised: result of denoised_beauty() to use instead of the colours of the film; may be
///          null.
Image shown_image(const RenderSession& session, const NodeList& output_shaders,
                  const Image* denoised = nullptr);

/// Whether lens or output shaders change the content of the file.
bool is_mapped(const PictureFile& file, const World& world);

/// Whether the session has to store this data for the file.
bool needs(const PictureFile& file, LayerNeed need);
SurfaceValues surface_values(const PictureFile& file);
/// Whether layers of lights stand in it: in EXR files of the beauty.
bool holds_light_layers(const PictureFile& file);

/// View settings of the options for integer files.
ViewOptions view_options(const scene::RenderOptions& options);

/// Writes one file.
///
/// Model:   a file shows the picture after lens shaders and `shaders`, unless it is unmapped. If
///          these change colours, EXR files also contain the beauty of the film (RGBA) as the layer
///          `linear`; all other layers are linear, too (ADR 5). All EXR files of the beauty contain
///          light layers, Cryptomattes (with their header) and user buffers. A file of a user
///          buffer shows the buffer after `shaders`.
/// Inputs:  metadata: header attributes of EXR files. denoised: linear; files other than EXR show
///          it, mapped; EXR files contain it as the layer `denoised` in addition to the noisy
///          beauty.
/// Errors:  std::runtime_error with path and reason.
/// Checked: Output.* in output_test.cpp
void write_picture(const PictureFile& file, const RenderSession& session,
                   const std::map<std::string, ExrValue>& metadata,
                   const Image* denoised = nullptr);

}  // namespace oriel
