// SPDX-License-Identifier: Apache-2.0
#include "models/import_texture.h"

#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include "base/durable_file.h"
#include "image/files.h"
#include "image/picture_target.h"
#include "models/import_material.h"
#include "models/shader_call.h"
#include "scene/asset_path.h"

namespace oriel::models {
namespace {

namespace fs = std::filesystem;

/// An uncompressed picture as a 32-bit Targa file, top row first; empty if it is too large.
std::string targa_of(const aiTexture& picture) {
  if (picture.mWidth > 0xffff || picture.mHeight > 0xffff) return {};
  const auto low = [](unsigned n) { return static_cast<char>(n & 0xff); };
  std::string file(18, '\0');
  file[2] = 2;  // colours, uncompressed
  file[12] = low(picture.mWidth), file[13] = low(picture.mWidth >> 8);
  file[14] = low(picture.mHeight), file[15] = low(picture.mHeight >> 8);
  file[16] = 32;
  file[17] = 0x28;  // top row first, 8 bits alpha
  // aiTexel is b, g, r, a like Targa pixels.
  const std::size_t bytes = sizeof(aiTexel) * picture.mWidth * picture.mHeight;
  return file.append(reinterpret_cast<const char*>(picture.pcData), bytes);
}

/// File extension from the format of a compressed picture; "png" if it is unknown, since readers
/// look at the content. assimp stores only three characters, too few for WebP, which is detected by
/// its header.
std::string suffix_of(const aiTexture& picture) {
  constexpr std::size_t kNameEnds = 12;  // "RIFF", a size, "WEBP"
  const std::string_view start(reinterpret_cast<const char*>(picture.pcData),
                               picture.mHeight == 0 && picture.mWidth >= kNameEnds ? kNameEnds : 0);
  if (start.substr(0, 4) == "RIFF" && start.substr(8) == "WEBP") return "webp";
  std::string suffix;
  for (const char* c = picture.achFormatHint; *c && suffix.size() < 5; ++c)
    suffix += static_cast<char>(std::tolower(static_cast<unsigned char>(*c)));
  if (picture.mHeight > 0) return "tga";
  return is_texture_suffix(suffix) ? suffix : "png";
}

}  // namespace

bool is_texture_suffix(std::string_view suffix) {
  constexpr std::string_view kKnown[] = {"png", "jpg", "jpeg", "webp", "tga", "bmp",  "tif", "tiff",
                                         "gif", "dds", "hdr",  "exr",  "ktx", "ktx2", "jp2"};
  return std::find(std::begin(kKnown), std::end(kKnown), suffix) != std::end(kKnown);
}

void write_texture(const std::string& folder, const std::string& name, std::string_view content) {
  std::error_code error;
  if (fs::is_symlink(folder, error)) throw std::runtime_error("its folder is a symbolic link");
  fs::create_directories(folder, error);
  const std::string path = (fs::path(folder) / name).string();
  check_picture_target(path);
  DurableFile file(path);
  file.write(content);
  file.commit();
}

std::optional<Vec3> mean_color(const OpenFile& picture) try {
  if (!picture) return std::nullopt;
  const Image image = read_image(picture.path());
  if (image.channels < 3 || image.empty()) return std::nullopt;
  Imath::V3d sum(0);  // of millions of pixels
  for (std::size_t i = 0; i < image.pixels.size(); i += static_cast<std::size_t>(image.channels))
    sum += Imath::V3d(image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]);
  return Vec3(sum / static_cast<double>(image.pixel_count()));
} catch (const std::runtime_error&) {
  return std::nullopt;
}

std::optional<Vec3> TextureMaker::mean_color(const std::string& picture) const {
  const auto* element = scene_.get<scene::Texture>(picture);
  if (!element) return std::nullopt;
  const std::string path = (fs::path(element->directory) / element->file).string();
  return options_.color_reader ? options_.color_reader(path)
                               : models::mean_color(options_.files.open(path, FileUse::Asset));
}

