// SPDX-License-Identifier: Apache-2.0
// Shaders that write passes, look up textures, bump, and call other shaders.
#include <cmath>

#include "corpus.h"

namespace oriel {
namespace corpus_calls_test {

using testing::corpus_emitter;
using testing::corpus_square;
using testing::CorpusRow;
using testing::CorpusScene;
using testing::kCorpusLamp;

CorpusRow surface(const std::string& name, const std::string& before, const std::string& material,
                  std::function<Rgb(double, double)> wanted) {
  return {name, {before + corpus_square(material)}, std::move(wanted)};
}

double coordinate(double at) { return at / 16 + .5; }

CorpusRow pass(const std::string& name, int buffer, std::function<Rgb(double, double)> wanted) {
  CorpusRow row{name,
                {corpus_square("\"cp_by_number\" ( \"color\" .1 .2 .3 1, \"color_pass\" 2, "
                               "\"scalar_pass\" 0, \"vector_pass\" 1 )"),
                 "\"lamp_i\" \"square_i\"",
                 "frame buffer 0 \"+s_fp\" frame buffer 1 \"+n\" frame buffer 2 \"+rgba_fp\" "},
                std::move(wanted)};
  row.buffer = buffer;
  return row;
}

CorpusRow named_pass(const std::string& name, int buffer,
                     std::function<Rgb(double, double)> wanted) {
  CorpusRow row{name,
                {corpus_square("\"cp_by_name\" ( \"diffuse\" .1 .2 .3, \"ambient\" .4 .3 .2 )"),
                 "\"lamp_i\" \"square_i\"", "",
                 "framebuffer \"own_diffuse\" datatype \"rgba_fp\" framebuffer \"own_ambient\" "
                 "datatype \"rgba_fp\" "},
                std::move(wanted)};
  row.buffer = buffer;
  return row;
}

/// Two collectors, one in the other: the buffer holds what both brought.
CorpusRow collected(const std::string& name, int buffer,
                    std::function<Rgb(double, double)> wanted) {
  CorpusRow row{
      name,
      {"shader \"base\" \"mib_illum_lambert\" ( \"ambience\" 1 1 1, \"ambient\" .4 .2 .1, "
       "\"diffuse\" 0 0 0 ) shader \"inner\" \"cp_collect\" ( \"material\" \"base\" ) " +
           corpus_square("\"cp_collect\" ( \"material\" \"inner\", \"tint\" .5 .5 .5 )"),
       "\"lamp_i\" \"square_i\"", "frame buffer 0 \"+rgba_fp\" "},
      std::move(wanted)};
  row.buffer = buffer;
  return row;
}

/// Three buffers that the shader finds by their number.
CorpusRow all_passes(const std::string& name, int buffer,
                     std::function<Rgb(double, double)> wanted) {
  CorpusRow row{name,
                {corpus_square("\"cp_all\" ( \"color\" .6 .3 0 )"), "\"lamp_i\" \"square_i\"",
                 "frame buffer 0 \"+rgba_fp\" frame buffer 1 \"+rgba_fp\" frame buffer 2 "
                 "\"+rgba_fp\" "},
                std::move(wanted)};
  row.buffer = buffer;
  return row;
}

// acceptance: I4, U6
TEST(CorpusPasses, ContainValuesWrittenByShaders) {
  const auto even = [](float r, float g, float b) {
    return [=](double, double) { return Rgb(r, g, b); };
  };
  testing::run_corpus(
      "passes",
      {pass("by_number", -1, even(.1f, .2f, .3f)), pass("by_number/colour", 2, even(.2f, .4f, .6f)),
       pass("by_number/depth", 0,
            [](double x, double y) {
              return Rgb(static_cast<float>(.25 * std::sqrt(x * x + y * y + 16)));
            }),
       pass("by_number/normal", 1, even(0, 0, 1)), named_pass("by_name", -1, even(.5f, .5f, .5f)),
       named_pass("by_name/diffuse", 0, even(.1f, .2f, .3f)),
       named_pass("by_name/ambient", 1, even(.4f, .3f, .2f)),
       collected("collect", -1, even(.2f, .1f, .05f)),
       collected("collect/buffer", 0, even(.6f, .3f, .15f)),
       all_passes("all", -1, even(.375f, .375f, .375f)),
       all_passes("all/first", 0, even(.6f, .3f, 1 / 3.f)),
       all_passes("all/last", 2, even(.2f, .1f, 1))});
}

/// Four columns: red, green, blue, grey.
const std::string kColumns = "color texture \"columns\" [4 1 3] 'ff0000 00ff00 0000ff 808080' ";

Rgb column_at(int n) { return n == 3 ? Rgb(128 / 255.0f) : Rgb(n == 0, n == 1, n == 2); }

Rgb column(double u) { return column_at(int(u * 4)); }

/// As textures are looked up: between the middles of two columns.
Rgb between_columns(double u) {
  const double at = u * 4 - .5, below = std::floor(at);
  const int n = (int(below) + 4) % 4;
  const auto t = static_cast<float>(at - below);
  return column_at(n) * (1 - t) + column_at((n + 1) % 4) * t;
}

std::vector<CorpusRow> lookups() {
  const std::string shaders =
      "color texture \"c\" \"cp_tex_color\" ( ) scalar texture \"s\" \"cp_tex_scalar\" ( ) "
      "vector texture \"v\" \"cp_tex_vector\" ( ) ";
  const std::string lookup =
      "shader \"at\" \"mib_texture_vector\" ( \"select\" 0 ) shader \"c\" \"mib_texture_lookup\" ( "
      "\"tex\" \"columns\", \"coord\" = \"at\" ) ";
  CorpusRow built_in{"lookups/as the built-in lookup",
                     {kColumns + corpus_square("\"cp_lookups\" ( \"color\" \"columns\" )")}};
  built_in.equivalent = {kColumns + lookup + corpus_square(corpus_emitter("= \"c\""))};
  return {
      built_in,
      surface(
          "lookups", shaders,
          "\"cp_lookups\" ( \"color\" \"c\", \"scalar\" \"s\", \"vector\" \"v\", \"repeat\" 2 )",
          [](double x, double y) {
            const double u = 2 * coordinate(x), v = 2 * coordinate(y), s = .5 * u;
            return Rgb(float((u - std::floor(u)) * s), float((v - std::floor(v)) * s * .5),
                       float(s * v));
          }),
      surface("lookups/repeated picture", kColumns,
              "\"cp_lookups\" ( \"color\" \"columns\", \"repeat\" 1.5 )",
              [](double x, double) {
                const double u = 1.5 * coordinate(x);
                return between_columns(u - std::floor(u));
              }),
      surface("texels", kColumns, "\"cp_texels\" ( \"texture\" \"columns\" )",
              [](double x, double) { return column(coordinate(x)); }),
      surface("texels/mirrored", kColumns,
              "\"cp_texels\" ( \"texture\" \"columns\", \"mirrored\" on )",
              [](double x, double) { return column(1 - coordinate(x)); }),
  };
}

std::vector<CorpusRow> bumps() {
  const auto tilt = [](double x) { return -.2 * kTwoPi / 4 * std::cos(kTwoPi * x / 4); };
  const std::string wave = "shader \"wave\" \"cp_wave\" ( \"length\" 4, \"height\" .2 ) ";
  return {
      surface("wave", wave, "\"cp_bumped\" ( \"bump\" \"wave\" )",
              [=](double x, double) {
                const double t = tilt(x), length = std::sqrt(1 + t * t);
                return Rgb(float(.5 * t / length + .5), .5f, float(1 / length));
              }),
      surface("wave/lit", wave + "shader \"lit\" \"cp_lit\" ( ) ",
              "\"cp_bumped\" ( \"bump\" \"wave\", \"surface\" \"lit\" )",
              [=](double x, double y) {
                const double t = tilt(x);
                return Rgb(
                    float((-x * t + 3) / std::sqrt(1 + t * t) / std::sqrt(x * x + y * y + 9)));
              }),
      surface("height",
              "color texture \"c\" \"cp_tex_color\" ( ) shader \"slope\" \"cp_height\" ( "
              "\"texture\" \"c\", \"factor\" 1.5, \"step\" .01 ) ",
              "\"cp_show\" ( \"vector\" = \"slope\" )",
              [](double x, double y) {
                return Rgb(.5f, .5f, float((coordinate(x) + coordinate(y) + 1) / 3));
              }),
  };
}

// acceptance: I4
TEST(CorpusTextures, SupportAllKindsOfLookups) {
  std::vector<CorpusRow> rows = lookups();
  rows.push_back(surface("filtered", kColumns, "\"cp_filtered\" ( \"texture\" \"columns\" )",
                         [](double x, double) { return between_columns(coordinate(x)); }));
  rows.back().tolerance = .05f;  // the ellipse is wider than a pixel
  for (CorpusRow& row : bumps()) rows.push_back(std::move(row));
  testing::run_corpus("textures", rows);
}

std::string flat(const std::string& name, const std::string& color) {
  return "shader \"" + name + "\" " + corpus_emitter(color) + " ";
}
const std::string kSky = "environment \"mib_color_mix\" ( \"num\" 0, \"color_base\" .25 .5 1 1 )";

double fresnel(double cosine, double ior) {
  const double sine = std::sqrt(1 - cosine * cosine) / ior, t = std::sqrt(1 - sine * sine);
  const double s = (cosine - ior * t) / (cosine + ior * t),
               p = (t - ior * cosine) / (t + ior * cosine);
  return .5 * (s * s + p * p);
}

// acceptance: I4
TEST(CorpusLayered, MaterialsCallOtherShaders) {
  const std::string colors = flat("red", ".8 .1 .1") + flat("blue", ".1 .1 .8");
  CorpusScene turned = {
      colors + kCorpusLamp +
      "material \"m\" \"cp_sides\" ( \"front\" \"red\", \"back\" \"blue\" ) end "
      "material object \"left\" visible trace group -8 -8 0 0 -8 0 0 8 0 -8 8 0 "
      "8 -8 0 8 8 0 v 0 v 1 v 2 v 3 v 1 v 2 v 5 v 4 c 0 1 2 3 c 4 5 6 7 end group "
      "end object instance \"square_i\" \"left\" material \"m\" end instance "};
  std::vector<CorpusRow> rows = {
      surface("blend", colors + flat("not_called", "1000 1000 1000"),
              "\"cp_blend\" ( \"layer\" [ { \"material\" \"red\" }, { \"material\" \"not_called\", "
              "\"weight\" 0 }, { \"material\" \"blue\", \"weight\" .25 } ] )",
              [](double, double) { return Rgb(.625f, .1f, .275f); }),
      surface("order", "shader \"served\" \"cp_served\" ( \"color\" .1 .2 .3 1 ) ",
              "\"cp_order\" ( \"shader\" \"served\", \"gain\" 3 )",
              [](double, double) { return Rgb(.3f, .6f, 1); }),
      surface("order/alone", "", "\"cp_served\" ( \"color\" .1 .2 .3 1 )",
              [](double, double) { return Rgb(.1f, .2f, .3f); }),
      {"sides", turned,
       [](double x, double) { return x < 0 ? Rgb(.8f, .1f, .1f) : Rgb(.1f, .1f, .8f); }},
      surface("switch/eye", colors, "\"cp_switch\" ( \"eye\" \"red\", \"reflection\" \"blue\" )",
              [](double, double) { return Rgb(.8f, .1f, .1f); }),
  };
  rows.push_back({"veil",
                  {corpus_square("\"cp_veil\" ( \"color\" .8 .4 .2, \"opacity\" .25 .5 1 )"),
                   "\"lamp_i\" \"square_i\"", "", kSky},
                  [](double, double) { return Rgb(.2f + .1875f, .2f + .25f, .2f); }});
  rows.push_back({"veil/clear",
                  {corpus_square("\"cp_veil\" ( \"color\" .8 .4 .2, \"opacity\" 0 0 0 )"),
                   "\"lamp_i\" \"square_i\"", "", kSky},
                  [](double, double) { return Rgb(.25f, .5f, 1); }});
  rows.push_back({"coat",
                  {flat("below", ".5 .25 0") + corpus_square("\"cp_coat\" ( \"below\" \"below\" )"),
                   "\"lamp_i\" \"square_i\"", "", kSky},
                  [](double x, double y) {
                    const auto f = float(fresnel(4 / std::sqrt(x * x + y * y + 16), 1.5));
                    return Rgb(.5f, .25f, 0) * (1 - f) + Rgb(.25f, .5f, 1) * f;
                  }});
  rows.push_back({"switch/transparent",
                  {colors + corpus_square("\"cp_veil\" ( \"color\" 0 0 0, \"opacity\" 0 0 0 )") +
                       "material \"below\" \"cp_switch\" ( \"eye\" \"red\", \"transparent\" "
                       "\"blue\" ) end material object \"floor\" visible trace group -90 -90 -2 "
                       "90 -90 -2 90 90 -2 -90 90 -2 v 0 v 1 v 2 v 3 c 0 1 2 3 end group end "
                       "object instance \"floor_i\" \"floor\" material \"below\" end instance ",
                   "\"lamp_i\" \"square_i\" \"floor_i\""},
                  [](double, double) { return Rgb(.1f, .1f, .8f); }});
  testing::run_corpus("layered", rows);
}

}  // namespace corpus_calls_test
}  // namespace oriel
