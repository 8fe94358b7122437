// SPDX-License-Identifier: Apache-2.0
// File types of images, line-by-line access, and colour clipping.
#ifndef ORIEL_SDK_IMAGE_TOOLS_H
#define ORIEL_SDK_IMAGE_TOOLS_H

// Conventions
//   As in image.h.
//   The signatures are specific to Oriel, because no description of them was available.

#include "image.h"
#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The type with the least loss in files of a format.
miImg_type mi_img_best_type(miImg_format format);
/// Whether Oriel writes files of a format without loss for a type.
miBoolean mi_img_type_query(miImg_format format, miImg_type type);
/// Clips r, g, b and a to 0...1; NaN becomes 0. desaturate: colours that are too bright are moved
/// towards white, with the mean of r, g and b preserved if possible.
void mi_img_clip_color(miColor* color, miBoolean desaturate);
/// Maps r, g, b from any brightness to 0...1: c = exposure * channel becomes c / (1 + c), to the
/// power of 1 / gamma.
void mi_img_tonemap(miColor* color, miScalar exposure, miScalar gamma);
/// The image at half the width and height per level; level 0 is the image. It is owned by the image
/// and has the pixels at the time of the first call. NULL: the previous level has one pixel.
miImg_image* mi_img_pyramid_get_level(miImg_image* image, int level);
/// Reads row y of an open file into row y of an image.
miBoolean mi_img_line_read(miImg_file* file, miImg_image* image, int y);
/// Stores row y of an image for a file under construction; mi_img_close writes it. Missing rows are
/// 0.
miBoolean mi_img_line_write(miImg_file* file, miImg_image* image, int y);

/// Start of the first row of a component, for images of one row.
#define miIMG_LINEACCESS(img, comp) mi_img_access((img), 0, (comp))

#ifdef __cplusplus
}
#endif

#endif
