// SPDX-License-Identifier: Apache-2.0
#include "explain_text.h"
#include "base/math.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "color/luminance.h"
#include "explain_words.h"

namespace oriel::app {
namespace {

/// Smaller contributions are not listed; their sum is printed at the end.
constexpr double kSmall = .01;
/// Maximum nesting depth; the light of deeper surfaces is not listed.
constexpr int kDeepest = 6;

/// A line of the tree: a share of the pixel, its description, and the surface listed below it.
struct Item {
  Rgb light{0};
  std::string words;
  std::size_t surface = 0;  ///< its items are listed below; 0 = none
  bool plain = true;        ///< a single contribution; its tint is printed
};

class Writer {
 public:
  explicit Writer(const ExplainReport& r) : r_(r), e_(r.facts), whole_(luminance(r.facts.colour)) {}

  std::string text() {
    title();
    first_surfaces();
    light();
    darkness();
    sources();
    layers();
    exposure();
    noise();
    return std::move(out_);
  }

 private:
  template <class... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    out_ += fmt::format(format, std::forward<Args>(args)...) + "\n";
  }
  double share(const Rgb& light) const { return whole_ > 0 ? luminance(light) / whole_ : 0; }

  void title() {
    line("pixel {},{}: {} (luminance {:.3g}), {} samples", e_.x, e_.y, text_of(e_.colour), whole_,
         e_.samples);
    const double unexplained = share(e_.unexplained);
    if (std::abs(unexplained) > kSmall)
      line("lens and state shaders changed the colour by {:+.0f} %", 100 * unexplained);
  }

  /// Surfaces that camera rays hit: none, one, or several at an edge.
  void first_surfaces() {
    std::vector<std::size_t> firsts;
    for (std::size_t i = 1; i < e_.surfaces.size(); ++i)
      if (e_.surfaces[i].from == 0) firsts.push_back(i);
    std::sort(firsts.begin(), firsts.end(), [&](std::size_t a, std::size_t b) {
      return e_.surfaces[a].hits > e_.surfaces[b].hits;
    });
    if (firsts.empty()) line("\nThe camera sees no surface in this pixel.");
    if (firsts.size() > 1)
      line("\nThe pixel lies on an edge: the camera sees {} surfaces.", firsts.size());
    for (const std::size_t i : firsts)
      if (e_.surfaces[i].hits > kSmall) surface(e_.surfaces[i]);
  }

  void surface(const ExplainedSurface& s) {
    line("\nThe camera sees {}{}.", instance_name(r_.world, s.instance),
         s.hits < 1 - kSmall ? fmt::format(" ({:.0f} % of the pixel)", 100 * s.hits) : "");
    line("  material   {}", material_name(s.material));
    line("  position   {}, {:.4g} away, {} side, {:.0f} degrees from the normal {}",
         text_of(s.position), s.distance, s.back_side > .5f ? "back" : "front",
         math::acos(clamp(s.cosine, -1, 1)) * 180 / kPi, text_of(s.normal));
    std::string lobes;
    for (const ExplainedLobe& lobe : s.lobes)
      if (!is_black(lobe.weight)) lobes += (lobes.empty() ? "" : "; ") + lobe_words(lobe);
    if (!is_black(s.emission))
      lobes += (lobes.empty() ? "" : "; ") + fmt::format("emission {}", text_of(s.emission));
    line("  lobes      {}", lobes.empty() ? "none" : lobes);
    if (s.opacity < 1 - kSmall) line("  opacity    {:.0f} %", 100 * s.opacity);
    for (const ExplainedParameter& p : s.parameters)
      line("  input      {} = {:.3g} from {}", p.name, fmt::join(p.values, " "), p.source);
    if (s.occlusion.samples > 0)
      line("  occlusion  {:.0f} % of the hemisphere is unoccluded{}{}", 100 * s.free,
           s.occlusion.distance > 0 ? fmt::format(" within {:.3g}", s.occlusion.distance) : "",
           s.occlusion.details > 0 ? "; occlusion reduces the indirect light" : "");
  }

  void light() {
    if (!(whole_ > 0)) return line("\nThe pixel is black: no light reaches the camera.");
    line("\nLight:");
    const double left_out = 1 - tree(0, 1, 0);
    if (std::abs(left_out - share(e_.unexplained)) > kSmall)
      line("  {:>3.0f} %  in contributions below 1 %", 100 * (left_out - share(e_.unexplained)));
  }

  /// Writes the items of a surface; returns the sum of their shares.
  double tree(std::size_t index, int indent, int depth) {
    std::vector<Item> items = items_of(index);
    std::sort(items.begin(), items.end(),
              [](const Item& a, const Item& b) { return luminance(a.light) > luminance(b.light); });
    double written = 0;
    for (const Item& item : items) {
      const double part = share(item.light);
      if (part < kSmall) continue;
      const bool expand = item.surface > 0 && depth < kDeepest;
      // The first surface is already printed: its light is not indented.
      const bool is_printed = index == 0 && item.surface > 0 && part > 1 - kSmall;
      if (!is_printed)
        line("{:{}}{:>3.0f} %  {}{}", "", indent * 2, 100 * part, item.words,
             item.surface == 0 && item.plain ? tint(item.light) : "");
      written += expand ? tree(item.surface, indent + (is_printed ? 0 : 3), depth + 1) : part;
    }
    return written;
  }

