// SPDX-License-Identifier: Apache-2.0
// All layers of EXR files in one table: names, channels, requirements, documentation, values.
#pragma once

#include <bitset>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "image/pixel_buffer.h"
#include "render/session.h"

namespace oriel {

/// Content of a file without layers. Intensity uses the luminance weights of the options. Bit is 1
/// if alpha is at least .5, else 0. Depth and the following views are layers.
enum class PixelView {
  ColorAlpha,
  Color,
  Alpha,
  Intensity,
  Bit,
  Depth,
  Normal,
  Motion,
  Tag,
  Coverage
};

/// Groups by which layers are requested.
enum class LayerGroup : std::uint8_t {
  Film,         ///< in EXR files by default
  Photometric,  ///< values in lux or cd/m2
  Motion,
  Outputs,   ///< outputs of materials
  Coverage,  ///< coverage of the instance that covers most of the pixel
  Always     ///< in each EXR file of the beauty if the session stores it; cannot be selected
};

/// What a session has to store for a layer.
enum class LayerNeed : std::uint8_t { None, Outputs, Irradiance, Mattes, LightLayers, UserBuffers };

/// One row of the table: a layer, or a family of layers that depends on the scene.
struct LayerSpec {
  std::string name;                   ///< name for --layers; for families a pattern
  std::string exr;                    ///< name in EXR files
  std::vector<std::string> channels;  ///< names in EXR files
  LayerGroup group;
  LayerNeed need = LayerNeed::None;
  const char* type = nullptr;  ///< in `output` statements; null = none
  PixelView view = PixelView::ColorAlpha;
  const char* about = "";                          ///< one line of documentation
  std::optional<SurfaceValue> surface_value = {};  ///< the layer shows that value
  /// Writes the values of film pixel (x, y); empty for families and surface values.
  std::function<void(const RenderSession& session, int x, int y, float* to)> value = {};
  /// Whether the session has the values; null = always.
  bool (*exists)(const RenderSession& session) = nullptr;
  /// Appends the layers of a family.
  void (*expand)(const RenderSession& session, std::vector<Layer>& layers) = nullptr;
  bool statistics = false;  ///< colour channels that are not a colour

  /// Layer::exact of the layer: all but colours.
  bool is_exact() const { return statistics || channels.size() != 3 || channels.front() != "R"; }
};

/// All rows in the order of the layers in a file.
/// Checked: LayerTable.* in layer_table_test.cpp
const std::vector<LayerSpec>& layer_table();

inline constexpr const char* kDenoisedLayer = "denoised";

/// A set of rows of the table.
class LayerSet {
 public:
  LayerSet() = default;
  /// The layer with that --layers name; empty if there is none.
  explicit LayerSet(std::string_view name);
  explicit LayerSet(LayerGroup group);
  /// The layers of `--layers all`.
  static LayerSet all();

  bool contains(std::size_t row) const { return rows_[row]; }
  bool empty() const { return rows_.none(); }
  bool needs(LayerNeed need) const;
  SurfaceValues surface_values() const;
  bool overlaps(const LayerSet& o) const { return (rows_ & o.rows_).any(); }
  LayerSet& operator|=(const LayerSet& o) { return rows_ |= o.rows_, *this; }
  LayerSet& operator-=(const LayerSet& o) { return rows_ &= ~o.rows_, *this; }
  friend LayerSet operator|(LayerSet a, const LayerSet& b) { return a |= b; }
  friend LayerSet operator-(LayerSet a, const LayerSet& b) { return a -= b; }
  bool operator==(const LayerSet&) const = default;

 private:
  std::bitset<64> rows_;
};

/// Names for --layers, in the order of the table.
std::vector<std::string> layer_names();
/// Find a row by its --layers name, by its type in `output` statements ("z"), or by view; null =
/// none.
const LayerSpec* find_layer_spec(std::string_view name);
const LayerSpec* layer_of_type(std::string_view type);
const LayerSpec* layer_of_view(PixelView view);

/// The values of a row that is not a family, as an image of the full frame.
Image layer_image(const RenderSession& session, const LayerSpec& row);
/// An image of the full frame with the values of f(x, y, values) inside the film window.
Image collect_pixels(const RenderSession& session, int channels,
                     const std::function<void(int x, int y, float* to)>& f);

/// The table of docs/outputs.md: name, EXR channels, documentation.
std::string layer_documentation();

}  // namespace oriel
