// SPDX-License-Identifier: Apache-2.0
#include "image/flip.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "base/math.h"
#include "base/parallel.h"
#include "base/vec.h"

namespace oriel {
namespace {

// Constants of the paper: exponents and break points of the error map, and the width of the
// feature detector in degrees.
constexpr float kColourExponent = 0.7f;     // qc
constexpr float kFeatureExponent = 0.5f;    // qf
constexpr float kBreakShare = 0.4f;         // pc
constexpr float kBreakError = 0.95f;        // pt
constexpr float kFeatureWidthDeg = 0.082f;  // w

using Plane = std::vector<float>;

struct Picture {
  int width, height;
  Plane plane[3];
};

// --- colour spaces; linear sRGB, reference white D65 as the sum of the matrix's columns ---

Vec3 xyz_of(const Vec3& c) {
  return Vec3(0.4123908f * c.x + 0.3575843f * c.y + 0.1804808f * c.z,
              0.2126390f * c.x + 0.7151687f * c.y + 0.0721923f * c.z,
              0.0193308f * c.x + 0.1191948f * c.y + 0.9505322f * c.z);
}

Vec3 rgb_of(const Vec3& c) {
  return Vec3(3.2409699f * c.x - 1.5373832f * c.y - 0.4986108f * c.z,
              -0.9692436f * c.x + 1.8759675f * c.y + 0.0415551f * c.z,
              0.0556301f * c.x - 0.2039770f * c.y + 1.0569715f * c.z);
}

const Vec3 kWhite = xyz_of(Vec3(1, 1, 1));

float decoded(float v) {
  const float c = v > 0 ? std::min(v, 1.0f) : 0.0f;
  return c <= 0.04045f ? c / 12.92f : math::pow((c + 0.055f) / 1.055f, 2.4f);
}

Vec3 ycxcz_of(const Vec3& linear) {
  const Vec3 t = xyz_of(linear) / kWhite;
  return Vec3(116 * t.y - 16, 500 * (t.x - t.y), 200 * (t.y - t.z));
}

Vec3 linear_of_ycxcz(const Vec3& c) {
  const float y = (c.x + 16) / 116;
  return rgb_of(Vec3(y + c.y / 500, y, y - c.z / 200) * kWhite);
}

Vec3 hunt_lab_of(const Vec3& linear) {
  const Vec3 t = xyz_of(linear) / kWhite;
  const auto f = [](float v) {
    constexpr float kDelta = 6.0f / 29;
    return v > kDelta * kDelta * kDelta ? math::cbrt(v) : v / (3 * kDelta * kDelta) + 4.0f / 29;
  };
  const float lightness = 116 * f(t.y) - 16;
  return Vec3(lightness, 0.01f * lightness * 500 * (f(t.x) - f(t.y)),
              0.01f * lightness * 200 * (f(t.y) - f(t.z)));
}

float hyab(const Vec3& a, const Vec3& b) {
  return std::abs(a.x - b.x) + math::hypot(a.y - b.y, a.z - b.z);
}

// --- separable filters ---

/// Convolves rows with `kx`, then columns with `ky`, both of odd length. Border pixels are
/// repeated. The inner loops run over whole rows, one tap at a time, so that they vectorise.
Plane filtered(const Plane& in, int width, int height, const std::vector<float>& kx,
               const std::vector<float>& ky) {
  Plane between(in.size(), 0.0f), out(in.size(), 0.0f);
  const auto add_row = [width](float weight, const float* from, float* to) {
    for (int x = 0; x < width; ++x) to[x] += weight * from[x];
  };
  parallel_for(std::size_t(height), [&](std::size_t y) {
    const int r = int(kx.size()) / 2;
    const float* row = in.data() + y * width;
    std::vector<float> padded(width + 2 * r);
    for (int x = -r; x < width + r; ++x) padded[x + r] = row[std::clamp(x, 0, width - 1)];
    for (int i = 0; i <= 2 * r; ++i) add_row(kx[i], padded.data() + i, between.data() + y * width);
  });
  parallel_for(std::size_t(height), [&](std::size_t y) {
    const int r = int(ky.size()) / 2;
    for (int i = -r; i <= r; ++i) {
      const int from = std::clamp(int(y) + i, 0, height - 1);
      add_row(ky[i + r], between.data() + std::size_t(from) * width, out.data() + y * width);
    }
  });
  return out;
}

struct Gaussian {
  float height, width;  // a and b of the paper's contrast sensitivity functions
};

/// The contrast sensitivity filter of one opponent channel: a normalised sum of one or two
/// Gaussians.
Plane contrast_filtered(const Plane& in, int width, int height, const std::vector<Gaussian>& parts,
                        float pixels_per_degree) {
  // All channels share the radius of the widest Gaussian (b = 0.04).
  const int r = int(std::ceil(3 * std::sqrt(0.04f / (2 * kPi * kPi)) * pixels_per_degree));
  std::vector<std::vector<float>> kernels;
  std::vector<float> weights;
  float total = 0;
  for (const Gaussian& g : parts) {
    std::vector<float> k;
    float sum = 0;
    for (int i = -r; i <= r; ++i) {
      k.push_back(math::exp(-sqr(kPi * float(i) / pixels_per_degree) / g.width));
      sum += k.back();
    }
    for (float& v : k) v /= sum;
    // The sum of the unnormalised Gaussian in two dimensions is sum^2.
    weights.push_back(g.height * std::sqrt(kPi / g.width) * sum * sum);
    total += weights.back();
    kernels.push_back(std::move(k));
  }
  Plane out(in.size(), 0.0f);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const Plane one = filtered(in, width, height, kernels[p], kernels[p]);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += weights[p] / total * one[i];
  }
  return out;
}

/// Converts the sRGB-encoded picture to YCxCz.
Picture opponent_picture(const Image& image) {
  Picture out{image.width, image.height, {}};
  for (Plane& p : out.plane) p.resize(image.pixel_count());
  for (std::size_t i = 0; i < image.pixel_count(); ++i) {
    const float* v = image.pixels.data() + i * image.channels;
    const bool grey = image.channels < 3;
    const Vec3 c =
        ycxcz_of(Vec3(decoded(v[0]), decoded(v[grey ? 0 : 1]), decoded(v[grey ? 0 : 2])));
    for (int k = 0; k < 3; ++k) out.plane[k][i] = c[k];
  }
  return out;
}

/// The picture after contrast sensitivity filtering, in Hunt-adjusted L*a*b*.
std::vector<Vec3> perceived(const Picture& p, float ppd) {
  const Plane y = contrast_filtered(p.plane[0], p.width, p.height, {{1, 0.0047f}}, ppd);
  const Plane cx = contrast_filtered(p.plane[1], p.width, p.height, {{1, 0.0053f}}, ppd);
  const Plane cz =
      contrast_filtered(p.plane[2], p.width, p.height, {{34.1f, 0.04f}, {13.5f, 0.025f}}, ppd);
  std::vector<Vec3> out(y.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Vec3 c = linear_of_ycxcz(Vec3(y[i], cx[i], cz[i]));
    out[i] = hunt_lab_of(Vec3(clamp01(c.x), clamp01(c.y), clamp01(c.z)));
  }
  return out;
}

// --- features ---

struct Features {
  Plane edge, point;  // magnitudes
};

/// Scales positive and negative weights to sums of 1 and -1.
void normalise_signs(std::vector<float>& k) {
  float up = 0, down = 0;
  for (float v : k) (v > 0 ? up : down) += v;
  for (float& v : k) v = v > 0 ? v / up : (down < 0 ? v / -down : 0.0f);
}

Features features_of(const Picture& p, float ppd) {
  const float sigma = 0.5f * kFeatureWidthDeg * ppd;
  const int r = int(std::ceil(3 * sigma));
  std::vector<float> smooth, slope, bend;
  float sum = 0;
  for (int i = -r; i <= r; ++i) {
    const float g = math::exp(-sqr(float(i)) / (2 * sqr(sigma)));
    smooth.push_back(g);
    slope.push_back(-float(i) * g);
    bend.push_back((sqr(float(i) / sigma) - 1) * g);
    sum += g;
  }
  for (float& v : smooth) v /= sum;
  normalise_signs(slope);
  normalise_signs(bend);

  Plane grey(p.plane[0].size());
  std::transform(p.plane[0].begin(), p.plane[0].end(), grey.begin(),
                 [](float y) { return (y + 16) / 116; });
  const auto magnitude = [&](const std::vector<float>& k) {
    Plane x = filtered(grey, p.width, p.height, k, smooth);
    const Plane y = filtered(grey, p.width, p.height, smooth, k);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = math::hypot(x[i], y[i]);
    return x;
  };
  return {magnitude(slope), magnitude(bend)};
}

/// Maps the colour distance to 0...1. Most of the range is used for distances well below the
/// maximum.
float colour_error(const Vec3& a, const Vec3& b) {
  static const float largest =
      math::pow(hyab(hunt_lab_of(Vec3(0, 1, 0)), hunt_lab_of(Vec3(0, 0, 1))), kColourExponent);
  const float e = math::pow(hyab(a, b), kColourExponent);
  const float at = kBreakShare * largest;
  if (e < at) return kBreakError * e / at;
  return std::min(1.0f, kBreakError + (e - at) / (largest - at) * (1 - kBreakError));
}

}  // namespace

