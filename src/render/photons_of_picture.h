// SPDX-License-Identifier: Apache-2.0
// The photons of a picture: how many of which lights, their files, and messages about them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/diagnostic.h"
#include "render/indirect_plan.h"
#include "render/integrator.h"
#include "transport/photon/photon_trace.h"
#include "transport/photon/sharp_caustics.h"

namespace oriel {

/// For the maps of a plan.
PhotonSettings photon_settings(const World& world, const IndirectPlan& plan, std::uint32_t seed);
/// For the caustics of a path-traced picture. Inputs:  paths: camera paths of the picture.
PhotonSettings sharp_photon_settings(const World& world, const SharpCaustics& sharp, double paths,
                                     std::uint32_t seed);
/// Photons of lights that rays find rarely. Inputs:  count: of all lights together.
SharpPhotons photons_of_found_lights(const World& world, const IntegratorPreparation& p,
                                     SharpCaustics of, double count);
/// How these are looked up. The radius follows the space that photons light, not the scene: a room
/// may stand on wide land.
PhotonLookup lookup_of_found_lights(const World& world, const PhotonMap& map);

/// Reports lights that emit no photons because their elements have no energy statement.
void note_lights_without_energy(const World& world, const PhotonSettings& settings,
                                Diagnostics& diagnostics);
/// Reports that the lights request more photons than their budget.
void note_photon_budget(const World& world, const PhotonSettings& settings,
                        Diagnostics& diagnostics);

/// Reports a file that cannot be read, and returns nothing.
std::optional<PhotonMaps> read_photons(const std::string& file, const World& world,
                                       Diagnostics& diagnostics);
void write_photons(const std::string& file, const PhotonMaps& photons, Diagnostics& diagnostics);

}  // namespace oriel
