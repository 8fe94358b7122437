// SPDX-License-Identifier: Apache-2.0
// The files module: all code that requires OpenImageIO, behind one exported function.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "image/dither.h"
#include "image/module.h"
#include "image/oiio/texture_file.h"

namespace oriel {
namespace {

OIIO::TypeDesc type_of(SampleFormat format) {
  switch (format) {
    case SampleFormat::U16:
      return OIIO::TypeDesc::UINT16;
    case SampleFormat::Half:
      return OIIO::TypeDesc::HALF;
    case SampleFormat::Float:
      return OIIO::TypeDesc::FLOAT;
    case SampleFormat::U8:
      break;
  }
  return OIIO::TypeDesc::UINT8;
}

[[noreturn]] void fail(const std::string& why) {
  throw std::runtime_error(why.empty() ? "the image library gives no reason" : why);
}

/// The picture for a file type without alpha: grey or RGB.
Image without_alpha(const Image& image) {
  const int n = image.channels < 3 ? 1 : 3;
  Image out(image.width, image.height, n);
  for (std::size_t p = 0; p < image.pixel_count(); ++p)
    std::copy_n(image.pixels.data() + p * image.channels, n, out.pixels.data() + p * n);
  return out;
}

Image dithered(Image image) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < image.channels; ++c) image.at(x, y)[c] += dither_offset(x, y, c) / 255.0f;
  return image;
}

class Module final : public FilesModule {
 public:
  Image read(const std::string& path) override {
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::open(path, &config);
    if (!input) fail(OIIO::geterror());
    const OIIO::ImageSpec spec = input->spec();
    oiio::check_size(spec.width, spec.height, spec.nchannels);
    Image image(spec.width, spec.height, std::min(spec.nchannels, 4));
    if (!input->read_image(0, 0, 0, image.channels, OIIO::TypeDesc::FLOAT, image.pixels.data()))
      fail(input->geterror());
    return image;
  }

  void write(const std::string& path, const Image& image, const FileOptions& options) override {
    const auto output = OIIO::ImageOutput::create(path);
    if (!output) fail(OIIO::geterror());
    const bool no_alpha = image.channels % 2 == 0 && !output->supports("alpha");
    Image changed;
    const Image* from = &image;
    if (no_alpha) from = &(changed = without_alpha(image));
    if (options.dither && options.format == SampleFormat::U8) from = &(changed = dithered(*from));

    OIIO::ImageSpec spec(from->width, from->height, from->channels, type_of(options.format));
    // Without this attribute the writer would divide colour by alpha.
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("CompressionQuality", std::clamp(options.jpeg_quality, 1, 100));
    if (!output->open(path, spec)) fail(output->geterror());
    if (!output->write_image(OIIO::TypeDesc::FLOAT, from->pixels.data())) fail(output->geterror());
    if (!output->close()) fail(output->geterror());
  }

  std::unique_ptr<Texture> open_texture(const std::string& path, float gamma) override {
    return oiio::open_texture_file(path, gamma);
  }

  void set_cache_megabytes(float megabytes) override { oiio::set_cache_megabytes(megabytes); }

  TextureStatistics texture_statistics() override { return oiio::texture_statistics(); }
};

}  // namespace
}  // namespace oriel

extern "C" __attribute__((visibility("default"))) oriel::FilesModule* oriel_image_files_module(
    int version) {
  if (version != oriel::kFilesModuleVersion) return nullptr;
  // The renderer has its own threads; the thread pools of the library would compete with them.
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
  OIIO::attribute("limits:imagesize_MB", 4096);
  // Never destroyed, because texture lookups may run until the end of the process.
  static oriel::FilesModule* const module = new oriel::Module;
  return module;
}
