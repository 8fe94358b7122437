// SPDX-License-Identifier: Apache-2.0
// Writes src/bsdf/ggx_albedo_table.h: B-spline coefficients of the single-scatter albedo of GGX.
//   generate_ggx_albedo src/bsdf/ggx_albedo_table.h
// Takes about half a minute and is deterministic on one machine; another compiler may change last
// digits, which is why the test compares the table with quadrature and not with a second table.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "bsdf/ggx.h"
#include "bsdf/ggx_albedo.h"
#include "sampling/sampler.h"

namespace {

using namespace oriel;
using Coordinates = bsdf::GgxAlbedoCoordinates;

constexpr int kQuadraturePoints = 4096;
constexpr int kOversampling = 3;  // samples for each cell of the table, each way
constexpr int kSkewSamples = 6;
constexpr float kLargestRatio = 10.7f;  // of the axes; a little beyond what is asked of the table
constexpr float kLargestAxis = 1.3f;    // likewise
constexpr int kIterations = 250;

std::vector<Vec2> quadrature_points() {
  std::vector<Vec2> points;
  for (std::uint32_t i = 0; i < kQuadraturePoints; ++i)
    points.push_back(sampling::Sampler(1, 1, i).next_2d());
  return points;
}

double albedo(const bsdf::Ggx& ggx, const Vec3& wo, const std::vector<Vec2>& points) {
  double sum = 0;
  const float so = ggx.stretched(wo);
  for (const Vec2& u : points) {
    const Vec3 wi = bsdf::reflect(wo, ggx.sample_visible(wo, u));
    if (wi.z > 0) sum += wi.z * (wo.z + so) / (so * wi.z + ggx.stretched(wi) * wo.z);
  }
  return sum / static_cast<double>(points.size());
}

struct Row {
  Coordinates at;
  double value;
};

/// The surface with the given roughness in and across the viewer's plane and the given skew, as
/// axes and a viewer; false where the axes are beyond the range of the table.
bool invert(float x, float along, float across, float skew, bsdf::Ggx& ggx, Vec3& wo) {
  const float a = along * along, b = across * across;
  const float c = std::sqrt(std::max(0.0f, 1 - skew * skew)) * along * across;
  const float half = 0.5f * (a + b), spread = std::sqrt(sqr(0.5f * (a - b)) + c * c);
  const float major = half + spread, minor = (a * b - c * c) / major;
  if (std::sqrt(major) > kLargestAxis || major > minor * sqr(kLargestRatio)) return false;
  const float turn = 0.5f * std::atan2(2 * c, a - b);
  const float tangent = (1 - x) / (x * along);
  const float cosine = 1 / std::sqrt(1 + tangent * tangent), sine = tangent * cosine;
  ggx = {std::sqrt(major), std::sqrt(minor)};
  wo = Vec3(sine * std::cos(turn), -sine * std::sin(turn), cosine);
  return true;
}

std::vector<Row> sample_domain() {
  const auto points = quadrature_points();
  const auto root_grid = [](int i, int cells, float smallest) {
    return std::max(smallest, sqr(static_cast<float>(i) / static_cast<float>(cells)));
  };
  std::vector<Row> rows;
  const int n[3] = {Coordinates::kCells[0] * kOversampling, Coordinates::kCells[1] * kOversampling,
                    Coordinates::kCells[2] * kOversampling};
  for (int i = 0; i <= n[0]; ++i)
    for (int j = 0; j <= n[1]; ++j)
      for (int k = 0; k <= n[2]; ++k)
        for (int s = 0; s < kSkewSamples; ++s) {
          const float x = root_grid(i, n[0], 1e-4f);
          const float along = Coordinates::kLargest * root_grid(j, n[1], 8e-4f);
          const float across = Coordinates::kLargest * root_grid(k, n[2], 8e-4f);
          const float t = 0.5f - 0.5f * std::cos(kPi * static_cast<float>(s) / (kSkewSamples - 1));
          const float skew = lerp(Coordinates::kSmallestSkew, 1, t);
          bsdf::Ggx ggx{};
          Vec3 wo;
          if (invert(x, along, across, skew, ggx, wo))
            rows.push_back({Coordinates(x, along, across, skew), albedo(ggx, wo, points)});
        }
  return rows;
}

/// Calls f(index of coefficient, its factor) for all 27 x 4 coefficients a row depends on.
template <typename F>
void for_each_factor(const Coordinates& at, const F& f) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) {
        const float w = at.weight[0][i] * at.weight[1][j] * at.weight[2][k];
        const int node =
            ((at.cell[0] + i) * Coordinates::kNodes[1] + at.cell[1] + j) * Coordinates::kNodes[2] +
            at.cell[2] + k;
        for (int m = 0; m < Coordinates::kTerms; ++m)
          f(static_cast<std::size_t>(node * Coordinates::kTerms + m), double{w * at.term[m]});
      }
}

