// SPDX-License-Identifier: Apache-2.0
#include "image/exr.h"

#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "base/durable_file.h"
#include "image/picture_target.h"

namespace oriel {
namespace {

// Memory that any file may request regardless of its length, and the maximum expansion of longer
// files: ZIP reaches about 1000 : 1, lossy codecs of constant pictures somewhat more.
constexpr std::size_t kFreeBytes = std::size_t(256) << 20;
constexpr std::size_t kMaxExpansion = 4096;
constexpr std::size_t kMaxChannels = 4096;
constexpr float kLargestHalf = HALF_MAX;

[[noreturn]] void fail(const std::string& what, const std::string& path, const std::string& why) {
  throw std::runtime_error("cannot " + what + " '" + path + "': " + why);
}

std::string full_name(const std::string& layer, const std::string& channel) {
  if (layer.empty()) return channel;
  return channel.empty() ? layer : layer + "." + channel;
}

/// Depth and ids require all 32 bits.
bool is_exact(const Layer& layer) {
  return layer.exact || layer.name.starts_with("Crypto") || layer.name == "Z" ||
         layer.name == "ZBack" || layer.name == "depth";
}

bool is_lossy(ExrCompression c) { return c == ExrCompression::Dwaa || c == ExrCompression::Dwab; }

Imf::Compression imf_compression(ExrCompression c) {
  constexpr Imf::Compression kOf[] = {
      Imf::NO_COMPRESSION,  Imf::RLE_COMPRESSION,  Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION,
      Imf::PIZ_COMPRESSION, Imf::DWAA_COMPRESSION, Imf::DWAB_COMPRESSION};
  return kOf[static_cast<std::size_t>(c)];
}

void insert_attribute(Imf::Header& header, const std::string& name, const ExrValue& value) {
  if (const auto* text = std::get_if<std::string>(&value))
    header.insert(name, Imf::StringAttribute(*text));
  else if (const auto* whole = std::get_if<int>(&value))
    header.insert(name, Imf::IntAttribute(*whole));
  else if (const auto* number = std::get_if<float>(&value))
    header.insert(name, Imf::FloatAttribute(*number));
  else {
    Imath::M44f matrix;
    const auto& from = std::get<ExrMatrix>(value);
    std::copy(from.begin(), from.end(), matrix.getValue());
    header.insert(name, Imf::M44fAttribute(matrix));
  }
}

/// The nearest half, ties to even. Finite values beyond its range are clamped, since an infinity
/// would spread in later filters. Integer arithmetic, because emulated processors flush subnormal
/// results of the conversion instruction.
half to_half(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(std::clamp(value, -kLargestHalf, kLargestHalf));
  const std::uint32_t sign = bits >> 16 & 0x8000u, magnitude = bits & 0x7fffffffu;
  const std::uint32_t exponent = magnitude >> 23;
  std::uint32_t result = 0;
  if (std::isnan(value)) {
    result = 0x7e00;
  } else if (exponent >= 113) {  // at least 2^-14, the smallest normal half
    result = (magnitude - (112u << 23) + 0xfffu + (magnitude >> 13 & 1)) >> 13;
  } else if (exponent >= 102) {  // subnormal: multiples of 2^-24
    const std::uint32_t mantissa = (magnitude & 0x7fffffu) | 0x800000u, shift = 126 - exponent;
    const std::uint32_t whole = mantissa >> shift, rest = mantissa - (whole << shift);
    const std::uint32_t tie = 1u << (shift - 1);
    result = whole + (rest > tie || (rest == tie && (whole & 1)) ? 1 : 0);
  }
  half h;
  h.setBits(static_cast<std::uint16_t>(sign | result));
  return h;
}

/// Whether the layer is stored with 16 bits per channel.
bool is_half(const Layer& layer, const ExrOptions& options) {
  if (options.precision == ExrPrecision::Float || is_exact(layer)) return false;
  if (options.precision == ExrPrecision::Half || is_lossy(options.compression)) return true;
  return std::none_of(layer.image.pixels.begin(), layer.image.pixels.end(),
                      [](float v) { return std::abs(v) > kLargestHalf; });
}

/// Name of a channel in the file. Lower case protects exact layers from lossy compression.
std::string file_channel(const Layer& layer, int channel, ExrCompression compression) {
  std::string name = layer.channel_names[static_cast<std::size_t>(channel)];
  if (is_lossy(compression) && is_exact(layer))
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return full_name(layer.name, name);
}

void check_layers(const std::string& path, const std::vector<Layer>& layers) {
  if (layers.empty()) fail("write", path, "there are no layers to write");
  const Image& first = layers.front().image;
  std::set<std::string> names;
  for (const Layer& layer : layers) {
    const Image& image = layer.image;
    if (image.width < 1 || image.height < 1 || image.width != first.width ||
        image.height != first.height)
      fail("write", path,
           "layer '" + layer.name + "' is empty or differs in size from the first layer");
    if (layer.channel_names.size() != std::size_t(image.channels) ||
        image.pixels.size() != image.pixel_count() * image.channels)
      fail("write", path,
           "layer '" + layer.name + "' has a channel count that differs from its list of names");
    for (const std::string& channel : layer.channel_names) {
      const std::string name = full_name(layer.name, channel);
      if (name.empty() || !names.insert(name).second)
        fail("write", path, "channel '" + name + "' is a duplicate or has no name");
    }
  }
}

/// A stream that keeps the first write error of its file, because the destructor of Imf::OutputFile
/// ignores errors.
class ExrStream final : public Imf::OStream {
 public:
  ExrStream(DurableFile& file, const std::string& path) : OStream(path.c_str()), file_(file) {}
  void write(const char data[], int size) override {
    file_.write(data, static_cast<std::size_t>(size));
  }
  std::uint64_t tellp() override { return file_.position(); }
  void seekp(std::uint64_t position) override { file_.seek(position); }

