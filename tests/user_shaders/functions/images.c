/* SPDX-License-Identifier: Apache-2.0 */
/* A picture is made, written, read again. Once: a second shader would find it open. */
#include "coverage.h"

static void pixels(miImg_image* image) {
  miColor c = paint(.25, .5, .75), back;
  miVector v = make(1, 2, 3), w;
  miScalar s;
  miUint label;

  mi_img_put_color(image, &c, 1, 2);
  mi_img_get_color(image, &back, 1, 2);
  COVER(mi_img_put_color, SHOWS(back, .25, .5, .75));
  COVER(mi_img_get_color, SHOWS(back, .25, .5, .75) && back.a == 1);
  mi_img_get_color(image, &back, 0, 0);
  COVER(mi_img_get_color, SHOWS(back, 0, 0, 0));
  mi_img_put_vector(image, &v, 0, 0);
  mi_img_get_vector(image, &w, 0, 0);
  COVER(mi_img_put_vector, IS(w, 1, 2, 3));
  COVER(mi_img_get_vector, IS(w, 1, 2, 3));
  v = make(0, .6, .8);
  mi_img_put_normal(image, &v, 0, 1);
  mi_img_get_normal(image, &w, 0, 1);
  COVER(mi_img_put_normal, IS(w, 0, .6, .8));
  COVER(mi_img_get_normal, IS(w, 0, .6, .8));
  mi_img_put_scalar(image, .5f, 2, 0);
  mi_img_get_scalar(image, &s, 2, 0);
  COVER(mi_img_put_scalar, NEAR(s, .5, 1e-6));
  COVER(mi_img_get_scalar, NEAR(s, .5, 1e-6));
  mi_img_put_depth(image, 7.5f, 2, 1);
  mi_img_get_depth(image, &s, 2, 1);
  COVER(mi_img_put_depth, NEAR(s, 7.5, 1e-6));
  COVER(mi_img_get_depth, NEAR(s, 7.5, 1e-6));
  mi_img_put_coverage(image, .25f, 2, 2);
  mi_img_get_coverage(image, &s, 2, 2);
  COVER(mi_img_put_coverage, NEAR(s, .25, 1e-6));
  COVER(mi_img_get_coverage, NEAR(s, .25, 1e-6));
  mi_img_put_label(image, 12345, 3, 3);
  mi_img_get_label(image, &label, 3, 3);
  COVER(mi_img_put_label, label == 12345);
  COVER(mi_img_get_label, label == 12345);
  COVER(mi_img_access, mi_img_access(image, 0, 0) && !mi_img_access(image, 4, 0));
  COVER(miIMG_ACCESS, miIMG_ACCESS(image, 1, 2) == mi_img_access(image, 1, 2));
  COVER(mi_img_get_width, mi_img_get_width(image) == 4);
  COVER(mi_img_get_height, mi_img_get_height(image) == 4);
}

static void names(void) {
  void* handle = &handle;
  COVER(mi_img_type_identify, mi_img_type_identify("rgba_fp") == miIMG_TYPE_RGBA_FP);
  COVER(mi_img_type_name, strcmp(mi_img_type_name(miIMG_TYPE_RGBA_FP), "rgba_fp") == 0);
  COVER(mi_img_format_identify, mi_img_format_identify("exr") == miIMG_FORMAT_EXR);
  COVER(mi_img_format_name, strcmp(mi_img_format_name(miIMG_FORMAT_EXR), "exr") == 0);
  /* No texture of a scene can be edited here. */
  COVER(mi_lightmap_edit, mi_lightmap_edit(&handle, 1) == NULL && handle == NULL);
  mi_lightmap_edit_end(handle);
  COVER(mi_lightmap_edit_end, 1);
}

static void files(void) {
  miImg_file file;
  miImg_image *image, *again;
  miColor c;

  COVER(mi_img_create,
        mi_img_create(&file, "covered.exr", miIMG_TYPE_RGBA_FP, miIMG_FORMAT_EXR, 4, 4));
  image = mi_img_image_alloc(&file);
  COVER(mi_img_image_alloc, image && image->width == 4 && image->height == 4);
  if (!image) return;
  pixels(image);
  COVER(mi_img_image_write, mi_img_image_write(&file, image));
  COVER(mi_img_close, mi_img_close(&file) && !mi_img_close(&file));
  COVER(mi_img_create,
        !mi_img_create(&file, "../../covered.exr", miIMG_TYPE_RGBA_FP, miIMG_FORMAT_EXR, 4, 4));

  COVER(mi_img_create,
        mi_img_create(&file, "covered.tif", miIMG_TYPE_RGB, miIMG_FORMAT_TIFF_U, 4, 4));
  COVER(mi_img_image_write, mi_img_image_write(&file, image));
  mi_img_close(&file);
  COVER(mi_img_open, mi_img_open(&file, "covered.tif", miIMG_TYPE_RGB) && file.height == 4);
  mi_img_close(&file);

  COVER(mi_img_open, mi_img_open(&file, "covered.exr", miIMG_TYPE_RGBA_FP) && file.width == 4);
  again = mi_img_image_alloc(&file);
  COVER(mi_img_image_read, mi_img_image_read(&file, again));
  mi_img_get_color(again, &c, 1, 2);
  COVER(mi_img_image_read, SHOWS(c, .25, .5, .75));
  mi_img_close(&file);
  mi_img_image_release(image);
  mi_img_image_release(again);
  COVER(mi_img_image_release, 1);
  COVER(mi_img_open,
        !mi_img_open(&file, "no_such.exr", miIMG_TYPE_ANY) && file.error == miIMG_ERR_OPEN);
}

DLLEXPORT miBoolean cover_images(miColor* result, miState* state, void* paras) {
  static int done = 0;
  if (!done) {
    done = 1;
    names();
    files();
  }
  *result = paint(0, 1, 0);
  return miTRUE;
}
