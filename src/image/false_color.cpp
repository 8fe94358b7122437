// SPDX-License-Identifier: Apache-2.0
#include "image/false_color.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/math.h"
#include "image/glyphs.h"

namespace oriel {
namespace {

constexpr int kViridisSteps = 16;
constexpr std::uint32_t kViridis[kViridisSteps] = {
    0x440154, 0x481a6c, 0x472f7d, 0x414487, 0x39568c, 0x31688e, 0x2a788e, 0x23888e,
    0x1f988b, 0x22a884, 0x35b779, 0x54c568, 0x7ad151, 0xa5db36, 0xd2e21b, 0xfde725};

/// Converts 0xRRGGBB.
Rgb color_of(std::uint32_t bits) {
  return Rgb(static_cast<float>(bits >> 16), static_cast<float>((bits >> 8) & 255),
             static_cast<float>(bits & 255)) /
         255.0f;
}

/// Share of the values that may lie above the scale, and below a logarithmic scale.
constexpr double kShareOutside = 0.01;

/// The nearest 1, 2 or 5 times a power of ten above (or below) a value.
float round_number(float value, bool up) {
  const float decade = math::pow(10.0f, std::floor(math::log10(value)));
  const float digit = value / decade;
  // A value slightly above a round number counts as that number.
  constexpr float kSlack = 1.0001f;
  constexpr float kDigits[] = {1, 2, 5, 10};
  float found = kDigits[up ? 3 : 0];
  for (const float d : kDigits)
    if (up ? d * kSlack >= digit && d < found : d <= digit * kSlack) found = d;
  return found * decade;
}

std::vector<float> linear_ticks(const ValueScale& s) {
  const float step = round_number((s.high - s.low) / 8, true);
  std::vector<float> ticks;
  const float slack = step * 1e-3f;
  for (float i = std::ceil((s.low - slack) / step); i * step <= s.high + slack; ++i)
    ticks.push_back(i * step);
  return ticks;
}

std::vector<float> logarithmic_ticks(const ValueScale& s) {
  const float decades = math::log10(s.high / s.low);
  if (decades < 1) return linear_ticks(s);
  std::vector<float> ticks;
  const int first = static_cast<int>(std::floor(math::log10(s.low)));
  const int last = static_cast<int>(std::ceil(math::log10(s.high)));
  const int stride = std::max(1, static_cast<int>(std::lround(decades / 8)));
  for (int e = first; e <= last; ++e)
    for (const float digit : {1.0f, 2.0f, 5.0f}) {
      if (digit > 1 && decades > 3) continue;
      if (digit == 1 && (e - first) % stride != 0) continue;
      const float value = digit * math::pow(10.0f, static_cast<float>(e));
      if (value >= s.low * .999f && value <= s.high * 1.001f) ticks.push_back(value);
    }
  return ticks;
}

bool counts(float value) { return std::isfinite(value) && value > 0; }

/// Layout of the legend; the unit is the size of a font dot.
struct Legend {
  int scale, gap, bar, width, top, bottom;