std::string TextureMaker::relative(const std::string& path) const {
  if (options_.scene_folder.empty()) return fs::absolute(path).lexically_normal().string();
  const fs::path inside = fs::absolute(path).lexically_normal().lexically_relative(
      fs::absolute(options_.scene_folder).lexically_normal());
  if (inside.empty() || *inside.begin() == "..")
    return fs::absolute(path).lexically_normal().string();
  return inside.string();
}

std::optional<std::string> TextureMaker::file_of(const aiScene& model, const std::string& written) {
  const auto [picture, index] = model.GetEmbeddedTextureAndIndex(written.c_str());
  if (!picture) {
    // Exporters write backslashes and absolute paths of their own machine.
    const std::string name = scene::with_slashes(written);
    for (const fs::path& candidate :
         {fs::path(folder_) / name, fs::path(folder_) / fs::path(name).filename()}) {
      const OpenFile file = options_.files.open(candidate.string(), FileUse::Asset);
      if (file) return relative(candidate.string());
      if (file.fault() == OpenFile::Fault::Missing) continue;
      diagnostics_.warning("OR-MD-025", {},
                           fmt::format("image \"{}\" is not read: {}", written, file.reason()),
                           file.hint());
    }
    return "";
  }
  const fs::path path =
      fs::path(options_.texture_folder) / fmt::format("texture_{}.{}", index, suffix_of(*picture));
  const std::string content =
      picture->mHeight > 0
          ? targa_of(*picture)
          : std::string(reinterpret_cast<const char*>(picture->pcData), picture->mWidth);
  if (content.empty()) return "";
  try {
    const std::string name = path.filename().string();
    if (options_.texture_writer)
      options_.texture_writer(name, content);
    else
      write_texture(options_.texture_folder, name, content);
  } catch (const std::runtime_error& e) {
    diagnostics_.error("OR-MD-023", {},
                       fmt::format("cannot write the texture '{}': {}", path.string(), e.what()));
    return std::nullopt;
  }
  return relative(path.string());
}

std::string TextureMaker::picture(const aiScene& model, const std::string& written, Holds holds,
                                  const std::string& user) {
  const auto [known, is_new] = pictures_.try_emplace({written, holds});
  if (!is_new) return known->second;
  const std::optional<std::string> found = file_of(model, written);
  if (!found) return {};
  const std::string& file = *found;
  if (file.empty()) {
    diagnostics_.warning(
        "OR-MD-004", {},
        fmt::format("material \"{}\": image \"{}\" does not exist; the texture is ignored", user,
                    written),
        "copy the file into the folder of the model");
    return {};
  }
  scene::Texture texture;
  texture.type =
      holds == Holds::Colors ? scene::ParamType::ColorTexture : scene::ParamType::VectorTexture;
  texture.name = unique_name(scene_, "picture_" + fs::path(file).stem().string());
  texture.file = file;
  texture.directory = options_.scene_folder;
  known->second = texture.name;
  scene_.add(std::move(texture));
  return known->second;
}

std::string TextureMaker::lookup(const std::string& picture, unsigned space) {
  if (picture.empty()) return {};
  const auto [known, is_new] = lookups_.try_emplace({picture, space});
  if (!is_new) return known->second;
  if (space == 0) {
    ShaderCall call("mib_texture_lookup2");
    call.set("tex", picture.c_str()).set("factor", 1.0f);
    known->second = add_shader(scene_, picture + "_lookup", call);
  } else {
    ShaderCall call("mib_texture_lookup");
    call.set("tex", picture.c_str()).connect("coord", coordinate(space));
    known->second = add_shader(scene_, fmt::format("{}_lookup_{}", picture, space), call);
  }
  return known->second;
}

std::string TextureMaker::coordinate(unsigned space) {
  std::string& known = coordinates_[space];
  if (!known.empty()) return known;
  ShaderCall vector("mib_texture_vector");
  vector.set("select", static_cast<int>(space));
  ShaderCall remap("mib_texture_remap");
  remap.connect("input", add_shader(scene_, fmt::format("uv_{}", space), vector));
  remap.set("torus_x", true).set("torus_y", true);
  known = add_shader(scene_, fmt::format("uv_{}_repeated", space), remap);
  return known;
}

}  // namespace oriel::models
