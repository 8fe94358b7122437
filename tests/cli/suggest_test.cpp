// SPDX-License-Identifier: Apache-2.0
// Wrong names on the command line and in scenes: the message suggests the nearest name.
#include "support/program.h"

namespace oriel {
namespace suggest_test {

struct Case {
  std::vector<std::string> words;
  int exit_code;  ///< -1 = any
  std::string expected;
};

class Suggestions : public ProgramTest {
 protected:
  void expect(const Case& c) {
    const RunResult r = run(c.words);
    std::string line;
    for (const std::string& word : c.words) line += word + ' ';
    EXPECT_TRUE(c.exit_code < 0 || r.exit_code == c.exit_code) << line << r.err;
    EXPECT_NE(r.err.find(c.expected), std::string::npos) << line << "\n" << r.err;
  }
};

TEST_F(Suggestions, OfCommandsAndOptions) {
  for (const Case& c : {
           Case{{"rendr", "s.mi"}, 2, "unknown command rendr; did you mean render? (see"},
           Case{{"shader-biuld", "s"},
                2,
                "unknown command shader-biuld; did you mean shader-build?"},
           Case{{"paint"}, 2, "unknown command paint (see"},
           Case{{"--verison"}, 2, "unknown option --verison; did you mean --version?"},
           Case{{}, 2, "a command is required"},
           Case{{"render", "s.mi", "--smaples", "3"},
                2,
                "unknown option --smaples; did you mean --samples? (see oriel render --help)"},
           Case{{"render", "--smaples=3"}, 2, "unknown option --smaples; did you mean --samples?"},
           Case{{"render", "s.mi", "--colour"}, 2, "unknown option --colour (see"},
           Case{{"render", "s.mi", "t.mi"}, 2, "unexpected argument t.mi (see"},
           Case{{"measure", "s.mi", "--presision", "1%"}, 2, "did you mean --precision?"},
       })
    expect(c);
}

TEST_F(Suggestions, OfValuesOfOptions) {
  write("scene.mi", small_scene());
  write("a.exr", "");
  for (const Case& c : {
           Case{{"render", "scene.mi", "--gi", "foton"},
                2,
                "--gi foton: expected path, path+cache, fg"},
           Case{{"render", "scene.mi", "--gi", "photon"}, 2, "; did you mean photons?"},
           Case{{"render", "scene.mi", "--layers", "depth,albdo"}, 2, "; did you mean albedo?"},
           Case{{"render", "scene.mi", "--layers", "beuaty"}, 2, "; did you mean beauty?"},
           Case{{"tonemap", "a.exr", "-o", "a.png", "--view", "agxx"},
                2,
                "--view agxx: expected agx or neutral; did you mean agx?"},
           Case{{"tonemap", "a.exr", "-o", "a.png", "--view", "filmic"},
                2,
                "--view filmic: expected agx or neutral; views of a configuration require --ocio "
                "(see"},
           Case{{"diff", "a.exr", "a.exr", "--threshold", "rsme=1"}, 2, "; did you mean rmse?"},
           Case{{"shaders", "--mi", "bsae"}, 1, "; did you mean base?"},
           Case{{"render", "scene.mi", "--camera", "cam_ints"}, 1, "did you mean \"cam_inst\"?"},
           Case{{"render", "scene.mi", "--set", "opt.smaples=1"}, 1, "; did you mean samples?"},
           Case{{"tonemap", "a.exrr", "-o", "a.png"}, 1, "did you mean 'a.exr'?"},
           Case{{"render", "scen.mi"}, 1, "did you mean \"scene.mi\"?"},
           Case{{"ray", "-filter", "bax", "1", "1"}, 2, "; did you mean box?"},
       })
    expect(c);
}

TEST_F(Suggestions, OfNamesInScenes) {
  write("wood.png", "");
  const std::string texture =
      "color texture \"bark\" \"wod.png\"\n"
      "shader \"look\" \"mib_texture_lookup\" ( \"tex\" \"bark\" )\n";
  const std::string diffuse = "\"diffuse\" .5 .5 .5", look = "\"diffuse\" = \"look\"";
  struct Replaced {
    std::string from, to, expected;
  };
  for (const Replaced& c : {
           Replaced{"trace depth", "filter bax 1 1 trace depth",
                    "unknown value 'bax' of 'filter' was skipped"},
           Replaced{"trace depth", "filter bax 1 1 trace depth", "did you mean box?"},
           Replaced{"trace depth", "trace dpeth", "did you mean"},
           Replaced{"aperture 1", "apertrue 1", "did you mean aperture?"},
           Replaced{" origin 0", " orgin 0", "did you mean origin?"},
           Replaced{"\"cam_inst\" \"cam\"", "\"cam_inst\" \"cma\"", "did you mean"},
           Replaced{"[ \"grey\" ]", "[ \"gery\" ]", "did you mean \"grey\"?"},
           Replaced{"\"refl_gloss\"", "\"refl_glos\"", "did you mean \"refl_gloss\"?"},
           Replaced{"mia_material_x", "mia_materail_x", "did you mean \"mia_material_x\"?"},
           Replaced{diffuse, look, "did you mean \"wood.png\"?"},
       }) {
    std::string text = texture + small_scene();
    text.replace(text.find(c.from), c.from.size(), c.to);
    write("scene.mi", text);
    expect({{"render", "scene.mi", "--samples", "1", "-o", file("out.png")}, -1, c.expected});
  }
  write("scene.mi", small_scene("filter quux 1 1"));
  const RunResult stranger = run({"render", "scene.mi", "--samples", "1", "-o", file("out.png")});
  EXPECT_NE(stranger.err.find("unknown statement 'quux'"), std::string::npos) << stranger.err;
  EXPECT_EQ(stranger.err.find("did you mean"), std::string::npos) << stranger.err;
}

}  // namespace suggest_test
}  // namespace oriel