 private:
  DurableFile& file_;
};

void write_file(const std::string& path, const std::vector<Layer>& layers,
                const ExrOptions& options) {
  const Image& first = layers.front().image;
  const ExrWindow w = options.window.value_or(ExrWindow{0, 0, first.width, first.height});
  Imf::Header header(Imath::Box2i({0, 0}, {first.width - 1, first.height - 1}),
                     Imath::Box2i({w.x0, w.y0}, {w.x1 - 1, w.y1 - 1}));
  header.compression() = imf_compression(options.compression);
  Imf::addChromaticities(header, Imf::Chromaticities());  // default: Rec. 709, D65
  for (const auto& [key, value] : options.metadata) insert_attribute(header, key, value);

  // OpenEXR writes the type of the slice, so convert to half here.
  std::vector<std::vector<half>> halves(layers.size());
  Imf::FrameBuffer frame;
  for (std::size_t l = 0; l < layers.size(); ++l) {
    const Image& image = layers[l].image;
    const bool as_half = is_half(layers[l], options);
    if (as_half) {
      halves[l].resize(image.pixels.size());
      std::transform(image.pixels.begin(), image.pixels.end(), halves[l].begin(), to_half);
    }
    for (int c = 0; c < image.channels; ++c) {
      const std::string name = file_channel(layers[l], c, options.compression);
      const Imf::PixelType type = as_half ? Imf::HALF : Imf::FLOAT;
      const std::size_t size = as_half ? sizeof(half) : sizeof(float);
      const void* base = as_half ? static_cast<const void*>(halves[l].data() + c)
                                 : static_cast<const void*>(image.pixels.data() + c);
      header.channels().insert(name, Imf::Channel(type));
      // OpenEXR only reads through this pointer, but Imf::Slice takes no const pointer.
      frame.insert(name, Imf::Slice(type, static_cast<char*>(const_cast<void*>(base)),
                                    size * image.channels, size * image.channels * image.width));
    }
  }
  check_picture_target(path);
  DurableFile file(path);
  {
    ExrStream stream(file, path);
    Imf::OutputFile output(stream, header, std::max(0, options.threads));
    output.setFrameBuffer(frame);
    output.writePixels(w.y1 - w.y0);
  }
  file.commit();
}

struct Extent {
  std::int64_t width, height;
};

/// The size of a window; throws if the window is empty, malformed or beyond the limits.
Extent checked_extent(const std::string& path, const Imath::Box2i& box, int largest_side) {
  const Extent e{std::int64_t(box.max.x) - box.min.x + 1, std::int64_t(box.max.y) - box.min.y + 1};
  if (e.width < 1 || e.height < 1) fail("read", path, "its picture is empty");
  if (e.width > largest_side || e.height > largest_side)
    fail("read", path,
         "it claims " + std::to_string(e.width) + " x " + std::to_string(e.height) + " pixels");
  return e;
}

/// Groups the channels of one part into layers; R, G, B, A come first within each layer.
std::vector<Layer> layers_of(const Imf::ChannelList& list) {
  std::vector<Layer> layers;
  for (auto i = list.begin(); i != list.end(); ++i) {
    const std::string name = i.name();
    const std::size_t dot = name.rfind('.');
    std::string layer = dot == std::string::npos ? "" : name.substr(0, dot);
    std::string channel = dot == std::string::npos ? name : name.substr(dot + 1);
    if (layer.empty() && std::string("RGBAY").find(channel) == std::string::npos)
      std::swap(layer, channel);
    auto found =
        std::find_if(layers.begin(), layers.end(), [&](const Layer& l) { return l.name == layer; });
    if (found == layers.end()) found = layers.insert(layers.end(), Layer{layer, {}, {}});
    found->channel_names.push_back(channel);
  }
  for (Layer& layer : layers)
    std::stable_sort(layer.channel_names.begin(), layer.channel_names.end(),
                     [](const std::string& a, const std::string& b) {
                       const std::string order = "RrGgBbAa";
                       const auto rank = [&](const std::string& s) {
                         return s.size() == 1 ? std::min(order.find(s), order.size())
                                              : order.size();
                       };
                       return rank(a) < rank(b);
                     });
  std::stable_partition(layers.begin(), layers.end(),
                        [](const Layer& l) { return l.name.empty(); });
  return layers;
}

/// Reads one flat part line by line and stores the pixels inside the display window.
void read_part(const std::string& path, Imf::MultiPartInputFile& file, int index,
               const std::string& part_name, const ExrLimits& limits, std::size_t& bytes_left,
               std::vector<Layer>& out) {
  const Imf::Header& header = file.header(index);
  const Imath::Box2i data = header.dataWindow();
  const Imath::Box2i display = header.displayWindow();
  const Extent d = checked_extent(path, data, limits.largest_side);
  const Extent shown = checked_extent(path, display, limits.largest_side);

  std::size_t channels = 0;
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i, ++channels)
    if (i.channel().xSampling != 1 || i.channel().ySampling != 1)
      fail("read", path, "its channel '" + std::string(i.name()) + "' is subsampled");
  if (channels > kMaxChannels)
    fail("read", path, "its header lists more channels than are supported");
  const std::size_t area =
      std::size_t(std::max(d.width, shown.width)) * std::size_t(std::max(d.height, shown.height));
  const std::size_t bytes = area * channels * sizeof(float);
  if (bytes > bytes_left)
    fail("read", path, "its header declares more pixels than a file of this length can contain");
  bytes_left -= bytes;

