// SPDX-License-Identifier: Apache-2.0
#include "image/files.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>

#include "base/durable_file.h"
#include "image/exr.h"
#include "image/module.h"
#include "image/picture_target.h"
#include "image/png.h"
#include "image/reader_process.h"

namespace oriel {
namespace {

std::string extension_of(const std::string& path) {
  std::string e = std::filesystem::path(path).extension().string();
  std::transform(e.begin(), e.end(), e.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return e;
}

void write_plain_exr(const std::string& path, const Image& image, const FileOptions& options) {
  static const std::vector<std::string> names[] = {
      {"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
  ExrOptions exr;
  if (options.format == SampleFormat::Half) exr.precision = ExrPrecision::Half;
  write_exr(path, {{"", names[image.channels - 1], image}}, exr);
}

}  // namespace

void apply_ocio(Image& image, const OcioTransform& transform) {
  try {
    files_module().apply_ocio(image, transform);
  } catch (const std::exception& e) {
    throw std::runtime_error(std::string("cannot apply the OpenColorIO transform: ") + e.what());
  }
}

Image read_image(const std::string& path) {
  if (!readers_are_isolated()) return read_image_here(path);
  try {
    return read_image_isolated(path);
  } catch (const std::exception& e) {
    const std::string why = e.what();
    if (why.starts_with("cannot ")) throw;  // the reader process has named the file
    throw std::runtime_error("cannot read '" + path + "': " + why);
  }
}

Image read_image_here(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == ".exr") return read_exr_image(path);
  if (extension == ".png") return read_png(path);
  try {
    return files_module().read(path);
  } catch (const std::exception& e) {
    throw std::runtime_error("cannot read '" + path + "': " + e.what());
  }
}

void write_image(const std::string& path, const Image& image, const FileOptions& options) {
  if (image.empty() || image.channels < 1 || image.channels > 4)
    throw std::runtime_error("cannot write '" + path + "': a picture has 1 to 4 channels");
  const std::string extension = options.type.empty() ? extension_of(path) : "." + options.type;
  if (extension == ".exr") return write_plain_exr(path, image, options);
  if (extension == ".png") {
    PngOptions png;
    png.bits = options.format == SampleFormat::U8 ? 8 : 16;
    png.dither = options.dither;
    if (options.srgb) png.encoding = PngEncoding::Srgb;
    return write_png(path, image, png);
  }
  try {
    if (extension.size() < 2) throw std::runtime_error("the name has no extension");
    check_picture_target(path);
    FileOptions typed = options;
    typed.type = extension.substr(1);
    const std::string content = files_module().encode(image, typed);
    DurableFile file(path);
    file.write(content);
    file.commit();
  } catch (const std::exception& e) {
    throw std::runtime_error("cannot write '" + path + "': " + e.what());
  }
}

}  // namespace oriel
