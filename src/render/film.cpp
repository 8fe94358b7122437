// SPDX-License-Identifier: Apache-2.0
#include "render/film.h"

#include <bit>
#include <limits>

namespace oriel {
namespace {

Rgb finite_or_black(const Rgb& c) { return is_finite(c) ? c : Rgb(0); }

Rgb not_negative(const Rgb& c) {
  return Rgb(std::max(c.x, 0.0f), std::max(c.y, 0.0f), std::max(c.z, 0.0f));
}

float brightness(const Rgb& c) { return (c.x + c.y + c.z) / 3; }

float finite_or_zero(float x) { return std::isfinite(x) ? x : 0.0f; }

/// a * x + b * y, where y may be missing altogether.
template <class T>
T weigh(float a, const T& x, float b, const T* y) {
  return y ? x * a + *y * b : x * a;
}

Rgb variance_of_mean(const PixelMeans& means, float share) {
  const auto n = static_cast<float>(means.samples);
  return n > 1 ? means.beauty_m2 * (share * share / (n * (n - 1))) : Rgb(0);
}

/// Samples of a pixel go to its halves four by four: four that follow each other are spread evenly,
/// while every second one would be a half with a bias.
constexpr std::uint32_t kHalfBlock = 4;

std::uint32_t second_half(std::uint32_t samples) {
  const std::uint32_t rest = samples % (2 * kHalfBlock);
  return samples / (2 * kHalfBlock) * kHalfBlock + (rest > kHalfBlock ? rest - kHalfBlock : 0);
}

/// Half the difference of the halves' means: the first half is what the second leaves of the whole.
Rgb half_difference(const PixelMeans& means) {
  const std::uint32_t second = second_half(means.samples);
  if (second == 0) return Rgb(0);
  const float ratio =
      static_cast<float>(means.samples) / static_cast<float>(2 * (means.samples - second));
  return (means.beauty - means.second) * ratio;
}

/// The change of the mean brightness when its number of samples was last doubled, and the time
/// before. Samples are spread evenly over each first 2^k, so a change is that of an estimate with
/// half as many well-spread samples; the halves above differ more than that.
struct Doublings {
  float last = 0, before = 0;
};

Doublings doublings(const PixelMeans& means) {
  if (means.samples < kMinSplitSamples) return {};
  // Since then the error has fallen at least as that of independent samples.
  const float since = std::sqrt(static_cast<float>(std::bit_floor(means.samples)) /
                                static_cast<float>(means.samples));
  const auto& m = means.at_powers;
  return {since * (m[0] - m[1]), since * (m[1] - m[2])};
}

/// Parts are mapped separately where their spread is kApart times that of noise alone, and together
/// below kAlike times; in between gradually. Noise alone sometimes reaches the first limit and
/// hardly ever the second.
constexpr float kAlike = 1.5f, kApart = 4;
/// The same in denoised pixels, where what is left of noise would be seen as dots.
constexpr float kSurelyApart = 12;
/// Parts are mapped together where denoising left 1 / (1 + 1 / kTakenAway) of the light. A guess.
constexpr float kTakenAway = 8;

/// Samples of a part, below which nothing is said of noise within parts.
constexpr float kMinSamplesOfPart = 2;

/// A sample whose sums and differences are finite.
Rgb bounded(const Rgb& sample) {
  constexpr float kBrightest = 1e37f;
  const Rgb c = finite_or_black(sample);
  return {clamp(c.x, -kBrightest, kBrightest), clamp(c.y, -kBrightest, kBrightest),
          clamp(c.z, -kBrightest, kBrightest)};
}

/// The sum, or the largest finite number: an infinite variance would remain infinite with any
/// number of further samples.
Rgb finite_sum(const Rgb& a, const Rgb& b) {
  constexpr float kMost = std::numeric_limits<float>::max();
  return {std::min(a.x + b.x, kMost), std::min(a.y + b.y, kMost), std::min(a.z + b.z, kMost)};
}

/// The quarter of the turned grid that a part belongs to.
std::size_t quarter_of(std::size_t cell) { return cell / 8 * 2 + cell % 4 / 2; }

}  // namespace

void PixelMeans::add(const FilmSample& s) {
  const Rgb c = bounded(s.beauty);
  const float share = 1 / static_cast<float>(++samples);

  if ((samples - 1) & kHalfBlock) second += (c - second) / static_cast<float>(second_half(samples));
  const Rgb before = c - beauty;
  beauty += before * share;
  beauty_m2 = finite_sum(beauty_m2, before * (c - beauty));
  if (std::has_single_bit(samples)) at_powers = {brightness(beauty), at_powers[0], at_powers[1]};
  alpha += (finite_or_zero(s.alpha) - alpha) * share;
  normal += ((is_finite(s.normal) ? s.normal : Vec3(0)) - normal) * share;
  albedo += (finite_or_black(s.albedo) - albedo) * share;

  if (s.depth > 0 && std::isfinite(s.depth)) {
    const float hit_share = 1 / static_cast<float>(++hits);
    depth += (s.depth - depth) * hit_share;
    irradiance += (finite_or_zero(s.irradiance) - irradiance) * hit_share;
  }
}

void SubPixelMeans::add(const PartSample& s) {
  const std::size_t i = s.sub_pixel % kSubPixels;
  if (samples[i] == std::numeric_limits<std::uint16_t>::max()) return;
  const Rgb c = bounded(s.beauty);
  const float before = brightness(c - beauty[i]);
  beauty[i] += (c - beauty[i]) / static_cast<float>(++samples[i]);
  m2 = std::min(m2 + before * brightness(c - beauty[i]), std::numeric_limits<float>::max());
}

Film::Film(int width, int height, const FilterSampler& filter, DisplayMap map, FilmRequest request)
    : width_(width),
      height_(height),
      clips_(filter.clips()),
      positive_share_(filter.positive_share()),
      negative_share_(-filter.negative_share()),
      positive_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
      negative_(filter.has_negative_lobes() ? positive_.size() : 0),
      map_(std::move(map)),
      request_(std::move(request)),
      positive_parts_(map_ ? positive_.size() : 0),
      negative_parts_(map_ ? negative_.size() : 0) {
  add_planes();
}

std::size_t Film::bytes() const {
  std::size_t sum = (positive_.size() + negative_.size()) * sizeof(PixelMeans) +
                    (positive_parts_.size() + negative_parts_.size()) * sizeof(SubPixelMeans);
  for (const FilmPlane& plane : planes_) sum += plane.bytes();
  return sum;
}

void Film::add_planes() {
  using Record = PathRecord;
  const auto add = [&](const FilmPlane::Spec& spec) {
    planes_.emplace_back(spec, positive_.size(), negative_.size());
    return planes_.size() - 1;
  };
  const auto add_aov = [&](auto source, std::size_t values, float initial = 0, int channels = 3) {
    add({.channels = channels,
         .values = values,
         .initial = initial,
         .of_beauty = true,
         .source = source});
  };
  if (request_.aovs) {
    add_aov([](const Record& r, std::size_t) -> const float* { return &r.aovs->result[0].x; },
            kAovs);
    add_aov([](const Record& r, std::size_t) -> const float* { return &r.aovs->level[0].x; },
            kLevels);
    add_aov([](const Record& r, std::size_t) -> const float* { return &r.aovs->occlusion.x; }, 1,
            1);
    add_aov([](const Record& r, std::size_t) -> const float* { return &r.aovs->dimming.x; }, 1, 1);
    add_aov([](const Record& r, std::size_t) -> const float* { return &r.aovs->opacity; }, 1, 1, 1);
  }
  if (request_.light_layers > 0)
    light_plane_ = add({.values = request_.light_layers,
                        .of_beauty = true,
                        .source = [](const Record& r, std::size_t) -> const float* {
                          return r.has_layers() ? &r.by_light.of[0].x : nullptr;
                        }});
  buffer_plane_ = planes_.size();
  for (std::size_t i = 0; i < request_.user_buffers.size(); ++i)
    add({.channels = 4,
         .rule = request_.user_buffers[i],
         .source = [](const Record& r, std::size_t k) -> const float* {
           return k < r.user_buffers.size() ? &r.user_buffers[k].r : nullptr;
         },
         .index = i});
  for (std::size_t i = 0; i < kSurfaceValues; ++i)
    if (request_.surface_values[i])
      surface_planes_[i] = add({.rule = PlaneRule::FirstSample,
                                .source = [](const Record& r, std::size_t k) -> const float* {
                                  return &r.surface_values[k].x;
                                },
                                .index = i});
}

void Film::add(int x, int y, const FilmSample& sample) {
  const std::size_t i = index(x, y);
  const bool negative = sample.negative && !negative_.empty();
  (negative ? negative_ : positive_)[i].add(sample);
  if (map_) {
    SubPixelMeans& means = (negative ? negative_parts_ : positive_parts_)[i];
    if (sample.parts.empty()) means.add({sample.sub_pixel, sample.beauty});
    for (const PartSample& part : sample.parts) means.add(part);
  }
  if (planes_.empty()) return;
  static const PathRecord kEmpty(RecordRequest{.aovs = true});
  const PathRecord& record = sample.record ? *sample.record : kEmpty;
  const bool finite = is_finite(sample.beauty);
  const std::uint32_t samples_of_kind = (negative ? negative_ : positive_)[i].samples;
  const bool first = samples(i) == 1;
  for (FilmPlane& plane : planes_)
    plane.add(i, negative, samples_of_kind, first,
              plane.spec().of_beauty && !finite ? kEmpty : record);
}

void Film::clear() {
  const auto reset = [](auto& means) {
    std::fill(means.begin(), means.end(), typename std::decay_t<decltype(means)>::value_type{});
  };
  reset(positive_), reset(negative_), reset(positive_parts_), reset(negative_parts_);
  for (FilmPlane& plane : planes_) plane.clear();
}

bool Film::is_valid(std::uint32_t most) const {
  const auto valid = [&](const PixelMeans& m) {
    const float* const powers = m.at_powers.data();
    return m.samples <= most && m.hits <= m.samples && is_finite(m.beauty) &&
           is_finite(m.beauty_m2) && is_finite(m.second) &&
           is_finite(Vec3(powers[0], powers[1], powers[2])) &&
           is_finite(Vec3(m.alpha, m.depth, m.irradiance)) && is_finite(m.normal) &&
           is_finite(m.albedo);
  };
  const auto valid_parts = [](const SubPixelMeans& parts) {
    return std::isfinite(parts.m2) && std::all_of(parts.beauty.begin(), parts.beauty.end(),
                                                  [](const Rgb& c) { return is_finite(c); });
  };
  for (std::size_t i = 0; i < positive_.size(); ++i)
    if (!valid(positive_[i]) || (!negative_.empty() && !valid(negative_[i])) ||
        positive_[i].samples > most - (negative_.empty() ? 0 : negative_[i].samples))
      return false;
  return std::all_of(positive_parts_.begin(), positive_parts_.end(), valid_parts) &&
         std::all_of(negative_parts_.begin(), negative_parts_.end(), valid_parts) &&
         std::all_of(planes_.begin(), planes_.end(),
                     [](const FilmPlane& plane) { return plane.is_finite(); });
}

double Film::mean_samples() const {
  double sum = 0;  // double: counts of millions of pixels
  for (std::size_t i = 0; i < positive_.size(); ++i) sum += samples(i);
  return positive_.empty() ? 0 : sum / static_cast<double>(positive_.size());
}

Film::Shares Film::shares(std::size_t pixel) const {
  if (negative_.empty() || negative_[pixel].samples == 0) return {1, 0};
  // Until both kinds have been drawn one stands for the other.
  if (positive_[pixel].samples == 0) return {0, 1};
  return {positive_share_, negative_share_};
}

Rgb Film::color(std::size_t i) const {
  const Shares s = shares(i);
  const Rgb c = weigh(s.positive, positive_[i].beauty, s.negative,
                      negative_.empty() ? nullptr : &negative_[i].beauty);
  return clips_ ? not_negative(c) : c;
}

Rgb Film::color_error(std::size_t i) const {
  const Shares s = shares(i);
  Rgb variance = variance_of_mean(positive_[i], s.positive);
  if (!negative_.empty()) variance += variance_of_mean(negative_[i], s.negative);
  return Rgb(std::sqrt(variance.x), std::sqrt(variance.y), std::sqrt(variance.z));
}

Rgb Film::split_difference(std::size_t i) const {
  const Shares s = shares(i);
  Rgb difference = half_difference(positive_[i]) * s.positive;
  if (!negative_.empty()) difference += half_difference(negative_[i]) * s.negative;
  return difference;
}

Film::Pixel Film::pixel(int x, int y) const {
  const std::size_t i = index(x, y);
  const PixelMeans& p = positive_[i];
  const PixelMeans* m = negative_.empty() ? nullptr : &negative_[i];
  const Shares s = shares(i);

  Pixel out;
  const Rgb c = color(i);
  float alpha = weigh(s.positive, p.alpha, s.negative, m ? &m->alpha : nullptr);
  // Coverage outside 0...1 has no meaning, whatever the filter.
  if (m) alpha = clamp01(alpha);
  out.beauty = Rgba(c.x, c.y, c.z, alpha);
  out.albedo = weigh(s.positive, p.albedo, s.negative, m ? &m->albedo : nullptr);
  out.normal = weigh(s.positive, p.normal, s.negative, m ? &m->normal : nullptr);
  const Rgb error = color_error(i);
  out.variance = error * error;
  out.split_difference = split_difference(i);

  // A mean of distances, not a filtered one: negative weights make no sense of them.
  const auto over_hits = [&](float PixelMeans::*value) {
    const auto positive = static_cast<float>(p.hits),
               negative = m ? static_cast<float>(m->hits) : 0;
    return (p.*value * positive + (m ? m->*value * negative : 0)) /
           std::max(positive + negative, 1.0f);
  };
  out.depth = over_hits(&PixelMeans::depth);
  out.irradiance = over_hits(&PixelMeans::irradiance);
  return out;
}

/// Parts of what the filter clips to nothing are nothing.
void Film::clip(std::size_t pixel, Rgb& part) const {
  if (!clips_) return;
  const Rgb whole = color(pixel);
  for (int k = 0; k < 3; ++k)
    if (whole[k] <= 0) part[k] = 0;
}

AovValues Film::outputs(int x, int y) const {
  AovValues out;
  if (!keeps_outputs()) return out;
  const std::size_t i = index(x, y);
  const Shares s = shares(i);
  for (std::size_t c = 0; c < kAovs; ++c) {
    planes_[0].read(i, c, s, &out.result[c].x);
    clip(i, out.result[c]);
  }
  for (std::size_t c = 0; c < kLevels; ++c) planes_[1].read(i, c, s, &out.level[c].x);
  planes_[2].read(i, 0, s, &out.occlusion.x);
  planes_[3].read(i, 0, s, &out.dimming.x);
  planes_[4].read(i, 0, s, &out.opacity);
  return out;
}

Rgb Film::light(int x, int y, std::size_t layer) const {
  const std::size_t i = index(x, y);
  Rgb out;
  planes_[light_plane_].read(i, layer, shares(i), &out.x);
  clip(i, out);
  return out;
}

Rgba Film::user_buffer(int x, int y, std::size_t buffer) const {
  const std::size_t i = index(x, y);
  Rgba out;
  planes_[buffer_plane_ + buffer].read(i, 0, shares(i), &out.r);
  return out;
}

Vec3 Film::surface_value(int x, int y, SurfaceValue value) const {
  if (!stores(value)) return Vec3(0);
  const std::size_t i = index(x, y);
  Vec3 out;
  planes_[surface_planes_[static_cast<std::size_t>(value)]].read(i, 0, shares(i), &out.x);
  return out;
}

bool Film::is_written(std::size_t buffer) const {
  return planes_[buffer_plane_ + buffer].is_written();
}

Film::Part Film::part(std::size_t i, std::size_t cell) const {
  const Shares s = shares(i);
  const SubPixelMeans& positive = positive_parts_[i];
  const SubPixelMeans* negative = negative_parts_.empty() ? nullptr : &negative_parts_[i];
  const bool has_positive = positive.samples[cell] > 0,
             has_negative = negative && negative->samples[cell] > 0;
  if (!has_positive && !has_negative) return {};
  Rgb c = has_positive ? positive.beauty[cell] : negative->beauty[cell];
  if (has_positive && has_negative)
    c = not_negative(positive.beauty[cell] * s.positive + negative->beauty[cell] * s.negative);
  return {c, static_cast<float>(positive.samples[cell] + (negative ? negative->samples[cell] : 0))};
}

float Film::Parts::kept(float alike, float apart) const {
  if (!(spread > alike * noise)) return 0;
  return noise > 0 ? std::min((spread / noise - alike) / (apart - alike), 1.0f) : 1.0f;
}

Film::Parts Film::parts(std::size_t i) const {
  Parts p;
  float count = 0;
  for (std::size_t cell = 0; cell < kSubPixels; ++cell) {
    const Part& from = p.all[cell] = part(i, cell);
    if (from.samples == 0) continue;
    p.samples += from.samples;
    ++count;
    Part& quarter = p.quarters[quarter_of(cell)];
    quarter.samples += from.samples;
    quarter.color += (from.color - quarter.color) * (from.samples / quarter.samples);
  }
  for (const Part& part : p.all)
    if (part.samples > 0) p.mean += part.color * (part.samples / p.samples);
  for (const Part& part : p.all)
    if (part.samples > 0)
      p.spread += sqr(brightness(part.color - p.mean)) * (part.samples / p.samples);
  // Of few samples the noise within parts is not known.
  p.noise = std::numeric_limits<float>::infinity();
  if (p.samples >= kMinSamplesOfPart * kSubPixels) {
    const float m2 = positive_parts_[i].m2 + (negative_parts_.empty() ? 0 : negative_parts_[i].m2);
    p.noise = m2 / (p.samples - count) * (count - 1) / p.samples;
  }
  return p;
}

Rgb Film::shown(int x, int y) const {
  const std::size_t i = index(x, y);
  if (!map_) return color(i);
  const Parts p = parts(i);
  if (p.samples == 0) return Rgb(0);
  const float kept = p.kept(kAlike, kApart);
  // By their samples: parts that few samples found say little of the pixel.
  const auto mapped = [&](const auto& parts) {
    Rgb sum(0);
    for (const Part& part : parts)
      if (part.samples > 0) sum += map_(x, y, part.color) * (part.samples / p.samples);
    return sum;
  };
  if (kept == 0) return mapped(p.quarters);
  const Rgb fine = mapped(p.all);
  return kept == 1 ? fine : mapped(p.quarters) * (1 - kept) + fine * kept;
}

Rgb Film::shown(int x, int y, const Rgb& denoised) const {
  if (!map_) return denoised;
  const Parts p = parts(index(x, y));
  if (p.samples == 0) return map_(x, y, denoised);
  // What denoising took away was noise and no edge: single samples that are far too bright make
  // parts that differ as much.
  const float left = brightness(denoised), had = brightness(p.mean);
  const float clean = left > 0 ? clamp01(1 - (had / left - 1) * kTakenAway) : 0;
  const float kept = p.kept(kApart, kSurelyApart) * clean;
  Rgb sum(0);
  for (const Part& part : p.all)
    if (part.samples > 0)
      sum += map_(x, y, not_negative(denoised + (part.color - p.mean) * kept)) * part.samples;
  return sum * (1 / p.samples);
}

bool Film::has_split_samples() const {
  for (const PixelMeans& p : positive_)
    if (p.samples < kMinSplitSamples) return false;
  return !positive_.empty();
}

Film::Estimate Film::estimate(std::size_t i) const {
  const int x = static_cast<int>(i % static_cast<std::size_t>(width_));
  const int y = static_cast<int>(i / static_cast<std::size_t>(width_));
  const bool known = samples(i) > 1;
  const Rgb c = color(i);
  const auto shown_change = [&](const Rgb& change) {
    if (!map_ || change == Rgb(0)) return std::abs(brightness(change));
    const Rgb more = map_(x, y, not_negative(c + change));
    return std::abs(brightness(more) - brightness(map_(x, y, not_negative(c - change)))) / 2;
  };
  Estimate level;
  level.mean = brightness(map_ ? map_(x, y, c) : c);
  level.error = known ? shown_change(color_error(i)) : std::numeric_limits<float>::infinity();
  level.doubling = level.error;
  if (samples(i) < kMinSplitSamples) return level;
  const Shares share = shares(i);
  const Doublings p = doublings(positive_[i]);
  const Doublings m = negative_.empty() ? Doublings() : doublings(negative_[i]);
  level.doubling = shown_change(Rgb(p.last * share.positive + m.last * share.negative));
  level.doubling_before = shown_change(Rgb(p.before * share.positive + m.before * share.negative));
  return level;
}

}  // namespace oriel
