// SPDX-License-Identifier: Apache-2.0
// Image files read and written by shaders.
#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <string>

#include "image/files.h"
#include "oriel/sdk/shader/image.h"
#include "oriel/sdk/shader/image_tools.h"
#include "oriel/sdk/shader/system.h"
#include "output/camera_output.h"
#include "output/output_request.h"
#include "sdk/current.h"
#include "sdk/host.h"
#include "sdk/picture.h"

namespace {

namespace fs = std::filesystem;
using oriel::Image;
using oriel::SampleFormat;
using oriel::sdk::Picture;
using oriel::sdk::Storage;
using oriel::sdk::traits_of;

/// Data of an open miImg_file, which the C structure cannot hold.
struct OpenFile {
  std::string path;
  std::string extension;                ///< output: extension for the image writers
  std::optional<Image> image;           ///< input
  std::shared_ptr<Picture> lines = {};  ///< output: lines written so far
};

struct OpenFiles {
  std::mutex mutex;
  std::map<const miImg_file*, std::shared_ptr<OpenFile>> open;
};
OpenFiles& files() {
  static OpenFiles all;
  return all;
}

std::shared_ptr<OpenFile> find(const miImg_file* file) {
  const std::lock_guard lock(files().mutex);
  const auto found = files().open.find(file);
  return found == files().open.end() ? nullptr : found->second;
}

void keep(const miImg_file* file, OpenFile open) {
  const std::lock_guard lock(files().mutex);
  files().open[file] = std::make_shared<OpenFile>(std::move(open));
}

miBoolean failed(miImg_file* file, miImg_error error, const std::string& why) {
  file->error = error;
  if (!why.empty()) mi_error("%s", why.c_str());
  return miFALSE;
}

std::string extension_of(const std::string& path) {
  const std::string suffix = oriel::lower_case(fs::path(path).extension().string());
  return suffix.empty() ? suffix : suffix.substr(1);
}

/// The smallest lossless type for a file: 16 bits if the format supports it.
miImg_type natural_type(const std::string& extension, int channels) {
  const bool alpha = channels % 2 == 0, grey = channels < 3;
  if (extension == "exr" || extension == "hdr" || extension == "pfm")
    return alpha ? miIMG_TYPE_RGBA_FP : (grey ? miIMG_TYPE_S_FP : miIMG_TYPE_RGB_FP);
  if (extension == "png" || extension == "tif" || extension == "tiff" || extension == "psd")
    return alpha ? miIMG_TYPE_RGBA_16 : (grey ? miIMG_TYPE_S_16 : miIMG_TYPE_RGB_16);
  return alpha ? miIMG_TYPE_RGBA : (grey ? miIMG_TYPE_S : miIMG_TYPE_RGB);
}

void describe(miImg_file* file, miImg_type type, int width, int height) {
  *file = {};
  file->width = width;
  file->height = height;
  file->type = type;
  file->comp = traits_of(type).components;
  file->bits = 8 * oriel::sdk::bytes_of(traits_of(type).storage);
  file->gamma = 1;
  file->aspect = height > 0 ? static_cast<float>(width) / static_cast<float>(height) : 1;
}

SampleFormat samples_of(miImg_type type) {
  switch (traits_of(type).storage) {
    case Storage::U8:
      return SampleFormat::U8;
    case Storage::U16:
      return SampleFormat::U16;
    case Storage::Half:
      return SampleFormat::Half;
    default:
      return SampleFormat::Float;
  }
}

void write(const OpenFile& open, const Image& image, oriel::FileOptions options) {
  options.type = open.extension;
  oriel::write_image(open.path, image, options);
}

}  // namespace

miBoolean mi_img_open(miImg_file* file, const char* name, miImg_type type) {
  describe(file, miIMG_TYPE_ANY, 0, 0);
  if (!name || *name == '\0') return failed(file, miIMG_ERR_ARGS, "");
  try {
    const std::string named = (fs::path(oriel::sdk::output_roots().base) / name).string();
    // The name may be a parameter of the scene.
    const oriel::sdk::Host* const host = oriel::sdk::current_host();
    const oriel::OpenFile source =
        host ? host->scene().files.open(named, oriel::FileUse::Asset) : oriel::open_regular(named);
    if (!source)
      return failed(file, miIMG_ERR_OPEN, "cannot read '" + named + "': " + source.reason());
    const std::string& path = source.path();
    Image image = oriel::read_image(path);
    const std::string extension = extension_of(path);
    describe(file,
             type >= 0 && type < miIMG_NTYPES ? type : natural_type(extension, image.channels),
             image.width, image.height);
    file->format = mi_img_format_identify(extension.c_str());
    file->filesize = static_cast<long>(fs::file_size(path));
    keep(file, {path, extension, std::move(image)});
    return miTRUE;
  } catch (const std::exception& e) {
    return failed(file, miIMG_ERR_OPEN, e.what());
  }
}

