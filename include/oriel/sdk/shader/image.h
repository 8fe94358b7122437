// SPDX-License-Identifier: Apache-2.0
// Image files and pixel access.
#ifndef ORIEL_SDK_IMAGE_H
#define ORIEL_SDK_IMAGE_H

// Conventions
//   Pixel (0,0) is the lower left one. miFALSE: miImg_file::error has the reason.

#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Data types of images.
typedef enum miImg_type {
  miIMG_TYPE_RGBA = 0,
  miIMG_TYPE_RGBA_16 = 1,
  miIMG_TYPE_RGB = 2,
  miIMG_TYPE_RGB_16 = 3,
  miIMG_TYPE_A = 4,
  miIMG_TYPE_A_16 = 5,
  miIMG_TYPE_S = 6,
  miIMG_TYPE_S_16 = 7,
  miIMG_TYPE_VTA = 8,
  miIMG_TYPE_VTS = 9,
  miIMG_TYPE_Z = 10,
  miIMG_TYPE_N = 11,
  miIMG_TYPE_TAG = 12,
  miIMG_TYPE_RGBA_FP = 13,
  miIMG_TYPE_M = 14,
  miIMG_TYPE_BIT = 15,
  miIMG_TYPE_RGB_FP = 16,
  miIMG_TYPE_COVERAGE = 17,
  miIMG_TYPE_RGBE = 18,
  miIMG_TYPE_A_FP = 19,
  miIMG_TYPE_S_FP = 20,
  miIMG_TYPE_RGBA_H = 21,
  miIMG_TYPE_RGB_H = 22,
  miIMG_NTYPES = 23,
  miIMG_TYPE_CONT = 29,
  miIMG_TYPE_ANY = 30,
  miIMG_TYPE_USER_FIRST = 31
} miImg_type;

/// File formats.
typedef enum miImg_format {
  miIMG_FORMAT_RLA = 0,
  miIMG_FORMAT_PIC = 2,
  miIMG_FORMAT_ALIAS = 3,
  miIMG_FORMAT_RGB = 4,
  miIMG_FORMAT_CT = 5,
  miIMG_FORMAT_TIFF = 14,
  miIMG_FORMAT_TIFF_U = 15,  ///< uncompressed
  miIMG_FORMAT_TARGA = 22,
  miIMG_FORMAT_BMP = 23,
  miIMG_FORMAT_TIFF_16 = 30,
  miIMG_FORMAT_JPEG = 34,
  miIMG_FORMAT_HDR = 39,
  miIMG_FORMAT_IFF = 41,
  miIMG_FORMAT_CUSTOM_0 = 42,
  miIMG_FORMAT_CUSTOM_1 = 43,
  miIMG_FORMAT_CUSTOM_2 = 44,
  miIMG_FORMAT_CUSTOM_3 = 45,
  miIMG_FORMAT_CUSTOM_4 = 46,
  miIMG_FORMAT_CUSTOM_5 = 47,
  miIMG_FORMAT_CUSTOM_6 = 48,
  miIMG_FORMAT_CUSTOM_7 = 49,
  miIMG_FORMAT_CUSTOM_8 = 50,
  miIMG_FORMAT_CUSTOM_9 = 51,
  miIMG_FORMAT_CUSTOM_10 = 52,
  miIMG_FORMAT_CUSTOM_11 = 53,
  miIMG_FORMAT_CUSTOM_12 = 54,
  miIMG_FORMAT_CUSTOM_13 = 55,
  miIMG_FORMAT_CUSTOM_14 = 56,
  miIMG_FORMAT_CUSTOM_15 = 57,
  miIMG_FORMAT_PNG = 58,
  miIMG_FORMAT_EXR = 60,
  miIMG_FORMAT_DDS = 61,
  miIMG_FORMAT_FROM_EXT = 255
} miImg_format;

typedef enum miImg_error {
  miIMG_ERR_NONE = 0,
  miIMG_ERR_READ,
  miIMG_ERR_WRITE,
  miIMG_ERR_DECODE,
  miIMG_ERR_ENCODE,
  miIMG_ERR_TYPE,
  miIMG_ERR_SUBTYPE,
  miIMG_ERR_CREATE,
  miIMG_ERR_OPEN,
  miIMG_ERR_CLOSE,
  miIMG_ERR_ARGS,
  miIMG_ERR_NOTOPEN,
  miIMG_ERR_NOTCLOSED,
  miIMG_ERR_SIZE
} miImg_error;

// Components of mi_img_access.
#define miIMG_R 0
#define miIMG_G 1
#define miIMG_B 2
#define miIMG_A 3
#define miIMG_S 0
#define miIMG_U 0
#define miIMG_V 1
#define miIMG_Z 0
#define miIMG_NX 0
#define miIMG_NY 1
#define miIMG_NZ 2
#define miIMG_T 0
#define miIMG_E 3

