// SPDX-License-Identifier: Apache-2.0
#include "image/denoise_regression.h"

#include <algorithm>
#include <cstring>
#include <memory>

#include "base/parallel.h"

namespace oriel::denoising {
namespace {

/// Sizes of patch and window.
/// Source: Bitterli et al. 2016, section 6.
constexpr int kPatch = 3, kWindow = 9;
constexpr int kPatchSide = 2 * kPatch + 1, kWindowSide = 2 * kWindow + 1;
constexpr int kOffsets = kWindowSide * kWindowSide;

/// A tile's weights (0.7 MB) stay in the second-level cache from one step to the next.
constexpr int kTileWidth = 32, kTileHeight = 16;
constexpr int kHalo = kPatch + kWindow;
constexpr int kLocalWidth = kTileWidth + 2 * kHalo, kLocalHeight = kTileHeight + 2 * kHalo;

/// Relative differences below this count as none, or equal pixels would divide 0 by 0.
constexpr float kRelativeResolution = 1e-5f;

/// Squared feature distance at which a neighbour has lost 1 - 1/e of its weight. Features follow
/// the linear model up to here; beyond it, at another surface, the model says nothing.
constexpr float kFeatureReach = 0.5f;

/// How much colour may change, relative to itself, over a feature difference of 1: the prior of
/// the slopes. Wide, so that data decide wherever they can.
constexpr float kSlopePrior = 2.0f;
/// Keeps the system regular where a feature does not vary at all.
constexpr float kSmallestRidge = 1e-4f;

constexpr int kColors = 3;
constexpr int kTerms = 1 + 2 + kFeatures;  ///< constant, position, features
constexpr int kPairs = kTerms * (kTerms + 1) / 2;
constexpr int kLanes = 8;
using Lanes = float[kLanes];

/// A tile with its surroundings; beyond the picture the border pixel goes on.
struct Tile {
  using Plane = float[kLocalHeight][kLocalWidth];
  Plane guide[kColors], guide_variance[kColors];
  Plane target[kColors], target_variance;
  Plane features[kFeatures];
  Plane inside;  ///< 0 beyond the picture
  float distance[kOffsets][kTileHeight][kTileWidth];
};

void load(const Planes& from, int channel, int x0, int y0, Tile::Plane& to) {
  for (int y = 0; y < kLocalHeight; ++y) {
    const float* row = from.row(channel, std::clamp(y0 + y - kHalo, 0, from.height - 1));
    for (int x = 0; x < kLocalWidth; ++x)
      to[y][x] = row[std::clamp(x0 + x - kHalo, 0, from.width - 1)];
  }
}

void load(const Estimate& target, const Estimate& guide, const Planes& features, int x0, int y0,
          Tile& tile) {
  for (int c = 0; c < kColors; ++c) {
    load(guide.mean, c, x0, y0, tile.guide[c]);
    load(guide.variance, c, x0, y0, tile.guide_variance[c]);
    load(target.mean, c, x0, y0, tile.target[c]);
  }
  for (int f = 0; f < kFeatures; ++f) load(features, f, x0, y0, tile.features[f]);
  for (int y = 0; y < kLocalHeight; ++y) {
    for (int x = 0; x < kLocalWidth; ++x) {
      const int px = x0 + x - kHalo, py = y0 + y - kHalo;
      const bool inside = px >= 0 && py >= 0 && px < features.width && py < features.height;
      tile.inside[y][x] = inside ? 1.0f : 0.0f;
      const std::size_t i = std::size_t(std::clamp(py, 0, features.height - 1)) * features.width +
                            std::clamp(px, 0, features.width - 1);
      tile.target_variance[y][x] = (target.variance.plane(0)[i] + target.variance.plane(1)[i] +
                                    target.variance.plane(2)[i]) /
                                   kColors;
    }
  }
}

/// Squared differences of the guide to itself, shifted, in units of its variance, less the part
/// that noise alone makes.
/// Source: Rousselle et al. 2012, equation 6, with its alpha = 1.
void shifted_distances(const Tile& tile, int dx, int dy,
                       float (&out)[kTileHeight + 2 * kPatch][kTileWidth + 2 * kPatch]) {
  for (int y = 0; y < kTileHeight + 2 * kPatch; ++y) {
    std::fill(out[y], out[y] + kTileWidth + 2 * kPatch, 0.0f);
    for (int c = 0; c < kColors; ++c) {
      const float* up = &tile.guide[c][y + kWindow][kWindow];
      const float* uq = &tile.guide[c][y + kWindow + dy][kWindow + dx];
      const float* vp = &tile.guide_variance[c][y + kWindow][kWindow];
      const float* vq = &tile.guide_variance[c][y + kWindow + dy][kWindow + dx];
      for (int x = 0; x < kTileWidth + 2 * kPatch; ++x) {
        const float difference = up[x] - uq[x];
        const float expected = vp[x] + std::min(vp[x], vq[x]);
        const float resolved =
            kRelativeResolution * kRelativeResolution * (up[x] * up[x] + uq[x] * uq[x]) + 1e-30f;
        out[y][x] += (difference * difference - expected) / (resolved + vp[x] + vq[x]);
      }
    }
  }
}

/// Patch distances of all offsets, for a bandwidth of 1.
void patch_distances(Tile& tile) {
  float point[kTileHeight + 2 * kPatch][kTileWidth + 2 * kPatch];
  float across[kTileHeight + 2 * kPatch][kTileWidth];
  constexpr float kMean = 1.0f / (kColors * kPatchSide * kPatchSide);
  for (int o = 0; o < kOffsets; ++o) {
    shifted_distances(tile, o % kWindowSide - kWindow, o / kWindowSide - kWindow, point);
    for (int y = 0; y < kTileHeight + 2 * kPatch; ++y)
      for (int x = 0; x < kTileWidth; ++x) {
        float sum = 0;
        for (int i = 0; i < kPatchSide; ++i) sum += point[y][x + i];
        across[y][x] = sum;
      }
    for (int y = 0; y < kTileHeight; ++y)
      for (int x = 0; x < kTileWidth; ++x) {
        float sum = 0;
        for (int i = 0; i < kPatchSide; ++i) sum += across[y + i][x];
        tile.distance[o][y][x] = std::max(sum * kMean, 0.0f);
      }
  }
}

/// exp(-d) for d >= 0, within 2 % of 1 where it matters and exactly 0 from 64 on; vectorises.
inline float falloff(float d) {
  float e = std::max(1 - d * (1.0f / 64), 0.0f);
  e *= e, e *= e, e *= e, e *= e, e *= e;
  return e * e;
}

constexpr int pair_index(int i, int j) { return i * (i + 1) / 2 + j; }  // j <= i

struct Sums {
  Lanes matrix[kPairs];
  Lanes right[kColors][kTerms];
};

/// The first unknown of the ridge-regularised normal equations: the correction at the pixel itself.
void solve(Sums& s, const Lanes& ridge, Lanes (&out)[kColors]) {
  auto& a = s.matrix;
  // The constant comes last in elimination, so nothing need be substituted back: terms are
  // eliminated from the highest down to 0, where right / matrix is the answer.
  for (int i = 1; i < kTerms; ++i)
    for (int l = 0; l < kLanes; ++l) a[pair_index(i, i)][l] += ridge[l];
  for (int k = kTerms - 1; k > 0; --k) {
    Lanes inverse;
    for (int l = 0; l < kLanes; ++l)
      inverse[l] = 1 / std::max(a[pair_index(k, k)][l], std::max(ridge[l], 1e-30f));
    for (int i = 0; i < k; ++i) {
      Lanes factor;
      for (int l = 0; l < kLanes; ++l) factor[l] = a[pair_index(k, i)][l] * inverse[l];
      for (int j = 0; j <= i; ++j)
        for (int l = 0; l < kLanes; ++l)
          a[pair_index(i, j)][l] -= factor[l] * a[pair_index(k, j)][l];
      for (int c = 0; c < kColors; ++c)
        for (int l = 0; l < kLanes; ++l) s.right[c][i][l] -= factor[l] * s.right[c][k][l];
    }
  }
  for (int c = 0; c < kColors; ++c)
    for (int l = 0; l < kLanes; ++l) out[c][l] = a[0][l] > 0 ? s.right[c][0][l] / a[0][l] : 0.0f;
}

/// Adds the neighbours at one offset to the sums of kLanes pixels.
inline void accumulate(const Tile& tile, int x, int y, int o, float inverse_square, Sums& s) {
  const int dx = o % kWindowSide - kWindow, dy = o / kWindowSide - kWindow;
  const int py = y + kHalo, px = x + kHalo, qy = py + dy, qx = px + dx;
  Lanes t[kTerms], w;
  float any = 0;
  const float* distance = &tile.distance[o][y][x];
  for (int l = 0; l < kLanes; ++l) {
    w[l] = falloff(distance[l] * inverse_square) * tile.inside[qy][qx + l];
    any += w[l];
  }
  if (any == 0) return;
  Lanes apart = {};
  for (int l = 0; l < kLanes; ++l) {
    t[0][l] = 1;
    t[1][l] = float(dx) / kWindow;
    t[2][l] = float(dy) / kWindow;
  }
  for (int f = 0; f < kFeatures; ++f)
    for (int l = 0; l < kLanes; ++l) {
      const float d = tile.features[f][qy][qx + l] - tile.features[f][py][px + l];
      t[3 + f][l] = d;
      apart[l] += d * d;
    }
  for (int l = 0; l < kLanes; ++l) w[l] *= falloff(apart[l] * (1 / kFeatureReach));
  for (int i = 0; i < kTerms; ++i) {
    Lanes wt;
    for (int l = 0; l < kLanes; ++l) wt[l] = w[l] * t[i][l];
    for (int j = 0; j <= i; ++j)
      for (int l = 0; l < kLanes; ++l) s.matrix[pair_index(i, j)][l] += wt[l] * t[j][l];
    for (int c = 0; c < kColors; ++c)
      for (int l = 0; l < kLanes; ++l)
        s.right[c][i][l] += wt[l] * (tile.target[c][qy][qx + l] - tile.target[c][py][px + l]);
  }
}

void regress_lanes(const Tile& tile, int x, int y, float bandwidth, Lanes (&out)[kColors]) {
  Sums s = {};
  const float inverse_square = 1 / (bandwidth * bandwidth);
  for (int o = 0; o < kOffsets; ++o) accumulate(tile, x, y, o, inverse_square, s);
  // The ridge of a Gaussian prior on slopes is noise variance over the prior's variance.
  Lanes ridge;
  for (int l = 0; l < kLanes; ++l) {
    const float weight = std::max(s.matrix[0][l], 1e-30f);
    float level = 0;
    for (int c = 0; c < kColors; ++c) {
      const float mean = tile.target[c][y + kHalo][x + kHalo + l] + s.right[c][0][l] / weight;
      level += mean * mean / kColors;
    }
    const float noise = tile.target_variance[y + kHalo][x + kHalo + l];
    ridge[l] = kSmallestRidge * weight +
               std::min(noise / (kSlopePrior * kSlopePrior * level + 1e-30f), 1e6f);
  }
  solve(s, ridge, out);
}

void store(const Lanes (&values)[kColors], int x, int y, Planes& out) {
  const int count = std::min(kLanes, out.width - x);
  for (int c = 0; c < kColors; ++c) std::copy_n(values[c], count, out.row(c, y) + x);
}

}  // namespace

std::array<Planes, kBandwidths> regress(const Estimate& target, const Estimate& guide,
                                        const Planes& features, float strength) {
  const int width = features.width, height = features.height;
  std::array<Planes, kBandwidths> out;
  for (Planes& planes : out) planes = Planes(width, height, kColors);
  const int columns = (width + kTileWidth - 1) / kTileWidth;
  const int rows = (height + kTileHeight - 1) / kTileHeight;
  parallel_for(std::size_t(columns) * rows, [&](std::size_t i) {
    const int x0 = int(i % columns) * kTileWidth, y0 = int(i / columns) * kTileHeight;
    const auto tile = std::make_unique<Tile>();
    load(target, guide, features, x0, y0, *tile);
    patch_distances(*tile);
    for (int y = 0; y < std::min(kTileHeight, height - y0); ++y)
      for (int x = 0; x < std::min(kTileWidth, width - x0); x += kLanes)
        for (int b = 0; b < kBandwidths; ++b) {
          Lanes correction[kColors];
          regress_lanes(*tile, x, y, kBandwidth[b] * strength, correction);
          store(correction, x0 + x, y0 + y, out[b]);
        }
  });
  return out;
}

}  // namespace oriel::denoising
