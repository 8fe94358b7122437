// SPDX-License-Identifier: Apache-2.0
// The files module: all code that requires OpenImageIO, behind one exported function.
#include <OpenImageIO/color.h>
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "image/dither.h"
#include "image/module.h"
#include "image/oiio/allowed_formats.h"
#include "image/oiio/local_source.h"
#include "image/oiio/texture_file.h"
#include "image/oiio/texture_input.h"

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

/// "a, b, c" for messages.
std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Fails with the known names unless `name` is one of them.
void check_name(const char* what, const std::string& name, const std::vector<std::string>& known) {
  if (!contains(known, name))
    throw std::runtime_error(std::string("unknown ") + what + " \"" + name +
                             "\"; the configuration has " + joined(known));
}

/// The name of linear Rec. 709 in a configuration: usual names, then the role scene_linear.
std::string linear_space(const OIIO::ColorConfig& config) {
  for (const char* name : {"Linear Rec.709 (sRGB)", "Linear Rec.709", "lin_rec709", "lin_srgb",
                           "Utility - Linear - sRGB", "Utility - Linear - Rec.709"})
    if (contains(config.getColorSpaceNames(), name)) return name;
  return "scene_linear";
}

/// A configuration without views in a temporary file, for look-up tables, which OpenColorIO only
/// applies within some configuration.
class PlainConfig {
 public:
  PlainConfig() {
    constexpr std::string_view kText =
        "ocio_profile_version: 2\nroles:\n  scene_linear: lin\n  default: lin\n"
        "file_rules:\n  - !<Rule> {name: Default, colorspace: lin}\n"
        "displays:\n  Screen:\n    - !<View> {name: Plain, colorspace: lin}\n"
        "active_displays: []\nactive_views: []\n"
        "colorspaces:\n  - !<ColorSpace>\n    name: lin\n";
    path_ = (std::filesystem::temp_directory_path() / "oriel-ocio-XXXXXX").string();
    const int file = mkstemp(path_.data());
    if (file < 0 || write(file, kText.data(), kText.size()) != static_cast<ssize_t>(kText.size()))
      throw std::runtime_error("the temporary folder is not writable");
    close(file);
  }
  ~PlainConfig() { unlink(path_.c_str()); }
  PlainConfig(const PlainConfig&) = delete;
  PlainConfig& operator=(const PlainConfig&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// A file in memory with a path, for writers that only write to paths.
class MemoryFile {
 public:
  /// Inputs:  pixel_bytes: upper bound of the content without header. The limit of the size of
  ///          files applies in memory, too, and these writers would not report it.
  explicit MemoryFile(std::size_t pixel_bytes)
      : descriptor_(::memfd_create("oriel-picture", MFD_CLOEXEC)) {
    constexpr std::size_t kHeaderBytes = 1 << 20;
    rlimit limit{};
    if (descriptor_ < 0) throw std::runtime_error("not enough memory");
    if (::getrlimit(RLIMIT_FSIZE, &limit) == 0 && pixel_bytes + kHeaderBytes > limit.rlim_cur)
      throw std::runtime_error("the file may exceed the size limit of this process (ulimit -f)");
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

  std::string content() const {
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0) throw std::runtime_error("the picture is lost");
    std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
    for (std::size_t at = 0; at < bytes.size();) {
      const ssize_t size =
          ::pread(descriptor_, &bytes[at], bytes.size() - at, static_cast<off_t>(at));
      if (size <= 0) throw std::runtime_error("the picture is lost");
      at += static_cast<std::size_t>(size);
    }
    return bytes;
  }

 private:
  int descriptor_;
};

class Module final : public FilesModule {
 public:
  void apply_ocio(Image& image, const OcioTransform& t) override {
    OIIO::ImageBuf buffer(
        OIIO::ImageSpec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT),
        image.pixels.data());
    std::optional<PlainConfig> plain;
    const char* of_environment = std::getenv("OCIO");
    if (t.config.empty() && !(of_environment && *of_environment)) {
      if (t.lut.empty())
        throw std::runtime_error("the environment variable OCIO names no configuration");
      plain.emplace();
    }
    OIIO::ColorConfig config(plain ? plain->path() : t.config);
    if (config.error()) fail(config.geterror());
    bool done = false;
    if (!t.lut.empty()) {
      // OpenColorIO searches relative names in the folder of the configuration.
      const std::string path = std::filesystem::absolute(t.lut).string();
      done = OIIO::ImageBufAlgo::ociofiletransform(buffer, buffer, path, true, false, &config);
    } else {
      if (config.getDisplayNames().empty())
        throw std::runtime_error("the configuration has no display");
      const std::string display = t.display.empty() ? config.getDefaultDisplayName() : t.display;
      check_name("display", display, config.getDisplayNames());
      const std::string view = t.view.empty() ? config.getDefaultViewName(display) : t.view;
      check_name("view", view, config.getViewNames(display));
      const std::string space = t.space.empty() ? linear_space(config) : t.space;
      if (!t.space.empty() && !contains(config.getRoles(), space))
        check_name("colour space", space, config.getColorSpaceNames());
      done = OIIO::ImageBufAlgo::ociodisplay(buffer, buffer, display, view, space, "", true, "", "",
                                             &config);
    }
    if (!done) fail(buffer.geterror());
  }

  Image read(const std::string& path) override {
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = oiio::open_allowed(path, &config);
    const OIIO::ImageSpec spec = input->spec();
    oiio::check_size(spec.width, spec.height, spec.nchannels);
    Image image(spec.width, spec.height, std::min(spec.nchannels, 4));
    if (!input->read_image(0, 0, 0, image.channels, OIIO::TypeDesc::FLOAT, image.pixels.data()))
      fail(input->geterror());
    return image;
  }

  std::string encode(const Image& image, const FileOptions& options) override {
    const auto output = OIIO::ImageOutput::create(options.type);
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
    OIIO::Filesystem::IOVecOutput buffer;
    std::optional<MemoryFile> file;
    std::string path = "memory." + options.type;
    if (output->supports("ioproxy"))
      output->set_ioproxy(&buffer);
    else
      path = file.emplace(from->pixels.size() * sizeof(float)).path();
    if (!output->open(path, spec)) fail(output->geterror());
    if (!output->write_image(OIIO::TypeDesc::FLOAT, from->pixels.data())) fail(output->geterror());
    if (!output->close()) fail(output->geterror());
    if (file) return file->content();
    return {reinterpret_cast<const char*>(buffer.buffer().data()), buffer.buffer().size()};
  }

  std::unique_ptr<Texture> open_texture(const std::string& path, float gamma,
                                        std::uint64_t most_tile_bytes) override {
    return oiio::open_texture_file(path, gamma, most_tile_bytes);
  }

  void set_source_opener(PixelSourceOpener opener) override {
    oiio::set_source_opener(std::move(opener));
  }

  std::unique_ptr<PixelSource> open_source(const std::string& path) override {
    return oiio::open_local_source(path);
  }

  void prepare_reading() override { OIIO::get_string_attribute("extension_list"); }

  void set_cache_megabytes(float pictures, float tiles) override {
    oiio::set_cache_megabytes(pictures, tiles);
  }

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
