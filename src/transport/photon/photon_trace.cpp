// SPDX-License-Identifier: Apache-2.0
#include "transport/photon/photon_trace.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "lights/light_sampler.h"
#include "transport/photon/photon_walk.h"

namespace oriel {
namespace {

/// Photons one thread takes at a time, and all together before counts are looked at.
constexpr std::uint64_t kBatch = 1024, kRound = 64 * kBatch;
/// Photons of one light, whatever is asked; they are numbered by 32 bits.
constexpr std::uint64_t kMaxEmitted = std::uint64_t{1} << 31;
/// Most photons sent for each that is to be stored.
constexpr std::uint64_t kMaxForEach = 1000;

/// The photons of one light for one map, in the order they were sent.
struct Harvest {
  PhotonCount count;
  bool wanted = false;
  std::vector<StoredPhoton> photons;
  std::vector<PhotonChain> chains = {};  // of the photons, if wanted

  /// After how many photons this map asks for no more, as far as can be told.
  std::uint64_t most() const {
    if (!wanted) return 0;
    std::uint64_t n = kMaxEmitted;
    if (count.emit > 0) n = std::min(n, count.emit);
    if (count.store > 0) n = std::min(n, std::max(kRound, kMaxForEach * count.store));
    return n;
  }
  bool is_done(std::uint64_t sent) const {
    if (sent >= most() || (count.store > 0 && photons.size() >= count.store)) return true;
    return count.store > 0 && photons.empty() && sent >= kHopelessPhotons;
  }

  double share_done(std::uint64_t sent) const {
    if (!wanted) return 0;
    const double of_sent = static_cast<double>(sent) / static_cast<double>(most());
    if (count.store == 0) return of_sent;
    return std::max(of_sent, std::min(1.0, static_cast<double>(photons.size()) /
                                               static_cast<double>(count.store)));
  }

  /// Drops what came past the limits and appends the rest, each its share of the power. Returns the
  /// number of photons that count as emitted.
  std::uint64_t take_to(std::vector<Photon>& map, std::uint64_t sent, std::uint32_t layer) const {
    std::uint64_t emitted = std::min(sent, most());
    if (count.store > 0 && photons.size() >= count.store)
      emitted = std::min(emitted, std::uint64_t{photons[count.store - 1].index} + 1);
    const float share = 1 / static_cast<float>(emitted);
    for (const StoredPhoton& s : photons) {
      if (s.index >= emitted) break;
      map.push_back(s.photon);
      map.back().power *= share;
      map.back().layer = layer;
    }
    return emitted;
  }
};

class MapTracer {
 public:
  MapTracer(const World& world, const PhotonSettings& settings, const ProgressMonitor& monitor)
      : world_(world), settings_(settings), monitor_(monitor) {}

  /// `share`: of all lights, how many were traced before and are when this one is.
  void trace(const PhotonSource& source, const LightPhotons& asked, int stream, std::uint32_t layer,
             const std::array<double, 2>& share) {
    Harvest global{asked.global, settings_.globillum && asked.global.any(), {}};
    Harvest caustic{asked.caustic, settings_.caustics && asked.caustic.any(), {}};
    // Photons that no map asks for any more are not followed.
    PhotonSettings settings = settings_;
    const PhotonAim aim =
        settings_.sharp ? PhotonAim(source, settings_.sharp->spheres(stream - 1)) : PhotonAim();
    if (aim.share() == 0) return;
    PhotonBalance balance;
    std::uint64_t sent = 0;
    while (!monitor_.cancelled()) {
      settings.globillum = global.wanted && !global.is_done(sent);
      settings.caustics = caustic.wanted && !caustic.is_done(sent);
      if (!settings.globillum && !settings.caustics) break;
      std::uint64_t end = sent + kRound;
      for (const Harvest* h : {&global, &caustic})
        if (h->most() > sent) end = std::min(end, h->most());
      std::vector<PhotonLog> logs((end - sent + kBatch - 1) / kBatch);
      parallel_for(logs.size(), [&](std::size_t b) {
        const std::uint64_t first = sent + b * kBatch, last = std::min(first + kBatch, end);
        for (std::uint64_t i = first; i < last; ++i)
          walk_photon(world_, settings, source, aim, stream, static_cast<std::uint32_t>(i),
                      logs[b]);
      });
      for (const PhotonLog& log : logs) {
        global.photons.insert(global.photons.end(), log.global.begin(), log.global.end());
        caustic.photons.insert(caustic.photons.end(), log.caustic.begin(), log.caustic.end());
        caustic.chains.insert(caustic.chains.end(), log.chains.begin(), log.chains.end());
        balance += log.balance;
        counts_ += log.counts;
      }
      sent = end;
      const double done = std::max(global.share_done(sent), caustic.share_done(sent));
      monitor_.report("photons", std::lerp(share[0], share[1], done));
    }
    if (sent == 0) return;
    global.take_to(global_, sent, layer);
    const std::size_t before = caustic_.size();
    const std::uint64_t emitted = caustic.take_to(caustic_, sent, layer);
    if (settings_.chains) {
      settings_.chains->emitted[static_cast<std::size_t>(stream) - 1] = emitted;
      for (std::size_t i = before; i < caustic_.size(); ++i)
        settings_.chains->photons.push_back({caustic_[i], caustic.chains[i - before]});
    }
    const double each = 1 / static_cast<double>(sent);
    for (auto* sum : {&balance.emitted, &balance.absorbed, &balance.escaped, &balance.stopped})
      *sum *= each;
    balance_ += balance;
  }

