// SPDX-License-Identifier: Apache-2.0
// Models that are imported in a confined process.
#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "fault_test.h"
#include "image/files.h"
#include "mi/writer.h"
#include "models/import_apart.h"

namespace oriel {
namespace model_process_test {

using models::ImportOptions;
using models::ImportProcess;

constexpr const char* kSquareObj =
    "mtllib square.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
    "vt 0 1\nf 1/1 2/2 3/3 4/4\n";
constexpr const char* kSquareMtl = "newmtl red\nKd 1 0 0\nmap_Kd look.png\nbump bumps.png\n";

class ModelApart : public FaultTest {
 protected:
  ModelApart() {
    options_.scene_folder = file("");
    options_.texture_folder = file("textures");
  }
  /// Imports as the program does, and says what the program says.
  std::optional<scene::Scene> apart(const std::string& model, double seconds = 60,
                                    std::size_t memory_mb = 0,
                                    const char* program = ORIEL_PROGRAM) {
    Diagnostics diagnostics;
    ImportProcess process{program, memory_mb, seconds};
    auto scene = models::import_model_apart(file(model), options_, process, diagnostics);
    said_ = messages_of(diagnostics);
    return scene;
  }
  std::string hostile(const std::string& model, double seconds = 60) {
    write(model, "any");
    EXPECT_FALSE(apart(model, seconds, 0, ORIEL_HOSTILE_READER)) << model;
    return said_;
  }
  static std::string messages_of(const Diagnostics& diagnostics) {
    std::string all;
    for (const Diagnostic& d : diagnostics.all()) all += diagnostics.format(d) + "\n";
    return all;
  }
  static std::string scene_text(const scene::Scene& scene) {
    std::ostringstream text;
    mi::write_scene(scene, text);
    return text.str();
  }

  /// The same import in this process.
  void expect_same(const std::string& model) {
    Diagnostics diagnostics;
    const auto here = models::import_model(file(model), options_, diagnostics);
    const auto there = apart(model);
    EXPECT_EQ(said_, messages_of(diagnostics)) << model;
    ASSERT_EQ(here.has_value(), there.has_value()) << model;
    if (!here) return;
    EXPECT_EQ(scene_text(*here), scene_text(*there)) << model;
    EXPECT_TRUE(*here == *there) << model;
  }
  void write_picture(const std::string& name, float value) const {
    Image image(8, 8, 3);
    for (float& v : image.pixels) v = value;
    write_image(file(name), image);
  }

  ImportOptions options_;
  std::string said_;
};

TEST_F(ModelApart, GivesTheSameSceneAsThisProcess) {
  write_picture("look.png", .25f);
  write_picture("bumps.png", .5f);
  write("square.obj", kSquareObj);
  write("square.mtl", kSquareMtl);
  expect_same("square.obj");
  write("square.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0\n1 0 .1\n0 1 .333333\n3 0 1 2\n");
  expect_same("square.ply");
  write("square.stl",
        "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
        "endloop\nendfacet\nendsolid s\n");
  expect_same("square.stl");
  write("broken.obj", "v 0 0\nf 1 2 3\n");
  expect_same("broken.obj");
}

TEST_F(ModelApart, ReadsFilesBesideTheModelAndWritesItsTextures) {
  write_picture("look.png", .25f);
  write("points.bin", std::string("\0\0\0\0\0\0\0\0\0\0\0\0", 12) +
                          std::string("\0\0\x80\x3f\0\0\0\0\0\0\0\0", 12) +
                          std::string("\0\0\0\0\0\0\x80\x3f\0\0\0\0", 12) +
                          text_of(file("look.png")));
  write("a.gltf", fmt::format(R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
    "nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},
    "material":0}}]}}],"buffers":[{{"uri":"points.bin","byteLength":{0}}}],
    "bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":{1}}}],
    "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],
    "max":[1,1,0]}},{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC2"}}],
    "images":[{{"bufferView":1,"mimeType":"image/png"}}],"textures":[{{"source":0}}],
    "materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}]}})",
                              std::filesystem::file_size(file("points.bin")),
                              std::filesystem::file_size(file("points.bin")) - 36));
  ASSERT_TRUE(apart("a.gltf")) << said_;
  EXPECT_EQ(text_of(file("textures/texture_0.png")), text_of(file("look.png")));
  expect_same("a.gltf");
  std::filesystem::remove(file("points.bin"));
  EXPECT_FALSE(apart("a.gltf"));
  EXPECT_NE(said_.find("points.bin"), std::string::npos) << said_;
}

