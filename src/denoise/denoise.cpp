// SPDX-License-Identifier: Apache-2.0
#include "denoise/denoise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "base/parallel.h"
#include "denoise/denoise_planes.h"
#include "denoise/denoise_regression.h"
#include "denoise/oidn.h"
#include "denoise/restore_light.h"

namespace oriel {
namespace {

using denoising::Estimate;
using denoising::for_each_value;
using denoising::kBandwidths;
using denoising::Noisy;
using denoising::Oidn;
using denoising::Planes;

/// The bandwidth is selected by the mean error within the first radius, since errors of single
/// pixels are too noisy; the selection is then blurred with the second radius.
constexpr int kErrorRadius = 4, kChoiceRadius = 2;
/// Bandwidth without an error estimate: the wider one, because a picture that is its own guide fits
/// its own noise too closely.
constexpr int kBandwidthAlone = 1;

/// Noise that a window may leave, in standard errors of a pixel: that of a mean of 70 pixels.
/// Larger differences between the scales are details, which the smaller picture has lost: with .1
/// and .3 the error (FLIP) of two interiors is 0 to 1 % lower and 1 to 4 % higher.
constexpr float kMostResidue = 0.12f;
/// Pictures whose sides are shorter have no smaller one.
constexpr int kSmallestSide = 48;

constexpr char kNoOidn[] =
    "the library of Open Image Denoise was not found; install it, or set ORIEL_OIDN_LIBRARY to its "
    "path";

/// The mean of one half of the samples, with twice the variance of the whole.
Estimate half_of(const Noisy& noisy, float sign) {
  Estimate e{noisy.mean, noisy.variance};
  for_each_value(e.mean, [&](std::size_t i) {
    e.mean.values[i] += sign * noisy.half.values[i];
    e.variance.values[i] *= 2;
  });
  return e;
}

/// Excess squared error of the wider bandwidth against the other half, in units of variance.
Planes excess_of_wider(const Estimate& a, const Estimate& b,
                       const std::array<Planes, kBandwidths>& to_a,
                       const std::array<Planes, kBandwidths>& to_b) {
  Planes excess(a.mean.width, a.mean.height, 1);
  for_each_value(excess, [&](std::size_t i) {
    for (int c = 0; c < 3; ++c) {
      const std::size_t k = c * excess.size() + i;
      const auto error = [&](int width) {
        const float difference = a.mean.values[k] - b.mean.values[k];
        const float of_a = difference + to_a[width].values[k];
        const float of_b = difference - to_b[width].values[k];
        return of_a * of_a + of_b * of_b;
      };
      const float level = a.mean.values[k] * a.mean.values[k] + b.mean.values[k] * b.mean.values[k];
      excess.values[i] += (error(1) - error(0)) /
                          (a.variance.values[k] + b.variance.values[k] + 1e-6f * level + 1e-30f);
    }
  });
  return denoising::box_blur(excess, kErrorRadius);
}

using Corrections = std::array<Planes, kBandwidths>;

/// Averages neighbours with the weights that the noisy picture decides: either half of its samples
/// is filtered with the other half as the guide; without halves the picture is its own guide.
///
/// Model:   a window leaves slow variations of the noise, which show as stains on walls. In the
///          picture at half the size, filtered likewise, they are averaged over twice the distance.
///          The difference between its correction and that of the picture is added to the latter,
///          up to kMostResidue.
/// Source:  the scales: M. Delbracio, P. Muse, A. Buades, J. Chauvier, N. Phelps, J.-M. Morel,
///          "Boosting Monte Carlo Rendering by Ray Histogram Fusion", TOG 33(1), 2014, without
///          limits.
class Filter {
 public:
  Filter(const Noisy& noisy, float strength) : noisy_(noisy), strength_(strength) {
    if (has_halves()) {
      guides_ = {half_of(noisy, 1), half_of(noisy, -1)};
      const Estimate &a = guides_[0], &b = guides_[1];
      const Corrections to_a = regress(a.mean, 1), to_b = regress(b.mean, 0);
      wide_ = excess_of_wider(a, b, to_a, to_b);
      for_each_value(wide_, [&](std::size_t i) { wide_.values[i] = wide_.values[i] < 0 ? 1 : 0; });
      wide_ = denoising::box_blur(wide_, kChoiceRadius);
      color_ = mean_of(to_a, to_b);
    } else {
      guides_[0] = {noisy.mean, noisy.variance};
      color_ = regress(noisy.mean, 0)[kBandwidthAlone];
    }
    if (std::min(noisy.mean.width, noisy.mean.height) < kSmallestSide) return;
    half_size_noisy_ = std::make_unique<Noisy>(denoising::at_half_size(noisy));
    half_size_ = std::make_unique<Filter>(*half_size_noisy_, strength);
    add_residue(half_size_->color_, color_);
  }

  /// The correction of the mean colour.
  const Planes& color() const { return color_; }
  /// The correction of a part of the colour, whose halves are not known.
  Planes part(const Planes& mean) const {
    Planes out = has_halves() ? mean_of(regress(mean, 0), regress(mean, 1))
                              : regress(mean, 0)[kBandwidthAlone];
    if (half_size_) add_residue(half_size_->part(denoising::at_half_size(mean)), out);
    return out;
  }

