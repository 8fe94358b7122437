// SPDX-License-Identifier: Apache-2.0
#include "pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/diagnostic.h"
#include "image/files.h"
#include "suggest.h"

namespace oriel::app {
namespace {

UserError missing_file(const std::string& path) {
  const std::string near = nearest_file(path);
  return UserError(fmt::format("cannot read '{}': there is no such file{}", path,
                               near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
}

}  // namespace

UserError missing_layer(const std::string& path, const std::string& name,
                        const std::vector<Layer>& layers) {
  std::vector<std::string> names;
  names.reserve(layers.size());
  for (const Layer& layer : layers) names.push_back(layer.name);
  return UserError(fmt::format("'{}' has no layer {}{}", path, name,
                               name == kIlluminanceLayer
                                   ? "; it is written by oriel render --layers illuminance"
                                   : suggestion(name, names)));
}

Image read_named_picture(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw missing_file(path);
  if (std::filesystem::is_directory(status))
    throw UserError(fmt::format("cannot read '{}': it is a folder", path));
  return read_image(path);
}

Image read_linear_picture(const std::string& path) {
  Image shown = read_named_picture(path);
  if (std::filesystem::path(path).extension() != ".exr") return shown;
  const ExrFile file = read_exr(path);
  const Layer* linear = find_layer(file.layers, kLinearLayer);
  return linear ? linear->image : shown;
}

bool is_linear_file(const std::string& path) {
  std::string suffix = std::filesystem::path(path).extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return suffix == ".exr" || suffix == ".hdr";
}

}  // namespace oriel::app
