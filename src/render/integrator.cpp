// SPDX-License-Identifier: Apache-2.0
#include "render/integrator.h"

#include <algorithm>

#include "render/cached_integrator.h"
#include "render/path_integrator.h"

namespace oriel {
namespace {

using Method = scene::IndirectMethod;

template <class T>
std::unique_ptr<Integrator> make(const World& world) {
  return std::make_unique<T>(world);
}

constexpr IntegratorSpec kIntegrators[] = {
    {Method::Path, "path", "path tracing", make<CachedIntegrator>},
    {Method::PathCache, "path+cache", "path tracing with a cache behind the first diffuse bounce",
     make<CachedIntegrator>},
    {Method::FinalGather, "fg", "final gathering", make<CachedIntegrator>},
    {Method::Photons, "photons", "photon maps", make<CachedIntegrator>},
    {Method::FinalGatherPhotons, "fg+photons", "final gathering of photon maps",
     make<CachedIntegrator>},
    {Method::Scene, "scene", "the scene's own statements", make<CachedIntegrator>},
};

}  // namespace

std::span<const IntegratorSpec> integrators() { return kIntegrators; }

const IntegratorSpec* find_integrator(std::string_view name) {
  const auto row = std::find_if(std::begin(kIntegrators), std::end(kIntegrators),
                                [&](const IntegratorSpec& s) { return s.name == name; });
  return row == std::end(kIntegrators) ? nullptr : row;
}

std::unique_ptr<Integrator> make_integrator(const World& world) {
  const auto row =
      std::find_if(std::begin(kIntegrators), std::end(kIntegrators),
                   [&](const IntegratorSpec& s) { return s.method == world.options.indirect; });
  return row->make(world);
}

}  // namespace oriel
