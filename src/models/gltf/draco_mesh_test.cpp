// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/draco_mesh.h"

#include <draco/compression/expert_encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>

#include <array>
#include <set>

#include "models/testing/gltf_file.h"

namespace oriel::models::gltf {
namespace draco_mesh_test {

using testing::GltfFile;
using Points = std::array<std::array<std::int16_t, 3>, 3>;

constexpr Points kTriangle{{{0, 0, 0}, {32767, 0, 0}, {0, -32767, 16384}}};

/// One triangle with integer coordinates, compressed losslessly.
std::string packed() {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(1);
  const int id = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_INT16);
  builder.SetAttributeValuesForFace(id, draco::FaceIndex(0), kTriangle[0].data(),
                                    kTriangle[1].data(), kTriangle[2].data());
  const auto mesh = builder.Finalize();
  draco::ExpertEncoder encoder(*mesh);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeToBuffer(&buffer).ok());
  return {buffer.data(), buffer.size()};
}

GltfFile file_of(const std::string& data, bool normalized) {
  GltfFile file;
  const std::size_t view = file.add_view(data);
  file.root["accessors"].push_back(
      {{"componentType", testing::kShort}, {"count", 3}, {"type", "VEC3"}});
  if (normalized) file.root["accessors"][0]["normalized"] = true;
  file.primitive()["attributes"]["POSITION"] = 0;
  file.primitive()["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", view}, {"attributes", {{"POSITION", 0}}}};
  return file;
}

UnpackedMesh unpack(GltfFile file) {
  const std::string text = file.binary();
  const Document document = *parse(text);
  Buffers buffers(document, ".", text.size());
  return unpack_draco(document.root, buffers, document.root["meshes"][0]["primitives"][0]);
}

TEST(GltfDraco, QuantizedValuesFollowTheAccessor) {
  for (const bool normalized : {false, true}) {
    const UnpackedMesh mesh = unpack(file_of(packed(), normalized));
    const Column& points = mesh.attributes.at("POSITION");
    ASSERT_EQ(points.components, 3u);
    ASSERT_EQ(mesh.corners.size(), 3u);
    std::set<std::array<float, 3>> found, wanted;
    const float most = normalized ? 32767.f : 1;
    for (std::size_t i = 0; i < 3; ++i) {
      const float* p = points.values.data() + 3 * mesh.corners[i];
      found.insert({p[0], p[1], p[2]});
      wanted.insert({static_cast<float>(kTriangle[i][0]) / most,
                     static_cast<float>(kTriangle[i][1]) / most,
                     static_cast<float>(kTriangle[i][2]) / most});
    }
    EXPECT_EQ(found, wanted) << normalized;
  }
}

TEST(GltfDraco, DamagedDataIsReported) {
  const std::string data = packed();
  for (std::size_t size = 0; size + 1 < data.size(); ++size)
    EXPECT_THROW(unpack(file_of(data.substr(0, size), true)), Unreadable) << size;
  GltfFile file = file_of(data, true);
  file.primitive()["extensions"]["KHR_draco_mesh_compression"]["bufferView"] = 7;
  EXPECT_THROW(unpack(file), Unreadable);
}

}  // namespace draco_mesh_test
}  // namespace oriel::models::gltf
