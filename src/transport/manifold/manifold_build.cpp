// SPDX-License-Identifier: Apache-2.0
#include "transport/manifold/manifold_build.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "lights/sample_light.h"
#include "transport/shadow.h"

namespace oriel {
namespace {

/// One of kShare blocks of photons is compared with the search. Blocks of consecutive photons are
/// evenly distributed, every eighth photon is not.
constexpr std::uint64_t kBlock = 256, kShare = 8;
/// Photons whose chains decide about casters.
constexpr std::size_t kProbe = 1000;
/// A caster of fewer photons of the probe is not judged.
constexpr int kFewest = 10;
/// The search is used for casters of which it finds at least this share of the chains.
constexpr float kLeastShareFound = 0.5f;
/// Size of the smallest cells of starts, in radii of photon estimates.
constexpr float kCell = 0.5f;
/// Photons that the search misses are few, so that each lights a disc of few neighbours, which may
/// be large: their number, and the largest radius in radii of photon estimates.
constexpr int kNeighbours = 32;
constexpr float kMissedRadius = 2;
/// Maximum number of lights whose direct light is compared with caustics.
constexpr std::size_t kMostLights = 16;
/// Places and samples of a light for the noise of the search, and the largest mean of the squared
/// relative deviation of one sample with which it is used. Photon maps deviate by an eighth, so 64
/// samples of the search are better than they are below 1; an estimate for fewer samples.
constexpr std::size_t kNoisePlaces = 128;
constexpr int kNoiseSamples = 8;
constexpr float kMostNoise = 0.8f, kNoiseLimit = 4;
/// Photons that a thread compares at a time, and all together before progress is reported.
constexpr std::size_t kBatch = 64, kRound = 64 * kBatch;

bool is_compared(const PhotonChain& chain) { return chain.index / kBlock % kShare == kShare - 1; }

/// The number of photons of the first `emitted` that are compared.
std::uint64_t compared_of(std::uint64_t emitted) {
  constexpr std::uint64_t kPeriod = kBlock * kShare, kBefore = kPeriod - kBlock;
  const std::uint64_t rest = emitted % kPeriod;
  return emitted / kPeriod * kBlock + (rest > kBefore ? rest - kBefore : 0);
}

class ManifoldBuilder {
 public:
  ManifoldBuilder(const World& world, const ChainLog& log, float radius, RayCounts& counts,
                  const ProgressMonitor& monitor)
      : world_(world),
        log_(log),
        radius_(radius),
        counts_(counts),
        monitor_(monitor),
        lights_(world.lights.size(), 0),
        failed_(world.instances.size(), 0),
        found_(log.photons.size(), 0) {
    for (std::size_t i = 0; i < lights_.size(); ++i)
      lights_[i] = can_end_chains(world.lights[i]) && compared_of(log.emitted[i]) > 0 ? 1 : 0;
  }

  ManifoldCaustics build(float merge) {
    make_starts();
    bool changed = judge_casters();
    changed |= judge_lights();
    if (changed) make_starts();
    if (starts_.empty()) return {};
    compare(compared(1), 0.5);
    if (monitor_.cancelled()) return {};
    std::vector<Photon> missed, others;
    for (std::size_t i = 0; i < log_.photons.size(); ++i) {
      const ChainPhoton& p = log_.photons[i];
      if (!is_searched(p)) {
        others.push_back(p.photon);
      } else if (is_compared(p.chain) && found_[i] == 0) {
        const std::uint64_t emitted = log_.emitted[static_cast<std::size_t>(p.chain.kind.light)];
        missed.push_back(p.photon);
        missed.back().power *=
            static_cast<float>(emitted) / static_cast<float>(compared_of(emitted));
      }
    }
    return ManifoldCaustics(
        std::move(starts_),
        PhotonDiscs(std::move(missed), merge, kNeighbours, kMissedRadius * radius_),
        PhotonMap(std::move(others), merge));
  }