// Indices of the frame buffers that always exist, for mi_output_image_open.
#define miRC_IMAGE_RGBA 0
#define miRC_IMAGE_Z 1
#define miRC_IMAGE_N 2
#define miRC_IMAGE_M 3
#define miRC_IMAGE_TAG 4
#define miRC_IMAGE_COVERAGE 5
#define miRC_IMAGE_PPREV 7
#define miRC_IMAGE_USER 12

/// An open image file.
typedef struct miImg_file {
  int width, height;
  int bits, comp;
  miBoolean filter;
  miBoolean topdown;
  long filesize;
  float gamma;
  float aspect;
  int parms[8];
  miImg_type type;
  miImg_format format;
  miImg_error error;
  int os_error;
} miImg_file;

/// An image in memory; its pixels are accessed by the functions below only.
typedef struct miImg_image {
  miBoolean filter;
  int dirsize;
  int dir[20];
  int width, height;
  int bits, comp;
  miBoolean local, writable, cacheable;
  miImg_type type;
  char* real_name;
  int c[4];
} miImg_image;

/// Opens an image file for reading; type: the type of its elements, or miIMG_TYPE_ANY.
miBoolean mi_img_open(miImg_file* file, const char* name, miImg_type type);
/// Creates an image file for writing.
miBoolean mi_img_create(miImg_file* file, const char* name, miImg_type type, miImg_format format,
                        int width, int height);
/// Closes a file after reading or writing.
miBoolean mi_img_close(miImg_file* file);
/// Reads the whole picture into an image allocated for this file.
miBoolean mi_img_image_read(miImg_file* file, miImg_image* image);
/// Writes the whole picture.
miBoolean mi_img_image_write(miImg_file* file, miImg_image* image);
/// Allocates an image for the picture of this file.
miImg_image* mi_img_image_alloc(miImg_file* file);
/// Frees an image of mi_img_image_alloc.
void mi_img_image_release(miImg_image* image);
/// Sets a pixel to a colour.
void mi_img_put_color(miImg_image* image, const miColor* value, int x, int y);
/// Returns the colour of a pixel.
void mi_img_get_color(miImg_image* image, miColor* value, int x, int y);
/// Sets a pixel to a scalar.
void mi_img_put_scalar(miImg_image* image, miScalar value, int x, int y);
/// Returns the scalar of a pixel.
void mi_img_get_scalar(miImg_image* image, miScalar* value, int x, int y);
/// Sets a pixel to a vector.
void mi_img_put_vector(miImg_image* image, const miVector* value, int x, int y);
/// Returns the vector of a pixel.
void mi_img_get_vector(miImg_image* image, miVector* value, int x, int y);
/// Sets a pixel to a depth, scene units.
void mi_img_put_depth(miImg_image* image, miScalar value, int x, int y);
/// Returns the depth of a pixel, scene units.
void mi_img_get_depth(miImg_image* image, miScalar* value, int x, int y);
/// Sets the coverage of a pixel.
void mi_img_put_coverage(miImg_image* image, miScalar value, int x, int y);
/// Returns the coverage of a pixel.
void mi_img_get_coverage(miImg_image* image, miScalar* value, int x, int y);
/// Sets a pixel to a normal, camera space.
void mi_img_put_normal(miImg_image* image, const miVector* value, int x, int y);
/// Returns the normal of a pixel, camera space.
void mi_img_get_normal(miImg_image* image, miVector* value, int x, int y);
/// Sets a pixel to an object label.
void mi_img_put_label(miImg_image* image, miUint value, int x, int y);
/// Returns the object label of a pixel.
void mi_img_get_label(miImg_image* image, miUint* value, int x, int y);
/// Start of row y of a component.
miUchar* mi_img_access(miImg_image* image, int y, int comp);
/// Pixels in a row.
int mi_img_get_width(const miImg_image* image);
/// Number of rows.
int mi_img_get_height(const miImg_image* image);
/// Type by its name in scenes ("rgba_fp"); miIMG_NTYPES if unknown.
miImg_type mi_img_type_identify(const char* name);
/// Format by its name in scenes ("exr").
miImg_format mi_img_format_identify(const char* name);
/// Name of a type in scenes.
char* mi_img_type_name(miImg_type type);
/// Name of a format in scenes.
char* mi_img_format_name(miImg_format format);
/// Opens a light map for writing; returns its image, or NULL.
void* mi_lightmap_edit(void** handle, miTag tag);
/// Ends mi_lightmap_edit.
void mi_lightmap_edit_end(void* handle);

/// Start of row y of a component.
#define miIMG_ACCESS(img, y, comp) mi_img_access((img), (y), (comp))

#ifdef __cplusplus
}
#endif

#endif
