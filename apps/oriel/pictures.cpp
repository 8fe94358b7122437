// SPDX-License-Identifier: Apache-2.0
#include "pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "command.h"
#include "image/exr.h"
#include "image/files.h"

namespace oriel::app {

Image read_named_picture(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    throw UserError(fmt::format("cannot read '{}': there is no such file", path));
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
