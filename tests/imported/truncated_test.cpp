// SPDX-License-Identifier: Apache-2.0
// Model files of every format, cut at many lengths: an error names the file and the reason.
#include <cstring>

#include "ifc_house.h"
#include "pane_models.h"

namespace oriel {
namespace truncated_test {

using models::testing::Made;
using namespace std::string_literals;

template <class T>
std::string bytes(T value) {
  std::string text(sizeof value, '\0');
  std::memcpy(text.data(), &value, sizeof value);
  return text;
}
std::string reals(const std::vector<float>& values) {
  std::string text;
  for (const float v : values) text += bytes(v);
  return text;
}
std::string chunk(std::uint16_t kind, const std::string& content) {
  return bytes(kind) + bytes(static_cast<std::uint32_t>(content.size() + 6)) + content;
}

/// Two triangles.
std::string file_3ds() {
  std::string faces = bytes(std::uint16_t{2});
  for (const std::uint16_t i : {0, 1, 2, 0, 0, 2, 3, 0}) faces += bytes(i);
  const std::string mesh =
      chunk(0x4110, bytes(std::uint16_t{4}) + reals({0, 0, 0, 9, 0, 0, 9, 9, 0, 0, 9, 0})) +
      chunk(0x4120, faces);
  const std::string name("chair\0", 6);
  return chunk(0x4d4d, chunk(0x3d3d, chunk(0x4000, name + chunk(0x4100, mesh))));
}

std::string file_stl(bool binary) {
  const std::vector<float> triangle = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
  if (binary)
    return std::string(80, 'x') + bytes(std::uint32_t{2}) + reals(triangle) + "\0\0"s +
           reals(triangle) + "\0\0"s;
  std::string text = "solid chair\n";
  for (int i = 0; i < 2; ++i)
    text += fmt::format(
        "facet normal 0 0 1\nouter loop\nvertex 0 0 {0}\nvertex 1 0 {0}\nvertex 0 1 {0}\n"
        "endloop\nendfacet\n",
        i);
  return text + "endsolid chair\n";
}

std::string file_ply(const char* format) {
  const std::string head = fmt::format(
      "ply\nformat {} 1.0\ncomment two triangles\nelement vertex 4\nproperty float x\n"
      "property float y\nproperty float z\nelement face 2\n"
      "property list uchar int vertex_indices\nend_header\n",
      format);
  if (std::strcmp(format, "ascii") == 0)
    return head + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
  std::string faces;
  for (const std::array<int, 3>& face : {std::array{0, 1, 2}, {0, 2, 3}}) {
    faces += '\3';
    for (const int i : face) faces += bytes(std::int32_t{i});
  }
  return head + reals({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) + faces;
}

models::testing::GltfFile gltf() {
  return pane_models::gltf_pane({{"pbrMetallicRoughness", {{"metallicFactor", 0}}}}, .1f);
}

std::string obj_library() {
  return "newmtl pane\nKd 0.25 0.5 0.75\nKs 0.1 0.2 0.3\nNs 30\nmap_Kd t.png\nillum 2\n";
}

struct Result {
  bool scene = false, surfaces = false;
  std::string error;
};

/// Imports `name` with its content after other files were written.
Result imported(const std::string& name, const std::string& content,
                const std::vector<std::pair<std::string, std::string>>& beside = {}) {
  Made made;
  for (const auto& [other, text] : beside) made.folder.write(other, text);
  made.import(content, name);
  Result result{.scene = made.scene.has_value()};
  for (const Diagnostic& d : made.diagnostics.all())
    if (d.severity >= Severity::Error) result.error += made.diagnostics.format(d) + "\n";
  if (made.scene)
    for (const scene::Element& e : made.scene->elements())
      result.surfaces |= std::holds_alternative<scene::Object>(e);
  return result;
}

/// Lengths from 0 to just below the size, and all of the last bytes.
std::vector<std::size_t> cuts(std::size_t size) {
  constexpr std::size_t kCuts = 40, kLast = 3;
  std::vector<std::size_t> lengths;
  for (std::size_t i = 0; i < kCuts; ++i) lengths.push_back(size * i / kCuts);
  for (std::size_t i = 1; i <= kLast; ++i) lengths.push_back(size - i);
  return lengths;
}

bool names_the_reason(const std::string& error) {
  for (const char* reason : {"truncated", "is empty", "header is incomplete"})
    if (error.find(reason) != error.npos) return true;
  return false;
}

struct Format {
  std::string name, content;
};

// A newline or a blank behind the last statement is not missed.
TEST(TruncatedModels, AreErrorsThatNameTheReason) {
  const Format kFormats[] = {{"m.glb", gltf().binary()},
                             {"m.gltf", gltf().text()},
                             {"m.fbx", pane_models::fbx_pane("")},
                             {"m.dae", pane_models::collada_pane("", .1f)},
                             {"m.3ds", file_3ds()},
                             {"m.stl", file_stl(true)},
                             {"text.stl", file_stl(false)},
                             {"m.ply", file_ply("binary_little_endian")},
                             {"text.ply", file_ply("ascii")},
                             {"m.ifc", ifc_house::House().text()}};
  for (const Format& format : kFormats) {
    const Result whole = imported(format.name, format.content);
    EXPECT_TRUE(whole.surfaces) << format.name << whole.error;
    std::string needed = format.content;
    if (!format.name.ends_with(".glb") && format.name[0] != 'm')
      needed.erase(needed.find_last_not_of("\n") + 1);
    if (format.name == "text.stl") needed.erase(needed.rfind("endsolid") + 8);
    if (format.name == "m.ifc") needed.erase(needed.rfind(';'));
    if (format.name == "m.fbx") needed.erase(needed.rfind('}'));
    for (const std::size_t length : cuts(needed.size())) {
      const Result made = imported(format.name, needed.substr(0, length));
      const std::string& error = made.error;
      EXPECT_FALSE(made.scene) << format.name << ' ' << length;
      EXPECT_TRUE(names_the_reason(error)) << format.name << ' ' << length << ": " << error;
      EXPECT_NE(error.find(format.name), error.npos) << error;
    }
  }
}

TEST(TruncatedModels, BuffersOfGltfAreNamed) {
  models::testing::GltfFile file = gltf();
  models::testing::json root = models::testing::json::parse(file.text());
  const std::size_t size = root["buffers"][0]["byteLength"];
  root["buffers"][0]["uri"] = "m.bin";
  const std::string model = root.dump();
  EXPECT_TRUE(imported("m.gltf", model, {{"m.bin", std::string(size, '\0')}}).scene);
  for (const std::size_t length : cuts(size)) {
    const Result made = imported("m.gltf", model, {{"m.bin", std::string(length, '\0')}});
    EXPECT_FALSE(made.scene);
    EXPECT_NE(made.error.find(fmt::format("\"m.bin\" is truncated: {} of", length)),
              std::string::npos)
        << made.error;
  }
}

// A file that is cut at the end of a line is valid, but a file without surfaces is an error.
TEST(TruncatedModels, ObjFilesHaveSurfacesOrErrors) {
  const std::string text = pane_models::obj_pane(.1f), library = obj_library();
  ASSERT_TRUE(imported("m.obj", text, {{"m.mtl", library}}).surfaces);
  const std::size_t faces = text.find("\nf ");
  for (std::size_t length = 0; length < text.size(); ++length) {
    const Result made = imported("m.obj", text.substr(0, length), {{"m.mtl", library}});
    const std::string& error = made.error;
    EXPECT_NE(made.surfaces, error.find("m.obj") != error.npos) << length << error;
    EXPECT_TRUE(length >= faces || !made.scene) << length;
  }
  for (std::size_t length = 0; length < library.size(); ++length) {
    const Result made = imported("m.obj", text, {{"m.mtl", library.substr(0, length)}});
    const std::string& error = made.error;
    EXPECT_NE(made.surfaces, error.find("m.mtl") != error.npos) << length << error;
  }
}

// A binary FBX file is a list of records that begin with the offset of their end.
TEST(TruncatedModels, BinaryFbxFilesHaveWholeRecords) {
  for (const std::uint32_t version : {7400u, 7500u}) {
    std::string text = "Kaydara FBX Binary  "s + "\0\x1a\0"s + bytes(version);
    const std::size_t first = text.size();
    for (const std::size_t end : {first + 100, first + 300}) {
      text += version < 7500 ? bytes(static_cast<std::uint32_t>(end))
                             : bytes(static_cast<std::uint64_t>(end));
      text.resize(end, 'x');
    }
    for (const std::size_t length : cuts(text.size())) {
      const Result made = imported("m.fbx", text.substr(0, length));
      const std::string& error = made.error;
      EXPECT_FALSE(made.scene);
      EXPECT_NE(error.find("m.fbx"), error.npos) << error;
      // Without its mark, the file appears to be text.
      EXPECT_TRUE(names_the_reason(error)) << length << error;
    }
    const std::string complete = text + std::string(25, '\0');
    EXPECT_FALSE(names_the_reason(imported("m.fbx", complete).error)) << version;
  }
}

}  // namespace truncated_test
}  // namespace oriel
