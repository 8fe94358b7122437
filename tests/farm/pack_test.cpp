// SPDX-License-Identifier: Apache-2.0
// oriel pack: the picture of the packed scene, without the original files, has the same bytes.
#include <set>

#include "support/program.h"

namespace oriel {
namespace pack_test {

namespace fs = std::filesystem;

class PackProgram : public ProgramTest {
 protected:
  RunResult render(const std::string& scene, const std::string& picture,
                   const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"render", scene,   "-o",        picture,
                                      "--size", "24x16", "--samples", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  RunResult pack(const std::string& scene, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"pack", scene, "-o", "packed"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  /// Packs a scene of the folder "origin", renames both folders, and compares the pictures.
  void expect_same_bytes(const std::string& scene, const std::vector<std::string>& search = {},
                         const std::vector<std::string>& frames = {}) const {
    std::vector<std::string> more = search;
    more.insert(more.end(), frames.begin(), frames.end());
    const RunResult before = render("origin/" + scene, "before.exr", more);
    ASSERT_EQ(before.exit_code, 0) << scene << ": " << before.err;
    const RunResult packed = pack("origin/" + scene, search);
    ASSERT_EQ(packed.exit_code, 0) << scene << ": " << packed.err;
    fs::rename(file("origin"), file("hidden"));
    fs::create_directory(file("elsewhere"));
    fs::rename(file("packed"), file("elsewhere/moved"));
    std::vector<std::string> untrusted = {"--untrusted"};
    untrusted.insert(untrusted.end(), frames.begin(), frames.end());
    // Untrusted: nothing outside of the folder is read.
    const RunResult after =
        render("elsewhere/moved/" + fs::path(scene).filename().string(), "after.exr", untrusted);
    fs::rename(file("hidden"), file("origin"));
    EXPECT_EQ(after.exit_code, 0) << scene << ": " << after.err;
    EXPECT_EQ(after.err.find("warning"), std::string::npos) << scene << ": " << after.err;
    EXPECT_TRUE(bytes_of(file("before.exr")) == bytes_of(file("after.exr"))) << scene;
    fs::remove_all(file("elsewhere"));
  }
  std::set<std::string> files_of(const std::string& folder) const {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(file(folder)))
      if (entry.is_regular_file())
        names.insert(entry.path().lexically_relative(file(folder)).generic_string());
    return names;
  }
  void copy(const std::string& from, const std::string& to) const {
    fs::create_directories(fs::path(file(to)).parent_path());
    fs::copy_file(std::string(ORIEL_SOURCE_DIR) + "/" + from, file(to));
  }
};

/// A picture on the wall and a lamp with a profile.
std::string textured(const std::string& texture, const std::string& more = "") {
  std::string scene = small_scene();
  const std::string look_up =
      more + "color texture \"wood\" \"" + texture +
      "\"\n"
      "shader \"look\" \"mib_texture_lookup2\" ( \"tex\" \"wood\", \"factor\" 1 )\n"
      "shader \"place\" \"mib_texture_vector\" ( \"select\" -1, \"selspace\" 1 )\n";
  const std::string diffuse = "\"diffuse\" .5 .5 .5";
  scene.insert(0, look_up);
  scene.replace(scene.find(diffuse), diffuse.size(), "\"diffuse\" = \"look\"");
  return scene;
}

TEST_F(PackProgram, ScenesOfTheRepository) {
  fs::copy(ORIEL_SOURCE_DIR "/scenes", file("origin"), fs::copy_options::recursive);
  for (const char* scene : {"freeform.mi", "profile-bulbs.mi", "nine-tiles/nine-tiles.mi"})
    expect_same_bytes(scene);
  // Includes by search folders, textures of a shared folder.
  for (const char* scene : {"manual/details/bump.mi", "manual/utility/bulbs.mi"})
    expect_same_bytes(scene, {"-I", "origin"});
}

TEST_F(PackProgram, TheInteriorWithItsFurniture) {
  fs::copy(ORIEL_SOURCE_DIR "/scenes/interior", file("origin"), fs::copy_options::recursive);
  expect_same_bytes("interior.mi");
}

TEST_F(PackProgram, FilesBelowTheSceneKeepTheirBytesAndPlaces) {
  fs::create_directories(file("origin/maps"));
  copy("data/textures/wood.exr", "origin/maps/wood.exr");
  write("origin/house.mi", textured("maps/wood.exr"));
  ASSERT_EQ(pack("origin/house.mi").exit_code, 0);
  EXPECT_EQ(files_of("packed"), (std::set<std::string>{"house.mi", "maps/wood.exr", "pack.json"}));
  EXPECT_EQ(text_of(file("packed/house.mi")), text_of(file("origin/house.mi")));
  EXPECT_EQ(fs::last_write_time(file("packed/maps/wood.exr")),
            fs::last_write_time(file("origin/maps/wood.exr")));
  fs::remove_all(file("packed"));
  expect_same_bytes("house.mi");
}

// Names in other languages, includes within includes, and the way through a symbolic link.
TEST_F(PackProgram, NamesMayHaveSpacesAndAnyLetters) {
  copy("data/textures/wood.exr", "Häuser & Möbel/Texturen/Eiche hell.exr");
  copy("scenes/profile-bulbs/narrow.ies", "Häuser & Möbel/Stühle/Leuchte ö.ies");
  fs::create_directory_symlink("Häuser & Möbel", file("origin"));
  write("origin/Stühle/profil größe.mi",
        "lightprofile \"narrow\" format ies file \"Leuchte ö.ies\" end lightprofile\n");
  write("origin/alle s.mi", "$include \"Stühle/profil größe.mi\"\n");
  std::string scene = textured("Texturen/Eiche hell.exr", "$include \"alle s.mi\"\n");
  const std::string light = "\"mib_light_point\" (";
  scene.replace(scene.find(light), light.size(),
                "\"mib_light_photometric\" ( \"profile\" \"narrow\",");
  write("origin/Haus groß & schön.mi", scene);
  expect_same_bytes("Haus groß & schön.mi");
}

TEST_F(PackProgram, AbsoluteAndForeignNamesBecomeRelative) {
  copy("data/textures/wood.exr", "origin/Oak 1.exr");
  copy("data/textures/brick.exr", "library/a/oak.exr");
  copy("data/textures/grain.exr", "library/b/oak.exr");
  fs::create_directories(file("origin"));
  write("origin/house.mi", textured("W:\\\\maps\\\\oak 1.EXR"));
  // As exporters on Windows write it, with the wrong case.
  write("origin/house.mi",
        textured("W:\\maps\\OAK 1.exr", "color texture \"a\" \"" + file("library/a/oak.exr") +
                                            "\"\n# keep this\ncolor texture \"b\" \"" +
                                            file("library/b/oak.exr") + "\"\n"));
  fs::remove_all(file("packed"));
  ASSERT_EQ(pack("origin/house.mi").exit_code, 0);
  EXPECT_EQ(files_of("packed"),
            (std::set<std::string>{"house.mi", "Oak 1.exr", "external/a/oak.exr",
                                   "external/b/oak.exr", "pack.json"}));
  const std::string text = text_of(file("packed/house.mi"));
  EXPECT_NE(text.find("# keep this"), text.npos);
  EXPECT_EQ(text.find(file("library")), text.npos) << text;
  EXPECT_EQ(bytes_of(file("packed/external/b/oak.exr")), bytes_of(file("library/b/oak.exr")));
  fs::remove_all(file("packed"));
  expect_same_bytes("house.mi");
}

TEST_F(PackProgram, EveryKindOfFile) {
  fs::create_directories(file("origin/parts"));
  fs::create_directories(file("shared/lib"));
  copy("scenes/profile-bulbs/narrow.ies", "shared/narrow.ies");
  copy("data/textures/wood.exr", "shared/lib/wood.exr");
  // A texture of an include belongs to the folder of the include.
  write("shared/lib/wood.mi", "color texture \"wood\" \"wood.exr\"\n");
  write("origin/parts/box.mi",
        "object \"box\" visible trace shadow tagged group\n -1 0 -4 1 0 -4 0 1 -4\n v 0 v 1 v 2\n "
        "p 0 0 1 2\n"
        "end group end object\n");
  std::string scene = small_scene();
  const std::string before_root = "instgroup \"root\"";
  scene.insert(
      scene.find(before_root),
      "lightprofile \"narrow\" format ies file \"" + file("shared/narrow.ies") +
          "\" end lightprofile\n"
          "object \"box\" visible trace shadow tagged file \"parts/box.mi\" end object\n"
          "instance \"box_inst\" \"box\" material [ \"wooden\" ] end instance\n"
          "light \"spot\" \"mib_light_photometric\" ( \"color\" 1 1 1 ) origin 0 1 -3 "
          "direction 0 -1 0 lightprofile \"narrow\" end light\n"
          "instance \"spot_inst\" \"spot\" end instance\n"
          "shader \"look\" \"mib_texture_lookup2\" ( \"tex\" \"wood\", \"factor\" 1 )\n"
          "material \"wooden\" \"mia_material_x\" ( \"diffuse\" = \"look\" ) end material\n");
  scene.replace(scene.find(before_root), before_root.size(),
                before_root + " \"box_inst\" \"spot_inst\"");
  scene.insert(0, "$include <wood.mi>\n");
  write("origin/house.mi", scene);
  ASSERT_EQ(pack("origin/house.mi", {"-I", "shared/lib"}).exit_code, 0);
  EXPECT_EQ(files_of("packed"),
            (std::set<std::string>{"house.mi", "pack.json", "parts/box.mi", "external/lib/wood.mi",
                                   "external/lib/wood.exr", "external/shared/narrow.ies"}));
  EXPECT_EQ(text_of(file("packed/house.mi")).rfind("$include \"external/lib/wood.mi\"\n", 0), 0u);
  fs::remove_all(file("packed"));
  expect_same_bytes("house.mi", {"-I", "shared/lib"});
}

TEST_F(PackProgram, AllFramesAreSearched) {
  copy("data/textures/wood.exr", "origin/../library/wood.exr");
  copy("data/textures/brick.exr", "library/brick.exr");
  fs::create_directories(file("origin"));
  write("origin/house.mi", textured(file("library/wood.exr")) +
                               "incremental color texture \"wood\" \"" + file("library/brick.exr") +
                               "\"\nrender \"root\" \"cam_inst\" \"opt\"\n");
  const RunResult packed = pack("origin/house.mi");
  ASSERT_EQ(packed.exit_code, 0) << packed.err;
  EXPECT_NE(packed.out.find("2 frames"), std::string::npos) << packed.out;
  EXPECT_EQ(files_of("packed").count("external/library/brick.exr"), 1u);
  fs::remove_all(file("packed"));
  expect_same_bytes("house.mi", {}, {"--frames", "2"});
}

TEST_F(PackProgram, MissingFilesAreNamedAndNothingIsWritten) {
  fs::create_directories(file("origin"));
  write("origin/house.mi", "$include \"gone.mi\"\n" + textured("maps/gone.exr"));
  const RunResult refused = pack("origin/house.mi");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.err.find("texture \"maps/gone.exr\""), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("house.mi:2"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("--missing keep"), std::string::npos) << refused.err;
  EXPECT_FALSE(fs::exists(file("packed")));
  const RunResult kept = pack("origin/house.mi", {"--missing", "keep"});
  EXPECT_EQ(kept.exit_code, 0) << kept.err;
  EXPECT_NE(text_of(file("packed/house.mi")).find("maps/gone.exr"), std::string::npos);
}

TEST_F(PackProgram, FoldersWithFilesAreKept) {
  write("house.mi", small_scene());
  fs::create_directories(file("packed"));
  write("packed/mine.txt", "mine");
  const RunResult refused = pack("house.mi");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_EQ(files_of("packed"), std::set<std::string>{"mine.txt"});
  fs::remove(file("packed/mine.txt"));
  EXPECT_EQ(pack("house.mi").exit_code, 0);
  // Nothing is left beside the folder.
  for (const auto& entry : fs::directory_iterator(file(".")))
    EXPECT_FALSE(entry.path().filename().string().starts_with(".packed")) << entry.path();
}

TEST_F(PackProgram, ModelsBecomeScenes) {
  copy("data/textures/wood.exr", "origin/maps/wood.exr");
  write("origin/quad.mtl", "newmtl wooden\nKd 1 1 1\nmap_Kd maps/wood.exr\n");
  write("origin/quad.obj",
        "mtllib quad.mtl\nusemtl wooden\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nvt 0 0\nvt 1 0\n"
        "vt 1 1\nvt 0 1\nf 1/1 4/4 3/3 2/2\n");
  // The scene that oriel quick writes.
  ASSERT_EQ(run({"quick", "origin/quad.obj", "-o", "quad.png", "--samples", "1", "--size", "24x16",
                 "--no-denoise"})
                .exit_code,
            0);
  const RunResult packed = pack("origin/quad.obj");
  ASSERT_EQ(packed.exit_code, 0) << packed.err;
  ASSERT_EQ(render("quad.mi", "before.exr").exit_code, 0);
  fs::rename(file("origin"), file("hidden"));
  const RunResult after = render("packed/quad.mi", "after.exr", {"--untrusted"});
  EXPECT_EQ(after.exit_code, 0) << after.err;
  EXPECT_TRUE(bytes_of(file("before.exr")) == bytes_of(file("after.exr")));
}

TEST_F(PackProgram, UntrustedScenesDoNotTakeOtherFiles) {
  copy("data/textures/wood.exr", "library/wood.exr");
  fs::create_directories(file("origin"));
  write("origin/house.mi", textured(file("library/wood.exr")));
  const RunResult refused = pack("origin/house.mi", {"--untrusted"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.err.find("wood.exr"), std::string::npos) << refused.err;
  EXPECT_FALSE(fs::exists(file("packed")));
}

}  // namespace pack_test
}  // namespace oriel
