// SPDX-License-Identifier: Apache-2.0
#include "explain_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "color/luminance.h"

namespace oriel::app {
namespace {

constexpr double kAll = .995;  ///< a share that is called all
constexpr double kSome = .01;

/// Whose light a source is: of it alone, or of others that share its name but for digits.
bool is_of(const std::string& source, const std::string& lamp) {
  if (!source.ends_with('*')) return source == lamp;
  return lamp.compare(0, source.size() - 1, source, 0, source.size() - 1) == 0;
}

std::string main_blocker(const World& world, const std::map<int, double>& blockers) {
  const auto most = std::max_element(blockers.begin(), blockers.end(),
                                     [](auto& a, auto& b) { return a.second < b.second; });
  if (most == blockers.end() || most->first < 0) return {};
  return fmt::format(", {}by {}", blockers.size() > 1 ? "most " : "",
                     instance_name(world, most->first));
}

std::string value_text(const ParamSpec& p, const std::byte* at) {
  switch (p.type) {
    case ParamType::Boolean:
      return *reinterpret_cast<const bool*>(at) ? "on" : "off";
    case ParamType::Integer:
      return fmt::format("{}", *reinterpret_cast<const int*>(at));
    case ParamType::Scalar:
      return fmt::format("{:.4g}", *reinterpret_cast<const float*>(at));
    case ParamType::Color:
      return text_of(rgb(*reinterpret_cast<const Rgba*>(at)));
    default:
      return {};
  }
}

}  // namespace

std::string text_of(const Rgb& c) { return fmt::format("{:.3g} {:.3g} {:.3g}", c.x, c.y, c.z); }
std::string text_of(const Vec3& v) {
  // A place at 1e-9 is one at 0.
  const auto number = [](float f) { return std::abs(f) < 1e-5f ? 0.0f : f; };
  return fmt::format("{:.3g} {:.3g} {:.3g}", number(v.x), number(v.y), number(v.z));
}

std::string tint(const Rgb& c) {
  constexpr float kGrey = .25f;  // of the greatest channel
  const float most = max_component(c), least = std::min({c.x, c.y, c.z});
  if (!(most > 0) || (most - least) / most < kGrey) return {};
  // Where the middle channel stands between the others tells the hue between two of them.
  const float middle = (c.x + c.y + c.z - most - least - least) / (most - least);
  const bool mixed = middle > .6f;
  const char* hue = "";
  if (most == c.x)
    hue = least == c.z ? (mixed           ? "yellowish"
                          : middle > .25f ? "orange"
                                          : "reddish")
                       : (mixed ? "purple" : "reddish");
  else if (most == c.y)
    hue = least == c.z ? (mixed ? "yellowish" : "greenish") : (mixed ? "cyan" : "greenish");
  else
    hue = least == c.x ? (mixed ? "cyan" : "bluish") : (mixed ? "purple" : "bluish");
  return fmt::format(", {}", hue);
}

std::string lobe_words(const ExplainedLobe& lobe) {
  std::string words = fmt::format("{} {}", lobe_name(lobe.kind), text_of(lobe.weight));
  const bool glossy = lobe.kind == LobeKind::GlossyReflection ||
                      lobe.kind == LobeKind::GlossyRefraction || lobe.kind == LobeKind::GlossyThin;
  if (glossy) words += fmt::format(" (roughness {:.2g})", lobe.roughness);
  if (lobe.kind == LobeKind::Diffuse && lobe.roughness > 0)
    words += fmt::format(" (roughness {:.2g})", lobe.roughness);
  return words;
}

std::string light_words(Aov part, const std::string& source, bool environment) {
  const std::string who = environment ? "the environment" : source;
  switch (part) {
    case Aov::Diffuse:
      return "direct light of " + who;
    case Aov::Specular:
      return "highlight of " + who;
    case Aov::Reflection:
      return "reflection of " + who;
    case Aov::Refraction:
      return who + ", seen through it";
    case Aov::Translucency:
      return "light of " + who + " from its other side";
    case Aov::Indirect:
      return "indirect light of " + who;
    case Aov::Added:
      return "its own glow";
    default:
      return who + ", seen directly";
  }
}

std::string shadow_words(const ExplainReport& r, const ExplainedSurface& s,
                         const std::string& source) {
  double all = 0, arrived = 0;
  std::map<int, double> blockers;
  for (const ExplainedLamp& lamp : s.lamps) {
    if (lamp.light < 0 || !is_of(source, lamp_name(r.world, lamp.light))) continue;
    all += luminance(lamp.unshadowed), arrived += luminance(lamp.arrived);
    for (const auto& [instance, lost] : lamp.blockers) blockers[instance] += lost;
  }
  const double lost = all > 0 ? 1 - arrived / all : 0;
  if (lost < kSome) return {};
  return fmt::format("; {:.0f} % of what it sends there is shadowed{}", 100 * lost,
                     main_blocker(r.world, blockers));
}

std::string map_words(const ExplainedSurface& s) {
  std::string words;
  if (s.records > 0) words = fmt::format(" (of {:.0f} gathered points)", s.records);
  if (s.photons > 0) words += fmt::format(" (of {:.0f} photons)", s.photons);
  return words;
}

std::string seen_words(const World& world, const ExplainedSurface& s) {
  const std::string what =
      fmt::format("{} (material {}), {:.3g} away", instance_name(world, s.instance),
                  s.material->name, s.distance);
  switch (s.way) {
    case PathSegment::Reflection:
      return "reflection of " + what;
    case PathSegment::Refraction:
      return "what refraction shows: " + what;
    case PathSegment::Straight:
      return "seen through it: " + what;
    default:
      return what;
  }
}

std::vector<std::string> lost_lights(const ExplainReport& r, const ExplainedSurface& s) {
  std::vector<std::string> lost;
  for (const ExplainedLamp& lamp : s.lamps) {
    const double all = luminance(lamp.unshadowed);
    const std::string name = lamp_name(r.world, lamp.light);
    if (!(all > 0)) {
      // The surface may have no lobe that this light could show on.
      if (lamp.light >= 0)
        lost.push_back(name + ": it does not face the light, or shows none of it");
    } else if (luminance(lamp.arrived) <= (1 - kAll) * all) {
      lost.push_back(fmt::format("{}: in shadow{}", name, main_blocker(r.world, lamp.blockers)));
    }
  }
  return lost;
}

std::string constants_of(const ShaderNode& node) {
  std::vector<std::string> words;
  const std::byte* constants = &node.constants<std::byte>();
  for (const ParamSpec& p : node.spec().params) {
    if (node.connected(p.offset)) {
      words.push_back(fmt::format("{} by a shader", p.name));
      continue;
    }
    if (const std::string text = value_text(p, constants + p.offset); !text.empty())
      words.push_back(fmt::format("{} {}", p.name, text));
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

double noise_of_mean(const Rgb& variance) {
  // The channels of a path rise and fall together.
  const double deviation =
      luminance(Rgb(std::sqrt(variance.x), std::sqrt(variance.y), std::sqrt(variance.z)));
  return deviation * deviation;
}

std::string noise_advice(const ExplainReport& r, Aov part) {
  switch (part) {
    case Aov::Indirect:
      return r.plan.gather || r.plan.global
                 ? "More gather rays or photons make the maps smoother."
                 : "Its rays seldom find the light: --gi fg gathers it once for many pixels, and "
                   "portals in windows lead rays to the sky.";
    case Aov::Diffuse:
      return "Large lights, half hidden, are seen by chance: only more samples help.";
    case Aov::Specular:
    case Aov::Reflection:
      return "Glossy rays find different things: raise the material's reflection samples "
             "(refl_gloss_samples), or let it interpolate.";
    case Aov::Refraction:
      return "Rays behind it find different things: raise refr_gloss_samples where it is frosted.";
    case Aov::Translucency:
      return "Light from the other side is found by chance: only more samples help.";
    default:
      return "The pixel's samples see different things: an edge, or a lens out of focus.";
  }
}

}  // namespace oriel::app
