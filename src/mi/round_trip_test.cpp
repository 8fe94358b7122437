// SPDX-License-Identifier: Apache-2.0
// Scenes are equal after writing and reading.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>

#include "mi/reader.h"
#include "mi/testing/random_scene.h"
#include "mi/writer.h"

namespace oriel::mi {
namespace round_trip_test {

using namespace scene;

ReadOptions with_packages() {
  ReadOptions options;
  options.packages = {"base", "physics", "architectural"};
  return options;
}

std::string written(const Scene& scene) {
  std::ostringstream out;
  write_scene(scene, out);
  return out.str();
}

/// Describes the first difference, for a failure message.
std::string difference(const Scene& a, const Scene& b) {
  if (a.commands != b.commands) return "commands";
  if (a.packages != b.packages) return "packages";
  if (a.data_declarations != b.data_declarations) return "data declarations";
  if (a.declarations != b.declarations) return "declarations";
  if (a.phenomena != b.phenomena) return "phenomena";
  if (a.renders != b.renders) return "renders";
  for (std::size_t i = 0; i < std::min(a.elements().size(), b.elements().size()); ++i)
    if (!(a.elements()[i] == b.elements()[i])) return "element " + name_of(a.elements()[i]);
  return a.elements().size() == b.elements().size() ? "" : "the number of elements";
}

/// Whether there are no errors except for names that a complete scene would define.
void expect_sound(const Diagnostics& diagnostics) {
  for (const Diagnostic& d : diagnostics.all())
    EXPECT_TRUE(d.severity != Severity::Error || d.code == "OR-MI-031") << diagnostics.format(d);
}

void expect_round_trip(const Scene& scene) {
  const std::string text = written(scene);
  Diagnostics diagnostics;
  const Scene again = read_text(text, with_packages(), diagnostics);
  expect_sound(diagnostics);
  EXPECT_TRUE(again == scene) << "differs: " << difference(scene, again) << "\n"
                              << text.substr(0, 4000);
}

Scene read(std::string_view text) {
  Diagnostics diagnostics;
  Scene scene = read_text(text, with_packages(), diagnostics);
  expect_sound(diagnostics);
  return scene;
}

// acceptance: H1
TEST(RoundTrip, NineTilesIsUnchanged) {
  const std::string path = ORIEL_SOURCE_DIR "/scenes/nine-tiles/nine-tiles.mi";
  Diagnostics diagnostics;
  const Scene scene = read_scene(path, with_packages(), diagnostics);
  EXPECT_GT(scene.elements().size(), 10u);
  expect_round_trip(scene);
}

// acceptance: H1
TEST(RoundTrip, AllElementsAreUnchanged) {
  const char* const texts[] = {
      "verbose off\nlink \"base.so\"\nmin version \"3.4\"\nset \"a\" \"b\"\nset \"c\"\necho \"x\"\n"
      "$include <base.mi>\n",
      "options \"o\" samples -1 2 contrast .1 .2 .3 trace depth 2 2 4 filter clip lanczos 4 4.\n"
      "shadow segments finalgather file [\"a\", \"b\"] photonmap file off finalgather accuracy "
      "view "
      "100 2. 1. state [\"s\" ( \"p\" 1 ), = \"t\"] \"unified sampling\" 1 \"samples quality\" .5 "
      ".5 "
      ".5 .5 frame buffer 0 \"-rgba\" \"maya\" \"x\" end options\n",
      "camera \"c\" output \"+rgba,z\" \"exr\" quality 90 \"a.exr\" output \"pic\" \"b.pic\" "
      "output \"rgb\" \"c.sgi\" output \"rgb\" \"d.rgb\" output \"rgba\" \"e.tif\" output = \"sh\" "
      "focal infinity aperture 36 aspect 1.5 resolution 640 480 window 0 0 10 10 clip .1 1000 "
      "frame 7 7. lens \"l\" ( \"a\" 1 ) = \"m\" environment = \"e\" "
      "framebuffer \"main\" datatype \"rgba\" filtering on primary off user on deep [ 1 ] "
      "framebuffer \"d\" filename \"d.exr\" filetype \"exr\" compression piz tiled on dpi 72 "
      "pass \"p\" read \"a\" end camera\n",
      "light \"l\" \"sh\" ( \"c\" 1 1 1 ) emitter = \"ph\" origin 0 0 0 direction 0 0 -1 spread .5 "
      "rectangle 1 0 0 0 1 0 4 4 2 1 1 energy 100 100 100 exponent 2 visible shadowmap file \"f\" "
      "end light\n"
      "lightprofile \"p\" format ies file \"a.ies\" resolution 10 20 end lightprofile\n",
      "material \"m\" opaque \"s\" ( ) = \"t\" shadow displace = \"d\" photon \"p\" ( ) end "
      "material\n",
      "color texture \"t\" \"C:\\maps\\wood.tif\"\nlocal filter .5 scalar texture \"u\" \"b.tif\"\n"
      "writable color texture \"w\" \"c.tif\" [64 32]\ncolor texture \"x\" [2 1 3] '0011ff223344'\n"
      "vector texture \"y\" \"noise\" ( \"f\" 2 )\n",
      "object \"o\" visible on shadow 3 trace tagged off box 0 0 0 1 1 1\n"
      "group \"g\" merge .1 0 0 0 1 0 0 1 1 0 0 1 0 v 0 n 1 t 2 0 1 t 3 m 1 u 2 v 1 v 2 t 1 v 3\n"
      "p \"m\" 0 1 2 3 p \"\" 0 1 2 c 2 1 0 p \"n\" 0 1 2 3 hole 0 1 2 strip 0 1 2 3\n"
      "approximate fine view length 2 all end group end object\n",
      "object \"o\" visible tagged group 0 0 0 1 0 0 1 1 0 v 0 v 1 v 2 p 3 0 1 2 p 0 2 1 0 end "
      "group end object\n",
      "object \"o\" group 0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 v 0 t 1 cusp v 1 conic level 2 v 2 corner "
      "v 3 dart v 4 p \"m\" 0 1 2 subdivision surface \"s\" polygon 1 2 3 4 texture space "
      "[face, subdivision] p 0 1 2 3 crease 5 .5 1 p \"n\" 0 1 4 trim 3 { child 0 { material 1 "
      "\"k\" } } derivative 1 space 0 derivative 2 end subdivision surface "
      "ccmesh \"c\" polygon 1 vertex 4 p \"m\" 0 1 2 3 crease 0 .25 0 1 end ccmesh "
      "approximate subdivision surface parametric 3 \"s\" end group end object\n",
      "object \"o\" tagged group 0 0 0 1 0 0 1 1 0 v 0 v 1 v 2 ccmesh \"c\" polygon 1 vertex 3 "
      "p 7 0 1 2 p 8 2 1 0 crease 1 end ccmesh end group end object\n",
      "object \"h\" visible hair material \"m\" radius .25 approximate 3 degree 3 max size 4 max "
      "depth 5 hair n m 2 t 3 vertex radius u 2 scalar [4] 0 1.5 -2 3e-5 hair [3] 0 1 4 end hair "
      "end object\n",
      "object \"o\" visible basis \"b\" rational bezier 1 basis \"c\" cardinal\n"
      "basis \"m\" matrix 1 2 1. -1. 0. 1. group 0 0 0 1 0 0 0 1 0 1 1 0 v 0 v 1 v 2 v 3\n"
      "curve \"k\" \"b\" 0. 1. 0 w 2. 1 special .5 .25 space curve \"s\" rational \"m\" 0. 1. 0 1\n"
      "surface \"f\" \"m\" \"b\" 0 1 0. 1. rational \"b\" 0 1 0. 1. 0 1 w .5 2 3\n"
      "derivative 1 2 volume texture \"b\" 0. 1. \"b\" 0. 1. 0 1 2 3\n"
      "vector texture \"b\" 0. 1. \"b\" 0. 1. 0 1 2 3\n"
      "trim \"k\" 0. 1. \"k\" 1 0 hole \"k\" 0 1 special \"k\" 0 1 special 1 2\n"
      "approximate surface parametric 4 \"f\" connect \"f\" \"k\" 0 .5 \"f\" \"k\" .5 1\n"
      "end group end object\n",
      "instance \"i\" \"o\" hide off caustic on caustic 3 transform 1 0 0 0 0 1 0 0 0 0 1 0 -1 -2 "
      "-3 "
      "1 motion transform 1 0 0 0 0 1 0 0 0 0 1 0 -2 -2 -3 1 material [\"a\", \"b\"] "
      "light \"exclusive\" [] light shadow [ \"l\" ] ( \"p\" 1 ) end instance\n"
      "instance \"j\" geometry \"sh\" ( ) motion off material \"m\" override () end instance\n"
      "instance \"k\" end instance\ninstgroup \"root\" merge .1 \"i\" \"j\" end instgroup\n"
      "render \"root\" \"cam\" \"opt\"\n",
      "declare shader struct { color \"a\", scalar \"b\" } \"s\" ( integer \"q\" default -1,\n"
      "color \"c\" default 1 .5 0 1, array light \"lights\", array struct \"sets\" { string \"n\" "
      "default \"x\", boolean \"on\" default off }, shader \"sh\", color texture \"tex\", ) "
      "version 2 "
      "apply material, texture scanline off derivative 1 gui \"g\" { control \"x\" \"y\" ( \"h\" ) "
      "} "
      "end declare\ndeclare color \"old\" ( scalar \"x\" )\n"
      "declare data \"d\" ( scalar \"x\" ) version 1 end declare\n",
      "declare phenomenon material \"ph\" ( color \"c\", string \"t\" )\n"
      "shader \"s\" \"mib\" ( \"a\" = interface \"c\", \"b\" = \"other.x\" )\n"
      "material \"mm\" = \"s\" end material root material \"mm\" volume = interface \"t\" "
      "version 1 apply material output priority 5 end declare\n",
      "shader \"s\" \"t\" ( \"a\" 1, \"b\" 1., \"c\" .1 .2 .3 1e-05, \"d\" null, \"e\" on, \"f\" "
      "\"q\", "
      "\"g\" bare, \"h\" [], \"i\" [{\"a\" 1}, {\"a\" 2, \"b\" [1, 2]}], \"j\" = \"k.l\", \"m\" "
      "-0, "
      "\"n\" 4294967295, \"o\" \"say \\\"hi\\\" # not a comment\" ) = \"next\"\n",
      "data \"d\" tag 4 8 '00ff00ff00ff00ff'\ndata \"e\" \"decl\" ( \"x\" 1 )\n"
      "gui \"g\" { control \"a\" \"b\" ( \"c\" ) }\nassembly \"a\" box 0 0 0 1 1 1 file \"x.mi\" "
      "end "
      "assembly\nregistry \"r\" { link \"x\" } end registry\n"};
  for (const char* text : texts) {
    SCOPED_TRACE(text);
    expect_round_trip(read(text));
  }
}

// acceptance: H1
TEST(RoundTrip, RandomScenesAreUnchanged) {
  for (std::uint32_t seed = 1; seed <= 200 && !::testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    expect_round_trip(RandomScene(seed).make());
  }
}

TEST(RoundTrip, WrittenTextIsAFixedPoint) {
  const Scene scene = RandomScene(7).make();
  Diagnostics diagnostics;
  const std::string once = written(scene);
  EXPECT_EQ(written(read_text(once, with_packages(), diagnostics)), once);
}

}  // namespace round_trip_test
}  // namespace oriel::mi