  const PhotonBalance& balance() const { return balance_; }
  const RayCounts& counts() const { return counts_; }
  PhotonMaps maps() {
    return {PhotonMap(std::move(global_), settings_.merge_global),
            PhotonMap(std::move(caustic_), settings_.merge_caustic)};
  }

 private:
  const World& world_;
  const PhotonSettings& settings_;
  const ProgressMonitor& monitor_;
  std::vector<Photon> global_, caustic_;
  PhotonBalance balance_;
  RayCounts counts_;
};

}  // namespace

PhotonBalance& PhotonBalance::operator+=(const PhotonBalance& o) {
  emitted += o.emitted;
  absorbed += o.absorbed;
  escaped += o.escaped;
  stopped += o.stopped;
  photons += o.photons;
  return *this;
}

bool sends_photons(const Light& light, const PhotonSettings& settings) {
  return !light.photons.none && (light.photons.has_energy || !settings.by_energy);
}

namespace {

std::uint64_t requested(const PhotonCount& count) {
  return count.store > 0 ? count.store : std::min(count.emit, kMaxEmitted);
}

/// The request of a light; null: it sends no photons.
const LightPhotons* request_of(const Light& light, const PhotonSettings& settings) {
  const bool own = light.photons.any() && !settings.sharp;
  const LightPhotons& asked = own ? light.photons : settings.each;
  return asked.any() && sends_photons(light, settings) ? &asked : nullptr;
}

std::uint64_t requested(const LightPhotons& asked, const PhotonSettings& settings) {
  return (settings.globillum ? requested(asked.global) : 0) +
         (settings.caustics ? requested(asked.caustic) : 0);
}

void limit(PhotonCount& count, double share) {
  if (count.any())
    count.store = std::max<std::uint64_t>(
        1, static_cast<std::uint64_t>(static_cast<double>(requested(count)) * share));
}

/// The request, reduced to a share of its photons.
LightPhotons limited(LightPhotons asked, double share) {
  if (share >= 1) return asked;
  limit(asked.global, share);
  limit(asked.caustic, share);
  return asked;
}

}  // namespace

std::uint64_t requested_photons(const World& world, const PhotonSettings& settings,
                                const Light** largest) {
  std::uint64_t sum = 0, most = 0;
  for (const Light& light : world.lights) {
    const bool requests = light.photons.any() && sends_photons(light, settings);
    const std::uint64_t wanted = requests ? requested(light.photons, settings) : 0;
    sum += wanted;
    if (largest && wanted > most) *largest = &light, most = wanted;
  }
  return sum;
}

PhotonMaps trace_photons(const World& world, const PhotonSettings& settings, RayCounts& counts,
                         PhotonBalance* balance, const ProgressMonitor& monitor) {
  if (settings.chains) settings.chains->emitted.assign(world.lights.size(), 0);
  MapTracer tracer(world, settings, monitor);
  const double sources = static_cast<double>(world.lights.size()) + 1;
  const double share =
      static_cast<double>(settings.most) /
      static_cast<double>(std::max<std::uint64_t>(requested_photons(world, settings), 1));
  const LightLayers& layers = world.light_layers;
  for (std::size_t i = 0; i < world.lights.size(); ++i) {
    const LightPhotons& own = world.lights[i].photons;
    const LightPhotons* asked = request_of(world.lights[i], settings);
    if (!asked || (settings.sharp && !settings.sharp->ways_of(static_cast<int>(i)))) continue;
    const double done = static_cast<double>(i);
    // Energy statements do not apply to paths.
    const EmissionRequest emission = settings.sharp ? EmissionRequest() : own.emission;
    tracer.trace(PhotonSource(world, world.lights[i], emission),
                 asked == &own ? limited(*asked, share) : *asked, static_cast<int>(i) + 1,
                 layers.asked() ? layers.of_light[i] : Photon::kUnknownLayer,
                 {done / sources, (done + 1) / sources});
  }
  if (world.light_sampler->environment().lights() && !settings.sharp)
    tracer.trace(PhotonSource(world, settings.environment.emission), settings.environment, 0,
                 layers.asked() ? layers.environment : Photon::kUnknownLayer, {1 - 1 / sources, 1});
  counts += tracer.counts();
  if (balance) *balance += tracer.balance();
  return tracer.maps();
}

}  // namespace oriel
