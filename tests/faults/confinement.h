// SPDX-License-Identifier: Apache-2.0
// Test support: a scene beside a folder with files that are not its own.
#pragma once

#include "fault_test.h"
#include "image/png.h"

namespace oriel {

/// The folder `scene` with files, links to the folder `other`, links within and pipes.
class ConfinementTest : public FaultTest {
 protected:
  ConfinementTest() {
    namespace fs = std::filesystem;
    constexpr const char* kProfile =
        "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 1 1 2 0 0 0\n1 1 100\n0 45 90\n0\n900 500 100\n";
    Image image(2, 2, 3);
    for (float& c : image.pixels) c = 0.5f;
    for (const std::string folder : {"scene", "other"}) {
      fs::create_directories(file(folder));
      write_png(file(folder + "/a.png"), image, {});
      write(folder + "/a.ies", kProfile);
      write(folder + "/a.mi", "set \"included\" \"yes\"\n");
      write(folder + "/a.mtl", "newmtl red\nKd 1 0 0\n");
      const float triangle[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
      write(folder + "/a.bin", {reinterpret_cast<const char*>(triangle), sizeof triangle});
    }
    for (const std::string suffix : {"png", "ies", "mi", "mtl", "bin"}) {
      fs::create_symlink(file("other/a." + suffix), file("scene/link." + suffix));
      fs::create_symlink(file("scene/a." + suffix), file("scene/own." + suffix));
      mkfifo(file("scene/pipe." + suffix).c_str(), 0600);
    }
    mkfifo(file("scene/pipe").c_str(), 0600);
  }

  std::string outside(const std::string& suffix) const { return file("other/a." + suffix); }

  static std::string textured_scene(const std::string& picture) {
    return "color texture \"t\" \"" + picture +
           "\"\nshader \"look\" \"mib_texture_lookup2\" ( \"tex\" \"t\" )\n" + small_scene() +
           "incremental material \"grey\" \"mib_illum_lambert\" ( \"diffuse\" = \"look\" ) end "
           "material\nrender \"root\" \"cam_inst\" \"opt\"\n";
  }

  /// Runs the program; a run that hangs ends with code 124.
  RunResult limited(const std::string& words) const {
    return shell("timeout 30 \"$ORIEL\" " + words + " >stdout.txt 2>stderr.txt");
  }
  static bool says(const RunResult& r, const std::string& words) {
    return r.err.find(words) != std::string::npos;
  }
};

}  // namespace oriel
