// SPDX-License-Identifier: Apache-2.0
#include "bsdf/ggx_albedo.h"

#include <array>
#include <cstddef>

#include "bsdf/ggx_albedo_table.h"

namespace oriel::bsdf {
namespace {

using Coordinates = GgxAlbedoCoordinates;

// Converted to float at compile time; the stored table has units of 1/16384.
alignas(64) constexpr auto kTable = [] {
  std::array<float, Coordinates::kValues> t{};
  for (std::size_t i = 0; i < t.size(); ++i) t[i] = kGgxAlbedoTable[i] * (1.0f / 16384);
  return t;
}();
static_assert(Coordinates::kTerms == 4);

using Float4 = float __attribute__((vector_size(16)));
Float4 load(const float* aligned) { return *reinterpret_cast<const Float4*>(aligned); }

}  // namespace

float ggx_albedo(float ax, float ay, const Vec3& wo) {
  const Coordinates c(ax, ay, wo);
  // The lanes are the polynomials of the skew.
  Float4 sum = {0, 0, 0, 0};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const float* node =
          kTable.data() +
          (((c.cell[0] + i) * Coordinates::kNodes[1] + c.cell[1] + j) * Coordinates::kNodes[2] +
           c.cell[2]) *
              Coordinates::kTerms;
      const Float4 row = c.weight[2][0] * load(node) + c.weight[2][1] * load(node + 4) +
                         c.weight[2][2] * load(node + 8);
      sum += c.weight[0][i] * c.weight[1][j] * row;
    }
  const float albedo = (sum[0] + sum[1] * c.term[1]) + (sum[2] * c.term[2] + sum[3] * c.term[3]);
  return clamp(albedo, 0.05f, 1.0f);
}

}  // namespace oriel::bsdf
