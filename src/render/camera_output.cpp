// SPDX-License-Identifier: Apache-2.0
#include "render/camera_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "runtime/binder.h"

namespace oriel {
namespace {

namespace fs = std::filesystem;

struct Format {
  std::string_view name;       ///< as the language or a suffix spells it
  std::string_view extension;  ///< as the writers know it
  bool linear = false;
};

// Formats of the language that files can be written in today, and suffixes that mean the same.
constexpr std::array<Format, 15> kFormats = {{{"exr", "exr", true},
                                              {"hdr", "hdr", true},
                                              {"png", "png"},
                                              {"jpg", "jpg"},
                                              {"jpeg", "jpg"},
                                              {"tif", "tif"},
                                              {"tiff", "tif"},
                                              {"tifu", "tif"},
                                              {"tga", "tga"},
                                              {"bmp", "bmp"},
                                              {"ppm", "ppm"},
                                              {"iff", "iff"},
                                              {"sgi", "sgi"},
                                              {"rgb", "sgi"},
                                              {"rla", "rla"}}};

const Format* find_format(std::string_view name) {
  const auto at = std::find_if(kFormats.begin(), kFormats.end(),
                               [&](const Format& f) { return f.name == name; });
  return at == kFormats.end() ? nullptr : &*at;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string suffix_of(const std::string& path) {
  const std::string suffix = lower(fs::path(path).extension().string());
  return suffix.empty() ? suffix : suffix.substr(1);
}

/// What one word of the type list means.
struct Type {
  Channels channels;
  unsigned layer = 0;
  SampleFormat samples = SampleFormat::U8;
};

std::optional<Type> read_type(std::string word) {
  if (!word.empty() && (word[0] == '+' || word[0] == '-')) word.erase(0, 1);
  Type type{Channels::ColorAlpha};
  const auto take = [&](std::string_view suffix, SampleFormat samples) {
    if (!word.ends_with(suffix)) return;
    word.resize(word.size() - suffix.size());
    type.samples = samples;
  };
  take("_16", SampleFormat::U16);
  take("_fp", SampleFormat::Float);
  take("_h", SampleFormat::Half);
  if (word == "rgba") return type;
  if (word == "rgb") return type.channels = Channels::Color, type;
  if (word == "rgbe")
    return type.channels = Channels::Color, type.samples = SampleFormat::Float, type;
  if (word == "a") return type.channels = Channels::Alpha, type;
  if (word == "z") return type.channels = Channels::Depth, type.layer = kLayerDepth, type;
  if (word == "n") return type.channels = Channels::Normal, type.layer = kLayerNormal, type;
  return std::nullopt;
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    std::string word = text.substr(at, end - at);
    std::erase(word, ' ');
    if (!word.empty()) words.push_back(lower(word));
    at = end + 1;
  }
  return words;
}

class OutputReader {
 public:
  OutputReader(const OutputRoots& roots, Diagnostics& diagnostics)
      : roots_(roots), diagnostics_(diagnostics) {}

  std::optional<PictureFile> read(const scene::Output& output) {
    PictureFile file{.path = allowed_path(output.file, roots_)};
    if (file.path.empty()) {
      diagnostics_.warning("OR-RN-050", output.where,
                           fmt::format("output \"{}\" lies outside of the scene's folder and is "
                                       "not written",
                                       output.file),
                           "name the file with -o");
      return std::nullopt;
    }
    std::string types = output.types;
    const Format* format = choose_format(output, types);
    if (!format) {
      diagnostics_.warning("OR-RN-051", output.where,
                           fmt::format("no file of format \"{}\" can be written; output \"{}\" is "
                                       "left out",
                                       output.format, output.file),
                           "exr, hdr, png, jpg, tif, tga, bmp, ppm, iff, sgi and rla can");
      return std::nullopt;
    }
    file.format = format->extension;
    file.linear = format->linear;
    if (!read_types(types, output, file)) return std::nullopt;
    for (const scene::Statement& m : output.modifiers)
      if (m.keyword == "quality" && !m.values.empty() && !m.values[0].numbers.empty())
        file.quality = std::clamp(static_cast<int>(m.values[0].numbers[0]), 1, 100);
    return file;
  }

 private:
  /// Three strings: the format as written. Two: the suffix, else the one word there is; which is
  /// moved to the types when it is one.
  const Format* choose_format(const scene::Output& output, std::string& types) const {
    const std::string written = lower(output.format);
    if (!types.empty() && !written.empty()) return find_format(written);
    const std::string word = written.empty() ? types : written;
    if (read_type(word)) types = word;
    if (const Format* by_suffix = find_format(suffix_of(output.file))) return by_suffix;
    return find_format(word);
  }

