// SPDX-License-Identifier: Apache-2.0
#include "render/best_settings.h"

#include <algorithm>
#include <utility>

#include "base/math.h"

namespace oriel {
namespace {

/// The usual gain has the weight of pilot paths of this many pixels. Gains that are measured with
/// 256 pixels have a standard deviation of a fifth. In 22 scenes, choices by measured gains alone
/// have .87 of the speed of the best choice, with this weight .92 (bench/paths.md).
constexpr float kPixelsOfUsual = 256;
/// Photons replace rays that find caustics if pilot paths gain at least this much. The gain does
/// not count the time of photons and look-ups: paths of rooms take 1.2 to 1.4 times as long. Of
/// twenty scenes, most of them drawn at random, those with a smaller gain than 1.2 lose by photons
/// up to a fifth of their speed to equal error, and nine with more than 1.3 reach it 1.06 to 14
/// times as fast (bench/paths.md).
constexpr float kWorthwhilePhotons = 1.3f;
/// Number of pilot paths of each choice, as a share of the number of paths of the picture; limits
/// of the number of their pixels.
constexpr double kPilotShare = 0.01;
constexpr double kFewestPilotPixels = 256, kMostPilotPixels = 4096;

}  // namespace

bool BestSettings::improve(const PathSettings& settings) {
  PilotPaths pilots = trace(settings);
  if (pilots.compare(own_pilots()).efficiency() < kWorthwhile) return false;
  settings_ = settings;
  pilots_ = std::move(pilots);
  return true;
}

void BestSettings::choose(std::span<const Candidate> candidates) {
  const float n = static_cast<float>(pilot_pixels()), trust = n / (n + kPixelsOfUsual);
  const Candidate* best = nullptr;
  std::optional<PilotPaths> best_pilots;
  float best_gain = 1;
  for (const Candidate& candidate : candidates) {
    PilotPaths pilots = trace(candidate.settings);
    const float measured = candidate.kept_gain * pilots.compare(own_pilots()).efficiency();
    const float gain = math::pow(measured, trust) * math::pow(candidate.usual_gain, 1 - trust);
    if (gain <= best_gain) continue;
    best = &candidate;
    best_pilots = std::move(pilots);
    best_gain = gain;
  }
  if (!best) return;
  settings_ = best->settings;
  pilots_ = std::move(best_pilots);
}

bool BestSettings::need_photons(const PathSettings& without) {
  const PilotPaths rays = trace(without);
  // compare() counts the light that the rays miss, if pilot paths find it too rarely.
  const float gain = std::max(own_pilots().compare_finds(rays).efficiency(),
                              own_pilots().compare(rays).efficiency());
  return gain >= kWorthwhilePhotons;
}

const PilotPaths& BestSettings::own_pilots() {
  if (!pilots_) pilots_ = trace(settings_);
  return *pilots_;
}

std::size_t BestSettings::pilot_pixels() const {
  const double wanted = kPilotShare * p_.paths / kPilotPathsOfPixel;
  return static_cast<std::size_t>(std::clamp(wanted, kFewestPilotPixels, kMostPilotPixels));
}

PilotPaths BestSettings::trace(const PathSettings& settings) const {
  return {world_, p_.picture, settings, p_.seed, p_.counts, pilot_pixels()};
}

}  // namespace oriel