 private:
  bool has_halves() const { return noisy_.half.count > 0; }
  Corrections regress(const Planes& mean, int guide) const {
    // Both halves have the same variance.
    return denoising::regress({mean, guides_[0].variance}, guides_[guide], noisy_.features,
                              strength_);
  }
  Planes mean_of(const Corrections& a, const Corrections& b) const {
    Planes out(wide_.width, wide_.height, 3);
    for_each_value(out, [&](std::size_t i) {
      const float wide = wide_.values[i % wide_.size()];
      out.values[i] = ((1 - wide) * (a[0].values[i] + b[0].values[i]) +
                       wide * (a[1].values[i] + b[1].values[i])) /
                      2;
    });
    return out;
  }
  /// Adds the difference between the correction at half the size and this one.
  void add_residue(const Planes& of_half_size, Planes& correction) const {
    Planes residue = denoising::at_half_size(correction);
    for_each_value(residue, [&](std::size_t i) {
      residue.values[i] = of_half_size.values[i] - residue.values[i];
    });
    residue = denoising::at_size(residue, correction.width, correction.height);
    for_each_value(correction, [&](std::size_t i) {
      const float most = kMostResidue * std::sqrt(noisy_.variance.values[i]);
      correction.values[i] += std::clamp(residue.values[i], -most, most);
    });
  }

  const Noisy& noisy_;
  float strength_;
  std::array<Estimate, 2> guides_;
  Planes wide_;  ///< share of the wider bandwidth
  Planes color_;
  std::unique_ptr<Noisy> half_size_noisy_;  ///< null: the picture is small
  std::unique_ptr<Filter> half_size_;
};

Planes corrected(const Planes& color, const Planes& correction, const Planes& albedo) {
  Planes out = color;
  for_each_value(out, [&](std::size_t i) {
    // Clamp to non-negative values; a linear fit may be negative near a steep edge.
    out.values[i] = std::max(color.values[i] + correction.values[i] * albedo.values[i],
                             std::min(color.values[i], 0.0f));
  });
  return out;
}

struct Filtered {
  Planes color;
  std::vector<Planes> parts;
};

Filtered filter_by_regression(const Noisy& noisy, float strength) {
  const Filter filter(noisy, strength);
  Filtered out{corrected(noisy.color, filter.color(), noisy.albedo), {}};
  for (const Planes& part : noisy.parts) {
    Planes mean = part;
    for_each_value(mean, [&](std::size_t i) { mean.values[i] /= noisy.albedo.values[i]; });
    out.parts.push_back(corrected(part, filter.part(mean), noisy.albedo));
  }
  return out;
}

Filtered filter_by(const Oidn& oidn, const Noisy& noisy, bool has_features) {
  const Planes* features = has_features ? &noisy.features : nullptr;
  Filtered out{oidn.denoise(noisy.color, features), {}};
  for (const Planes& part : noisy.parts) out.parts.push_back(oidn.denoise(part, features));
  return out;
}

/// Changes the parts such that they sum to the whole: each in proportion to itself.
void make_sum(const Planes& whole, std::vector<Planes>& parts) {
  for_each_value(whole, [&](std::size_t i) {
    float sum = 0, magnitude = 0;
    for (const Planes& part : parts) {
      sum += part.values[i];
      magnitude += std::abs(part.values[i]);
    }
    const float missing = whole.values[i] - sum;
    for (Planes& part : parts)
      part.values[i] += missing * (magnitude > 0 ? std::abs(part.values[i]) / magnitude
                                                 : 1 / float(parts.size()));
  });
}

void copy(const Planes& from, Image& to) {
  parallel_for(std::size_t(to.height), [&](std::size_t y) {
    for (int x = 0; x < to.width; ++x)
      for (int c = 0; c < 3; ++c) to.at(x, int(y))[c] = from.row(c, int(y))[x];
  });
}

}  // namespace

DenoiseInput denoise_input(const std::vector<Layer>& layers) {
  const auto image = [&](const char* name) {
    const Layer* layer = find_layer(layers, name);
    return layer ? &layer->image : nullptr;
  };
  const Layer* beauty = find_linear_beauty(layers);
  return {beauty ? &beauty->image : nullptr,
          image("halves"),
          image("variance"),
          image("albedo"),
          image("normal"),
          image("Z")};
}

bool has_oidn() { return Oidn::find() != nullptr; }

DenoisedPicture denoise_with_parts(const DenoiseInput& input, const DenoiseOptions& options) {
  const Noisy noisy = denoising::prepare(input, options);
  DenoisedPicture out;
  Filtered filtered;
  const Oidn* oidn = options.denoiser == Denoiser::Own ? nullptr : Oidn::find();
  if (options.denoiser == Denoiser::Oidn && !oidn) throw std::runtime_error(kNoOidn);
  if (oidn) {
    try {
      filtered = filter_by(*oidn, noisy, input.albedo && input.normal);
      out.denoiser = oidn->name();
    } catch (const std::runtime_error& error) {
      if (options.denoiser == Denoiser::Oidn) throw;
      out.note = error.what();
      oidn = nullptr;
    }
  }
  if (!oidn) {
    filtered = filter_by_regression(noisy, options.strength);
    out.denoiser = "Oriel";
  }
  denoising::restore_light(noisy, filtered.color);
  if (!filtered.parts.empty()) make_sum(filtered.color, filtered.parts);

  out.color = *input.color;
  copy(filtered.color, out.color);
  for (const Planes& part : filtered.parts)
    copy(part, out.parts.emplace_back(part.width, part.height, 3));
  return out;
}

Image denoise(const DenoiseInput& input, const DenoiseOptions& options) {
  return denoise_with_parts(input, options).color;
}

}  // namespace oriel
