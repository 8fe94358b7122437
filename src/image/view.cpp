// SPDX-License-Identifier: Apache-2.0
#include "image/view.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "base/parallel.h"

namespace oriel {
namespace {

/// Maps NaN to 0 and infinity to the largest float.
float tame(float x) { return std::isnan(x) ? 0.0f : clamp(x, -3.0e38f, 3.0e38f); }

Rgb desaturated(const Rgb& c, const Rgb& weight) {
  const float lowest = std::min({c.x, c.y, c.z});
  const float highest = std::max({c.x, c.y, c.z});
  if (lowest >= 0 && highest <= 1) return c;
  const float sum = weight.x + weight.y + weight.z;
  const float grey = sum > 0 ? clamp01(weight.dot(c) / sum) : clamp01((c.x + c.y + c.z) / 3);

  // The largest share of the way from grey to the colour that stays inside the unit cube.
  float share = 1;
  if (highest > 1) share = std::min(share, highest > grey ? (1 - grey) / (highest - grey) : 0);
  if (lowest < 0) share = std::min(share, grey > lowest ? grey / (grey - lowest) : 0);
  return Rgb(lerp(grey, c.x, share), lerp(grey, c.y, share), lerp(grey, c.z, share));
}

}  // namespace

Rgba view_color(const Rgba& linear, const ViewOptions& options) {
  Rgb c(tame(linear.r), tame(linear.g), tame(linear.b));
  float alpha = tame(linear.a);
  if (!options.premultiply && alpha > 0)
    c = Rgb(tame(c.x / alpha), tame(c.y / alpha), tame(c.z / alpha));
  if (options.desaturate) c = desaturated(c, options.luminance_weight);

  const float exponent = options.gamma > 0 ? 1 / options.gamma : 1;
  if (exponent != 1)
    for (int i = 0; i < 3; ++i) c[i] = c[i] > 0 ? math::pow(c[i], exponent) : 0.0f;

  c = Rgb(clamp01(c.x), clamp01(c.y), clamp01(c.z));
  alpha = clamp01(alpha);
  if (options.premultiply && options.clip == ColorClip::KeepColor)
    alpha = std::max(alpha, max_component(c));
  if (options.premultiply && options.clip == ColorClip::KeepAlpha)
    for (int i = 0; i < 3; ++i) c[i] = std::min(c[i], alpha);
  return Rgba(c.x, c.y, c.z, alpha);
}

Image view_image(const Image& linear, const ViewOptions& options) {
  Image out(linear.width, linear.height, linear.channels);
  const int n = linear.channels;
  parallel_for(std::size_t(linear.height), [&](std::size_t y) {
    for (int x = 0; x < linear.width; ++x) {
      const float* in = linear.at(x, int(y));
      float* to = out.at(x, int(y));
      const Rgba c = n >= 3 ? Rgba(in[0], in[1], in[2], n > 3 ? in[3] : 1)
                            : Rgba(in[0], in[0], in[0], n > 1 ? in[1] : 1);
      const Rgba v = view_color(c, options);
      if (n >= 3) {
        to[0] = v.r, to[1] = v.g, to[2] = v.b;
        if (n > 3) to[3] = v.a;
      } else {
        to[0] = v.r;
        if (n > 1) to[1] = v.a;
      }
    }
  });
  return out;
}

}  // namespace oriel