  std::vector<Item> items_of(std::size_t index) const {
    const ExplainedSurface& s = e_.surfaces[index];
    std::vector<Item> items;
    for (const ExplainedLight& l : s.light) {
      std::string words = light_words(l.part, e_.sources[l.source], is_environment(l.source));
      if (l.part == Aov::Diffuse || l.part == Aov::Specular)
        words += shadow_words(r_, s, e_.sources[l.source]);
      if (l.part == Aov::Indirect) words += map_words(s);
      items.push_back({l.light, words, 0});
    }
    std::vector<std::size_t> bounces;
    for (std::size_t i = index + 1; i < e_.surfaces.size(); ++i) {
      const ExplainedSurface& c = e_.surfaces[i];
      if (c.from != index) continue;
      if (c.behind)
        bounces.push_back(i);
      else
        items.push_back({e_.total(i), seen_words(r_.world, c), i});
    }
    if (!bounces.empty()) items.push_back(bounced(bounces));
    return items;
  }

  /// Indirect light that a surface scatters diffusely, in one line.
  Item bounced(std::vector<std::size_t> from) const {
    std::sort(from.begin(), from.end(), [&](std::size_t a, std::size_t b) {
      return luminance(e_.surfaces[a].total()) > luminance(e_.surfaces[b].total());
    });
    Item item;
    item.plain = false;
    std::vector<std::string> names;
    for (const std::size_t i : from) {
      const Rgb light = e_.surfaces[i].total();
      item.light += light;
      if (share(light) >= kSmall && names.size() < 4)
        names.push_back(fmt::format("{} {:.0f} %{}",
                                    instance_name(r_.world, e_.surfaces[i].instance),
                                    100 * share(light), tint(light)));
    }
    item.words = "indirect light from other surfaces";
    if (!names.empty()) item.words += fmt::format(": {}", fmt::join(names, "; "));
    return item;
  }

  /// Lights without contribution to the first surfaces, with the reason.
  void darkness() {
    for (const ExplainedSurface& s : e_.surfaces) {
      if (s.segment != PathSegment::Eye || s.instance < 0 || s.hits <= kSmall) continue;
      std::vector<std::string> dark = lost_lights(r_, s);
      if (dark.empty()) continue;
      line("\nLights without contribution to {}:", instance_name(r_.world, s.instance));
      constexpr std::size_t kMax = 12;
      for (std::size_t i = 0; i < std::min(kMax, dark.size()); ++i) line("  {}", dark[i]);
      if (dark.size() > kMax) line("  and {} more", dark.size() - kMax);
    }
  }

  void sources() {
    std::vector<Item> items;
    for (std::size_t i = 0; i < e_.sources.size(); ++i) {
      Rgb sum(0);
      for (const ExplainedSurface& s : e_.surfaces)
        for (const ExplainedLight& l : s.light)
          if (l.source == i) sum += l.light;
      items.push_back({sum, e_.sources[i], 0});
    }
    const std::string words = list(std::move(items));
    if (!words.empty()) line("\nLight by source, including reflections and bounces: {}", words);
  }

  void layers() {
    std::vector<Item> items;
    for (std::size_t i = 0; i < kAovs; ++i)
      items.push_back({e_.parts[i], output_name(static_cast<Aov>(i)), 0});
    const std::string words = list(std::move(items));
    if (!words.empty()) line("Light by layer: {}", words);
  }

  std::string list(std::vector<Item> items) const {
    std::sort(items.begin(), items.end(),
              [](const Item& a, const Item& b) { return luminance(a.light) > luminance(b.light); });
    std::vector<std::string> words;
    for (const Item& item : items)
      if (share(item.light) >= kSmall)
        words.push_back(fmt::format("{} {:.0f} %", item.words, 100 * share(item.light)));
    return fmt::format("{}", fmt::join(words, ", "));
  }

  void exposure() {
    line("\nExposure: {:.4g} cd/m2; one pixel unit is {:.4g} cd/m2 ({}).", whole_ * r_.unit.cd_m2,
         r_.unit.cd_m2, r_.unit.by.empty() ? "default; the scene does not define it" : r_.unit.by);
    if (e_.mappings.empty()) line("  No tone mapper: the displayed colour is the rendered colour.");
    for (const ExplainedMapping& m : e_.mappings) {
      line("  {} shader {} maps {} to {}", m.output ? "output" : "lens", m.shader->spec().name,
           text_of(m.before), text_of(m.after));
      line("    {}", constants_of(*m.shader));
    }
  }

  void noise() {
    const double error = std::sqrt(noise_of_mean(e_.variance));
    if (!(whole_ > 0) || e_.samples < 2) return;
    line("\nNoise: standard error {:.2g} % of the luminance after {} samples.",
         100 * error / whole_, e_.samples);
    double all = 0;
    for (const double v : e_.noise) all += v;
    if (error < 1e-4 * whole_ || !(all > 0)) return line("  The noise is negligible.");
    const auto most = std::max_element(e_.noise.begin(), e_.noise.end());
    const auto part = static_cast<Aov>(most - e_.noise.begin());
    line("  {:.0f} % of the variance is in {}. {}", 100 * *most / all, output_name(part),
         noise_advice(r_, part));
    line("  Half the noise requires four times the samples.");
  }

  bool is_environment(std::size_t source) const {
    return source == r_.world.light_layers.environment;
  }

  const ExplainReport& r_;
  const Explanation& e_;
  double whole_;
  std::string out_;
};

}  // namespace

std::string explain_text(const ExplainReport& report) { return Writer(report).text(); }

}  // namespace oriel::app
