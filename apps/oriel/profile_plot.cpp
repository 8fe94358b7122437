// SPDX-License-Identifier: Apache-2.0
#include "profile_plot.h"
#include "base/math.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace oriel::app {
namespace {

constexpr float kSize = 480, kRadius = 190, kTop = 24;
constexpr int kCircles = 4;
constexpr float kDegree = kPi / 180;

/// The next round number that `circles` times is at least x.
float step_for(float x, int circles) {
  const float wanted = x / static_cast<float>(circles);
  const float power = math::pow(10.0f, std::floor(math::log10(wanted)));
  for (const float s : {1.0f, 1.25f, 1.5f, 2.0f, 2.5f, 3.0f, 4.0f, 5.0f, 7.5f})
    if (s * power >= wanted * 0.9999f) return s * power;
  return 10 * power;
}

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '<')
      safe += "&lt;";
    else if (c == '&')
      safe += "&amp;";
    else if (static_cast<unsigned char>(c) < 128)
      safe += c;
    else
      safe += '?';
  }
  return safe;
}

/// The curve around the whole plane of `along` and -z, nadir down.
std::string curve(const photometry::LightProfile& profile, const Vec3& along, float outer_candela,
                  const char* style) {
  std::string points;
  for (int deg = 0; deg <= 360; ++deg) {
    const float a = static_cast<float>(deg) * kDegree;
    const Vec3 d = Vec3(0, 0, -math::cos(a)) + along * math::sin(a);
    const float r = profile.evaluate(d) / outer_candela * kRadius;
    points += fmt::format("{:.1f},{:.1f} ", kSize / 2 + r * math::sin(a),
                          kTop + kSize / 2 + r * math::cos(a));
  }
  return fmt::format("<polygon points=\"{}\" {}/>\n", points, style);
}

}  // namespace

std::string polar_plot(const photometry::LightProfile& profile, const std::string& title) {
  const float middle_x = kSize / 2, middle_y = kTop + kSize / 2;
  const float step = step_for(std::max(profile.peak(), 1e-9f), kCircles);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{0}\" height=\"{1}\" "
      "fill=\"white\"/>\n<text x=\"{2}\" y=\"22\" text-anchor=\"middle\" "
      "font-size=\"14\">{3}</text>\n<g fill=\"none\" stroke=\"#bbb\">\n",
      kSize, kSize + kTop + 30, middle_x, escaped(title));
  for (int i = 1; i <= kCircles; ++i)
    svg += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{:.1f}\"/>\n", middle_x, middle_y,
                       kRadius * static_cast<float>(i) / kCircles);
  for (int deg = 0; deg < 360; deg += 30)
    svg += fmt::format("<path d=\"M{} {} L{:.1f} {:.1f}\"/>\n", middle_x, middle_y,
                       middle_x + kRadius * math::sin(static_cast<float>(deg) * kDegree),
                       middle_y + kRadius * math::cos(static_cast<float>(deg) * kDegree));
  svg += "</g>\n";
  const float outer = step * kCircles;
  svg += curve(profile, Vec3(0, 1, 0), outer,
               "fill=\"none\" stroke=\"#1668b0\" stroke-width=\"2\" stroke-dasharray=\"6 4\"");
  svg +=
      curve(profile, Vec3(1, 0, 0), outer, "fill=\"none\" stroke=\"#c23616\" stroke-width=\"2\"");
  svg += "<g fill=\"#333\">\n";
  for (int i = 1; i <= kCircles; ++i)
    svg += fmt::format("<text x=\"{}\" y=\"{:.1f}\">{:g}{}</text>\n", middle_x + 4,
                       middle_y + kRadius * static_cast<float>(i) / kCircles - 3,
                       step * static_cast<float>(i), i == kCircles ? " cd" : "");
  for (int deg = 0; deg < 360; deg += 30) {
    const float a = static_cast<float>(deg) * kDegree;
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}&#176;</text>\n",
                       middle_x + (kRadius + 20) * math::sin(a),
                       middle_y + 4 + (kRadius + 18) * math::cos(a), deg > 180 ? 360 - deg : deg);
  }
  const float below = kTop + kSize + 12;
  svg += fmt::format(
      "<text x=\"76\" y=\"{0}\">0 / 180 (right / left)</text>\n"
      "<text x=\"306\" y=\"{0}\">90 / 270</text>\n</g>\n"
      "<path d=\"M36 {1} h32\" stroke=\"#c23616\" stroke-width=\"2\"/>\n<path d=\"M266 {1} h32\" "
      "stroke=\"#1668b0\" stroke-width=\"2\" stroke-dasharray=\"6 4\"/>\n</svg>\n",
      below, below - 4);
  return svg;
}

}  // namespace oriel::app
