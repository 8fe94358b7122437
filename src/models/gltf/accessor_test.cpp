// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/accessor.h"

#include <gtest/gtest.h>

#include "models/testing/gltf_file.h"

namespace oriel::models::gltf {
namespace accessor_test {

using testing::GltfFile;

/// A file as it is read.
struct Read {
  std::string text;
  Document document;
  Buffers buffers;
  explicit Read(GltfFile& file)
      : text(file.binary()), document(*parse(text)), buffers(document, ".", text.size()) {}
  Column numbers(std::size_t accessor) { return read_numbers(document.root, buffers, accessor); }
};

TEST(GltfAccessor, NormalizedNumbersAreFractions) {
  GltfFile file;
  // Specification, 3.11: c / (2^(b - 1) - 1), not below -1, of signed ones; c / (2^b - 1).
  file.add<std::int8_t>({-128, -127, 0, 127}, testing::kByte, "SCALAR", 1, true);
  file.add<std::uint8_t>({0, 51, 255}, testing::kUnsignedByte, "SCALAR", 1, true);
  file.add<std::int16_t>({-32768, -32767, 0, 32767}, testing::kShort, "SCALAR", 1, true);
  file.add<std::uint16_t>({0, 13107, 65535}, testing::kUnsignedShort, "SCALAR", 1, true);
  file.add<std::int16_t>({-32768, 7}, testing::kShort, "SCALAR", 1);
  Read read(file);
  EXPECT_EQ(read.numbers(0).values, (std::vector<float>{-1, -1, 0, 1}));
  EXPECT_EQ(read.numbers(1).values, (std::vector<float>{0, .2f, 1}));
  EXPECT_EQ(read.numbers(2).values, (std::vector<float>{-1, -1, 0, 1}));
  EXPECT_EQ(read.numbers(3).values, (std::vector<float>{0, .2f, 1}));
  EXPECT_EQ(read.numbers(4).values, (std::vector<float>{-32768, 7}));
}

TEST(GltfAccessor, StridesOffsetsAndSparseElementsAreInPlace) {
  GltfFile file;
  file.add<std::uint16_t>({9, 1, 2, 9, 3, 4, 9, 5, 6}, testing::kUnsignedShort, "VEC2", 3);
  file.root["bufferViews"][0]["byteStride"] = 6;
  file.root["accessors"][0]["byteOffset"] = 2;
  file.root["accessors"][0]["count"] = 3;
  const std::size_t where = file.add_view(std::string("\0\2", 2));
  const std::size_t what = file.add_view(testing::bytes_of<std::uint16_t>({7, 8, 70, 80}));
  file.root["accessors"].push_back(file.root["accessors"][0]);
  file.root["accessors"][1]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", where}, {"componentType", testing::kUnsignedByte}}},
      {"values", {{"bufferView", what}}}};
  file.root["accessors"].push_back(file.root["accessors"][1]);
  file.root["accessors"][2].erase("bufferView");
  Read read(file);
  EXPECT_EQ(read.numbers(0).values, (std::vector<float>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(read.numbers(1).values, (std::vector<float>{7, 8, 3, 4, 70, 80}));
  EXPECT_EQ(read.numbers(2).values, (std::vector<float>{7, 8, 0, 0, 70, 80}));
}

TEST(GltfAccessor, IndicesKeepAllTheirBits) {
  GltfFile file;
  file.add<std::uint32_t>({0, 16777217, 4294967295u}, testing::kUnsignedInt, "SCALAR", 1);
  file.add<float>({1}, testing::kFloat, "SCALAR", 1);
  Read read(file);
  EXPECT_EQ(read_indices(read.document.root, read.buffers, 0),
            (std::vector<std::uint32_t>{0, 16777217, 4294967295u}));
  EXPECT_THROW(read_indices(read.document.root, read.buffers, 1), Unreadable);
}

TEST(GltfAccessor, OutOfBoundsAccessorsAreRejected) {
  const auto refused = [](const char* path, const json& value) {
    GltfFile file;
    file.add<float>({1, 2, 3, 4, 5, 6}, testing::kFloat, "VEC3", 3);
    file.root["accessors"][0]["byteOffset"] = 0;
    file.root["bufferViews"][0]["byteStride"] = 12;
    file.root[json::json_pointer(path)] = value;
    Read read(file);
    EXPECT_THROW(read.numbers(0), Unreadable) << path << ' ' << value;
  };
  const json most = 18446744073709551615u, large = 9007199254740992u;
  for (const json& number : {json(3), most, large, json(-1), json("x"), json(1.5)})
    refused("/accessors/0/count", number);
  for (const json& number : {json(1), json(24), large}) refused("/accessors/0/byteOffset", number);
  for (const json& number : {json(25), most, large, json(-1)})
    refused("/bufferViews/0/byteLength", number);
  for (const json& number : {json(1), json(24), large})
    refused("/bufferViews/0/byteOffset", number);
  for (const json& number : {json(13), large}) refused("/bufferViews/0/byteStride", number);
  for (const json& number : {json(1), large, json(nullptr)})
    refused("/bufferViews/0/buffer", number);
  for (const json& number : {json(1), large, json("x")}) refused("/accessors/0/bufferView", number);
  refused("/accessors/0/componentType", 5124);
  refused("/accessors/0/type", "MAT4");
  refused("/accessors/0/sparse", {{"count", 1u << 30}});
  refused("/accessors", 7);
}

TEST(GltfAccessor, SparsePlacesAreWithinTheAccessor) {
  GltfFile file;
  file.add<float>({1, 2}, testing::kFloat, "SCALAR", 1);
  const std::size_t where = file.add_view("\2");
  const std::size_t what = file.add_view("abcd");
  file.root["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", where}, {"componentType", testing::kUnsignedByte}}},
      {"values", {{"bufferView", what}}}};
  Read read(file);
  EXPECT_THROW(read.numbers(0), Unreadable);
}

