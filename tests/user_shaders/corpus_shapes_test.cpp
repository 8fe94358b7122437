// SPDX-License-Identifier: Apache-2.0
// Geometry shaders that make hair, particles and placeholders.
#include <cmath>

#include "corpus.h"

namespace oriel {
namespace corpus_shapes_test {

using testing::corpus_emitter;
using testing::CorpusRow;
using testing::CorpusScene;

/// What a geometry shader makes, under a material.
CorpusScene made(const std::string& shader, const std::string& material) {
  return {"material \"m\" " + material + " end material instance \"made\" geometry " + shader +
              " material \"m\" end instance ",
          "\"made\""};
}

/// Distance of the view of a place on z = 0 from the line through p along the unit vector d.
double distance_to_line(double x, double y, const Vec3& p, const Vec3& d) {
  const Vec3 view = normalize(Vec3(float(x), float(y), -4)), n = cross(view, d);
  return std::abs(dot(p - Vec3(0, 0, 4), normalize(n)));
}

/// Distance of that view from the upright line through (at, 0, 0).
double distance_to_upright(double x, double at) {
  return std::abs(4 * (at - x)) / std::sqrt(x * x + 16);
}

const std::string kStrands =
    "\"cp_strands\" ( \"n\" 3, \"radius\" .8, \"gap\" 2.5, \"colors\" [ 1 .5 .25, 0 .75 1 ] )";
const std::string kRibbons = "\"cp_ribbon\" ( \"x\" [ -2, 1.5 ], \"root\" .9, \"tip\" .9 )";

/// Where the view meets upright cylinders of radius .9 around x = -2 and x = 1.5: share of the way
/// from y = -6 to y = 6, and from 0 to 1 across; false: beside them.
bool on_ribbon(double x, double y, double& up, double& across) {
  for (const double at : {-2.0, 1.5}) {
    // |(x t - at, 4 - 4 t)| = .9, the first.
    const double a = x * x + 16, b = x * at + 16, c = at * at + 16 - .81, d = b * b - a * c;
    if (d < 0) continue;
    up = (y * (b - std::sqrt(d)) / a + 6) / 12;
    across = .5 + .5 * 4 * (x - at) / std::sqrt(a) / .9;
    return true;
  }
  return false;
}

/// The hairs of cp_ribbon from -2 and 1.5, becoming thinner, written as text.
CorpusScene ribbons_as_text(const std::string& material) {
  std::string numbers;
  for (const char* x : {"-2", "1.5"})
    for (int k = 0; k < 4; ++k)
      numbers += std::string(x) + " " + std::to_string(4 * k - 6) + " 0 " + std::to_string(k / 3.) +
                 " 0 0 0 0 1 " + std::to_string(1 - .8 * k / 3) + " ";
  return {"material \"m\" " + material +
              " end material object \"ribbons\" visible hair vertex t 3 n radius "
              "scalar "
              "[ 80 ] " +
              numbers +
              "hair [ 3 ] 0 40 80 end hair end object instance \"made\" \"ribbons\" material \"m\" "
              "end instance ",
          "\"made\""};
}

/// The hairs of cp_curls with radius .4 and sway 1, written as text.
CorpusScene curls_as_text(const std::string& material) {
  static const float kPoints[2][7][3] = {
      {{-2, -5, 0}, {-3, -3, 0}, {-1, -1, 0}, {-2, 0, 0}, {-3, 1, 0}, {-1, 3, 0}, {-2, 5, 0}},
      {{2, -5, 0}, {1, -4, 1}, {3, -2, 1}, {2, 0, 0}, {1, 2, -1}, {3, 4, -1}, {2, 5, 0}}};
  std::string numbers;
  for (const auto& hair : kPoints)
    for (int p = 0; p < 7; ++p) {
      for (const float n : hair[p]) numbers += std::to_string(n) + " ";
      numbers += std::to_string(.4f * float(7 - p) / 7) + " ";
    }
  return {"material \"m\" " + material +
              " end material object \"curls\" visible hair degree 3 vertex radius scalar [ 56 ] " +
              numbers +
              "hair [ 3 ] 0 28 56 end hair end object instance \"made\" \"curls\" material \"m\" "
              "end instance ",
          "\"made\""};
}

// acceptance: I4
TEST(CorpusHair, MatchesItsScalars) {
  const std::string emitter = corpus_emitter(".9 .5 .2");
  CorpusRow curls{"curls", made("\"cp_curls\" ( \"radius\" .4 )", emitter)};
  curls.equivalent = curls_as_text(emitter);
  CorpusRow tapered{"ribbon/thinner",
                    made("\"cp_ribbon\" ( \"x\" [ -2, 1.5 ], \"root\" 1, \"tip\" .2 )", emitter)};
  tapered.equivalent = ribbons_as_text(emitter);
  testing::run_corpus(
      "hair",
      {{"strands", made(kStrands, "\"cp_tress\" ( \"what\" 0 )"),
        [](double x, double) {
          for (int i = 0; i < 3; ++i)
            if (distance_to_upright(x, 2.5 * (i - 1)) < .8 / (i + 1))
              return i == 1 ? Rgb(0, .75f, 1) : Rgb(1, .5f, .25f);
          return Rgb(0);
        }},
       curls,
       {"ribbon", made(kRibbons, "\"cp_tress\" ( \"what\" 1 )"),
        [](double x, double y) {
          double up, across;
          return on_ribbon(x, y, up, across) ? Rgb(float(up)) : Rgb(0);
        }},
       tapered,
       {"tress/across", made(kRibbons, "\"cp_tress\" ( \"what\" 2 )"), [](double x, double y) {
          double up, across;
          return on_ribbon(x, y, up, across) ? Rgb(float(.5 * across), float(.5 - .5 * across), 0)
                                             : Rgb(0);
        }}});
}

struct Ball {
  Vec3 middle;
  float radius;
};

/// Normal of the sphere that the view meets first; none: 0.
Vec3 normal_of_spheres(double x, double y, const std::vector<Ball>& balls) {
  const Vec3 from(0, 0, 4), way = normalize(Vec3(float(x), float(y), -4));
  float nearest = 1e9f;
  Vec3 normal(0);
  for (const Ball& b : balls) {
    const Vec3 to = b.middle - from;
    const float along = dot(to, way), inside = b.radius * b.radius - (dot(to, to) - along * along);
    if (inside < 0 || along - std::sqrt(inside) > nearest) continue;
    nearest = along - std::sqrt(inside);
    normal = (from + way * nearest - b.middle) / b.radius;
  }
  return normal;
}

// acceptance: I4
TEST(CorpusParticles, AreSpheresAndTubes) {
  const std::string bubbles =
      "\"cp_bubbles\" ( \"centers\" [ -1.5 0 0, 1.5 1 -1, .2 0 1 ], \"radius\" 1.6, \"each\" on )";
  CorpusRow shaded{
      "bubbles", made(bubbles, "\"cp_drop\" ( \"what\" 1 )"), [](double x, double y) {
        const Vec3 n = normal_of_spheres(
            x, y, {{Vec3(-1.5f, 0, 0), 1.6f}, {Vec3(1.5f, 1, -1), .8f}, {Vec3(.2f, 0, 1), .4f}});
        if (n == Vec3(0)) return Rgb(0);
        const Vec3 view = normalize(Vec3(float(x), float(y), -4));
        return Rgb(.5f + .5f * n.x, .5f + .5f * n.y, -dot(n, view));
      }};
  shaded.tolerance = .01f;
  // From below the picture to above it, slanting in the depth as well.
  const std::string streaks =
      "\"cp_streaks\" ( \"particle\" [ { \"point\" -4 -8 -2, \"velocity\" 3 8 2 }, { \"point\" 2 "
      "-12 "
      "0, \"velocity\" 0 12 0 } ], \"shutter\" 2, \"radius\" .5 )";
  const auto streak = [](double x, double y) {
    return distance_to_line(x, y, Vec3(-4, -8, -2), normalize(Vec3(3, 8, 2))) < .5 ||
                   distance_to_line(x, y, Vec3(2, 0, 0), Vec3(0, 1, 0)) < .5
               ? Rgb(1, .5f, .25f)
               : Rgb(0);
  };
  testing::run_corpus(
      "particles",
      {shaded,
       {"drop", made("\"cp_bubbles\" ( \"centers\" [ 0 0 0 ], \"radius\" 2 )", "\"cp_drop\" ( )"),
        [](double x, double y) {
          return normal_of_spheres(x, y, {{Vec3(0), 2}}) == Vec3(0) ? Rgb(0) : Rgb(1, .5f, .25f);
        }},
       {"streaks", made(streaks, "\"cp_drop\" ( )"), streak}});
}

/// What cp_height shows of level squares around the z axis, half size and height of each.
Rgb level_squares(double x, double y, const std::vector<std::pair<double, double>>& squares) {
  for (const auto& [half, height] : squares) {
    const double share = (4 - height) / 4;
    if (std::max(std::abs(x), std::abs(y)) * share < half)
      return Rgb(float(.25 * height), float(.125 * x * share + .5), 1);
  }
  return Rgb(0);
}

// acceptance: I4
TEST(CorpusPlaceholders, ContainGeometryOfCallbacksAndFiles) {
  const std::string rooms =
      "\"cp_later\" ( \"room\" [ { \"name\" \"upper\", \"half\" 1, \"height\" 1 }, { \"name\" "
      "\"lower\", \"half\" 3, \"height\" -.5 } ] )";
  const std::string file = ORIEL_SOURCE_DIR "/tests/user_shaders/corpus/placeholders/board.mi";
  const auto both = [](double x, double y) { return level_squares(x, y, {{1, 1}, {3, -.5}}); };
  testing::run_corpus(
      "placeholders",
      {{"later", made(rooms, "\"cp_height\" ( )"), both},
       {"height/of a file",
        made("\"cp_stored\" ( \"file\" \"" + file + "\", \"low\" -3 -3 1, \"high\" 3 3 1 )",
             "\"cp_height\" ( )"),
        [](double x, double y) {
          return level_squares(x, y, {{3, 1}});
        }},
       {"stored",
        made("\"cp_stored\" ( \"file\" \"" + file + "\", \"low\" -3 -3 1, \"high\" 3 3 1 )",
             corpus_emitter(".2 .4 .8")),
        [](double x, double y) {
          return level_squares(x, y, {{3, 1}}) == Rgb(0) ? Rgb(0) : Rgb(.2f, .4f, .8f);
        }}});
}

}  // namespace corpus_shapes_test
}  // namespace oriel
