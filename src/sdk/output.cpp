// SPDX-License-Identifier: Apache-2.0
// The finished picture for output shaders.
#include "sdk/output_work.h"

#include "sdk/call.h"
#include "sdk/once.h"

using namespace oriel;
using namespace oriel::sdk;

extern "C" {

miImg_image* mi_output_image_open(miState* state, miUint index) {
  OutputWork* work = context(state).output;
  if (!work) return nullptr;
  const int number = static_cast<int>(index);
  if (const auto found = work->open.find(number); found != work->open.end())
    return found->second.get();
  const Image* image = work->picture->buffer(number);
  if (!image) return nullptr;
  const miImg_type type = image->channels == 1   ? miIMG_TYPE_Z
                          : image->channels == 3 ? miIMG_TYPE_N
                                                 : miIMG_TYPE_RGBA_FP;
  auto open = std::make_unique<Picture>(type, image->width, image->height);
  fill(*open, *image);
  open->writable = work->picture->is_writable(number);
  return (work->open[number] = std::move(open)).get();
}

void mi_output_image_close(miState* state, miUint index) {
  OutputWork* work = context(state).output;
  if (work) work->close(static_cast<int>(index));
}

// Contours are unsupported.
miBoolean mi_get_contour_line(miContour_endpoint*, miContour_endpoint*) {
  warn_no_effect("mi_get_contour_line", "contours are unsupported");
  return miFALSE;
}
void mi_add_contour_lines(miContour_endpoint[], miContour_endpoint[], int) {
  warn_no_effect("mi_add_contour_lines", "contours are unsupported");
}

}  // extern "C"
