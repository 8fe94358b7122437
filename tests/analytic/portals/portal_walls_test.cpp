// SPDX-License-Identifier: Apache-2.0
// Irradiance of a window on all walls of a room: portals compared with light tracing from the sky.
#include <array>

#include "base/parallel.h"
#include "image/exr.h"
#include "support/files.h"
#include "support/portal_scenes.h"

namespace oriel::testing {
namespace portal_walls_test {

constexpr float kAlbedo = .5f;
constexpr Vec3 kLow(0, -1.5f, 0), kHigh(4, 1.5f, 3);

/// Faces of the room: 2 * axis, and one more for the upper. Face 0 has the window.
constexpr const char* kWalls[] = {"window wall", "back wall", "right wall",
                                  "left wall",   "floor",     "ceiling"};
constexpr int kFaces = 6;

float area_of(int face) {
  const Vec3 size = kHigh - kLow;
  const int axis = face / 2;
  const Opening o;
  const float whole = size[(axis + 1) % 3] * size[(axis + 2) % 3];
  return face == 0 ? whole - (o.y1 - o.y0) * (o.z1 - o.z0) : whole;
}

/// The face that a ray meets from inside, and how far away.
std::pair<int, float> wall_ahead(const Vec3& p, const Vec3& d) {
  std::pair<int, float> nearest(0, std::numeric_limits<float>::infinity());
  for (int axis = 0; axis < 3; ++axis) {
    if (d[axis] == 0) continue;
    const float t = ((d[axis] > 0 ? kHigh[axis] : kLow[axis]) - p[axis]) / d[axis];
    if (t < nearest.second) nearest = {2 * axis + (d[axis] > 0 ? 1 : 0), t};
  }
  return nearest;
}

bool in_opening(const Vec3& p) {
  const Opening o;
  return p.y > o.y0 && p.y < o.y1 && p.z > o.z0 && p.z < o.z1;
}

Vec3 inward(int face) {
  Vec3 n(0);
  n[face / 2] = face % 2 ? -1.0f : 1.0f;
  return n;
}

Vec3 around(const Vec3& n, Vec2 u) {
  const Frame frame(n);
  const float r = std::sqrt(u.x), phi = kTwoPi * u.y;
  return frame.s * (r * std::cos(phi)) + frame.t * (r * std::sin(phi)) +
         frame.n * std::sqrt(std::max(0.0f, 1 - u.x));
}

/// Directions into the room with most of the light.
struct Cone {
  Vec3 axis{1, 0, 0};
  float cosine = 1;

