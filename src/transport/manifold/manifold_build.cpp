// SPDX-License-Identifier: Apache-2.0
#include "transport/manifold/manifold_build.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"

namespace oriel {
namespace {

/// One of kShare blocks of photons is compared with the search. Blocks of consecutive photons are
/// evenly distributed, every eighth photon is not.
constexpr std::uint64_t kBlock = 256, kShare = 8;
/// Photons whose chains decide about casters.
constexpr std::size_t kProbe = 1000;
/// A caster of fewer photons of the probe is not judged.
constexpr int kFewest = 10;
/// Share of the chains of a caster that the search must find.
constexpr float kLeastFound = 0.5f;
/// Size of the smallest cells of starts, in radii of photon estimates.
constexpr float kCell = 0.5f;
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
    if (judge_casters()) make_starts();
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
    return ManifoldCaustics(std::move(starts_), PhotonMap(std::move(missed), merge),
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
    starts_ =
        ChainStarts(photons, finds, world_.accel->bounds().min, kCell * radius_, counts_, monitor_);
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
          const auto starts = starts_.at(p.photon.position);
          found_[photons[i]] = finds_chain(world_, starts, p, counts[b]) ? 1 : 0;
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
      const bool fails = tried[i] >= kFewest &&
                         static_cast<float>(found[i]) < kLeastFound * static_cast<float>(tried[i]);
      failed_[i] = fails ? 1 : 0;
      any |= fails;
    }
    return any;
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
