// SPDX-License-Identifier: Apache-2.0
#include "render/film.h"

#include <limits>

namespace oriel {
namespace {

Rgb finite_or_black(const Rgb& c) { return is_finite(c) ? c : Rgb(0); }

float brightness(const Rgb& c) { return (c.x + c.y + c.z) / 3; }

float finite_or_zero(float x) { return std::isfinite(x) ? x : 0.0f; }

/// a * x + b * y, where y may be missing altogether.
template <class T>
T weigh(float a, const T& x, float b, const T* y) {
  return y ? x * a + *y * b : x * a;
}

}  // namespace

void PixelMeans::add(const FilmSample& s, bool mapped) {
  const Rgb c = finite_or_black(s.beauty);
  const float share = 1 / static_cast<float>(++samples);

  const Rgb before = c - beauty;
  beauty += before * share;
  beauty_m2 += before * (c - beauty);
  alpha += (finite_or_zero(s.alpha) - alpha) * share;
  normal += ((is_finite(s.normal) ? s.normal : Vec3(0)) - normal) * share;
  albedo += (finite_or_black(s.albedo) - albedo) * share;

  const Rgb shown = mapped ? finite_or_black(s.display) : c;
  if (mapped) display += (shown - display) * share;
  const float value = brightness(shown);
  const float level_before = value - level;
  level += level_before * share;
  level_m2 += level_before * (value - level);

  if (s.depth > 0 && std::isfinite(s.depth))
    depth += (s.depth - depth) / static_cast<float>(++hits);
}

Film::Film(int width, int height, const FilterSampler& filter, bool mapped)
    : width_(width),
      height_(height),
      mapped_(mapped),
      clips_(filter.clips()),
      plain_share_(filter.positive_share()),
      marked_share_(-filter.negative_share()),
      plain_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
      marked_(filter.has_negative_lobes() ? plain_.size() : 0) {}

void Film::add(int x, int y, const FilmSample& sample) {
  const bool marked = sample.negative && !marked_.empty();
  (marked ? marked_ : plain_)[index(x, y)].add(sample, mapped_);
}

double Film::mean_samples() const {
  double sum = 0;  // double: counts of millions of pixels
  for (std::size_t i = 0; i < plain_.size(); ++i) sum += samples(i);
  return plain_.empty() ? 0 : sum / static_cast<double>(plain_.size());
}

Film::Shares Film::shares(std::size_t pixel) const {
  if (marked_.empty() || marked_[pixel].samples == 0) return {1, 0};
  // Until both kinds have been drawn one stands for the other.
  if (plain_[pixel].samples == 0) return {0, 1};
  return {plain_share_, marked_share_};
}

Film::Pixel Film::pixel(int x, int y) const {
  const std::size_t i = index(x, y);
  const PixelMeans& p = plain_[i];
  const PixelMeans* m = marked_.empty() ? nullptr : &marked_[i];
  const Shares s = shares(i);

  Pixel out;
  Rgb colour = weigh(s.plain, p.beauty, s.marked, m ? &m->beauty : nullptr);
  float alpha = weigh(s.plain, p.alpha, s.marked, m ? &m->alpha : nullptr);
  out.display = weigh(s.plain, p.display, s.marked, m ? &m->display : nullptr);
  out.albedo = weigh(s.plain, p.albedo, s.marked, m ? &m->albedo : nullptr);
  out.normal = weigh(s.plain, p.normal, s.marked, m ? &m->normal : nullptr);
  if (clips_) {
    for (int c = 0; c < 3; ++c) {
      colour[c] = std::max(colour[c], 0.0f);
      out.display[c] = std::max(out.display[c], 0.0f);
    }
  }
  // Coverage outside 0...1 has no meaning, whatever the filter.
  if (m) alpha = clamp01(alpha);
  out.beauty = Rgba(colour.x, colour.y, colour.z, alpha);

  const auto variance = [](const PixelMeans& means, float share) {
    const auto n = static_cast<float>(means.samples);
    return n > 1 ? means.beauty_m2 * (share * share / (n * (n - 1))) : Rgb(0);
  };
  out.variance = variance(p, s.plain) + (m ? variance(*m, s.marked) : Rgb(0));

  // A mean of distances, not a filtered one: negative weights make no sense of them.
  const std::uint32_t hits = p.hits + (m ? m->hits : 0);
  if (hits > 0)
    out.depth = (p.depth * static_cast<float>(p.hits) +
                 (m ? m->depth * static_cast<float>(m->hits) : 0.0f)) /
                static_cast<float>(hits);
  return out;
}

Film::Level Film::level(std::size_t pixel) const {
  if (samples(pixel) < 2) {
    const float only = plain_[pixel].samples ? plain_[pixel].level
                       : marked_.empty()     ? 0.0f
                                             : marked_[pixel].level;
    return {only, std::numeric_limits<float>::infinity()};
  }
  const Shares s = shares(pixel);
  float mean = 0, variance = 0;
  const auto gather = [&](const PixelMeans& means, float share) {
    const auto n = static_cast<float>(means.samples);
    mean += share * means.level;
    if (n > 1) variance += share * share * means.level_m2 / (n * (n - 1));
  };
  gather(plain_[pixel], s.plain);
  if (!marked_.empty()) gather(marked_[pixel], s.marked);
  return {mean, std::sqrt(std::max(variance, 0.0f))};
}

}  // namespace oriel
