// SPDX-License-Identifier: Apache-2.0
#include "render/best_settings.h"

#include <algorithm>
#include <utility>

namespace oriel {
namespace {

/// Pilot paths compare noise and rays, but not the time of look-ups in the guide. In nine scenes,
/// pictures with a guide gain .81 to 1.05 of what pilot paths find (mean .9), with a guide and two
/// diffuse rays .88 to 1.15.
constexpr float kKeptWithGuide = 0.9f;
/// The gain of a choice is measured with an error of about a tenth: a choice replaces the best one
/// before it if it gains this many times as much.
constexpr float kClearlyBetter = 1.08f;
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
  if (!pilots_) pilots_ = trace(settings_);
  PilotPaths pilots = trace(settings);
  const float kept = settings.guide && settings.diffuse_rays == 1 ? kKeptWithGuide : 1;
  const float gain = kept * pilots.compare(*pilots_).efficiency();
  if (gain < (next_ ? kClearlyBetter * next_->gain : kWorthwhile)) return false;
  next_ = Next{settings, std::move(pilots), gain};
  return true;
}

bool BestSettings::need_photons(const PathSettings& without) {
  if (!pilots_) pilots_ = trace(settings_);
  const PilotPaths rays = trace(without);
  // compare() counts the light that the rays miss, if pilot paths find it too rarely.
  const float gain =
      std::max(pilots_->compare_finds(rays).efficiency(), pilots_->compare(rays).efficiency());
  return gain >= kWorthwhilePhotons;
}

void BestSettings::settle() {
  if (!next_) return;
  settings_ = next_->settings;
  pilots_ = std::move(next_->pilots);
  next_.reset();
}

PilotPaths BestSettings::trace(const PathSettings& settings) const {
  const double wanted = kPilotShare * p_.paths / kPilotPathsOfPixel;
  return {world_,
          p_.picture,
          settings,
          p_.seed,
          p_.counts,
          static_cast<std::size_t>(std::clamp(wanted, kFewestPilotPixels, kMostPilotPixels))};
}

}  // namespace oriel
