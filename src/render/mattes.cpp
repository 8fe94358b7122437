// SPDX-License-Identifier: Apache-2.0
#include "render/mattes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/byte_stream.h"
#include "base/checkpoint_file.h"

namespace oriel {

Mattes::Mattes(int width, int height, const FilterSampler& filter, MatteNames names)
    : width_(width),
      positive_share_(filter.positive_share()),
      negative_share_(filter.negative_share()),
      names_(std::move(names)),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

void Mattes::add(int x, int y, std::span<const FirstSurface> seen, bool negative) {
  std::vector<Entry>& entries =
      pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
              static_cast<std::size_t>(x)];
  for (const FirstSurface& surface : seen) {
    auto at = std::find_if(entries.begin(), entries.end(), [&](const Entry& e) {
      return e.seen.instance == surface.instance && e.seen.material == surface.material;
    });
    if (at == entries.end()) at = entries.insert(entries.end(), {surface, 0, 0});
    // Where a sample is several rays, each is a part of it.
    (negative ? at->negative : at->positive) += 1 / static_cast<float>(seen.size());
  }
}

void Mattes::clear() {
  for (std::vector<Entry>& entries : pixels_) entries.clear();
}

template <class Writer>
void Mattes::save(Writer& out, const std::vector<Material>& materials,
                  const std::vector<std::uint32_t>& pixels) const {
  std::vector<std::uint32_t> counts;
  std::vector<std::int32_t> surfaces;  // two numbers for each entry
  std::vector<float> samples;          // the same
  for (const std::uint32_t pixel : pixels) {
    const std::vector<Entry>& entries = pixels_[pixel];
    counts.push_back(static_cast<std::uint32_t>(entries.size()));
    for (const Entry& e : entries) {
      const auto material = e.seen.material ? e.seen.material - materials.data() : -1;
      surfaces.insert(surfaces.end(), {e.seen.instance, static_cast<std::int32_t>(material)});
      samples.insert(samples.end(), {e.positive, e.negative});
    }
  }
  out.array(counts);
  out.list(surfaces);
  out.list(samples);
}

template <class Reader>
void Mattes::restore(Reader& in, const std::vector<Material>& materials, std::size_t instances,
                     const std::vector<std::uint32_t>& pixels) {
  std::vector<std::uint32_t> counts(pixels.size());
  std::vector<std::int32_t> surfaces;
  std::vector<float> samples;
  in.array(counts);
  in.list(surfaces);
  in.list(samples);
  std::size_t at = 0;
  const auto require = [](bool condition) {
    if (!condition) throw CheckpointError("its Cryptomattes are invalid");
  };
  require(surfaces.size() == samples.size());
  const auto below = [](std::int32_t index, std::size_t count) {
    return index >= -1 && index < static_cast<std::int64_t>(count);
  };
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    std::vector<Entry>& entries = pixels_[pixels[i]];
    require(counts[i] <= (surfaces.size() - at) / 2);
    entries.clear();
    for (const std::size_t end = at + std::size_t{counts[i]} * 2; at < end; at += 2) {
      const std::int32_t instance = surfaces[at], material = surfaces[at + 1];
      require(below(instance, instances) && below(material, materials.size()));
      require(samples[at] >= 0 && std::isfinite(samples[at]) && samples[at + 1] >= 0 &&
              std::isfinite(samples[at + 1]));
      const FirstSurface seen{instance, material < 0 ? nullptr : &materials[std::size_t(material)]};
      entries.push_back({seen, samples[at], samples[at + 1]});
    }
  }
  require(at == surfaces.size());
}

template void Mattes::save(CheckpointWriter&, const std::vector<Material>&,
                           const std::vector<std::uint32_t>&) const;
template void Mattes::save(ByteWriter&, const std::vector<Material>&,
                           const std::vector<std::uint32_t>&) const;
template void Mattes::restore(CheckpointReader&, const std::vector<Material>&, std::size_t,
                              const std::vector<std::uint32_t>&);
template void Mattes::restore(ByteReader&, const std::vector<Material>&, std::size_t,
                              const std::vector<std::uint32_t>&);

std::vector<Mattes::Share> Mattes::shares(int x, int y) const {
  const std::vector<Entry>& entries =
      pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
              static_cast<std::size_t>(x)];
  float positive = 0, negative = 0;
  for (const Entry& e : entries) positive += e.positive, negative += e.negative;
  // Until both kinds of samples have been drawn one stands for the other.
  const float of_plain = positive == 0 ? 0 : (negative > 0 ? positive_share_ : 1.0f) / positive;
  const float of_marked = negative == 0 ? 0 : (positive > 0 ? -negative_share_ : 1.0f) / negative;
  std::vector<Share> shares;
  shares.reserve(entries.size());
  float sum = 0;
  for (const Entry& e : entries) {
    const float coverage = std::max(e.positive * of_plain + e.negative * of_marked, 0.0f);
    if (coverage > 0) shares.push_back({e.seen, coverage});
    sum += coverage;
  }
  for (Share& share : shares) share.coverage /= sum;
  return shares;
}

}  // namespace oriel
