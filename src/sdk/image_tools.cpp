// SPDX-License-Identifier: Apache-2.0
// Type selection for files, image scaling, and colour clipping.
#include "oriel/sdk/shader/image_tools.h"

#include <algorithm>
#include <mutex>
#include <new>

#include "output/output_request.h"
#include "sdk/context.h"
#include "sdk/picture.h"
#include "tone/simple_operators.h"

namespace {

using oriel::sdk::Picture;
using oriel::sdk::Storage;

/// Clamps to 0...1; NaN becomes 0.
float within_one(float v) { return v > 0 ? std::min(v, 1.0f) : 0.0f; }

}  // namespace

extern "C" {

miImg_type mi_img_best_type(miImg_format format) {
  switch (format) {
    case miIMG_FORMAT_EXR:
      return miIMG_TYPE_RGBA_FP;
    case miIMG_FORMAT_HDR:
      return miIMG_TYPE_RGBE;
    case miIMG_FORMAT_PNG:
    case miIMG_FORMAT_TIFF:
    case miIMG_FORMAT_TIFF_16:
      return miIMG_TYPE_RGBA_16;
    case miIMG_FORMAT_JPEG:
    case miIMG_FORMAT_BMP:
      return miIMG_TYPE_RGB;
    default:
      return miIMG_TYPE_RGBA;
  }
}

miBoolean mi_img_type_query(miImg_format format, miImg_type type) {
  const char* name = format == miIMG_FORMAT_TIFF_16 ? "tif" : mi_img_format_name(format);
  if (type < 0 || type >= miIMG_NTYPES || oriel::writable_format(name).empty()) return miFALSE;
  const oriel::sdk::TypeTraits& traits = oriel::sdk::traits_of(type);
  const Storage storage = traits.storage;
  switch (format) {
    case miIMG_FORMAT_EXR:
      return storage == Storage::Half || storage == Storage::Float ? miTRUE : miFALSE;
    case miIMG_FORMAT_HDR:
      return storage == Storage::SharedExponent ? miTRUE : miFALSE;
    case miIMG_FORMAT_PNG:
    case miIMG_FORMAT_TIFF:
    case miIMG_FORMAT_TIFF_16:
      return storage == Storage::U8 || storage == Storage::U16 ? miTRUE : miFALSE;
    case miIMG_FORMAT_TARGA:
      return storage == Storage::U8 ? miTRUE : miFALSE;
    default:
      return storage == Storage::U8 && traits.components < 4 ? miTRUE : miFALSE;
  }
}

void mi_img_clip_color(miColor* color, miBoolean desaturate) {
  if (desaturate)
    *color = oriel::sdk::as_c(oriel::tone::desaturate_to_one(oriel::sdk::rgb(*color)), color->a);
  for (float* v : {&color->r, &color->g, &color->b, &color->a}) *v = within_one(*v);
}

void mi_img_tonemap(miColor* color, miScalar exposure, miScalar gamma) {
  for (float* v : {&color->r, &color->g, &color->b})
    *v = oriel::tone::reinhard(*v, exposure, gamma);
}

miImg_image* mi_img_pyramid_get_level(miImg_image* image, int level) {
  static std::mutex mutex;
  if (!image || level < 0) return nullptr;
  if (level == 0) return image;
  auto& whole = *static_cast<Picture*>(image);
  // Crashes here if the pointer is invalid; with the lock held, other threads would wait forever.
  if (whole.width < 1 || whole.height < 1) return nullptr;
  const std::lock_guard lock(mutex);
  try {
    while (whole.levels.size() < static_cast<std::size_t>(level)) {
      Picture& before = whole.levels.empty() ? whole : *whole.levels.back();
      if (before.width <= 1 && before.height <= 1) return nullptr;
      whole.levels.push_back(halved(before));
    }
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
  return whole.levels[static_cast<std::size_t>(level) - 1].get();
}

}  // extern "C"