Image flip_error(const Image& test, const Image& reference, float pixels_per_degree) {
  if (test.width != reference.width || test.height != reference.height || test.empty() ||
      reference.empty())
    throw std::runtime_error("FLIP requires two pictures of the same size");
  const float ppd = pixels_per_degree > 0 ? pixels_per_degree : kFlipPixelsPerDegree;
  const Picture a = opponent_picture(test), b = opponent_picture(reference);
  const std::vector<Vec3> seen_a = perceived(a, ppd), seen_b = perceived(b, ppd);
  const Features fa = features_of(a, ppd), fb = features_of(b, ppd);

  Image out(test.width, test.height, 1);
  for (std::size_t i = 0; i < out.pixels.size(); ++i) {
    const float change =
        std::max(std::abs(fa.edge[i] - fb.edge[i]), std::abs(fa.point[i] - fb.point[i]));
    const float feature = std::min(1.0f, math::pow(change / std::sqrt(2.0f), kFeatureExponent));
    out.pixels[i] = math::pow(colour_error(seen_a[i], seen_b[i]), 1 - feature);
  }
  return out;
}

double mean_value(const Image& image) {
  double sum = 0;  // double: millions of small terms
  for (float v : image.pixels) sum += v;
  return image.pixels.empty() ? 0 : sum / double(image.pixels.size());
}

}  // namespace oriel
