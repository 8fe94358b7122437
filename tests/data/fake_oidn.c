/* SPDX-License-Identifier: Apache-2.0
 * A library with the interface of Open Image Denoise, for tests: version 1 by default, version 2
 * with FAKE_VERSION=2, which has other names for some functions. Its filter returns the mean of
 * each row, and fails unless the calls are those that the real library needs. */
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#ifndef FAKE_VERSION
#define FAKE_VERSION 1
#endif

struct Image {
  float* data;
  size_t width, height, pixel, row;
};
struct Filter {
  struct Image color, albedo, normal, output;
  int hdr, clean, committed;
};

static int is_committed, is_albedo_clean, is_normal_clean;
static const char* error;
static int device;

void* oidnNewDevice(int type) { return type == 1 ? &device : NULL; }
void oidnCommitDevice(void* d) { is_committed = d == &device; }
int oidnGetDeviceError(void* d, const char** message) {
  const char* now = error;
  (void)d;
  *message = now;
  error = NULL;
  return now ? 2 : 0;
}

static int device_int(void* d, const char* name) {
  return d == &device && strcmp(name, "version") == 0 ? 10000 * FAKE_VERSION + 403 : 0;
}

void* oidnNewFilter(void* d, const char* type) {
  if (d != &device || !is_committed || strcmp(type, "RT") != 0) error = "device is not committed";
  return calloc(1, sizeof(struct Filter));
}

void oidnSetSharedFilterImage(void* f, const char* name, void* data, int format, size_t width,
                              size_t height, size_t offset, size_t pixel, size_t row) {
  struct Filter* filter = f;
  struct Image* image = strcmp(name, "color") == 0    ? &filter->color
                        : strcmp(name, "albedo") == 0 ? &filter->albedo
                        : strcmp(name, "normal") == 0 ? &filter->normal
                                                      : &filter->output;
  if (format != 3) error = "the format must be three floats";
  image->data = (float*)((char*)data + offset);
  image->width = width;
  image->height = height;
  image->pixel = pixel ? pixel : 3 * sizeof(float);
  image->row = row ? row : width * image->pixel;
}

/* bool is one byte */
static void set_bool(void* f, const char* name, _Bool value) {
  struct Filter* filter = f;
  if (strcmp(name, "hdr") == 0)
    filter->hdr = value;
  else if (strcmp(name, "cleanAux") == 0)
    filter->clean = value;
  else
    error = "unknown parameter";
}

void oidnCommitFilter(void* f) { ((struct Filter*)f)->committed = 1; }

static float* at(const struct Image* image, size_t x, size_t y) {
  return (float*)((char*)image->data + y * image->row + x * image->pixel);
}

void oidnExecuteFilter(void* f) {
  struct Filter* filter = f;
  const struct Image* in = filter->color.data    ? &filter->color
                           : filter->albedo.data ? &filter->albedo
                                                 : &filter->normal;
  if (getenv("FAKE_OIDN_ERROR")) error = "out of memory";
  if (!filter->committed) error = "the filter is not committed";
  if (filter->color.data && !filter->hdr) error = "values above 1 would be cut";
  if (filter->clean && !(is_albedo_clean && is_normal_clean)) error = "the features are noisy";
  if (!in->data || !filter->output.data || in->width != filter->output.width)
    error = "images are missing";
  if (error) return;
  if (in == &filter->albedo) is_albedo_clean = 1;
  if (in == &filter->normal) is_normal_clean = 1;
  for (size_t y = 0; y < in->height; ++y)
    for (int c = 0; c < 3; ++c) {
      double sum = 0;
      for (size_t x = 0; x < in->width; ++x) sum += at(in, x, y)[c];
      for (size_t x = 0; x < in->width; ++x)
        at(&filter->output, x, y)[c] = (float)(sum / (double)in->width);
    }
}

void oidnReleaseFilter(void* f) { free(f); }

#if FAKE_VERSION == 1
int oidnGetDevice1i(void* d, const char* name) { return device_int(d, name); }
void oidnSetFilter1b(void* f, const char* name, _Bool value) { set_bool(f, name, value); }
#else
int oidnGetDeviceInt(void* d, const char* name) { return device_int(d, name); }
void oidnSetFilterBool(void* f, const char* name, _Bool value) { set_bool(f, name, value); }
#endif