 private:
  bool is_searched(const ChainPhoton& p) const {
    const ChainKind& kind = p.chain.kind;
    if (!p.chain.simple || lights_[static_cast<std::size_t>(kind.light)] == 0) return false;
    for (int i = 0; i < kind.count; ++i)
      if (failed_[static_cast<std::size_t>(kind.instance[i])] != 0) return false;
    return true;
  }

  void make_starts() {
    std::vector<const ChainPhoton*> photons;
    for (const ChainPhoton& p : log_.photons)
      if (is_searched(p) && !is_compared(p.chain)) photons.push_back(&p);
    const auto finds = [&](std::span<const ChainStart> starts, const ChainPhoton& p,
                           RayCounts& counts) { return finds_chain(world_, starts, p, counts); };
    const auto share = [&](const ChainPhoton& p, float irradiance, RayCounts& counts) {
      const float direct = direct_irradiance(p, counts);
      return irradiance > 0 ? irradiance / (irradiance + direct) : 0;
    };
    starts_ = ChainStarts(photons, finds, share, world_.accel->bounds().min, kCell * radius_,
                          counts_, monitor_);
  }

  /// Direct light of the lights at the place of a photon.
  float direct_irradiance(const ChainPhoton& p, RayCounts& counts) const {
    ShadingPoint point;
    point.position = p.photon.position;
    point.normal = point.geometric_normal = p.photon.normal;
    point.ray_direction = -p.photon.normal;
    point.ray_offset = p.chain.offset;
    point.world = &world_;
    float sum = 0;
    const std::size_t stride = (world_.lights.size() + kMostLights - 1) / kMostLights;
    for (std::size_t i = 0; i < world_.lights.size(); i += stride) {
      if (!gives_direct_light(world_.lights[i])) continue;
      const auto sample = sample_light(world_.lights[i], point, Vec2(0.5f));
      const float cosine = sample ? dot(sample->wi, p.photon.normal) : 0;
      if (!(cosine > 0)) continue;
      const Transmittance open = shadow_transmittance(world_, point, sample->wi, sample->reach,
                                                      counts, static_cast<int>(i));
      sum += max_component(sample->irradiance * open.all) * cosine * static_cast<float>(stride);
    }
    return sum;
  }

  /// Indices of every n-th photon that is compared.
  std::vector<std::uint32_t> compared(std::size_t n) const {
    std::vector<std::uint32_t> photons;
    std::size_t count = 0;
    for (std::size_t i = 0; i < log_.photons.size(); ++i) {
      const ChainPhoton& p = log_.photons[i];
      if (is_compared(p.chain) && is_searched(p) && count++ % n == 0)
        photons.push_back(static_cast<std::uint32_t>(i));
    }
    return photons;
  }

  /// Searches the chains of photons at their places.
  void compare(const std::vector<std::uint32_t>& photons, double done) {
    for (std::size_t round = 0; round < photons.size() && !monitor_.cancelled(); round += kRound) {
      const std::size_t all = std::min(photons.size() - round, kRound);
      std::vector<RayCounts> counts((all + kBatch - 1) / kBatch);
      parallel_for(counts.size(), [&](std::size_t b) {
        const std::size_t end = std::min(all, (b + 1) * kBatch);
        for (std::size_t i = round + b * kBatch; i < round + end; ++i) {
          const ChainPhoton& p = log_.photons[photons[i]];
          const ChainStarts::Found at = starts_.at(p.photon.position);
          const float concentration = finds_chain(world_, at.starts, p, counts[b]);
          found_[photons[i]] = concentration > 0 && concentration <= at.limit ? 1 : 0;
        }
      });
      for (const RayCounts& c : counts) counts_ += c;
      monitor_.report("caustics", std::lerp(done, 1.0,
                                            static_cast<double>(round + all) /
                                                static_cast<double>(photons.size())));
    }
  }

