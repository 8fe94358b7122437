// SPDX-License-Identifier: Apache-2.0
#include "analysis/explain_observer.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "color/luminance.h"
#include "transport/lobes.h"
#include "transport/surface.h"

namespace oriel {
namespace {

using Sums = Imath::Vec3<double>;  // double: sums of many samples

PathSegment segment_of_lobe(LobeKind kind) {
  switch (kind) {
    case LobeKind::Diffuse:
      return PathSegment::Diffuse;
    case LobeKind::Translucency:
      return PathSegment::Translucency;
    case LobeKind::ThinTransmission:
    case LobeKind::GlossyThin:
      return PathSegment::Straight;
    case LobeKind::ClearRefraction:
    case LobeKind::GlossyRefraction:
      return PathSegment::Refraction;
    default:
      return PathSegment::Reflection;
  }
}

/// The light-path AOV at a surface for light that it scatters into `segment`.
Aov part_by(PathSegment segment, Aov here) {
  switch (segment) {
    case PathSegment::Diffuse:
      return here == Aov::Diffuse ? here : Aov::Indirect;
    case PathSegment::Translucency:
      return Aov::Translucency;
    case PathSegment::Reflection:
      return here == Aov::Specular ? here : Aov::Reflection;
    case PathSegment::Refraction:
    case PathSegment::Straight:
      return Aov::Refraction;
    default:
      return here;
  }
}

int numbers_of(ParamType type) {
  switch (type) {
    case ParamType::Boolean:
    case ParamType::Integer:
    case ParamType::Scalar:
      return 1;
    case ParamType::Vector:
      return 3;
    case ParamType::Color:
      return 4;
    default:
      return 0;
  }
}

std::vector<float> values_of(const ParamSpec& p, const std::byte* at) {
  if (p.type == ParamType::Boolean) return {*reinterpret_cast<const bool*>(at) ? 1.0f : 0.0f};
  if (p.type == ParamType::Integer) return {static_cast<float>(*reinterpret_cast<const int*>(at))};
  std::vector<float> values(static_cast<std::size_t>(numbers_of(p.type)));
  std::memcpy(values.data(), at, values.size() * sizeof(float));
  return values;
}

/// Parameters of the material's shaders that are connected to other shaders, evaluated at the
/// point.
std::vector<ExplainedParameter> parameters_at(const Material& material, ShadingPoint& point) {
  std::vector<ExplainedParameter> found;
  for (const ShaderNode* node : material.surface) {
    const ShaderSpec& spec = node->spec();
    if (!spec.material.fill || spec.binding.deferred) continue;
    node->with_params(point, [&](const Call& call) {
      for (const ParamSpec& p : spec.params) {
        const ShaderNode* source = node->source(p.offset);
        if (!source || numbers_of(p.type) == 0) continue;
        const std::byte* at = static_cast<const std::byte*>(call.params) + p.offset;
        alignas(16) std::byte evaluated[sizeof(Rgba)];
        ShadingPoint own = point;
        if (p.asked_for && node->ask(p.offset, own, evaluated)) at = evaluated;
        found.push_back({p.name, source->spec().name, values_of(p, at)});
      }
    });
  }
  return found;
}

Rgb to_rgb(const Sums& sum, double by) {
  return Rgb(static_cast<float>(sum.x * by), static_cast<float>(sum.y * by),
             static_cast<float>(sum.z * by));
}

}  // namespace

ExplainObserver::ExplainObserver(const World& world) : world_(world), surfaces_(1) {}

void ExplainObserver::Sum::end_sample(int kind) {
  light[static_cast<std::size_t>(kind)] += Sums(current);
  const double value = luminance(current);
  squares += value * value;
  current = Rgb(0);
}

void ExplainObserver::begin_sample(bool negative) {
  kind_ = negative ? 1 : 0;
  weight_ = Rgb(1);
}

void ExplainObserver::end_sample(const Rgb& radiance) {
  const bool counts = is_finite(radiance);  // as PixelMeans::add
  const auto end = [&](Sum& sum) {
    if (!counts) sum.current = Rgb(0);
    sum.end_sample(kind_);
  };
  for (const std::size_t light : touched_) end(lights_[light].sum);
  for (Sum& part : parts_) end(part);
  touched_.clear();
  ++samples_[static_cast<std::size_t>(kind_)];
}

std::size_t ExplainObserver::depth_of(std::size_t surface) const {
  std::size_t depth = 0;
  for (; surface != 0; surface = surfaces_[surface].facts.from) ++depth;
  return depth;
}

std::size_t ExplainObserver::child(std::size_t from, PathSegment segment, const ShadingPoint& point,
                                   const Material& material) {
  for (const std::size_t c : surfaces_[from].children) {
    const ExplainedSurface& s = surfaces_[c].facts;
    if (s.segment == segment && s.instance == point.instance && s.material == &material) return c;
  }
  if (surfaces_.size() >= kMaxSurfaces || depth_of(from) >= kMaxDepth) return from;
  const std::size_t added = surfaces_.size();
  surfaces_[from].children.push_back(added);
  Surface& s = surfaces_.emplace_back();
  s.facts.segment = segment;
  s.facts.from = from;
  s.facts.instance = point.instance;
  s.facts.material = &material;
  s.facts.behind = segment == PathSegment::Diffuse || segment == PathSegment::Translucency;
  s.facts.opacity = 0;
  return added;
}

void ExplainObserver::add_lobes(const Closure& closure, ExplainedSurface& s) const {
  for (int i = 0; i < closure.count; ++i) {
    const Lobe& lobe = closure.lobes[i];
    const bool rough = lobe.kind == LobeKind::Diffuse || lobe.kind == LobeKind::Translucency ||
                       lobe.kind == LobeKind::Sheen;
    const auto same = std::find_if(s.lobes.begin(), s.lobes.end(),
                                   [&](const ExplainedLobe& l) { return l.kind == lobe.kind; });
    ExplainedLobe& sum = same == s.lobes.end() ? s.lobes.emplace_back() : *same;
    sum.kind = lobe.kind;
    sum.weight += lobe.weight;
    sum.roughness = rough ? lobe.roughness : std::sqrt(lobe.alpha_x * lobe.alpha_y);
    sum.eta = lobe.eta;
  }
}

PathObserver::Place ExplainObserver::on_hit(Place from, ShadingPoint& point,
                                            const Material& material, const Closure& closure) {
  const std::size_t before = surface_of(from);
  if (surfaces_[before].facts.behind) return from;
  const std::size_t at = child(before, segment_of(from), point, material);
  if (at == before) return static_cast<Place>(at << 3);
  Surface& s = surfaces_[at];
  ExplainedSurface& f = s.facts;
  if (s.hits++ == 0 && !f.behind) f.parameters = parameters_at(material, point);
  f.position += point.position;
  f.normal += point.normal;
  f.distance += point.ray_length;
  f.cosine += dot(point.normal, point.wo());
  f.back_side += point.back_side ? 1.0f : 0.0f;
  f.emission += closure.emission;
  f.opacity += closure.opacity;
  add_lobes(closure, f);
  return static_cast<Place>(at << 3);
}

PathObserver::Place ExplainObserver::on_scatter(Place at, LobeKind kind) {
  if (surfaces_[surface_of(at)].facts.behind) return at;
  return static_cast<Place>(surface_of(at) << 3) | static_cast<Place>(segment_of_lobe(kind));
}

void ExplainObserver::on_light(Place at, const LightPart& part, std::size_t layer,
                               const Rgb& radiance) {
  if (is_black(radiance)) return;
  std::size_t surface = surface_of(at);
  const Rgb weighted = radiance * weight_;
  parts_[static_cast<std::size_t>(part.of_first)].current += weighted;
  Aov own = part_by(segment_of(at), part.here);
  if (surfaces_[surface].facts.behind) {
    const PathSegment segment = surfaces_[surface].facts.segment;
    own = part_by(segment, Aov::Indirect);
    // Emission that a scattered ray hits counts as a light source, like light samples of it.
    if (part.here == Aov::Added && layer != world_.light_layers.unknown())
      surface = surfaces_[surface].facts.from;
  }
  std::vector<std::size_t>& known = surfaces_[surface].lights;
  const auto same = std::find_if(known.begin(), known.end(), [&](std::size_t i) {
    return lights_[i].part == own && lights_[i].source == layer;
  });
  std::size_t light = lights_.size();
  if (same == known.end()) {
    known.push_back(light);
    lights_.push_back({own, layer, {}});
  } else {
    light = *same;
  }
  lights_[light].sum.current += weighted;
  touched_.push_back(light);
}

int ExplainObserver::blocker(const ShadingPoint& point, const LightSampleEvent& event) const {
  const std::uint32_t kinds[] = {geom::RayMask::Shadow, geom::RayMask::ShadowTransparent};
  for (const std::uint32_t mask : kinds) {
    geom::Hit hit;
    if (world_.accel->intersect(oriel::leave(point, event.wi, event.reach, mask), hit))
      return static_cast<int>(world_.accel->instance(hit.instance).user);
  }
  return -1;
}

void ExplainObserver::on_light_sample(Place at, const ShadingPoint& point,
                                      const LightSampleEvent& event) {
  const std::size_t surface = surface_of(at);
  if (surface == 0 || surfaces_[surface].facts.behind) return;
  std::vector<ExplainedLightSource>& lights = surfaces_[surface].facts.lights;
  auto light = std::find_if(lights.begin(), lights.end(),
                            [&](const ExplainedLightSource& l) { return l.light == event.light; });
  if (light == lights.end()) {
    lights.emplace_back().light = event.light;
    light = lights.end() - 1;
  }
  const Rgb unoccluded = event.unshadowed * event.open;
  ++light->samples;
  light->unshadowed += event.unshadowed;
  light->unoccluded += unoccluded;
  const double lost = luminance(event.unshadowed - unoccluded);
  if (lost > 0) light->blockers[blocker(point, event)] += lost;
}

void ExplainObserver::on_lookup(Place at, int records, int photons) {
  Surface& s = surfaces_[surface_of(at)];
  if (s.facts.behind) return;
  s.facts.records += records;
  s.facts.photons += photons;
  ++s.lookups;
}

void ExplainObserver::on_occlusion(Place at, const Occlusion& occlusion, float free) {
  Surface& s = surfaces_[surface_of(at)];
  if (s.facts.behind) return;
  if (s.occlusions++ == 0) s.facts.occlusion = occlusion, s.facts.free = 0;
  s.facts.free += free;
}

void ExplainObserver::write_to(float positive, float negative, Explanation& e) const {
  const double n[2] = {static_cast<double>(samples_[0]), static_cast<double>(samples_[1])};
  const double by[2] = {n[0] > 0 ? positive / n[0] : 0, n[1] > 0 ? negative / n[1] : 0};
  const double all = std::max(1.0, n[0] + n[1]);
  const auto mean = [&](const Sum& s) {
    return to_rgb(s.light[0], by[0]) + to_rgb(s.light[1], by[1]);
  };
  const auto variance = [&](const Sum& s) {
    const double value = luminance(to_rgb(s.light[0] + s.light[1], 1 / all));
    return std::max(0.0, s.squares / all - value * value);
  };
  for (const Surface& s : surfaces_) {
    ExplainedSurface f = s.facts;
    const float per_hit = 1 / std::max(1.0f, static_cast<float>(s.hits));
    f.hits = static_cast<double>(s.hits) / all;
    f.position *= per_hit;
    f.normal = s.hits > 0 ? normalize(f.normal) : f.normal;
    for (float* sum : {&f.distance, &f.cosine, &f.back_side, &f.opacity}) *sum *= per_hit;
    f.emission *= per_hit;
    for (ExplainedLobe& lobe : f.lobes) lobe.weight *= per_hit;
    const double lookups = std::max<double>(1, static_cast<double>(s.lookups));
    f.records /= lookups, f.photons /= lookups;
    if (s.occlusions > 0) f.free /= static_cast<double>(s.occlusions);
    for (const std::size_t i : s.lights)
      f.light.push_back(
          {lights_[i].part, lights_[i].source, mean(lights_[i].sum), variance(lights_[i].sum)});
    e.surfaces.push_back(std::move(f));
  }
  for (std::size_t i = 0; i < kAovs; ++i) {
    e.parts[i] = mean(parts_[i]);
    e.noise[i] = variance(parts_[i]);
  }
}

}  // namespace oriel
