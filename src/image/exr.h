// SPDX-License-Identifier: Apache-2.0
// OpenEXR input and output: linear float pictures with named layers, the primary output format.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "image/pixel_buffer.h"

namespace oriel {

// Conventions
//   Channel names: the layer's name, a dot, the channel's name. The empty layer name (beauty) has
//   no prefix: R, G, B, A. A layer {"Z", {""}} is the bare channel Z. The chromaticities in the
//   header are those of Rec. 709 with white D65.

/// Channel type of colour. Exact layers, depth (Z) and ids (Crypto...) are always 32-bit.
enum class ExrPrecision : std::uint8_t {
  Float,
  Half,       ///< values beyond 65504 are clamped
  HalfIfFits  ///< layers with values beyond 65504 are written in 32 bits
};

enum class ExrCompression : std::uint8_t { None, Rle, Zips, Zip, Piz, Dwaa, Dwab };
/// Lower-case names in the order of the values: "none", "rle", ...
inline constexpr std::array<std::string_view, 7> kExrCompressionNames = {
    "none", "rle", "zips", "zip", "piz", "dwaa", "dwab"};

/// Row-major, row vectors, as in OpenEXR: translation in elements 12 to 14.
using ExrMatrix = std::array<float, 16>;
using ExrValue = std::variant<std::string, int, float, ExrMatrix>;

/// A rectangle of pixels from the top left corner, half open.
struct ExrWindow {
  int x0, y0, x1, y1;
};

struct ExrOptions {
  ExrPrecision precision = ExrPrecision::Float;
  ExrCompression compression = ExrCompression::Zip;
  int threads = 0;  ///< compression threads; 0 = compress on the calling thread
  std::map<std::string, ExrValue> metadata;  ///< attributes of the header
  /// Data window; unset = the whole picture. The display window is always the whole picture.
  std::optional<ExrWindow> window;
};

/// Writes the layers into one single-part scan-line file, atomically.
///
/// Model:   DWAA and DWAB compress channels R, G, B and Y with loss, at half precision. Exact
///          layers have lower-case channel names in such files (normal.y), which OpenEXR
///          compresses without loss.
/// Inputs:  layers: all of one size; every channel name unique within the file.
/// Errors:  std::runtime_error with the path if sizes differ, names repeat or the file cannot be
///          written.
/// Checked: Exr.*
void write_exr(const std::string& path, const std::vector<Layer>& layers,
               const ExrOptions& options = {});

struct ExrFile {
  std::vector<Layer> layers;  ///< beauty first, then in file order
  /// Attributes of type string, int, float and M44f, except those that describe the pixels.
  std::map<std::string, ExrValue> metadata;
  bool has_chromaticities = false;
  float chromaticities[8] = {};  ///< xy of red, green, blue, white
};

/// An attribute as text or as a number; unset if it is missing or has another type. Numbers in text
/// attributes are parsed, for files of earlier versions.
std::optional<std::string> text_attribute(const ExrFile& file, const std::string& name);
std::optional<float> number_attribute(const ExrFile& file, const std::string& name);

struct ExrLimits {
  int largest_side = 1 << 16;
  std::size_t most_bytes = std::size_t(16) << 30;  ///< limit for the decoded pixels
};

/// Reads every flat part and channel as float. Channels are grouped into layers by the text before
/// the last dot, and by the name of the part if the file has several parts.
///
/// Model:   the pictures cover the display window. Pixels of the data window outside the display
///          window are dropped; pixels outside the data window are 0. Deep parts are skipped.
///          Subsampled channels (luminance-chroma files) are unsupported.
/// Errors:  std::runtime_error with path and reason if the file is not a valid EXR file or exceeds
///          the limits. A header may not request more than 4096 times the length of the file.
/// Checked: Exr.BrokenFilesThrowAndNeverCrash
ExrFile read_exr(const std::string& path, const ExrLimits& limits = {});

/// The default picture of a file: up to four channels of its first layer, which is the beauty (R,
/// G, B, A in this order) if the file has one.
Image read_exr_image(const std::string& path, const ExrLimits& limits = {});

}  // namespace oriel