TEST(GltfAccessor, LargeCountsWithoutDataAreRejected) {
  GltfFile file;
  for (int i = 0; i < 2; ++i)
    file.root["accessors"].push_back(
        {{"componentType", testing::kFloat}, {"count", i ? 4000000000u : 1000}, {"type", "VEC4"}});
  Read read(file);
  EXPECT_EQ(read.numbers(0).values, std::vector<float>(4000, 0));
  EXPECT_THROW(read.numbers(1), Unreadable);
  // Also not by reading the same data repeatedly.
  EXPECT_THROW(while (true) read.buffers.spend(std::size_t{1} << 26), Unreadable);
}

TEST(GltfBuffers, FilesAreReadByThePolicy) {
  const testing::Folder folder;
  folder.write("a b.bin", "0123456789");
  FileAccess files;
  const auto read = [&](const std::string& uri, std::size_t length) {
    Document document{{{"buffers", {{{"uri", uri}, {"byteLength", length}}}},
                       {"bufferViews", {{{"buffer", 0}, {"byteLength", 4}}}}},
                      {}};
    Buffers buffers(document, folder.path(), 100, files);
    return std::string(buffers.view(0));
  };
  EXPECT_EQ(read("a%20b.bin", 10), "0123");
  EXPECT_EQ(read("./a b.bin", 10000), "0123");
  EXPECT_EQ(read((folder.path() / "a b.bin").string(), 10), "0123");
  EXPECT_EQ(read("/etc/passwd", 10).size(), 4u) << "buffers of own models may lie anywhere";
  EXPECT_THROW(read("a%20b.bin", 3), Unreadable) << "more than the buffer says it has";
  for (const char* none : {"none.bin", ".", "file:///etc/passwd", "/proc/self/environ", "/dev/zero",
                           "data:application/octet-stream;base64,!!!!"})
    EXPECT_THROW(read(none, 10), Unreadable) << none;
  files.set_untrusted(true);
  files.permit(folder.path());
  EXPECT_EQ(read("a%20b.bin", 10), "0123");
  for (const char* elsewhere :
       {"/etc/passwd", "../../../../../../etc/passwd", "%2e%2e/%2e%2e/%2e%2e/%2e%2e/etc/passwd"})
    EXPECT_THROW(read(elsewhere, 10), Unreadable) << elsewhere;
}

}  // namespace accessor_test
}  // namespace oriel::models::gltf
