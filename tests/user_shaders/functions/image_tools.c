/* SPDX-License-Identifier: Apache-2.0 */
/* Formats, colours that fit, images line by line and at lower resolution. */
#include "coverage.h"

static void formats(void) {
  COVER(mi_img_best_type, mi_img_best_type(miIMG_FORMAT_EXR) == miIMG_TYPE_RGBA_FP);
  COVER(mi_img_best_type, mi_img_best_type(miIMG_FORMAT_HDR) == miIMG_TYPE_RGBE);
  COVER(mi_img_best_type, mi_img_best_type(miIMG_FORMAT_JPEG) == miIMG_TYPE_RGB);
  COVER(mi_img_type_query, mi_img_type_query(miIMG_FORMAT_EXR, miIMG_TYPE_RGBA_H));
  COVER(mi_img_type_query, mi_img_type_query(miIMG_FORMAT_PNG, miIMG_TYPE_RGBA_16));
  COVER(mi_img_type_query, !mi_img_type_query(miIMG_FORMAT_PNG, miIMG_TYPE_RGB_FP));
  COVER(mi_img_type_query, !mi_img_type_query(miIMG_FORMAT_JPEG, miIMG_TYPE_RGBA));
  COVER(mi_img_type_query, !mi_img_type_query(miIMG_FORMAT_CT, miIMG_TYPE_RGBA));
}

static void colours(void) {
  miColor c = paint(2, .5, -1);
  mi_img_clip_color(&c, miFALSE);
  COVER(mi_img_clip_color, SHOWS(c, 1, .5, 0));
  /* The mean is .75; half of the way to it. */
  c = paint(1.25, .75, .25);
  mi_img_clip_color(&c, miTRUE);
  COVER(mi_img_clip_color, SHOWS(c, 1, .75, .5));
  c = paint(5, 1, 1);
  c.a = 3;
  mi_img_clip_color(&c, miTRUE);
  COVER(mi_img_clip_color, SHOWS(c, 1, 1, 1) && c.a == 1);
  c = paint(.5, 1.5, 0); /* twice: 1, 3, 0 to 1/2, 3/4, 0 */
  mi_img_tonemap(&c, 2, 1);
  COVER(mi_img_tonemap, SHOWS(c, .5, .75, 0));
  mi_img_tonemap(&c, 0, 1);
  COVER(mi_img_tonemap, SHOWS(c, 0, 0, 0));
  c = paint(1. / 3, 1, 0); /* 1/4 and 1/2, of which the roots */
  mi_img_tonemap(&c, 1, 2);
  COVER(mi_img_tonemap, SHOWS(c, .5, sqrt(.5), 0));
}

static void levels(miImg_image* image) {
  miImg_image *half, *last;
  miColor c;
  /* The mean of the places of four pixels. */
  half = mi_img_pyramid_get_level(image, 1);
  COVER(mi_img_pyramid_get_level, half && half->width == 3 && half->height == 2);
  mi_img_get_color(half, &c, 1, 1);
  COVER(mi_img_pyramid_get_level, SHOWS(c, 2.5, 2.5, 1));
  mi_img_get_color(half, &c, 2, 0); /* at the edge the last column counts twice */
  COVER(mi_img_pyramid_get_level, SHOWS(c, 4, .5, 1));
  last = mi_img_pyramid_get_level(image, 3);
  COVER(mi_img_pyramid_get_level, last && last->width == 1 && last->height == 1);
  COVER(mi_img_pyramid_get_level,
        mi_img_pyramid_get_level(image, 0) == image && mi_img_pyramid_get_level(image, 1) == half);
  COVER(mi_img_pyramid_get_level, !mi_img_pyramid_get_level(image, 4) &&
                                      !mi_img_pyramid_get_level(NULL, 0) &&
                                      !mi_img_pyramid_get_level(image, -1));
}

/* Writes lines from the top down, reads one. */
static void lines(void) {
  miImg_file file;
  miImg_image *image, *again;
  miColor c;
  int x, y, written = 0;

  mi_img_create(&file, "lines.exr", miIMG_TYPE_RGBA_FP, miIMG_FORMAT_EXR, 5, 4);
  image = mi_img_image_alloc(&file);
  if (!image) return;
  COVER(miIMG_LINEACCESS, miIMG_LINEACCESS(image, 1) == mi_img_access(image, 0, 1));
  for (y = 3; y >= 0; y--) {
    for (x = 0; x < 5; x++) {
      c = paint(x, y, 1);
      mi_img_put_color(image, &c, x, y);
    }
    written += mi_img_line_write(&file, image, y);
  }
  COVER(mi_img_line_write, written == 4 && !mi_img_line_write(&file, image, 4));
  COVER(mi_img_line_write, mi_img_close(&file));
  levels(image);

  COVER(mi_img_line_write, mi_img_open(&file, "lines.exr", miIMG_TYPE_RGBA_FP));
  COVER(mi_img_line_write, !mi_img_line_write(&file, image, 0));
  again = mi_img_image_alloc(&file);
  COVER(mi_img_line_read, mi_img_line_read(&file, again, 2));
  mi_img_get_color(again, &c, 4, 2);
  COVER(mi_img_line_read, SHOWS(c, 4, 2, 1));
  mi_img_get_color(again, &c, 4, 1);
  COVER(mi_img_line_read, SHOWS(c, 0, 0, 0) && !mi_img_line_read(&file, again, -1));
  mi_img_close(&file);
  COVER(mi_img_line_read, !mi_img_line_read(&file, again, 0) && file.error == miIMG_ERR_NOTOPEN);
  mi_img_image_release(image);
  mi_img_image_release(again);
}

DLLEXPORT miBoolean cover_image_tools(miColor* result, miState* state, void* paras) {
  static int done = 0;
  if (!done) {
    done = 1;
    formats();
    colours();
    lines();
  }
  *result = paint(0, 1, 0);
  return miTRUE;
}
