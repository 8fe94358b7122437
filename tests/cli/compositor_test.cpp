// SPDX-License-Identifier: Apache-2.0
// EXR files in the compositor of Blender.
#include <cstdlib>
#include <set>
#include <sstream>

#include "image/cryptomatte.h"
#include "image/exr.h"
#include "support/program.h"

namespace oriel {
namespace compositor_test {

class Compositor : public ProgramTest {};

// acceptance: M9
TEST_F(Compositor, BlenderSelectsEveryLayerAndPicksMattes) {
  if (std::system("command -v blender >/dev/null") != 0) GTEST_SKIP() << "Blender is not installed";
  write("scene.mi", small_scene());
  for (const char* format : {"half,zip", "float,piz", "half,dwaa"}) {
    ASSERT_EQ(run({"render", "scene.mi", "-o", "a.exr", "--samples", "4", "--layers", "all",
                   "--cryptomatte", "--light-group", "key=*", "--exr", format})
                  .exit_code,
              0);
    const std::string script = std::string(ORIEL_SOURCE_DIR) + "/tests/data/blender_compositor.py";
    const std::string command = "cd '" + file("") + "' && blender -b --factory-startup --python '" +
                                script + "' -- '" + file("a.exr") + "' floor 48 32 '" +
                                file("matte.exr") + "' > log.txt 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0);
    std::set<std::string> shown;
    std::ifstream log(file("log.txt"));
    for (std::string line; std::getline(log, line);)
      if (line.starts_with("LAYER ")) shown.insert(line.substr(6));
    const ExrFile exr = read_exr(file("a.exr"));
    for (const Layer& layer : exr.layers) {
      const std::string name = layer.name.empty()  ? "Combined"
                               : layer.name == "Z" ? "Depth"
                                                   : layer.name;
      EXPECT_TRUE(shown.contains(name)) << name << " " << format;
    }
    EXPECT_TRUE(shown.contains("light_key") && shown.contains("samples"));
    // The coverage of the floor, summed over the ranks of the file.
    const Image matte = read_exr_image(file("matte.exr"));
    ASSERT_EQ(matte.width, 48);
    const float id = cryptomatte_id("floor");
    double covered = 0;
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 48; ++x) {
        float wanted = 0;
        for (const Layer& layer : exr.layers)
          if (layer.name.starts_with("CryptoObject"))
            for (int c = 0; c < 4; c += 2)
              if (layer.image.at(x, y)[c] == id) wanted += layer.image.at(x, y)[c + 1];
        ASSERT_NEAR(matte.at(x, y)[0], wanted, 1e-3f) << x << " " << y << " " << format;
        covered += static_cast<double>(wanted);
      }
    EXPECT_GT(covered, 100) << "the floor is visible";
  }
}

}  // namespace compositor_test
}  // namespace oriel