  std::vector<Layer> layers = layers_of(header.channels());
  std::vector<std::vector<float>> rows;
  for (Layer& layer : layers) {
    layer.image = Image(int(shown.width), int(shown.height), int(layer.channel_names.size()));
    rows.emplace_back(std::size_t(d.width) * layer.image.channels);
  }

  Imf::InputPart part(file, index);
  const int x0 = std::max(data.min.x, display.min.x), x1 = std::min(data.max.x, display.max.x);
  const int y0 = std::max(data.min.y, display.min.y), y1 = std::min(data.max.y, display.max.y);
  Imf::FrameBuffer frame;
  for (std::size_t l = 0; l < layers.size(); ++l) {
    const int n = layers[l].image.channels;
    for (int c = 0; c < n; ++c) {
      // The y stride of 0 makes every line land in the same row buffer.
      char* base = reinterpret_cast<char*>(rows[l].data() + c) -
                   std::ptrdiff_t(data.min.x) * std::ptrdiff_t(sizeof(float) * n);
      frame.insert(full_name(layers[l].name, layers[l].channel_names[c]),
                   Imf::Slice(Imf::FLOAT, base, sizeof(float) * n, 0, 1, 1, 0.0));
    }
  }
  part.setFrameBuffer(frame);
  for (int y = y0; y <= y1; ++y) {
    part.readPixels(y);
    if (x0 > x1) continue;
    for (std::size_t l = 0; l < layers.size(); ++l) {
      const int n = layers[l].image.channels;
      const float* from = rows[l].data() + std::size_t(x0 - data.min.x) * n;
      std::copy(from, from + std::size_t(x1 - x0 + 1) * n,
                layers[l].image.at(x0 - display.min.x, y - display.min.y));
    }
  }
  for (Layer& layer : layers) {
    if (!part_name.empty()) layer.name = full_name(part_name, layer.name);
    out.push_back(std::move(layer));
  }
}

void read_header(const Imf::Header& header, ExrFile& out) {
  const std::set<std::string> of_pixels = {
      "pixelAspectRatio",   "screenWindowWidth", "chunkCount", "version", "name", "type",
      "dwaCompressionLevel"};
  for (auto i = header.begin(); i != header.end(); ++i) {
    if (of_pixels.contains(i.name())) continue;
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute()))
      out.metadata[i.name()] = text->value();
    else if (const auto* whole = dynamic_cast<const Imf::IntAttribute*>(&i.attribute()))
      out.metadata[i.name()] = whole->value();
    else if (const auto* number = dynamic_cast<const Imf::FloatAttribute*>(&i.attribute()))
      out.metadata[i.name()] = number->value();
    else if (const auto* m = dynamic_cast<const Imf::M44fAttribute*>(&i.attribute())) {
      ExrMatrix values;
      std::copy_n(m->value().getValue(), values.size(), values.begin());
      out.metadata[i.name()] = values;
    }
  }
  if (!Imf::hasChromaticities(header)) return;
  const Imf::Chromaticities& c = Imf::chromaticities(header);
  const float xy[8] = {c.red.x,  c.red.y,  c.green.x, c.green.y,
                       c.blue.x, c.blue.y, c.white.x, c.white.y};
  std::copy(std::begin(xy), std::end(xy), out.chromaticities);
  out.has_chromaticities = true;
}

}  // namespace

