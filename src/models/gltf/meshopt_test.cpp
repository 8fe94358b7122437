// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/meshopt.h"

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "models/testing/gltf_file.h"

namespace oriel::models::gltf {
namespace meshopt_test {

using testing::bytes_of;

MeshoptStream stream(std::size_t count, std::size_t stride, const char* mode,
                     const char* filter = "NONE") {
  return meshopt_stream(
      {{"count", count}, {"byteStride", stride}, {"mode", mode}, {"filter", filter}}, "it");
}

template <class T>
std::string packed(const std::vector<T>& values, std::size_t stride) {
  const std::size_t count = values.size() * sizeof(T) / stride;
  std::string data(meshopt_encodeVertexBufferBound(count, stride), '\0');
  data.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(data.data()), data.size(),
                                         values.data(), count, stride));
  return data;
}

std::string packed_triangles(const std::vector<std::uint32_t>& corners, std::size_t vertices) {
  std::string data(meshopt_encodeIndexBufferBound(corners.size(), vertices), '\0');
  data.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(data.data()), data.size(),
                                        corners.data(), corners.size()));
  return data;
}

TEST(GltfMeshopt, AttributesAreDecoded) {
  std::vector<std::uint16_t> values;
  for (unsigned i = 0; i < 997 * 6; ++i) values.push_back(static_cast<std::uint16_t>(i * i % 4099));
  EXPECT_EQ(unpacked(stream(997, 12, "ATTRIBUTES"), packed(values, 12), "it"), bytes_of(values));
}

TEST(GltfMeshopt, TrianglesAndIndicesAreDecoded) {
  const std::vector<std::uint32_t> corners{0, 1, 2, 2, 1, 3, 4, 0, 2};
  const std::string triangles = packed_triangles(corners, 5);
  const std::string read = unpacked(stream(9, 4, "TRIANGLES"), triangles, "it");
  std::vector<std::uint32_t> got(9);
  std::memcpy(got.data(), read.data(), 36);
  // A triangle may begin with another corner.
  for (std::size_t t = 0; t < 9; t += 3) {
    const auto first = std::find(got.begin() + static_cast<long>(t),
                                 got.begin() + static_cast<long>(t) + 3, corners[t]) -
                       got.begin();
    ASSERT_LT(first, static_cast<long>(t) + 3);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(got[t + (static_cast<std::size_t>(first) - t + k) % 3], corners[t + k]);
  }
  std::string data(meshopt_encodeIndexSequenceBound(9, 5), '\0');
  data.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(data.data()),
                                          data.size(), corners.data(), 9));
  const std::vector<std::uint16_t> narrow(corners.begin(), corners.end());
  EXPECT_EQ(unpacked(stream(9, 2, "INDICES"), data, "it"), bytes_of(narrow));
}

TEST(GltfMeshopt, FiltersAreUndone) {
  // From the text of the extension. Octahedral: x, y, one, and an unchanged fourth component. Three
  // elements, one more than a multiple of the step size of the decoder.
  const std::vector<std::int8_t> octahedral{127, 0, 127, 5, 0, -127, 127, 6, 0, 0, 127, 7};
  const std::vector<std::int8_t> normals{127, 0, 0, 5, 0, -127, 0, 6, 0, 0, 127, 7};
  EXPECT_EQ(unpacked(stream(3, 4, "ATTRIBUTES", "OCTAHEDRAL"), packed(octahedral, 4), "it"),
            bytes_of(normals));
  // Exponential: mantissa of 24 bits times two to the exponent of 8.
  const std::vector<std::uint32_t> exponential{0xFF000003u, 0x02FFFFFBu, 0};
  EXPECT_EQ(unpacked(stream(3, 4, "ATTRIBUTES", "EXPONENTIAL"), packed(exponential, 4), "it"),
            bytes_of(std::vector<float>{1.5f, -20, 0}));
  // Quaternion: three of four components over sqrt(2); the last component is the index of the
  // missing one.
  const std::vector<std::int16_t> turns{0, 0, 0, 2044 | 3};
  const std::string turned =
      unpacked(stream(1, 8, "ATTRIBUTES", "QUATERNION"), packed(turns, 8), "it");
  EXPECT_EQ(turned, bytes_of(std::vector<std::int16_t>{0, 0, 0, 32767}));
}

TEST(GltfMeshopt, DamagedDataIsReported) {
  const std::string data = packed(std::vector<float>{1, 2, 3, 4}, 4);
  for (std::size_t size = 0; size < data.size(); ++size)
    EXPECT_THROW(unpacked(stream(4, 4, "ATTRIBUTES"), std::string_view(data).substr(0, size), "it"),
                 Unreadable);
  for (const char* mode : {"TRIANGLES", "INDICES"})
    for (const char* bytes : {"", "abcdefghijkl", "\xE1", "\xD1"})
      EXPECT_THROW(unpacked(stream(300, 4, mode), bytes, "it"), Unreadable) << mode;
}

TEST(GltfMeshopt, SizesAreValidatedBeforeDecoding) {
  const std::size_t large = std::size_t{1} << 50;
  for (const std::size_t stride : {std::size_t{0}, std::size_t{3}, std::size_t{260}, large})
    EXPECT_THROW(stream(4, stride, "ATTRIBUTES"), Unreadable);
  EXPECT_THROW(stream(large, 4, "ATTRIBUTES"), Unreadable);
  EXPECT_THROW(stream(4, 4, "TRIANGLES"), Unreadable);
  EXPECT_THROW(stream(3, 1, "TRIANGLES"), Unreadable);
  EXPECT_THROW(stream(3, 8, "INDICES"), Unreadable);
  EXPECT_THROW(stream(3, 4, "INDICES", "OCTAHEDRAL"), Unreadable);
  EXPECT_THROW(stream(3, 12, "ATTRIBUTES", "OCTAHEDRAL"), Unreadable);
  EXPECT_THROW(stream(3, 4, "ATTRIBUTES", "QUATERNION"), Unreadable);
  EXPECT_THROW(stream(3, 4, "ATTRIBUTES", "MAGIC"), Unreadable);
  EXPECT_THROW(stream(3, 4, "MAGIC"), Unreadable);
}

}  // namespace meshopt_test
}  // namespace oriel::models::gltf