miBoolean mi_img_create(miImg_file* file, const char* name, miImg_type type, miImg_format format,
                        int width, int height) {
  describe(file, type, width, height);
  if (!name || *name == '\0') return failed(file, miIMG_ERR_ARGS, "");
  if (width <= 0 || height <= 0) return failed(file, miIMG_ERR_SIZE, "");
  if (type < 0 || type >= miIMG_NTYPES) return failed(file, miIMG_ERR_TYPE, "");
  try {
    const std::string path = oriel::allowed_path(name, oriel::sdk::output_roots());
    if (path.empty())
      return failed(file, miIMG_ERR_CREATE,
                    "a shader may not write '" + std::string(name) +
                        "': it is outside of the folders that scenes may write to");
    const std::string asked = format == miIMG_FORMAT_FROM_EXT ? extension_of(path)
                              : format == miIMG_FORMAT_TIFF_16 || format == miIMG_FORMAT_TIFF_U
                                  ? "tif"
                                  : mi_img_format_name(format);
    const std::string_view extension = oriel::writable_format(asked);
    if (extension.empty())
      return failed(file, miIMG_ERR_SUBTYPE,
                    "a shader's picture '" + path + "' has an unsupported format");
    file->format = mi_img_format_identify(std::string(extension).c_str());
    keep(file, {path, std::string(extension), {}});
    return miTRUE;
  } catch (const std::exception& e) {
    return failed(file, miIMG_ERR_CREATE, e.what());
  }
}

miBoolean mi_img_close(miImg_file* file) {
  const auto open = find(file);
  if (!open) {
    file->error = miIMG_ERR_NOTOPEN;
    return miFALSE;
  }
  const miBoolean written = open->lines ? mi_img_image_write(file, open->lines.get()) : miTRUE;
  const std::lock_guard lock(files().mutex);
  files().open.erase(file);
  return written;
}

miBoolean mi_img_line_read(miImg_file* file, miImg_image* image, int y) {
  const auto open = find(file);
  if (!open) return failed(file, miIMG_ERR_NOTOPEN, "");
  if (!open->image) return failed(file, miIMG_ERR_READ, "");
  if (!image || y < 0 || y >= std::min(image->height, open->image->height))
    return failed(file, miIMG_ERR_ARGS, "");
  oriel::sdk::fill_row(*static_cast<Picture*>(image), *open->image, y);
  return miTRUE;
}

miBoolean mi_img_line_write(miImg_file* file, miImg_image* image, int y) {
  const auto open = find(file);
  if (!open || open->image) return failed(file, miIMG_ERR_NOTOPEN, "");
  if (!image || y < 0 || y >= std::min(image->height, file->height))
    return failed(file, miIMG_ERR_ARGS, "");
  try {
    if (!open->lines)
      open->lines = std::make_shared<Picture>(file->type, file->width, file->height);
  } catch (const std::bad_alloc&) {
    return failed(file, miIMG_ERR_SIZE, "");
  }
  auto& from = *static_cast<Picture*>(image);
  for (int x = 0; x < std::min(from.width, open->lines->width); ++x)
    open->lines->set_colour(x, y, from.colour(x, y));
  return miTRUE;
}

miBoolean mi_img_image_read(miImg_file* file, miImg_image* image) {
  const auto open = find(file);
  if (!open) return failed(file, miIMG_ERR_NOTOPEN, "");
  if (!open->image) return failed(file, miIMG_ERR_READ, "");
  if (!image) return failed(file, miIMG_ERR_ARGS, "");
  oriel::sdk::fill(*static_cast<Picture*>(image), *open->image);
  return miTRUE;
}

miBoolean mi_img_image_write(miImg_file* file, miImg_image* image) {
  const auto open = find(file);
  if (!open || open->image) return failed(file, miIMG_ERR_NOTOPEN, "");
  if (!image) return failed(file, miIMG_ERR_ARGS, "");
  try {
    oriel::FileOptions options;
    options.format = samples_of(file->type);
    write(*open, to_image(*static_cast<Picture*>(image)), options);
    return miTRUE;
  } catch (const std::exception& e) {
    return failed(file, miIMG_ERR_WRITE, e.what());
  }
}

miImg_image* mi_img_image_alloc(miImg_file* file) {
  return file ? Picture::in_one_block(file->type, file->width, file->height) : nullptr;
}