  bool read_types(const std::string& types, const scene::Output& output, PictureFile& file) {
    std::optional<Type> first;
    file.layers = 0;
    for (const std::string& word : split(types)) {
      const std::optional<Type> type = read_type(word);
      if (!type) {
        diagnostics_.warning("OR-RN-051", output.where,
                             fmt::format("no picture of type \"{}\" is made; it is left out of "
                                         "output \"{}\"",
                                         word, output.file),
                             "rgb, rgba, a, z and n are");
        continue;
      }
      file.layers |= type->layer;
      if (!first) first = type;
    }
    if (!first && !types.empty()) return false;
    const Type type = first.value_or(Type{Channels::ColorAlpha});
    file.channels = type.channels;
    file.samples = type.samples;
    // An integer type in a float file is a promise that the file does not need.
    const bool is_integer = type.samples == SampleFormat::U8 || type.samples == SampleFormat::U16;
    if (file.linear && is_integer) file.samples = SampleFormat::Float;
    // Float pixels in any other file are film values too.
    if (!is_integer) file.linear = true;
    return true;
  }

  const OutputRoots& roots_;
  Diagnostics& diagnostics_;
};

/// Binds output shaders one list after the other. A shader of an output list names no lights.
class ShaderReader {
 public:
  ShaderReader(const scene::Scene& scene, const Registry& registry, World& world,
               Diagnostics& diagnostics)
      : binder_(scene, registry, world, no_lights_, diagnostics), diagnostics_(diagnostics) {}

  void append(const scene::Output& output, NodeList& nodes) {
    for (const ShaderNode* node : binder_.bind(output.shaders)) {
      if (node->spec().lens)
        nodes.push_back(node);
      else
        diagnostics_.warning("OR-RN-052", output.where,
                             fmt::format("shader \"{}\" does not act as an output shader; skipped",
                                         node->spec().name));
    }
  }

 private:
  std::unordered_map<std::string, std::vector<int>> no_lights_;
  Binder binder_;
  Diagnostics& diagnostics_;
};

}  // namespace

const scene::Camera* find_camera(const scene::Scene& scene, const scene::RenderCommand& command,
                                 const std::string& name) {
  const std::string& wanted = name.empty() ? command.camera : name;
  if (const auto* instance = scene.get<scene::Instance>(wanted))
    return scene.get<scene::Camera>(instance->element);
  return scene.get<scene::Camera>(wanted);
}

std::string allowed_path(const std::string& file, const OutputRoots& roots) {
  if (file.empty()) return {};
  std::error_code error;
  const fs::path base = fs::absolute(roots.base.empty() ? fs::path(".") : fs::path(roots.base));
  const fs::path target = fs::weakly_canonical(base / file, error);
  if (error || !target.has_filename()) return {};
  for (const std::string& root : roots.allowed) {
    const fs::path folder =
        fs::weakly_canonical(root.empty() ? fs::path(".") : fs::path(root), error);
    if (error) continue;
    const auto relative = target.lexically_relative(folder);
    if (!relative.empty() && *relative.begin() != ".." && relative != ".") return target.string();
  }
  return {};
}

bool has_writable_suffix(const std::string& path) { return find_format(suffix_of(path)); }

std::vector<PictureFile> camera_outputs(const scene::Camera& camera, const OutputRoots& roots,
                                        const scene::Scene& scene, const Registry& registry,
                                        World& world, Diagnostics& diagnostics) {
  OutputReader files(roots, diagnostics);
  ShaderReader shaders(scene, registry, world, diagnostics);
  NodeList before;
  std::vector<PictureFile> out;
  for (const scene::Output& output : camera.outputs) {
    if (!output.shaders.empty()) {
      if (world.options.output) shaders.append(output, before);
      continue;
    }
    if (std::optional<PictureFile> file = files.read(output)) {
      file->shaders = before;
      out.push_back(std::move(*file));
    }
  }
  return out;
}

NodeList camera_output_shaders(const scene::Camera& camera, const scene::Scene& scene,
                               const Registry& registry, World& world, Diagnostics& diagnostics) {
  ShaderReader shaders(scene, registry, world, diagnostics);
  NodeList nodes;
  for (const scene::Output& output : camera.outputs)
    if (!output.shaders.empty() && world.options.output) shaders.append(output, nodes);
  return nodes;
}

}  // namespace oriel
