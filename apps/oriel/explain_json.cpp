// SPDX-License-Identifier: Apache-2.0
// JSON of an explanation, and names that its text uses, too.
#include <fmt/format.h>

#include "color/luminance.h"
#include "explain_text.h"

namespace oriel::app {
namespace {

using nlohmann::json;

json explain_json_of(const Rgb& c) { return {c.x, c.y, c.z}; }
json explain_json_of(const Vec3& v) { return {v.x, v.y, v.z}; }

json lobes_json(const ExplainedSurface& s) {
  json lobes = json::array();
  for (const ExplainedLobe& lobe : s.lobes)
    lobes.push_back({{"kind", lobe_name(lobe.kind)},
                     {"weight", explain_json_of(lobe.weight)},
                     {"roughness", lobe.roughness},
                     {"eta", lobe.eta}});
  return lobes;
}

json lights_json(const ExplainReport& r, const ExplainedSurface& s) {
  json lights = json::array();
  for (const ExplainedLightSource& light : s.lights) {
    const double all = luminance(light.unshadowed), unoccluded = luminance(light.unoccluded);
    json blockers = json::object();
    for (const auto& [instance, lost] : light.blockers)
      blockers[instance_name(r.world, instance)] = all > 0 ? lost / all : 0;
    lights.push_back({{"light", light_name(r.world, light.light)},
                      {"faces_away", all <= 0},
                      {"shadowed", all > 0 ? 1 - unoccluded / all : 0},
                      {"blockers", blockers}});
  }
  return lights;
}

json surface_json(const ExplainReport& r, std::size_t index) {
  const ExplainedSurface& s = r.facts.surfaces[index];
  json light = json::array();
  for (const ExplainedLight& l : s.light)
    light.push_back({{"part", output_name(l.part)},
                     {"source", r.facts.sources[l.source]},
                     {"light", explain_json_of(l.light)},
                     {"variance", l.variance}});
  json out = {{"light", light}};
  if (index == 0) return out;
  out["segment"] = segment_name(s.segment);
  out["from"] = s.from;
  out["instance"] = instance_name(r.world, s.instance);
  out["material"] = s.material->name;
  out["hits_per_sample"] = s.hits;
  out["position"] = explain_json_of(s.position);
  out["normal"] = explain_json_of(s.normal);
  out["distance"] = s.distance;
  out["cosine"] = s.cosine;
  out["back_side"] = s.back_side;
  out["diffuse_bounce"] = s.behind;
  if (s.behind) return out;
  out["lobes"] = lobes_json(s);
  out["emission"] = explain_json_of(s.emission);
  out["opacity"] = s.opacity;
  out["lights"] = lights_json(r, s);
  out["records"] = s.records;
  out["photons"] = s.photons;
  for (const ExplainedParameter& p : s.parameters)
    out["parameters"][p.name] = {{"shader", p.source}, {"values", p.values}};
  if (s.occlusion.samples > 0)
    out["occlusion"] = {{"distance", s.occlusion.distance}, {"unoccluded", s.free}};
  return out;
}

}  // namespace

std::string instance_name(const World& world, int instance) {
  return instance < 0 ? "nothing" : world.instances[static_cast<std::size_t>(instance)].name;
}

std::string light_name(const World& world, int light) {
  return light < 0 ? "the environment" : world.lights[static_cast<std::size_t>(light)].name;
}

const char* lobe_name(LobeKind kind) {
  constexpr const char* kNames[] = {"diffuse",
                                    "mirror",
                                    "glossy reflection",
                                    "clear refraction",
                                    "glossy refraction",
                                    "thin transparency",
                                    "blurred thin transparency",
                                    "translucency",
                                    "sheen",
                                    "Phong highlight",
                                    "Cook-Torrance highlight",
                                    "Ward highlight",
                                    "hair highlight"};
  return kNames[static_cast<std::size_t>(kind)];
}

const char* segment_name(PathSegment segment) {
  constexpr const char* kNames[] = {"eye",        "diffuse",    "translucency",
                                    "reflection", "refraction", "straight"};
  return kNames[static_cast<std::size_t>(segment)];
}

const char* output_name(Aov aov) {
  constexpr const char* kNames[] = {"diffuse_result", "spec_result",    "refl_result",
                                    "refr_result",    "tran_result",    "indirect_result",
                                    "add_result",     "opacity_result", "other"};
  return kNames[static_cast<std::size_t>(aov)];
}

std::string material_name(const Material* material) {
  for (auto node = material->surface.rbegin(); node != material->surface.rend(); ++node)
    if ((*node)->spec().material.fill)
      return fmt::format("{} ({})", material->name, (*node)->spec().name);
  return material->name;
}

json explain_json(const ExplainReport& r) {
  const Explanation& e = r.facts;
  json out = {{"pixel", {e.x, e.y}},
              {"samples", e.samples},
              {"colour", explain_json_of(e.colour)},
              {"variance", explain_json_of(e.variance)},
              {"shown", explain_json_of(e.shown)},
              {"indirect", r.plan.name()},
              {"unit_luminance", r.unit.cd_m2},
              {"unit_luminance_source", r.unit.by},
              {"unexplained", explain_json_of(e.unexplained)}};
  for (std::size_t i = 0; i < kAovs; ++i) {
    const auto c = static_cast<Aov>(i);
    out["outputs"][output_name(c)] = {{"light", explain_json_of(e.parts[i])},
                                      {"variance", e.noise[i]}};
  }
  for (std::size_t i = 0; i < e.surfaces.size(); ++i) out["surfaces"].push_back(surface_json(r, i));
  out["mappings"] = json::array();
  for (const ExplainedMapping& m : e.mappings)
    out["mappings"].push_back({{"shader", m.shader->spec().name},
                               {"role", m.output ? "output" : "lens"},
                               {"before", explain_json_of(m.before)},
                               {"after", explain_json_of(m.after)}});
  return out;
}

}  // namespace oriel::app