std::optional<std::string> text_attribute(const ExrFile& file, const std::string& name) {
  const auto found = file.metadata.find(name);
  if (found == file.metadata.end()) return std::nullopt;
  const auto* text = std::get_if<std::string>(&found->second);
  return text ? std::optional(*text) : std::nullopt;
}

std::optional<float> number_attribute(const ExrFile& file, const std::string& name) {
  const auto found = file.metadata.find(name);
  if (found == file.metadata.end()) return std::nullopt;
  if (const auto* number = std::get_if<float>(&found->second)) return *number;
  if (const auto* whole = std::get_if<int>(&found->second)) return static_cast<float>(*whole);
  const auto* text = std::get_if<std::string>(&found->second);
  if (!text) return std::nullopt;
  char* end = nullptr;
  const float value = std::strtof(text->c_str(), &end);
  return end == text->c_str() ? std::nullopt : std::optional(value);
}

void write_exr(const std::string& path, const std::vector<Layer>& layers,
               const ExrOptions& options) {
  check_layers(path, layers);
  try {
    if (options.threads > Imf::globalThreadCount()) Imf::setGlobalThreadCount(options.threads);
    write_file(path, layers, options);
  } catch (const std::exception& e) {
    fail("write", path, e.what());
  }
}

ExrFile read_exr(const std::string& path, const ExrLimits& limits) {
  try {
    const std::size_t length = std::filesystem::file_size(path);
    std::size_t bytes_left =
        std::min(limits.most_bytes, std::max(kFreeBytes, kMaxExpansion * length));
    Imf::MultiPartInputFile file(path.c_str(), 0);
    ExrFile out;
    for (int p = 0; p < file.parts(); ++p) {
      const Imf::Header& header = file.header(p);
      if (p == 0) read_header(header, out);
      if (header.hasType() && Imf::isDeepData(header.type())) continue;
      const std::string part = file.parts() > 1 && header.hasName() ? header.name() : "";
      read_part(path, file, p, part, limits, bytes_left, out.layers);
    }
    if (out.layers.empty()) throw std::runtime_error("it contains no flat picture");
    return out;
  } catch (const std::exception& e) {
    const std::string why = e.what();
    if (why.rfind("cannot read '", 0) == 0) throw;
    fail("read", path, why);
  }
}

Image read_exr_image(const std::string& path, const ExrLimits& limits) {
  ExrFile file = read_exr(path, limits);
  Layer& first = file.layers.front();
  if (first.image.channels <= 4) return std::move(first.image);

  // Only the first four channels of a layer are used.
  Image out(first.image.width, first.image.height, 4);
  for (std::size_t p = 0; p < out.pixel_count(); ++p)
    std::copy_n(first.image.pixels.data() + p * first.image.channels, 4, out.pixels.data() + p * 4);
  return out;
}

}  // namespace oriel
