// SPDX-License-Identifier: Apache-2.0
#include "bsdf/ggx_albedo.h"

#include <array>
#include <cstddef>

#include "bsdf/ggx_albedo_table.h"

namespace oriel::bsdf {
namespace {

using Coordinates = GgxAlbedoCoordinates;

// Floats at compile time; the checked-in table is in units of 1/16384.
alignas(64) constexpr auto kTable = [] {
  std::array<float, Coordinates::kValues> t{};
  for (std::size_t i = 0; i < t.size(); ++i) t[i] = kGgxAlbedoTable[i] * (1.0f / 16384);
  return t;
}();

}  // namespace

float ggx_albedo(float ax, float ay, const Vec3& wo) {
  const Coordinates c(ax, ay, wo);
  float sum[Coordinates::kTerms] = {};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const float w = c.weight[0][i] * c.weight[1][j];
      const int row =
          ((c.cell[0] + i) * Coordinates::kNodes[1] + c.cell[1] + j) * Coordinates::kNodes[2] +
          c.cell[2];
      const float* node = kTable.data() + row * Coordinates::kTerms;
      for (int k = 0; k < 3; ++k)
        for (int m = 0; m < Coordinates::kTerms; ++m)
          sum[m] += w * c.weight[2][k] * node[k * Coordinates::kTerms + m];
    }
  float albedo = 0;
  for (int m = 0; m < Coordinates::kTerms; ++m) albedo += sum[m] * c.term[m];
  return clamp(albedo, 0.05f, 1.0f);
}

}  // namespace oriel::bsdf
