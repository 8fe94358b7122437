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

/// Whether a source contains the light: by its name, or by a name that ends with * (see
/// separate_light_layers).
bool is_of(const std::string& source, const std::string& light) {
  if (!source.ends_with('*')) return source == light;
  return light.compare(0, source.size() - 1, source, 0, source.size() - 1) == 0;
}

std::string main_blocker(const World& world, const std::map<int, double>& blockers) {
  const auto most = std::max_element(blockers.begin(), blockers.end(),
                                     [](auto& a, auto& b) { return a.second < b.second; });
  if (most == blockers.end() || most->first < 0) return {};
  return fmt::format("{} by {}", blockers.size() > 1 ? ", mostly" : "",
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
  // Rounding errors are printed as 0.
  const auto number = [](float f) { return std::abs(f) < 1e-5f ? 0.0f : f; };
  return fmt::format("{:.3g} {:.3g} {:.3g}", number(v.x), number(v.y), number(v.z));
}

std::string tint(const Rgb& c) {
  constexpr float kGrey = .25f;  // of the greatest channel
  const float most = max_component(c), least = std::min({c.x, c.y, c.z});
  if (!(most > 0) || (most - least) / most < kGrey) return {};
  // The middle channel, relative to the others, determines the hue.
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
  const bool wide = lobe.kind == LobeKind::Diffuse || lobe.kind == LobeKind::Sheen;
  if (wide && lobe.roughness > 0) words += fmt::format(" (roughness {:.2g})", lobe.roughness);
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
      return "transmission of " + who;
    case Aov::Translucency:
      return "light of " + who + " from the other side";
    case Aov::Indirect:
      return "indirect light of " + who;
    case Aov::Added:
      return "emission";
    default:
      return who + ", seen directly";
  }
}

std::string shadow_words(const ExplainReport& r, const ExplainedSurface& s,
                         const std::string& source) {
  double all = 0, unoccluded = 0;
  std::map<int, double> blockers;
  for (const ExplainedLightSource& light : s.lights) {
    if (light.light < 0 || !is_of(source, light_name(r.world, light.light))) continue;
    all += luminance(light.unshadowed), unoccluded += luminance(light.unoccluded);
    for (const auto& [instance, lost] : light.blockers) blockers[instance] += lost;
  }
  const double lost = all > 0 ? 1 - unoccluded / all : 0;
  if (lost < kSome) return {};
  return fmt::format("; {:.0f} % shadowed{}", 100 * lost, main_blocker(r.world, blockers));
}

std::string map_words(const ExplainedSurface& s) {
  std::string words;
  if (s.records > 0) words = fmt::format(" ({:.0f} gather points)", s.records);
  if (s.photons > 0) words += fmt::format(" ({:.0f} photons)", s.photons);
  return words;
}

std::string seen_words(const World& world, const ExplainedSurface& s) {
  const std::string what =
      fmt::format("{} (material {}), {:.3g} away", instance_name(world, s.instance),
                  s.material->name, s.distance);
  switch (s.segment) {
    case PathSegment::Reflection:
      return "reflection of " + what;
    case PathSegment::Refraction:
      return "refraction of " + what;
    case PathSegment::Straight:
      return "behind it: " + what;
    default:
      return what;
  }
}

std::vector<std::string> lost_lights(const ExplainReport& r, const ExplainedSurface& s) {
  std::vector<std::string> lost;
  for (const ExplainedLightSource& light : s.lights) {
    const double all = luminance(light.unshadowed);
    const std::string name = light_name(r.world, light.light);
    if (!(all > 0)) {
      if (light.light >= 0)
        lost.push_back(name + ": the surface faces away from it, or has no lobe for it");
    } else if (luminance(light.unoccluded) <= (1 - kAll) * all) {
      lost.push_back(fmt::format("{}: shadowed{}", name, main_blocker(r.world, light.blockers)));
    }
  }
  return lost;
}

std::string constants_of(const ShaderNode& node) {
  std::vector<std::string> words;
  const std::byte* constants = &node.constants<std::byte>();
  for (const ParamSpec& p : node.spec().params) {
    if (node.connected(p.offset)) {
      words.push_back(fmt::format("{} from a shader", p.name));
      continue;
    }
    if (const std::string text = value_text(p, constants + p.offset); !text.empty())
      words.push_back(fmt::format("{} {}", p.name, text));
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

double noise_of_mean(const Rgb& variance) {
  // The channels of a path are fully correlated.
  const double deviation =
      luminance(Rgb(std::sqrt(variance.x), std::sqrt(variance.y), std::sqrt(variance.z)));
  return deviation * deviation;
}

std::string noise_advice(const ExplainReport& r, Aov part) {
  switch (part) {
    case Aov::Indirect:
      return r.plan.gather || r.plan.global ? "Increase the number of gather rays or photons."
                                            : "Few paths find the light. Use --gi fg, whose gather "
                                              "points many pixels share, or "
                                              "add portals to windows.";
    case Aov::Diffuse:
      return "It comes from partly occluded lights. Increase the number of samples.";
    case Aov::Specular:
    case Aov::Reflection:
      return "It comes from glossy reflection. Increase refl_gloss_samples of the material, or "
             "interpolate the reflection.";
    case Aov::Refraction:
      return "It comes from glossy refraction. Increase refr_gloss_samples of the material.";
    case Aov::Translucency:
      return "It comes from light on the other side. Increase the number of samples.";
    default:
      return "The samples see different surfaces: an edge, or defocus. Increase the number of "
             "samples.";
  }
}

}  // namespace oriel::app