  /// Finds the casters whose chains are hardly found. True: there are some.
  bool judge_casters() {
    const std::size_t all = compared(1).size();
    const std::vector<std::uint32_t> probe = compared(std::max<std::size_t>(1, all / kProbe));
    compare(probe, 0.5);
    std::vector<int> tried(failed_.size(), 0), found(failed_.size(), 0);
    for (const std::uint32_t i : probe) {
      const ChainKind& kind = log_.photons[i].chain.kind;
      for (int k = 0; k < kind.count; ++k) {
        const auto caster = static_cast<std::size_t>(kind.instance[k]);
        ++tried[caster];
        found[caster] += found_[i];
      }
    }
    bool any = false;
    for (std::size_t i = 0; i < failed_.size(); ++i) {
      const bool fails = tried[i] >= kFewest && static_cast<float>(found[i]) <
                                                    kLeastShareFound * static_cast<float>(tried[i]);
      failed_[i] = fails ? 1 : 0;
      any |= fails;
    }
    return any;
  }

  /// Excludes lights for which the search is noisier than photons, since their chains depend much
  /// on the sampled place on the light. True: there are some.
  bool judge_lights() {
    bool any = false;
    std::vector<std::vector<std::uint32_t>> photons(lights_.size());
    for (const std::uint32_t i : compared(1))
      photons[static_cast<std::size_t>(log_.photons[i].chain.kind.light)].push_back(i);
    for (std::size_t light = 0; light < lights_.size(); ++light) {
      const Light& source = world_.lights[light];
      if (lights_[light] == 0 || !(has_extent(source.shape) || source.cone_angle > 0)) continue;
      if (monitor_.cancelled() || !(noise_of(photons[light]) > kMostNoise)) continue;
      lights_[light] = 0;
      any = true;
    }
    return any;
  }

  /// Mean over the places of photons of the squared relative deviation of one search.
  float noise_of(const std::vector<std::uint32_t>& photons) {
    const std::size_t places = std::min(photons.size(), kNoisePlaces);
    std::vector<float> noise(places, -1);
    std::vector<RayCounts> counts(places);
    parallel_for(places, [&](std::size_t k) {
      const ChainPhoton& p = log_.photons[photons[k * photons.size() / places]];
      noise[k] = noise_at(p, counts[k]);
    });
    float sum = 0, known = 0;
    for (std::size_t k = 0; k < places; ++k) {
      counts_ += counts[k];
      if (noise[k] >= 0) sum += noise[k], ++known;
    }
    return known > 0 ? sum / known : 0;
  }

  /// The same at the place of one photon; -1: the search finds nothing there.
  float noise_at(const ChainPhoton& p, RayCounts& counts) const {
    ChainStarts::Found at = starts_.at(p.photon.position);
    std::vector<ChainStart> starts;
    for (const ChainStart& start : at.starts)
      if (start.kind.light == p.chain.kind.light) starts.push_back(start);
    at.starts = starts;
    const ChainReceiver from{p.photon.position, p.photon.normal, p.chain.offset, 0};
    float sum = 0, squares = 0;
    for (int i = 0; i < kNoiseSamples; ++i) {
      sampling::Sampler sampler(0, 0, static_cast<std::uint32_t>(i));
      ChainArrivals arrivals;
      search_chains(world_, at, from, sampler.next_2d(), arrivals, counts);
      float value = 0;
      for (int k = 0; k < arrivals.count; ++k)
        value += max_component(arrivals.of[k].irradiance) * dot(arrivals.of[k].wi, from.normal);
      sum += value;
      squares += sqr(value);
    }
    if (!(sum > 0)) return -1;
    constexpr float kCount = kNoiseSamples;
    const float variance = (squares - sqr(sum) / kCount) / (kCount - 1);
    return std::min(kNoiseLimit, variance / sqr(sum / kCount));
  }

  const World& world_;
  const ChainLog& log_;
  float radius_;
  RayCounts& counts_;
  const ProgressMonitor& monitor_;
  std::vector<std::uint8_t> lights_, failed_, found_;  // by light, instance, photon
  ChainStarts starts_;
};

}  // namespace

ManifoldCaustics build_manifold_caustics(const World& world, const ChainLog& log, float radius,
                                         float merge, RayCounts& counts,
                                         const ProgressMonitor& monitor) {
  if (world.shutter.on || world.has_object_volumes || !world.light_volume.empty()) return {};
  return ManifoldBuilder(world, log, radius, counts, monitor).build(merge);
}

}  // namespace oriel
