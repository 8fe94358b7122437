// SPDX-License-Identifier: Apache-2.0
// Shaders of lights, shadows and photons.
#include <cmath>

#include "corpus.h"

namespace oriel {
namespace corpus_lights_test {

using testing::CorpusRow;
using testing::CorpusScene;
using testing::kCorpusLamp;
using testing::lamp_cosine;
using testing::UserScene;

const std::string kWhite =
    "material \"m\" \"mib_illum_lambert\" ( \"ambience\" 0 0 0, \"diffuse\" 1 1 1, \"mode\" 1, "
    "\"lights\" [\"lamp_i\"] ) end material " +
    UserScene::square("m");

/// A square polygon named "board" that is invisible to the camera and casts shadows. `corners`:
/// four points.
std::string board(const std::string& material, const std::string& corners) {
  return "object \"board\" visible shadow trace group " + corners +
         " 0 0 0 1 0 0 1 1 0 0 1 0 v 0 t 4 v 1 t 5 v 2 t 6 v 3 t 7 c 0 1 2 3 end group end object "
         "instance \"board_i\" \"board\" material \"" +
         material + "\" visible off shadow on end instance ";
}
const std::string kWhole = "-8 -8 2 8 -8 2 8 8 2 -8 8 2", kHalf = "0 -8 2 8 -8 2 8 8 2 0 8 2";

/// A white surface under a light; half of it is in the shadow of a black board.
CorpusScene under(const std::string& light, const std::string& before = "") {
  return {before + "light \"lamp\" " + light +
              " end light instance \"lamp_i\" \"lamp\" end instance material \"black\" "
              "\"mib_illum_lambert\" ( ) end material " +
              board("black", kHalf) + kWhite,
          "\"lamp_i\" \"square_i\" \"board_i\""};
}

CorpusRow as_built_in(const std::string& name, const std::string& own, const std::string& built_in,
                      const std::string& parameters, const std::string& place) {
  CorpusRow row{name, under("\"" + own + "\" ( " + parameters + " ) " + place)};
  row.equivalent = under("\"" + built_in + "\" ( " + parameters + " ) " + place);
  return row;
}

std::vector<CorpusRow> lamps() {
  const std::string colored = "\"color\" 4 3 2, ", up = " origin 0 0 3 ";
  CorpusRow slide{
      "slide",
      under("\"cp_slide\" ( \"color\" .5 .5 .5, \"picture\" \"columns\", \"half\" 1 )" + up,
            "color texture \"columns\" [4 1 3] 'ff0000 00ff00 0000ff 808080' "),
      [](double x, double y) {
        if (x > 0 || std::abs(x) > 3 || std::abs(y) > 3) return Rgb(0);
        // Columns as textures are looked up: linear between the middles of red and green.
        const double green = std::min(std::max((x + 3) / 1.5 - .5, 0.0), 1.0);
        const double grey = std::max(.5 - (x + 3) / 1.5, 0.0);
        const double blue = std::max((x + 3) / 1.5 - 1.5, 0.0);
        const double g = 128 / 255.0 * grey;
        return Rgb(float((1 - green) * (1 - grey) + g), float(green * (1 - blue) + g),
                   float(blue + g)) *
               static_cast<float>(.5 * lamp_cosine(x, y));
      }};
  CorpusRow sun{"sun",
                {"shader \"sun\" \"cp_sun\" ( \"color\" 1 2 4 ) light \"lamp\" \"cp_filter\" ( "
                 "\"light\" \"sun\", \"filter\" 1 .5 .1 ) direction 3 0 -4 end light instance "
                 "\"lamp_i\" \"lamp\" end instance " +
                 kWhite},
                [](double, double) { return Rgb(.8f, .8f, .32f); }};
  return {as_built_in("falloff", "cp_falloff", "mib_light_point",
                      colored + "\"shadow\" on, \"atten\" on, \"start\" 3.5, \"stop\" 5", up),
          as_built_in("falloff/soft shadow", "cp_falloff", "mib_light_point",
                      colored + "\"shadow\" on, \"factor\" .3", up),
          as_built_in("falloff/no shadow", "cp_falloff", "mib_light_point",
                      colored + "\"shadow\" off", up),
          as_built_in("cone", "cp_cone", "mib_light_spot", colored + "\"shadow\" on, \"cone\" .95",
                      up + "direction .2 .1 -1 spread .8"),
          slide,
          sun};
}

std::vector<CorpusRow> shadows() {
  std::vector<CorpusRow> rows;
  for (const char* mode : {"on", "sort", "segments"})
    for (const bool by_angle : {false, true}) {
      const std::string name = std::string("pane/") + mode + (by_angle ? ", by angle" : "");
      rows.push_back(
          {name,
           {kCorpusLamp +
                "material \"glass\" \"mib_illum_lambert\" ( ) shadow \"cp_pane\" ( "
                "\"color\" .9 .5 .1, \"by_angle\" " +
                (by_angle ? "on" : "off") + " ) end material " + board("glass", kWhole) + kWhite,
            "\"lamp_i\" \"square_i\" \"board_i\"", std::string("shadow ") + mode},
           [=](double x, double y) {
             const double c = lamp_cosine(x, y);
             return Rgb(.9f, .5f, .1f) * static_cast<float>(by_angle ? c * c : c);
           }});
    }
  // The shadow shader has the parameters of the surface's.
  std::string seen = board("cut", kWhole);
  seen.replace(seen.find("visible off"), 11, "visible on");
  rows.push_back({"cutout",
                  {kCorpusLamp +
                       "material \"cut\" \"cp_cutout\" ( \"color\" .1 .2 .3, \"edge\" .5 ) shadow "
                       "\"cp_cutout\" ( ) end material " +
                       seen + kWhite,
                   "\"lamp_i\" \"square_i\" \"board_i\""},
                  [](double x, double y) {
                    return x < 0 ? Rgb(.1f, .2f, .3f) : Rgb(float(lamp_cosine(x, y)));
                  }});
  return rows;
}

/// A floor between walls, by photons.
CorpusScene room(const std::string& floor, const std::string& walls) {
  return {
      "light \"lamp\" \"mib_light_point\" ( \"color\" 4 4 4, \"shadow\" on ) origin 0 0 3 "
      "globillum photons 8000 end light instance \"lamp_i\" \"lamp\" end instance material "
      "\"wall\" " +
          walls + " end material material \"m\" " + floor +
          " end material object \"walls\" visible shadow trace group -5 -5 0 -5 5 0 -5 5 6 -5 "
          "-5 6 5 -5 0 5 5 0 5 5 6 5 -5 6 v 0 v 1 v 2 v 3 v 4 v 5 v 6 v 7 c 0 1 2 3 c 4 7 6 5 "
          "end group end object instance \"walls_i\" \"walls\" material \"wall\" end instance " +
          UserScene::square("m"),
      "\"lamp_i\" \"walls_i\" \"square_i\"", "globillum on "};
}

CorpusRow photons() {
  const auto built_in = [](const std::string& color) {
    return "\"mia_material\" ( \"diffuse_weight\" 1, \"diffuse\" " + color +
           " 1, \"reflectivity\" 0 )";
  };
  const auto own = [](const std::string& color) {
    return "\"cp_matte\" ( \"diffuse\" " + color + " ) photon \"cp_deposit\" ( \"diffuse\" " +
           color + " )";
  };
  CorpusRow row{"deposit", room(own(".8 .5 .2"), own(".8 .8 .8"))};
  row.equivalent = room(built_in(".8 .5 .2"), built_in(".8 .8 .8"));
  row.mean = true;
  row.tolerance = .02f;
  return row;
}

// acceptance: I4
TEST(CorpusLights, LightsShadowsAndPhotonsMatchTheBuiltInOnes) {
  std::vector<CorpusRow> rows = lamps();
  for (CorpusRow& row : shadows()) rows.push_back(std::move(row));
  rows.push_back(photons());
  testing::run_corpus("lights", rows);
}

}  // namespace corpus_lights_test
}  // namespace oriel
