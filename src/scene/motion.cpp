// SPDX-License-Identifier: Apache-2.0
#include "scene/motion.h"

#include <ImathMatrixAlgo.h>
#include <ImathQuat.h>

#include <algorithm>
#include <cmath>

#include "base/math.h"

namespace oriel::scene {
namespace {

// double: for inverses of matrices far from the origin and long products.
using Matrix = Imath::M44d;
using Linear = Imath::M33d;

Matrix matrix_of(const std::optional<Mat4>& matrix) {
  if (!matrix) return Matrix();
  const Matrix m(*matrix);
  return is_singular(m) ? Matrix() : m;
}

Linear linear_part(const Matrix& m) {
  return Linear(m[0][0], m[0][1], m[0][2], m[1][0], m[1][1], m[1][2], m[2][0], m[2][1], m[2][2]);
}

/// The rotation nearest to a matrix without reflection.
Linear rotation_of(Linear m) {
  constexpr int kMaxRounds = 50;  // quadratic convergence near the solution
  for (int i = 0; i < kMaxRounds; ++i) {
    const Linear next = (m + m.inverse().transposed()) * 0.5;
    const bool done = next.equalWithAbsError(m, 1e-14);
    m = next;
    if (done) break;
  }
  return m;
}

/// The motion of one instance within its parent.
class InstanceMotion {
 public:
  InstanceMotion(const Matrix& from, const Matrix& to) : from_(from), to_(to) {
    const Linear turn = linear_part(from).inverse() * linear_part(to);
    turns_ = turn.determinant() > 0;
    if (!turns_) return;
    const Linear rotation = rotation_of(turn);
    stretch_ = turn * rotation.transposed();
    Matrix r;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) r[row][column] = rotation[row][column];
    const Imath::Quatd q = Imath::extractQuat(r);
    // Of the two motions round the shorter.
    const double sign = q.r < 0 ? -1 : 1;
    const double sine = q.v.length();
    half_angle_ = math::atan2(sine, sign * q.r);
    axis_ = sine > 0 ? q.v * (sign / sine) : Imath::V3d(0, 0, 1);
  }

  Matrix at(double time) const {
    if (time == 0) return from_;
    if (time == 1) return to_;
    Matrix m = from_ * (1 - time) + to_ * time;
    if (!turns_) return m;
    // Clamped: an extrapolated stretch could invert the object.
    const double share = std::clamp(time, 0.0, 1.0);
    const Linear stretch = Linear() * (1 - share) + stretch_ * share;
    const double half = half_angle_ * time;
    const Imath::Quatd q(math::cos(half), axis_ * math::sin(half));
    const Linear turned = linear_part(from_) * stretch * q.toMatrix33();
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) m[row][column] = turned[row][column];
    return m;
  }

 private:
  Matrix from_, to_;
  bool turns_ = false;
  Linear stretch_;
  Imath::V3d axis_;
  double half_angle_ = 0;
};

InstanceMotion motion_of(const Instance& instance, bool moves) {
  const Matrix from = matrix_of(instance.transform).inverse();
  return {from, moves && instance.motion_transform ? matrix_of(instance.motion_transform).inverse()
                                                   : from};
}

/// Transforms of a chain of motions, outermost first, at the times of the shutter.
std::vector<Mat4> follow(const std::vector<InstanceMotion>& motions, const Shutter& shutter) {
  std::vector<Mat4> path;
  const int begin = shutter.first * shutter.steps, end = shutter.last * shutter.steps;
  const int pieces = end - begin;
  path.reserve(static_cast<std::size_t>(pieces) + 1);
  for (int i = begin; i <= end; ++i) {
    Matrix m;
    for (const InstanceMotion& motion : motions)
      m = motion.at(static_cast<double>(i) / static_cast<double>(shutter.steps)) * m;
    path.emplace_back(m);
  }
  return path;
}

}  // namespace

bool is_singular(const Imath::M44d& m) {
  constexpr double kRounding = 1e-12;  // linearly dependent rows give about 1e-16
  double scale = 1;
  for (int i = 0; i < 4; ++i) {
    double row = 0;
    for (int j = 0; j < 4; ++j) row += m[i][j] * m[i][j];
    scale *= i < 3 ? std::sqrt(row) : 1;
  }
  // Not `<`: a matrix with a NaN counts as singular.
  return !(std::abs(m.determinant()) > kRounding * scale);
}

Shutter shutter_of(const MotionOptions& options) {
  Shutter shutter;
  if (!options.on) return shutter;
  const auto within = [](float t) {
    return std::isfinite(t) ? std::clamp(t, -kFurthestShutter, kFurthestShutter) : 0;
  };
  const float open = within(options.delay), close = std::max(open, within(options.shutter));
  shutter.on = true;
  shutter.first = std::min(0, static_cast<int>(std::floor(open)));
  shutter.last = std::max(1, static_cast<int>(std::ceil(close)));
  const auto ray_time = [&](float t) {
    return (t - static_cast<float>(shutter.first)) /
           static_cast<float>(shutter.last - shutter.first);
  };
  shutter.open = ray_time(open);
  shutter.close = ray_time(close);
  shutter.steps = std::clamp(options.steps, 1, kMaxMotionSteps);
  return shutter;
}

std::vector<Mat4> motion_path(const Leaf& leaf, const Shutter& shutter) {
  if (!shutter.on || !leaf.motion_world_to_local) return {};
  std::vector<InstanceMotion> motions;
  motions.reserve(leaf.chain.size());
  for (std::size_t i = 0; i < leaf.chain.size(); ++i)
    motions.push_back(motion_of(*leaf.chain[i], i >= leaf.first_moving));
  return follow(motions, shutter);
}

std::vector<Mat4> motion_path(const Instance& instance, const Shutter& shutter) {
  if (!shutter.on || !instance.motion_transform) return {};
  return follow({motion_of(instance, true)}, shutter);
}

}  // namespace oriel::scene
