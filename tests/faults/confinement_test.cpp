// SPDX-License-Identifier: Apache-2.0
// What scenes of strangers may read and write: files outside of their folder, pipes, devices, URLs.
#include <fmt/format.h>

#include "confinement.h"

namespace oriel {
namespace confinement_test {

namespace fs = std::filesystem;

constexpr const char* kPicture = "OR-RT-020";
constexpr const char* kLamp = "OR-RT-040";
constexpr const char* kInclude = "OR-MI-011";

class Confinement : public ConfinementTest {
 protected:
  static std::string textured(const std::string& picture) { return textured_scene(picture); }
  static std::string lit(const std::string& profile) {
    return "lightprofile \"p\" format ies file \"" + profile +
           "\" end lightprofile\nlight \"q\" \"mib_light_photometric\" ( \"profile\" \"p\" ) "
           "origin 0 0 0 end light\ninstance \"q_inst\" \"q\" end instance\n" +
           small_scene() +
           "incremental instgroup \"root\" \"cam_inst\" \"q_inst\" \"floor_inst\" end instgroup\n"
           "render \"root\" \"cam_inst\" \"opt\"\n";
  }
  static std::string including(const std::string& name) {
    return "$include \"" + name + "\"\n" + small_scene();
  }

  RunResult run_scene(const std::string& text, const std::string& options = "",
                      const std::string& command = "render -o p.png --samples 1") const {
    write("scene/scene.mi", text);
    return limited(command + " scene/scene.mi " + options);
  }

