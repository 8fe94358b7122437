// SPDX-License-Identifier: Apache-2.0
// Reading of any file ends in bounded memory, with messages and without a crash.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "base/temporary_folder.h"
#include "mi/lexer.h"
#include "mi/reader.h"

namespace oriel::mi {
namespace robustness_test {

std::string sample_scene() {
  std::ifstream file(ORIEL_SOURCE_DIR "/scenes/nine-tiles/nine-tiles.mi", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// What every scene must satisfy for the stages behind the reader, however broken its text was.
void expect_sound(const scene::Scene& scene) {
  for (const scene::Element& element : scene.elements()) {
    const auto* object = std::get_if<scene::Object>(&element);
    if (!object) continue;
    for (const scene::PolygonGroup& g : object->groups) {
      for (const std::uint32_t i : g.vertices.point) ASSERT_LT(i, g.vectors.size());
      for (const std::uint32_t i : g.vertices.normal)
        ASSERT_TRUE(i < g.vectors.size() || i == scene::kNone);
      ASSERT_TRUE(g.vertices.normal.empty() || g.vertices.normal.size() == g.vertices.size());
      for (const auto& t : g.vertices.textures)
        ASSERT_TRUE(t.coordinate.empty() || t.coordinate.size() == g.vertices.size());
      for (const std::uint32_t i : g.polygons.indices) ASSERT_LT(i, g.vertices.size());
      ASSERT_TRUE(g.polygons.material.empty() || g.polygons.material.size() == g.polygons.size());
      if (!g.polygons.first.empty()) {
        ASSERT_EQ(g.polygons.first.back(), g.polygons.indices.size());
      }
      for (std::size_t p = 0; p < g.polygons.size(); ++p)
        ASSERT_GE(g.polygons.first[p + 1], g.polygons.first[p] + 3);
    }
  }
}

scene::Scene read(std::string_view text) {
  Diagnostics diagnostics;
  scene::Scene scene = read_text(text, {}, diagnostics);
  expect_sound(scene);
  for (const Diagnostic& d : diagnostics.all()) diagnostics.format(d);
  return scene;
}

// Seconds to read; generous limits that only a hang or a quadratic path can miss.
double seconds_to_read(std::string_view text) {
  const auto start = std::chrono::steady_clock::now();
  read(text);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}
constexpr double kPatienceSeconds = 20;

std::vector<std::string_view> tokens_of(Source& source) {
  std::vector<std::string_view> tokens;
  Lexer lexer(source);
  for (Token token;;) {
    lexer.next(token);
    if (token.kind == Token::Kind::End) return tokens;
    tokens.push_back(token.raw);
  }
}

// A scene with every construct that has a reader of its own, so that cuts go through all of them.
constexpr std::string_view kEverything = R"(
verbose on min version "3" link "l" set "v" "w"
declare shader struct { color "a" } "d" ( array struct "s" { scalar "x" }, color "c" default 1 1 1 )
version 1 apply material gui "g" { control "c" ( "h" ) } end declare
declare phenomenon color "p" ( scalar "x" ) shader "i" "d" ( "c" = interface "x" ) material "m"
= "i" end material root material "m" lens priority 1 end declare
declare data "dd" ( integer "i" ) end declare
options "o" samples 0 2 filter clip mitchell state [ "d" ( ) ] "s" 1 data null end options
camera "c" output "rgba" "tif" "x.tif" framebuffer "f" datatype "rgba" lens "d" ( ) focal infinity end camera
color texture "t" [2 1] 'ff00' '7f' local filter scalar texture "u" "f.tif"
light "l" "d" ( ) emitter = "i" rectangle 1 0 0 0 1 0 4 4 visible origin 0 0 0 end light
lightprofile "lp" format ies file "f" end lightprofile
material "m" opaque "d" ( "s" [ { "x" 1 }, { "x" = "k.y" } ] ) shadow = "i" photon end material
object "ob" tagged visible group "g" 0 0 0 1 0 0 `abcdefghijkl` v 0 n 1 d 0 1 t 1 0 1 m 0 u 1 v 1 v 2
p 0 0 1 2 hole 0 1 2 c 1 0 1 2 strip 0 0 1 2 0 approximate fine view length 1 end group end object
object "ff" basis "b" rational bspline 1 basis "m" matrix 1 1 1. -1. 0. 1. group 0 0 0 1 0 0 0 1 0
v 0 v 1 v 2 curve "k" "b" 0. 0. 1. 1. 0 w 2 1 special .5 space curve "s" rational "m" 0. 1. 0 1
surface "f" "m" "b" 0 1 0. 0. 1. 1. rational "m" 0 1 0. 1. 0 1 2 w .5 0 derivative 1 volume texture
"b" 0. 0. 1. 1. "b" 0. 0. 1. 1. 0 1 2 0 trim "k" 0 1 hole "k" 1 0 special "k" 0 1 special 1 2
approximate surface regular parametric 5 % 6 % "f" connect "f" "k" 0 1 "f" "k" 1 0 end group end object
object "tr" trilist vertex 3 p n t 2 triangle 1 [ 0 0 0 0 0 1 0 0 1 0 0 0 0 1 1 0 0 1 0 0 0 1 0 1 ]
[ 0 0 1 2 ] end trilist end object
object "tv" trilist vector [2] vertex [3] p t 1 triangle [1] [ 0 0 0 1 0 0 ] [ 0 1 1 0 0 0 ] [ 0 1 2 ]
end trilist end object
instance "in" "ob" transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 material [ "m" ] light "exclusive" [ "in" ]
approximate [ surface parametric 2 ] motion off data "q" ( "a" 1 ) end instance
instgroup "gr" merge 1 "in" end instgroup
gui "x" ( "a" 1 ) { control "y" } data "q" 1 '00' registry "r" value "1" end registry
namespace "ns" shader "a" = shader "b" "d" ( ) end namespace
incremental shader "a" "d" ( ) delete "a" touch "m" render "gr" "in" "o"
)";

TEST(Robustness, EmptyAndBlankFilesAreEmptyScenes) {
  for (const char* text : {"", "\n", "# only a comment", "\xef\xbb\xbf", "$endif", "\"", "'", "`"})
    EXPECT_TRUE(read(text).elements().empty()) << text;
}

// acceptance: H1
TEST(Robustness, ASceneCutAnywhereIsReadUpToTheCut) {
  for (const std::string& text : {sample_scene(), std::string(kEverything)}) {
    auto source = Source::from_text(text, "cut.mi");
    for (const std::string_view token : tokens_of(*source)) {
      const auto end = static_cast<std::size_t>(token.data() + token.size() - source->begin());
      read(std::string_view(text).substr(0, end));
      read(std::string_view(text).substr(0, end - token.size() / 2));
    }
  }
}

TEST(Robustness, MissingAndRepeatedTokensDoNotCrash) {
  auto source = Source::from_text(kEverything, "tokens.mi");
  const std::vector<std::string_view> tokens = tokens_of(*source);
  for (std::size_t skip = 0; skip < tokens.size(); ++skip) {
    std::string without, twice;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      if (i != skip) without.append(tokens[i]).append("\n");
      twice.append(tokens[i]).append(" ");
      if (i == skip) twice.append(tokens[i]).append("\n");
    }
    read(without);
    read(twice);
  }
}

TEST(Robustness, ShuffledTokensDoNotCrash) {
  const std::string all = sample_scene() + std::string(kEverything);
  auto source = Source::from_text(all, "shuffle.mi");
  const std::vector<std::string_view> tokens = tokens_of(*source);
  std::mt19937 random(20240229);
  for (int round = 0; round < 400; ++round) {
    std::string text;
    for (int i = 0; i < 500; ++i) {
      // Short runs of what belongs together get deeper into the readers than single tokens.
      const std::size_t at = random() % tokens.size();
      for (std::size_t k = at; k < std::min(tokens.size(), at + random() % 12); ++k)
        text.append(tokens[k]).append(random() % 8 ? " " : "\n");
    }
    read(text);
  }
}

TEST(Robustness, RandomBytesDoNotCrash) {
  std::mt19937 random(7);
  const std::string clean = sample_scene() + std::string(kEverything);
  for (int round = 0; round < 300; ++round) {
    std::string noise(4096, 0), scratched = clean;
    for (char& c : noise) c = static_cast<char>(random());
    for (int i = 0; i < 20; ++i)
      scratched[random() % scratched.size()] = static_cast<char>(random());
    read(noise);
    read(scratched);
  }
}

TEST(Robustness, TenMegabytesOnOneLineTakeLinearTime) {
  constexpr std::size_t kSize = 10'000'000;
  const auto repeated = [](std::string_view piece) {
    std::string text;
    while (text.size() < kSize) text += piece;
    return text;
  };
  EXPECT_LT(seconds_to_read(repeated("x ")), kPatienceSeconds);
  EXPECT_LT(seconds_to_read(repeated("shader \"a\" \"s\" ( \"p\" 1 ) ")), kPatienceSeconds);
  EXPECT_LT(seconds_to_read("object \"o\" group " + repeated("0 1 2 ") + "end group end object"),
            kPatienceSeconds);
  EXPECT_LT(seconds_to_read("object \"o\" group 0 0 0 v 0 " + repeated("p 0 0 1 ") +
                            "end group end object"),
            kPatienceSeconds);
  EXPECT_LT(seconds_to_read(repeated("\\\"\n") + "\"x"), kPatienceSeconds);
  EXPECT_LT(seconds_to_read(repeated("\"\n\\\"")), kPatienceSeconds);
  EXPECT_LT(seconds_to_read(repeated("`' ")), kPatienceSeconds);
  EXPECT_LT(seconds_to_read(repeated("1e9999999999999999999 ")), kPatienceSeconds);
  EXPECT_LT(seconds_to_read(repeated("$ifdef \"x\" ")), kPatienceSeconds);
  EXPECT_LT(seconds_to_read(repeated("9")), kPatienceSeconds);
}

TEST(Robustness, NestingBombsStopAtTheLimit) {
  constexpr int kDepth = 100'000;
  const auto bomb = [](std::string_view piece) {
    std::string text;
    for (int i = 0; i < kDepth; ++i) text += piece;
    return text;
  };
  for (const char* piece : {"[", "{ \"a\" ", "[ { \"a\" ", "= shader \"x\" \"s\" ( \"p\" "})
    EXPECT_LT(seconds_to_read("shader \"x\" \"s\" ( \"p\" " + bomb(piece)), kPatienceSeconds);
  EXPECT_LT(seconds_to_read("declare shader \"d\" ( " + bomb("array ") + bomb("struct \"s\" { ")),
            kPatienceSeconds);
  EXPECT_LT(seconds_to_read("gui \"g\" " + bomb("( {")), kPatienceSeconds);
  EXPECT_LT(seconds_to_read("options \"o\" state " + bomb("[")), kPatienceSeconds);
  EXPECT_LT(seconds_to_read(bomb("namespace \"n\" ") + "shader \"a\" \"s\" ( )"), kPatienceSeconds);
  EXPECT_LT(seconds_to_read(bomb("incremental ")), kPatienceSeconds);
}

TEST(Robustness, HugeCountsCostNoMemory) {
  for (const char* text :
       {"object \"o\" trilist vertex 4294967294 p n t 2 triangle 4294967294 [ ] [ ] end trilist",
        "object \"o\" trilist vertex 4294967295 p m 100000000 triangle 1 [ ] [ ]",
        "object \"o\" trilist vertex 1e18 p t 200 200 200 triangle 1e30 scalar `a` integer `a`",
        "object \"o\" trilist vector [4e9] vertex [4e9] p triangle [4e9] [ 1 2 3 ] [ 0 ] [ 0 0 0 ]",
        "object \"o\" group 0 0 0 v 4294967295 v 99999999999999 p 0 0 4294967294 1e300 -5",
        "object \"o\" group 0 0 0 v 0 t 0 4294967295 4294967294 p 0 0 0",
        "color texture \"t\" [2147483647 2147483647] 'ff'", "data \"d\" 99999999999 'ff'"})
    read(text);
}

TEST(Robustness, FilesThatIncludeThemselvesEnd) {
  const TemporaryFolder temporary;
  const std::filesystem::path& folder = temporary.path();
  std::ofstream(folder / "a.mi") << "$include \"b.mi\"\nshader \"a\" $include \"b.mi\"\n";
  std::ofstream(folder / "b.mi") << "$include \"a.mi\"\n$include \"/dev/zero\"\n$include \".\"\n";
  Diagnostics diagnostics;
  read_scene((folder / "a.mi").string(), {}, diagnostics);
  EXPECT_TRUE(diagnostics.has("OR-MI-012"));
}

}  // namespace robustness_test
}  // namespace oriel::mi