  Legend(int height, const std::vector<float>& ticks, const std::string& unit) {
    scale = std::max(1, height / 200);
    gap = 4 * scale;
    bar = 10 * scale;
    int text = 0;
    for (const float t : ticks) text = std::max(text, text_width(tick_text(t), scale));
    width = std::max(gap + bar + 2 * gap + text, gap + text_width(unit, scale)) + gap;
    const int line = kGlyphHeight * scale;
    top = gap + (unit.empty() ? 0 : line + gap) + line / 2;
    bottom = height - gap - line / 2;
  }
  static constexpr int kMinHeight = 60;
};

void draw_legend(Image& out, int left, const FalseColorOptions& o, const std::vector<float>& ticks,
                 const Legend& legend) {
  const Rgb white(1);
  draw_text(out, left + legend.gap, legend.gap, o.unit, legend.scale, white);
  const int bar = left + legend.gap, bottom = legend.bottom;
  const auto span = static_cast<float>(std::max(1, bottom - legend.top));
  const auto put = [&](int x, int y, const Rgb& c) {
    for (int k = 0; k < 3; ++k) out.at(x, y)[k] = c[k];
  };
  for (int y = legend.top; y <= bottom; ++y)
    for (int x = bar; x < bar + legend.bar; ++x)
      put(x, y, viridis(static_cast<float>(bottom - y) / span));
  const int step = (kGlyphHeight + 1) * legend.scale;
  int last = bottom + 2 * step;
  for (const float tick : ticks) {
    const int y = bottom - static_cast<int>(std::lround(o.scale.position(tick) * span));
    for (int x = bar + legend.bar; x < bar + legend.bar + legend.gap; ++x) put(x, y, white);
    if (last - y < step) continue;  // skips a tick whose text would overlap the previous one
    last = y;
    draw_text(out, bar + legend.bar + 2 * legend.gap, y - kGlyphHeight * legend.scale / 2,
              tick_text(tick), legend.scale, white);
  }
}

}  // namespace

Rgb viridis(float t) {
  const float at = std::clamp(t, 0.0f, 1.0f) * (kViridisSteps - 1);
  const int i = std::min(static_cast<int>(at), kViridisSteps - 2);
  const float t1 = at - static_cast<float>(i);
  return color_of(kViridis[i]) * (1 - t1) + color_of(kViridis[i + 1]) * t1;
}

float ValueScale::position(float value) const {
  const float t = logarithmic ? math::log(std::max(value, low) / low) / math::log(high / low)
                              : (value - low) / (high - low);
  return std::clamp(t, 0.0f, 1.0f);
}

ValueScale scale_of(const Image& values, bool logarithmic) {
  std::vector<float> sorted;
  for (std::size_t i = 0; i < values.pixel_count(); ++i)
    if (const float v = values.pixels[i * static_cast<std::size_t>(values.channels)]; counts(v))
      sorted.push_back(v);
  ValueScale scale;
  scale.logarithmic = logarithmic;
  if (sorted.empty()) {
    scale.low = logarithmic ? 0.1f : 0;
    return scale;
  }
  std::sort(sorted.begin(), sorted.end());
  const auto at = [&](double share) {
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  };
  scale.high = round_number(at(1 - kShareOutside), true);
  if (logarithmic) scale.low = std::min(round_number(at(kShareOutside), false), scale.high / 10);
  return scale;
}

std::vector<float> scale_ticks(const ValueScale& scale) {
  return scale.logarithmic ? logarithmic_ticks(scale) : linear_ticks(scale);
}

std::string tick_text(float value) {
  if (std::abs(value) >= 1e6f) return fmt::format("{:.4g}M", value * 1e-6f);
  if (std::abs(value) >= 1e4f) return fmt::format("{:.4g}k", value * 1e-3f);
  return fmt::format("{:.4g}", value);
}

Image false_color(const Image& values, const FalseColorOptions& o) {
  const std::vector<float> ticks = scale_ticks(o.scale);
  const int height = std::max(values.height, Legend::kMinHeight);
  const Legend legend(height, ticks, o.unit);
  Image out(values.width + legend.width, height, 3);
  const auto band = [&](int x, int y) {
    return std::upper_bound(ticks.begin(), ticks.end(), *values.at(x, y)) - ticks.begin();
  };
  for (int y = 0; y < values.height; ++y)
    for (int x = 0; x < values.width; ++x) {
      const float v = *values.at(x, y);
      if (!counts(v)) continue;
      const bool line =
          o.isolines &&
          ((x + 1 < values.width && counts(*values.at(x + 1, y)) && band(x, y) != band(x + 1, y)) ||
           (y + 1 < values.height && counts(*values.at(x, y + 1)) && band(x, y) != band(x, y + 1)));
      if (line) continue;
      const Rgb c = viridis(o.scale.position(v));
      for (int k = 0; k < 3; ++k) out.at(x, y)[k] = c[k];
    }
  draw_legend(out, values.width, o, ticks, legend);
  return out;
}

}  // namespace oriel