  /// The scene is rendered, with the message.
  void expect_refused(const std::string& text, const std::string& options, const char* code,
                      const std::string& words) const {
    fs::remove(file("p.png"));
    const RunResult r = run_scene(text, options);
    EXPECT_TRUE(says(r, code) && says(r, words)) << words << "\n" << r.exit_code << r.err;
    EXPECT_TRUE(r.exit_code == 0 || r.exit_code == 1) << r.exit_code << r.err;
    EXPECT_TRUE(there("p.png")) << r.err;
  }
  void expect_read(const std::string& text, const std::string& options, const char* code) const {
    const RunResult r = run_scene(text, options);
    EXPECT_EQ(r.exit_code, 0) << r.err;
    EXPECT_FALSE(says(r, code)) << r.err;
  }
};

TEST_F(Confinement, PicturesOfOwnScenesMayLieAnywhere) {
  for (const std::string& name : {std::string("a.png"), std::string("../other/a.png"),
                                  outside("png"), std::string("link.png"), std::string("own.png")})
    expect_read(textured(name), "", kPicture);
  expect_read(lit(outside("ies")), "", kLamp);
  expect_read(lit("link.ies"), "", kLamp);
}

// acceptance: Z5
TEST_F(Confinement, UntrustedScenesReadOnlyTheirFolder) {
  for (const std::string& name : {std::string("a.png"), std::string("own.png")})
    expect_read(textured(name), "--untrusted", kPicture);
  // A path of another machine is replaced by the file of its name, also if it exists here.
  expect_read(textured(outside("png")), "--untrusted", kPicture);
  fs::rename(file("scene/a.png"), file("scene/hidden.png"));
  for (const std::string& name :
       {std::string("../other/a.png"), outside("png"), std::string("link.png")})
    expect_refused(textured(name), "--untrusted", kPicture, "--allow " + file("other"));

  fs::remove(file("scene/a.ies"));
  for (const std::string& name :
       {std::string("../other/a.ies"), outside("ies"), std::string("link.ies")})
    expect_refused(lit(name), "--untrusted", kLamp, "--allow " + file("other"));
  fs::remove(file("scene/a.mi"));
  for (const std::string& name :
       {std::string("../other/a.mi"), outside("mi"), std::string("link.mi")})
    for (const char* mode : {"", "--untrusted"})
      expect_refused(including(name), mode, kInclude, "--allow " + file("other"));
}

// acceptance: Z5
TEST_F(Confinement, AllowPermitsAFileOrAFolder) {
  fs::remove(file("scene/a.ies"));
  fs::remove(file("scene/a.png"));
  for (const std::string& path : {file("other"), std::string("other"), outside("png")})
    expect_read(textured(outside("png")), "--untrusted --allow " + path, kPicture);
  expect_read(lit("link.ies"), "--untrusted --allow other", kLamp);
  expect_read(including("../other/a.mi"), "--allow other", kInclude);
  expect_read(including("../other/a.mi"), "--untrusted -I other", kInclude);
  expect_refused(lit("../other/a.ies"), "--untrusted --allow other/a.png", kLamp, "--allow");
}

// A pipe without a writer or a device without an end would stop the program for ever.
// acceptance: Z5
TEST_F(Confinement, OnlyRegularFilesAreOpened) {
  for (const char* mode : {"", "--untrusted --allow /"}) {
    for (const char* name : {"pipe.png", "pipe", "/dev/zero", "/proc/self/environ"})
      expect_refused(textured(name), mode, kPicture, "not a regular file");
    for (const char* name : {"pipe.ies", "/dev/zero", "/proc/self/environ"})
      expect_refused(lit(name), mode, kLamp, "not a regular file");
  }
  for (const char* mode : {"--allow /", "--untrusted --allow /"})
    for (const char* name : {"pipe.mi", "/dev/zero", "/proc/self/environ"})
      expect_refused(including(name), mode, "OR-MI-014", "not a regular file");
  for (const char* path : {"scene/pipe.mi", "/dev/zero", "/proc/self/environ"})
    EXPECT_EQ(limited(fmt::format("check {}", path)).exit_code, 1) << path;
}

// acceptance: Z5
TEST_F(Confinement, UrlsAreNotOpened) {
  fs::rename(file("scene/a.png"), file("scene/hidden.png"));
  for (const char* url : {"http://127.0.0.1:9/a.png", "file:///etc/passwd", "https://a.b/c.exr",
                          "ftp://127.0.0.1/c.hdr"})
    for (const char* mode : {"", "--untrusted"})
      expect_refused(textured(url), mode, kPicture, "URL");
  // Names that the image library takes for several files or for options of the reader.
  for (const char* name : {"a<UDIM>.png", "hidden.png?x=1"}) {
    fs::copy_file(file("scene/hidden.png"), file(std::string("scene/") + name));
    expect_refused(textured(name), "", kPicture, "pattern");
  }
}

// acceptance: Z5
TEST_F(Confinement, MapsStayBelowTheScene) {
  for (const char* method : {"photonmap", "finalgather"}) {
    const std::string indirect = method[0] == 'p' ? "photons" : "fg";
    const auto result = [&](const std::string& name) {
      return run_scene(
          small_scene(fmt::format("{} file \"{}\" \"indirect\" \"{}\"", method, name, indirect)));
    };
    result("own.map");
    EXPECT_TRUE(there("scene/own.map")) << method;
    fs::remove(file("scene/own.map"));
    fs::remove(file("scene/linked.map"));
    fs::create_symlink(file("other/linked.map"), file("scene/linked.map"));
    for (const std::string& name :
         {std::string("../other/out.map"), file("other/out.map"), std::string("linked.map")})
      EXPECT_NE(result(name).exit_code, 124) << name;
    EXPECT_FALSE(there("other/out.map") || there("other/linked.map")) << method;
    const RunResult r = result("pipe");
    EXPECT_NE(r.exit_code, 124);
    EXPECT_TRUE(says(r, "name a regular file")) << r.err;
  }
}

// acceptance: Z5
TEST_F(Confinement, OutputsStayBelowTheScene) {
  fs::create_symlink(file("other"), file("scene/away"));
  for (const std::string& name : {std::string("../other/p.exr"), std::string("away/p.exr")}) {
    const std::string text = small_scene("", fmt::format("output \"rgba\" \"exr\" \"{}\"", name));
    for (const char* mode : {"", "--untrusted --allow other"}) {
      const RunResult r = run_scene(text, mode, "render --samples 1");
      EXPECT_FALSE(there("other/p.exr")) << name << r.err;
      EXPECT_NE(r.exit_code, 124) << r.err;
    }
  }
}

// acceptance: Z5
TEST_F(Confinement, UntrustedScenesLoadNoLibrariesOfTheEnvironment) {
  write("scene/scene.mi", "link \"mine.so\"\n" + small_scene());
  write("other/mine.so", "not a library");
  const auto check = [&](const std::string& options) {
    return shell("ORIEL_SHADER_PATH=other timeout 30 \"$ORIEL\" check scene/scene.mi " + options +
                 " >stdout.txt 2>stderr.txt");
  };
  EXPECT_TRUE(says(check(""), "OR-SDK-002"));
  EXPECT_FALSE(says(check("--untrusted"), "OR-SDK-002"));
  EXPECT_TRUE(says(check("--untrusted --shader-path other"), "OR-SDK-002"));
  EXPECT_EQ(check("--untrusted --trust-code").exit_code, 2);
}

// A scene that is converted carries its pictures with it.
// acceptance: Z5
TEST_F(Confinement, PicturesThatAConversionEmbeds) {
  write("scene/scene.mi",
        "color texture \"t\" \"" + outside("png") +
            "\"\nshader \"look\" \"mib_texture_lookup2\" ( \"tex\" \"t\" )\n" + small_scene() +
            "incremental material \"grey\" \"mia_material_x\" ( \"diffuse\" = \"look\" ) end "
            "material\nrender \"root\" \"cam_inst\" \"opt\"\n");
  fs::remove(file("scene/a.png"));
  const auto bytes = [&](const std::string& options) {
    const RunResult r = limited("convert scene/scene.mi made.glb " + options);
    EXPECT_EQ(r.exit_code, 0) << r.err;
    return text_of(file("made.glb"));
  };
  const std::string picture = text_of(outside("png"));
  EXPECT_NE(bytes("").find(picture), std::string::npos);
  EXPECT_EQ(bytes("--untrusted").find(picture), std::string::npos);
}

}  // namespace confinement_test
}  // namespace oriel