using Vector = std::vector<double>;

double inner(const Vector& a, const Vector& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Least squares of the relative error by conjugate gradients with the diagonal as preconditioner.
Vector fit(const std::vector<Row>& rows) {
  constexpr double kRidge = 1e-4;  // settles coefficients that no row touches
  const auto evaluate = [](const Vector& c, const Row& row) {
    double sum = 0;
    for_each_factor(row.at, [&](std::size_t i, double f) { sum += c[i] * f; });
    return sum;
  };
  Vector diagonal(Coordinates::kValues, kRidge), solution(Coordinates::kValues), residual(solution);
  for (const Row& row : rows) {
    const double weight = 1 / (row.value * row.value);
    for_each_factor(row.at, [&](std::size_t i, double f) {
      diagonal[i] += weight * f * f;
      residual[i] += weight * f * row.value;
    });
  }
  const auto precondition = [&](const Vector& v) {
    Vector z(v);
    for (std::size_t i = 0; i < z.size(); ++i) z[i] /= diagonal[i];
    return z;
  };
  Vector z = precondition(residual), direction = z;
  double rz = inner(residual, z);
  for (int iteration = 0; iteration < kIterations && rz > 1e-12; ++iteration) {
    Vector image(Coordinates::kValues);
    for (const Row& row : rows) {
      const double v = evaluate(direction, row) / (row.value * row.value);
      for_each_factor(row.at, [&](std::size_t i, double f) { image[i] += v * f; });
    }
    for (std::size_t i = 0; i < image.size(); ++i) image[i] += kRidge * direction[i];
    const double step = rz / inner(direction, image);
    for (std::size_t i = 0; i < image.size(); ++i) {
      solution[i] += step * direction[i];
      residual[i] -= step * image[i];
    }
    z = precondition(residual);
    const double next = inner(residual, z);
    for (std::size_t i = 0; i < z.size(); ++i) direction[i] = z[i] + next / rz * direction[i];
    rz = next;
  }
  double square = 0, largest = 0;
  for (const Row& row : rows) {
    const double e = std::abs(evaluate(solution, row) / row.value - 1);
    square += e * e;
    largest = std::max(largest, e);
  }
  std::printf("%zu rows, relative error rms %.5f, largest %.5f\n", rows.size(),
              std::sqrt(square / static_cast<double>(rows.size())), largest);
  return solution;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: generate_ggx_albedo FILE\n");
    return 2;
  }
  const Vector solution = fit(sample_domain());
  std::FILE* out = std::fopen(argv[1], "w");
  if (!out) {
    std::perror(argv[1]);
    return 1;
  }
  std::fprintf(out,
               "// SPDX-License-Identifier: Apache-2.0\n"
               "// Generated by tools/generate_ggx_albedo.cpp: coefficients of ggx_albedo.\n"
               "#pragma once\n\n#include <cstdint>\n\nnamespace oriel::bsdf {\n\n"
               "// clang-format off\n"
               "inline constexpr std::int16_t kGgxAlbedoTable[] = {");
  std::uint64_t hash = 0xcbf29ce484222325ull;  // FNV-1a
  int column = 100;
  for (const double v : solution) {
    const auto q =
        static_cast<std::int16_t>(std::lround(std::min(1.999, std::max(-1.999, v)) * 16384));
    hash = (hash ^ static_cast<std::uint16_t>(q)) * 0x100000001b3ull;
    if (column > 92) column = std::fprintf(out, "\n") - 1;
    column += std::fprintf(out, "%d,", q);
  }
  std::fprintf(out,
               "\n};\n// clang-format on\n\n"
               "/// FNV-1a over the table.\n"
               "inline constexpr std::uint64_t kGgxAlbedoChecksum = 0x%016llxull;\n\n"
               "}  // namespace oriel::bsdf\n",
               static_cast<unsigned long long>(hash));
  return std::fclose(out) == 0 ? 0 : 1;
}
