// SPDX-License-Identifier: Apache-2.0
// Lights made by geometry shaders.
#include "sdk/context.h"
#include "sdk/geometry_work.h"
#include "sdk/made_parts.h"

namespace oriel::sdk {
namespace {

std::optional<scene::Statement> area_of(const miLight& light) {
  const auto& p = light.primitive;
  const auto area = [&](const char* word, std::vector<float> n) {
    n.push_back(static_cast<float>(light.samples_u > 0 ? light.samples_u : 1));
    n.push_back(static_cast<float>(light.samples_v > 0 ? light.samples_v : 1));
    return scene::Statement{word, false, {made::numbers(n)}, {}};
  };
  switch (light.area) {
    case miLIGHT_RECTANGLE: {
      const miVector &u = p.rectangle.edge_u, &v = p.rectangle.edge_v;
      return area("rectangle", {u.x, u.y, u.z, v.x, v.y, v.z});
    }
    case miLIGHT_DISC: {
      const miVector& n = p.disc.normal;
      return area("disc", {n.x, n.y, n.z, p.disc.radius});
    }
    case miLIGHT_SPHERE:
      return area("sphere", {p.sphere.radius});
    case miLIGHT_CYLINDER: {
      const miVector& a = p.cylinder.axis;
      return area("cylinder", {a.x, a.y, a.z, p.cylinder.radius});
    }
    case miLIGHT_OBJECT:
      return scene::Statement{"object", false, {made::text(made::name_of(p.object.object))}, {}};
    case miLIGHT_USER:
      return scene::Statement{"user", false, {}, {}};
    default:
      return std::nullopt;
  }
}

void store_photons(const miLight& light, std::vector<scene::Statement>& other) {
  const miColor& energy = light.energy;
  if (energy.r != 0 || energy.g != 0 || energy.b != 0)
    made::say(other, "energy", made::numbers({&energy.r, 3}));
  if (light.exponent != 0) made::say(other, "exponent", made::numbers({&light.exponent, 1}));
  const auto count = [&](const char* word, int stored, int sent) {
    if (stored <= 0 && sent <= 0) return;
    const float both[] = {static_cast<float>(stored), static_cast<float>(sent)};
    made::say(other, word, made::numbers(both));
  };
  count("caustic photons", light.caustic_store_photons, light.caustic_emit_photons);
  count("globillum photons", light.global_store_photons, light.global_emit_photons);
  if (light.photons_only) made::say(other, "photons only", made::boolean(true));
}

}  // namespace
}  // namespace oriel::sdk

using namespace oriel;
using namespace oriel::sdk;

extern "C" {

miLight* mi_api_light_begin(const char* name) {
  GeometryWork* work = GeometryWork::current();
  if (!work) return nullptr;
  work->elements.light.emplace();
  work->elements.light->name = work->name_for(name);
  work->elements.light_data = {};
  return &work->elements.light_data;
}

// Shadow maps are ignored; shadows are always ray traced.
miBoolean mi_api_light_end(void) {
  GeometryWork* work = GeometryWork::current();
  if (!work || !work->elements.light) return miFALSE;
  scene::Light made = std::move(*work->elements.light);
  work->elements.light.reset();
  const miLight& data = work->elements.light_data;
  if (data.type != miLIGHT_DIRECTION || data.dirlight_has_org) made.origin = vec(data.origin);
  if (data.type != miLIGHT_ORIGIN) made.direction = vec(data.direction);
  if (data.type == miLIGHT_SPOT) made.spread = data.spread;
  made.area = area_of(data);
  made.shaders = made::shader_list(*work->scene, data.shader);
  made.emitters = made::shader_list(*work->scene, data.emitter);
  if (data.visible) made::say(made.other, "visible", made::boolean(true));
  store_photons(data, made.other);
  if (const std::string profile = made::name_of(data.lightprofile); !profile.empty())
    made::say(made.other, "lightprofile", made::text(profile));
  made::attach(data, made.other);
  work->add(std::move(made));
  return miTRUE;
}

}  // extern "C"
