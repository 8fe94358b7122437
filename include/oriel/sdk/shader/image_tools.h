// SPDX-License-Identifier: Apache-2.0
// Which images do files hold, how are they read line by line, and how are colours made to fit?
#ifndef ORIEL_SDK_IMAGE_TOOLS_H
#define ORIEL_SDK_IMAGE_TOOLS_H

// Conventions
//   As in image.h.
//   The arguments are Oriel's choice: no description of them was available.

#include "image.h"
#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The type that loses least in files of a format.
miImg_type mi_img_best_type(miImg_format format);
/// Whether Oriel writes files of a format that hold all numbers of a type.
miBoolean mi_img_type_query(miImg_format format, miImg_type type);
/// Brings r, g, b and a into 0 to 1; what is not a number becomes 0. desaturate: a colour that is
/// too bright fades to white and keeps the mean of r, g and b where it can.
void mi_img_clip_color(miColor* color, miBoolean desaturate);
/// Brings r, g, b from 0 to any brightness into 0 to 1: c = exposure * channel becomes c / (1 + c),
/// to the power of 1 / gamma.
void mi_img_tonemap(miColor* color, miScalar exposure, miScalar gamma);
/// The image at half its width and height for each level; level 0 is the image. It belongs to the
/// image and keeps the pixels of the first call. NULL: the level before has one pixel.
miImg_image* mi_img_pyramid_get_level(miImg_image* image, int level);
/// Reads row y of an open file into row y of an image.
miBoolean mi_img_line_read(miImg_file* file, miImg_image* image, int y);
/// Keeps row y of an image for a file being created; mi_img_close writes it. Rows that were not
/// given are 0.
miBoolean mi_img_line_write(miImg_file* file, miImg_image* image, int y);

/// Start of the first row of a component, for images of one row.
#define miIMG_LINEACCESS(img, comp) mi_img_access((img), 0, (comp))

#ifdef __cplusplus
}
#endif

#endif
