// SPDX-License-Identifier: Apache-2.0
#include "sampling/gradient_noise.h"

#include <array>
#include <cstdint>

namespace oriel::sampling {
namespace {

constexpr std::array<std::uint8_t, 256> kPermutation = {
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103,
    30,  69,  142, 8,   99,  37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,
    197, 62,  94,  252, 219, 203, 117, 35,  11,  32,  57,  177, 33,  88,  237, 149, 56,  87,  174,
    20,  125, 136, 171, 168, 68,  175, 74,  165, 71,  134, 139, 48,  27,  166, 77,  146, 158, 231,
    83,  111, 229, 122, 60,  211, 133, 230, 220, 105, 92,  41,  55,  46,  245, 40,  244, 102, 143,
    54,  65,  25,  63,  161, 1,   216, 80,  73,  209, 76,  132, 187, 208, 89,  18,  169, 200, 196,
    135, 130, 116, 188, 159, 86,  164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250, 124,
    123, 5,   202, 38,  147, 118, 126, 255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,
    182, 189, 28,  42,  223, 183, 170, 213, 119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101,
    155, 167, 43,  172, 9,   129, 22,  39,  253, 19,  98,  108, 110, 79,  113, 224, 232, 178, 185,
    112, 104, 218, 246, 97,  228, 251, 34,  242, 193, 238, 210, 144, 12,  191, 179, 162, 241, 81,
    51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,  181, 199, 106, 157, 184, 84,  204, 176,
    115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,  222, 114, 67,  29,  24,  72,  243,
    141, 128, 195, 78,  66,  215, 61,  156, 180};

/// Each value has to occur once; otherwise the lattice would be visible.
constexpr bool is_permutation() {
  std::array<bool, 256> seen{};
  for (const std::uint8_t v : kPermutation) seen[v] = true;
  for (const bool s : seen)
    if (!s) return false;
  return true;
}
static_assert(is_permutation());

unsigned permuted(unsigned i) { return kPermutation[i & 255u]; }

float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }

/// Dot product of the offset and one of twelve gradients, which point to the edges of a cube.
float gradient(unsigned hash, float x, float y, float z) {
  const unsigned h = hash & 15u;
  const float u = h < 8 ? x : y;
  const float v = h < 4 ? y : (h == 12 || h == 14 ? x : z);
  return ((h & 1u) ? -u : u) + ((h & 2u) ? -v : v);
}

}  // namespace

float gradient_noise(const Vec3& p) {
  if (!is_finite(p)) return 0;
  // Reduce before the conversion to integers, which would overflow for distant coordinates.
  const Vec3 cell(std::floor(p.x), std::floor(p.y), std::floor(p.z));
  const auto lattice = [](float c) {
    return static_cast<unsigned>(static_cast<int>(c - 256 * std::floor(c / 256))) & 255u;
  };
  const unsigned ix = lattice(cell.x), iy = lattice(cell.y), iz = lattice(cell.z);
  const Vec3 f = p - cell;
  float along_z[2];
  for (unsigned k = 0; k < 2; ++k) {
    float along_y[2];
    for (unsigned j = 0; j < 2; ++j) {
      float corner[2];
      for (unsigned i = 0; i < 2; ++i)
        corner[i] = gradient(permuted(permuted(permuted(ix + i) + iy + j) + iz + k),
                             f.x - static_cast<float>(i), f.y - static_cast<float>(j),
                             f.z - static_cast<float>(k));
      along_y[j] = lerp(corner[0], corner[1], fade(f.x));
    }
    along_z[k] = lerp(along_y[0], along_y[1], fade(f.y));
  }
  return lerp(along_z[0], along_z[1], fade(f.z));
}

}  // namespace oriel::sampling