TEST_F(ModelApart, OpensOnlyWhatThePolicyPermits) {
  const TemporaryFolder outside;
  std::ofstream(outside.path() / "square.mtl") << kSquareMtl;
  write("square.obj", "mtllib " + outside.path().string() + "/square.mtl\n" + kSquareObj);
  write("square.mtl", kSquareMtl);
  for (const bool untrusted : {false, true}) {
    options_.files.set_untrusted(untrusted);
    expect_same("square.obj");
    EXPECT_NE(said_.find("--allow"), std::string::npos) << said_;
  }
}

// acceptance: Z6
TEST_F(ModelApart, HostileReadersGiveOneMessage) {
  const auto is_one_error = [](const std::string& said) {
    return said.find("[OR-MD-001]") != said.npos &&
           said.find("[OR-MD-001]") == said.rfind("[OR-MD-001]");
  };
  for (const char* what : {"crash", "leave", "large"}) {
    const std::string said = hostile(std::string(what) + ".obj");
    EXPECT_TRUE(is_one_error(said)) << said;
    EXPECT_NE(said.find("crashed"), std::string::npos) << said;
  }
  for (const char* what : {"rubbish", "sizes", "unknown", "escape", "program", "floods"}) {
    const std::string said = hostile(std::string(what) + ".obj");
    EXPECT_TRUE(is_one_error(said)) << said;
    EXPECT_NE(said.find("invalid answer"), std::string::npos) << said;
  }
  EXPECT_NE(hostile("hang.obj", .3).find("took more than 0.3 s"), std::string::npos);
  EXPECT_EQ(hostile("kinds.obj"), "");  // a scene of no size
  EXPECT_FALSE(there("texture_0.png"));
  EXPECT_FALSE(there("textures/texture_0.sh"));
  EXPECT_NE(hostile("peeks.obj").find("outside of the folders"), std::string::npos) << said_;
}

// acceptance: Z6
TEST_F(ModelApart, KeepsOnlyWhatImportersMake) {
  write("secret.mi", "shader \"stolen\" \"mib_color_alpha\" ( )\n");
  write("scripts.obj", "any");
  const auto scene = apart("scripts.obj", 60, 0, ORIEL_HOSTILE_READER);
  ASSERT_TRUE(scene) << said_;
  const std::string text = scene_text(*scene);
  for (const char* word : {"evil", "hello", "stolen", "passwd", "writable", "photonmap"})
    EXPECT_EQ(text.find(word), std::string::npos) << text;
  EXPECT_NE(text.find("focal"), std::string::npos) << text;
  EXPECT_NE(text.find("render"), std::string::npos) << text;
}

// acceptance: Z6
TEST_F(ModelApart, FilesThatNeedTooMuchMemoryAreReported) {
  std::ofstream model(file("large.stl"), std::ios::binary);
  const std::uint32_t triangles = 1 << 20;
  model << std::string(80, ' ');
  model.write(reinterpret_cast<const char*>(&triangles), 4);
  std::string triangle(50, '\1');
  for (std::uint32_t i = 0; i < triangles; ++i) {
    triangle[13] = static_cast<char>(i), triangle[17] = static_cast<char>(i >> 8);
    model << triangle;
  }
  model.close();
  EXPECT_FALSE(apart("large.stl", 120, 80));
  EXPECT_NE(said_.find("more memory"), std::string::npos) << said_;
}

// assimp 5.2 reads beyond the header of the first, and writes where it should not for the second,
// which a fuzzer found; other versions may read it. The program continues.
// acceptance: Z6
TEST_F(ModelApart, DamagedModelsDoNotEndTheProgram) {
  write("broken.ply",
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"
        "property float y\nproperty float z\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\xff" +
            std::string(36, '\0') + "\3" + std::string(12, '\0'));
  const RunResult r = run({"convert", "broken.ply", "broken.mi"});
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_NE(r.err.find("[OR-MD-001]"), std::string::npos) << r.err;
  EXPECT_FALSE(there("broken.mi"));

  write("square.obj",
        "mtllib square.mtl\no square\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nvt 0 0\nvt 1 0\n"
        "vt 1 1\nvt 0 1\nvn 0 1 0\nusemtl red\nf 1/1/1 2/2/1 3/3/1 4/4/1\nf -4 -3 -2");
  write("square.mtl",
        "n welmtred\nKd 0.8 0.1 0.1\nKs 0.2 0.2 0.2\nNs 50\nd 0.5\nPr 0.3\n"
        "map_Kd -s 2 2 1 missing.png\nmap_bump -bm 0.5 4/1\nf -4 ng\n");
  const RunResult second = run({"convert", "square.obj", "square.mi"});
  EXPECT_TRUE(second.exit_code == 0 || second.exit_code == 1) << second.err;
  if (second.exit_code == 1) {
    EXPECT_NE(second.err.find("[OR-MD-001]"), std::string::npos) << second.err;
    EXPECT_FALSE(there("square.mi"));
  }
}

}  // namespace model_process_test
}  // namespace oriel
