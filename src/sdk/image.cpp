// SPDX-License-Identifier: Apache-2.0
// Pixels of images, and names of image types and formats.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "oriel/sdk/shader/image.h"
#include "oriel/sdk/shader/system.h"
#include "sdk/picture.h"

namespace {

using oriel::Rgba;
using oriel::Vec3;
using oriel::sdk::Picture;

/// The picture if it contains the pixel, else null: reads then return 0 and writes are ignored.
Picture* at(miImg_image* image, int x, int y) {
  auto* picture = static_cast<Picture*>(image);
  return picture && picture->holds(x, y) ? picture : nullptr;
}

void put_number(miImg_image* image, miScalar value, int x, int y) {
  if (Picture* p = at(image, x, y)) p->set_colour(x, y, Rgba(value, value, value, value));
}

/// The mean of the colour channels.
void get_number(miImg_image* image, miScalar* value, int x, int y) {
  Picture* p = at(image, x, y);
  const Rgba c = p ? p->colour(x, y) : Rgba(0);
  *value = p && p->comp == 1 ? c.r : (c.r + c.g + c.b) * (1.0f / 3);
}

struct FormatName {
  miImg_format format;
  char name[6];
};
// The first spelling is the one of scenes; aliases follow.
FormatName format_names[] = {
    {miIMG_FORMAT_RLA, "rla"},  {miIMG_FORMAT_PIC, "pic"},   {miIMG_FORMAT_ALIAS, "alias"},
    {miIMG_FORMAT_RGB, "rgb"},  {miIMG_FORMAT_CT, "ct"},     {miIMG_FORMAT_TIFF, "tif"},
    {miIMG_FORMAT_BMP, "bmp"},  {miIMG_FORMAT_TARGA, "tga"}, {miIMG_FORMAT_TIFF_16, "tif16"},
    {miIMG_FORMAT_JPEG, "jpg"}, {miIMG_FORMAT_HDR, "hdr"},   {miIMG_FORMAT_IFF, "iff"},
    {miIMG_FORMAT_PNG, "png"},  {miIMG_FORMAT_EXR, "exr"},   {miIMG_FORMAT_DDS, "dds"},
    {miIMG_FORMAT_RGB, "sgi"},  {miIMG_FORMAT_TIFF, "tiff"}, {miIMG_FORMAT_TIFF_U, "tifu"},
    {miIMG_FORMAT_JPEG, "jpeg"}};

char no_name[] = "";

}  // namespace

void mi_img_image_release(miImg_image* image) {
  if (!image) return;
  static_cast<Picture*>(image)->~Picture();
  std::free(image);
}

void mi_img_put_color(miImg_image* image, const miColor* value, int x, int y) {
  if (Picture* p = at(image, x, y))
    p->set_colour(x, y, Rgba(value->r, value->g, value->b, value->a));
}

void mi_img_get_color(miImg_image* image, miColor* value, int x, int y) {
  Picture* p = at(image, x, y);
  const Rgba c = p ? p->colour(x, y) : Rgba(0);
  *value = {c.r, c.g, c.b, c.a};
}

void mi_img_put_scalar(miImg_image* image, miScalar value, int x, int y) {
  put_number(image, value, x, y);
}
void mi_img_get_scalar(miImg_image* image, miScalar* value, int x, int y) {
  get_number(image, value, x, y);
}

void mi_img_put_vector(miImg_image* image, const miVector* value, int x, int y) {
  if (Picture* p = at(image, x, y)) p->set_vector(x, y, Vec3(value->x, value->y, value->z));
}

void mi_img_get_vector(miImg_image* image, miVector* value, int x, int y) {
  Picture* p = at(image, x, y);
  const Vec3 v = p ? p->vector(x, y) : Vec3(0);
  *value = {v.x, v.y, v.z};
}

void mi_img_put_depth(miImg_image* image, miScalar value, int x, int y) {
  put_number(image, value, x, y);
}
void mi_img_get_depth(miImg_image* image, miScalar* value, int x, int y) {
  get_number(image, value, x, y);
}
void mi_img_put_coverage(miImg_image* image, miScalar value, int x, int y) {
  put_number(image, value, x, y);
}
void mi_img_get_coverage(miImg_image* image, miScalar* value, int x, int y) {
  get_number(image, value, x, y);
}
void mi_img_put_normal(miImg_image* image, const miVector* value, int x, int y) {
  mi_img_put_vector(image, value, x, y);
}
void mi_img_get_normal(miImg_image* image, miVector* value, int x, int y) {
  mi_img_get_vector(image, value, x, y);
}

// Labels have more digits than a float.
void mi_img_put_label(miImg_image* image, miUint value, int x, int y) {
  Picture* p = at(image, x, y);
  if (!p) return;
  if (p->type == miIMG_TYPE_TAG)
    std::memcpy(p->row(y, 0) + sizeof value * static_cast<std::size_t>(x), &value, sizeof value);
  else
    put_number(image, static_cast<miScalar>(value), x, y);
}

void mi_img_get_label(miImg_image* image, miUint* value, int x, int y) {
  *value = 0;
  Picture* p = at(image, x, y);
  if (!p) return;
  if (p->type == miIMG_TYPE_TAG) {
    std::memcpy(value, p->row(y, 0) + sizeof *value * static_cast<std::size_t>(x), sizeof *value);
  } else {
    miScalar number;
    get_number(image, &number, x, y);
    *value = static_cast<miUint>(oriel::clamp(number, 0, 4e9f));
  }
}

miUchar* mi_img_access(miImg_image* image, int y, int comp) {
  Picture* p = at(image, 0, y);
  return p && comp >= 0 && comp < p->comp ? p->row(y, comp) : nullptr;
}

int mi_img_get_width(const miImg_image* image) { return image ? image->width : 0; }
int mi_img_get_height(const miImg_image* image) { return image ? image->height : 0; }

miImg_type mi_img_type_identify(const char* name) {
  for (int type = 0; name && type < miIMG_NTYPES; ++type)
    if (std::string_view(name) == oriel::sdk::traits_of(static_cast<miImg_type>(type)).name)
      return static_cast<miImg_type>(type);
  return miIMG_NTYPES;
}

miImg_format mi_img_format_identify(const char* name) {
  for (const FormatName& f : format_names)
    if (name && std::string_view(name) == f.name) return f.format;
  return miIMG_FORMAT_FROM_EXT;
}

// The interface lacks const; callers do not modify the names.
char* mi_img_type_name(miImg_type type) {
  if (type < 0 || type >= miIMG_NTYPES) return no_name;
  return const_cast<char*>(oriel::sdk::traits_of(type).name);
}

char* mi_img_format_name(miImg_format format) {
  FormatName* const end = std::end(format_names);
  FormatName* found = std::find_if(std::begin(format_names), end,
                                   [&](const FormatName& f) { return f.format == format; });
  return found == end ? no_name : found->name;
}

// Textures of the renderer are read-only.
void* mi_lightmap_edit(void** handle, miTag /*tag*/) {
  if (handle) *handle = nullptr;
  mi_warning("light maps are unsupported: textures of a scene cannot be edited");
  return nullptr;
}

void mi_lightmap_edit_end(void* /*handle*/) {}
