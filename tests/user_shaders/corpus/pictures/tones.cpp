// SPDX-License-Identifier: Apache-2.0
// Maps the sum of the picture and of a buffer by its brightness; the buffer gets the luminance.
#include <cmath>
#include <vector>

#include <shader.h>

struct cp_tones {
  miInteger extra;
  miScalar white;
};

namespace {

class Buffer {
 public:
  Buffer(miState* state, miUint index) : state_(state), index_(index) {
    image_ = mi_output_image_open(state, index);
  }
  ~Buffer() { mi_output_image_close(state_, index_); }
  bool ok() const { return image_ != 0; }
  miColor get(int x, int y) const {
    miColor c = {0, 0, 0, 0};
    if (image_) mi_img_get_color(image_, &c, x, y);
    return c;
  }
  void put(int x, int y, const miColor& c) { mi_img_put_color(image_, &c, x, y); }

 private:
  Buffer(const Buffer&);
  Buffer& operator=(const Buffer&);
  miState* state_;
  miUint index_;
  miImg_image* image_;
};

}  // namespace

extern "C" DLLEXPORT int cp_tones_version(void) { return 1; }

extern "C" DLLEXPORT miBoolean cp_tones(void*, miState* state, cp_tones* paras) {
  const int w = state->camera->x_resolution, h = state->camera->y_resolution;
  Buffer picture(state, miRC_IMAGE_RGBA);
  Buffer extra(state, miRC_IMAGE_USER + *mi_eval_integer(&paras->extra));
  Buffer missing(state, miRC_IMAGE_USER + 77);
  if (!picture.ok() || missing.ok()) return miFALSE;
  const miScalar white = *mi_eval_scalar(&paras->white);
  std::vector<miColor> copy(w * h);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      miColor c = picture.get(x, y);
      const miColor e = extra.get(x, y);
      c.r += e.r; c.g += e.g; c.b += e.b;
      copy[y * w + x] = c;
    }
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      miColor c = copy[y * w + x];
      const miScalar l = (c.r + c.g + c.b) / 3;
      const miScalar f = (1 + l / (white * white)) / (1 + l);
      c.r *= f; c.g *= f; c.b *= f;
      picture.put(x, y, c);
    }
  return miTRUE;
}
