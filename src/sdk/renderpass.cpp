// SPDX-License-Identifier: Apache-2.0
// Render pass files, which are unsupported.
#include "oriel/sdk/shader/renderpass.h"

#include "sdk/once.h"

namespace {

/// All functions return the result for a missing pass.
miBoolean no_pass(const char* function) {
  oriel::sdk::warn_no_effect(function, "files of render passes are neither read nor written");
  return miFALSE;
}

}  // namespace

extern "C" {

void* mi_renderpass_access(miState*, int, int) {
  no_pass("mi_renderpass_access");
  return nullptr;
}

// A resolution of 0 ends loops over pixels at once.
miBoolean mi_renderpass_resolution(int* xl, int* yl, int* xs, int* ys, int* xres, int* yres,
                                   miState*, int, int) {
  for (int* number : {xl, yl, xs, ys, xres, yres})
    if (number) *number = 0;
  return no_pass("mi_renderpass_resolution");
}

miBoolean mi_renderpass_sample_get(void*, int, miState*, int, int, int) {
  return no_pass("mi_renderpass_sample_get");
}

miBoolean mi_renderpass_sample_put(const void*, int, miState*, int, int, int) {
  return no_pass("mi_renderpass_sample_put");
}

miBoolean mi_renderpass_samplerect_black(miState*, int, int, int) {
  return no_pass("mi_renderpass_samplerect_black");
}

miBoolean mi_renderpass_samplerect_flush(miState*, int, int, int) {
  return no_pass("mi_renderpass_samplerect_flush");
}

}  // extern "C"