  Vec3 sample(Vec2 u) const {
    const Frame frame(axis);
    const float z = lerp(cosine, 1, u.x), r = std::sqrt(1 - z * z), phi = kTwoPi * u.y;
    return frame.s * (r * std::cos(phi)) + frame.t * (r * std::sin(phi)) + frame.n * z;
  }
  /// Of a direction drawn by the cosine or, as often, from the cone: both densities count.
  float weight(const Vec3& d) const {
    if (!(cosine < 1)) return 1;
    const float by_cosine = d.x / kPi;
    const float in_cone = dot(d, axis) > cosine ? 1 / (kTwoPi * (1 - cosine)) : 0;
    return by_cosine / (0.5f * (by_cosine + in_cone));
  }
};

using Walls = std::array<Measured, kFaces>;
struct Light {
  Walls direct, whole;  ///< what comes from the sky at once, and all
};

Walls means(const std::vector<std::array<Rgb, kFaces>>& batches) {
  Walls walls;
  const float n = static_cast<float>(batches.size());
  for (std::size_t f = 0; f < kFaces; ++f) {
    for (const auto& b : batches) walls[f].mean += b[f] / n;
    for (const auto& b : batches) walls[f].error += (b[f] - walls[f].mean) * (b[f] - walls[f].mean);
    for (int k = 0; k < 3; ++k) walls[f].error[k] = std::sqrt(walls[f].error[k] / (n - 1) / n);
  }
  return walls;
}

/// Mean light on each wall, in units of a white card's colour, and its standard error.
///
/// Model:   power comes in through points of the opening, in directions by the cosine, and goes on
///          from wall to wall until it is below a thousandth or out of the window. Uses of the
///          renderer only the colour of the sky.
/// Inputs:  bright: half of the directions are drawn from this cone, where its cosine is below 1.
Light followed_from_the_sky(const World& world, const Cone& bright) {
  constexpr int kBatches = 64, kEach = 1 << 15;
  constexpr float kLost = 1e-3f;
  const Opening o;
  const float opening = (o.y1 - o.y0) * (o.z1 - o.z0);
  using Sums = std::array<Imath::Vec3<double>, kFaces>;  // double: many small terms
  std::vector<std::array<Rgb, kFaces>> direct(kBatches), whole(kBatches);
  parallel_for(kBatches, [&](std::size_t b) {
    Sums first, all;
    first.fill(Imath::Vec3<double>(0.0));
    all.fill(Imath::Vec3<double>(0.0));
    for (int i = 0; i < kEach; ++i) {
      sampling::Sampler s(static_cast<int>(b), 11, static_cast<std::uint32_t>(i));
      const Vec2 u = s.next_2d();
      Vec3 p(0, lerp(o.y0, o.y1, u.x), lerp(o.z0, o.z1, u.y));
      const Vec2 v = s.next_2d();
      Vec3 d = bright.cosine < 1 && i % 2 ? bright.sample(v) : around(Vec3(1, 0, 0), v);
      if (!(d.x > 0)) continue;
      // What a unit of area gets in the colour of a white card: E / pi.
      const Rgb power =
          rgb(environment_radiance(world.environment, world, p, -d, RayKind::FinalGather)) *
          (opening * bright.weight(d));
      for (float share = 1; share > kLost; share *= kAlbedo) {
        const auto [face, t] = wall_ahead(p, d);
        p += d * t;
        if (face == 0 && in_opening(p)) break;
        const auto f = static_cast<std::size_t>(face);
        all[f] += Imath::Vec3<double>(power * share);
        if (share == 1) first[f] += Imath::Vec3<double>(power);
        p[face / 2] = face % 2 ? kHigh[face / 2] : kLow[face / 2];
        d = around(inward(face), s.next_2d());
      }
    }
    for (int face = 0; face < kFaces; ++face) {
      const auto f = static_cast<std::size_t>(face);
      const double unit = 1 / (double(kEach) * double(area_of(face)));
      direct[b][f] = Rgb(Imath::V3f(first[f] * unit));
      whole[b][f] = Rgb(Imath::V3f(all[f] * unit));
    }
  });
  return {means(direct), means(whole)};
}

/// The same by paths onto points all over a wall.
Measured by_paths(const Probe& probe, int face, int samples) {
  const Vec3 n = inward(face);
  const int axis = face / 2;
  Measured m = probe.over(samples, [&](sampling::Sampler& s, int) {
    Vec3 p;
    do {
      const Vec2 u = s.next_2d();
      p[axis] = face % 2 ? kHigh[axis] : kLow[axis];
      p[(axis + 1) % 3] = lerp(kLow[(axis + 1) % 3], kHigh[(axis + 1) % 3], u.x);
      p[(axis + 2) % 3] = lerp(kLow[(axis + 2) % 3], kHigh[(axis + 2) % 3], u.y);
    } while (face == 0 && in_opening(p));
    return std::pair(Camera::Ray{p + n * .01f, -n, 1, 0, 0}, Vec2(0));
  });
  m.mean /= kAlbedo;
  m.error /= kAlbedo;
  return m;
}

/// A latitude-longitude picture as of a hall at night: dim, brighter above, with a bright window
/// 21 degrees wide before the room's opening.
std::string write_hall(const TestFolder& folder) {
  constexpr int kWidth = 256, kHeight = 128;
  Image image(kWidth, kHeight, 3);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const float high = 1 - (static_cast<float>(y) + .5f) / kHeight;
      const float around = (static_cast<float>(x) + .5f) / kWidth;
      Rgb c = Rgb(.15f, .2f, .3f) + Rgb(.4f, .6f, .9f) * high;
      if (std::abs(around - .27f) < .03f && std::abs(high - .57f) < .06f) c += Rgb(20, 24, 30);
      for (int k = 0; k < 3; ++k) image.at(x, y)[k] = c[k];
    }
  const std::string path = folder.file("hall.exr");
  write_exr(path, {Layer{"", {"R", "G", "B"}, image}});
  return path;
}

/// sigma < .25 %, so that 1 % is four of them.
void expect_one_percent(const std::string& name, const Measured& m, const Measured& reference) {
  constexpr float kTolerance = .01f, kSigma = .0025f;
  for (int k = 0; k < 3; ++k) {
    const float sigma = std::hypot(m.error[k], reference.error[k]);
    EXPECT_LE(sigma, kSigma * reference.mean[k]) << name << ' ' << k << ": too noisy";
    EXPECT_NEAR(m.mean[k], reference.mean[k], kTolerance * reference.mean[k])
        << name << ' ' << k << ", sigma " << sigma / reference.mean[k];
  }
  figure(name, reference.mean.x, m.mean.x, std::hypot(m.error.x, reference.error.x));
}

/// One portal and sixteen on the walls that see the window; all light on the one that does not,
/// where bounces are wanted.
///
/// Inputs:  of_sixteen: samples of a wall with sixteen portals. They take many where one part of
///          the picture has most of the light: which portal it shines through is not known.
void expect_light_of(const std::string& name, const std::string& environment,
                     const std::string& statement, bool with_bounces, int of_sixteen,
                     const Cone& bright) {
  const auto with_portals = [&](int n) {
    SceneText scene = room(environment, kAlbedo).statement(statement);
    if (n > 0) add_window(scene, n, "\"cutoff_threshold\" 0");
    return probe_of(scene);
  };
  const Probe open = with_portals(0);
  const Light reference = followed_from_the_sky(open.world(), bright);
  for (const int n : {1, 4}) {
    Probe probe = with_portals(n);
    probe.direct_only();
    for (int face = 1; face < kFaces; ++face)
      expect_one_percent(fmt::format("{}, {} portals, {}", name, n * n, kWalls[face]),
                         by_paths(probe, face, n == 1 ? 3 << 14 : of_sixteen),
                         reference.direct[static_cast<std::size_t>(face)]);
  }
  if (with_bounces)
    expect_one_percent(fmt::format("{}, {}, all light", name, kWalls[0]),
                       by_paths(with_portals(1), 0, 1 << 18), reference.whole[0]);
}

// acceptance: L1
TEST(PortalRoom, HasTheLightOfThePhysicalSkyOnEveryWall) {
  expect_light_of("sky", kSky, "", true, 3 << 15, {});
}

// acceptance: L1
TEST(PortalRoom, HasTheLightOfAnHdrPictureOnEveryWall) {
  const TestFolder folder;
  expect_light_of("picture", "\"mib_lookup_spherical\" ( \"tex\" \"hall\" )",
                  fmt::format("color texture \"hall\" \"{}\"", write_hall(folder)), false, 1 << 18,
                  {normalize(Vec3(.968f, -.218f, .122f)), .954f});
}

}  // namespace portal_walls_test
}  // namespace oriel::testing
