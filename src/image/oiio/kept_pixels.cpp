// SPDX-License-Identifier: Apache-2.0
#include "image/oiio/kept_pixels.h"

#include <algorithm>
#include <cmath>

namespace oriel::oiio {
namespace {

/// The texel that shows at index i, which is at most one beyond the border.
int wrapped_texel(int i, int size, Wrap mode) {
  if (i >= 0 && i < size) return i;
  if (mode == Wrap::Periodic) return i < 0 ? i + size : i - size;
  return std::clamp(i, 0, size - 1);  // a mirror repeats the texel of the border as well
}

struct Texels {
  int first, second;
  float share;  ///< of the second
};

Texels texels_at(float x, int size, Wrap mode) {
  const float at = x * static_cast<float>(size) - 0.5f;
  const float below = std::floor(at);
  const int first = static_cast<int>(below);
  return {wrapped_texel(first, size, mode), wrapped_texel(first + 1, size, mode), at - below};
}

}  // namespace

void KeptPixels::sample(float u, float v, Wrap wrap_u, Wrap wrap_v, int channels,
                        float* out) const {
  const Texels x = texels_at(u, width_, wrap_u), y = texels_at(v, height_, wrap_v);
  const float* a = texel(x.first, y.first);
  const float* b = texel(x.second, y.first);
  const float* c = texel(x.first, y.second);
  const float* d = texel(x.second, y.second);
  for (int i = 0; i < channels; ++i)
    out[i] = lerp(lerp(a[i], b[i], x.share), lerp(c[i], d[i], x.share), y.share);
}

}  // namespace oriel::oiio
