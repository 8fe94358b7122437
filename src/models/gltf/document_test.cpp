// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/document.h"

#include <gtest/gtest.h>

namespace oriel::models::gltf {
namespace document_test {

TEST(GltfDocument, BinaryFilesHaveTextAndBytes) {
  // Built by hand from the figure of the specification: header, JSON chunk, BIN chunk.
  const std::string text = R"({"asset":{"version":"2.0"}} )";
  ASSERT_EQ(text.size() % 4, 0u);
  std::string file("glTF\2\0\0\0....", 12);
  file += std::string({static_cast<char>(text.size()), 0, 0, 0}) + "JSON" + text;
  file += std::string({4, 0, 0, 0, 'B', 'I', 'N', 0}) + "abcd";
  const auto document = parse(file);
  ASSERT_TRUE(document);
  EXPECT_EQ(words(member(member(document->root, "asset"), "version")), "2.0");
  EXPECT_EQ(document->binary, "abcd");
  // A truncated file has either no document or one with fewer bytes.
  for (std::size_t size = 0; size < file.size(); ++size)
    if (const auto cut = parse(std::string_view(file).substr(0, size))) {
      EXPECT_LT(cut->binary.size(), 4u);
    }
  const std::string made = glb(document->root, "abcde");
  EXPECT_EQ(parse(made)->binary.substr(0, 5), "abcde");
  EXPECT_EQ(parse(made)->root, document->root);
}

TEST(GltfDocument, OtherFilesAreRejected) {
  for (const char* text : {"", "glTF", "[", "null", "[1]", "3", R"({"meshes":{"a":{}}})"})
    EXPECT_FALSE(parse(text)) << text;
  std::string no_text("glTF\2\0\0\0....", 12);
  no_text += std::string({4, 0, 0, 0, 'B', 'I', 'N', 0}) + "abcd";
  EXPECT_FALSE(parse(no_text));
}

TEST(GltfDocument, NestingIsBounded) {
  const auto nested = [](std::size_t levels) {
    return R"({"a":"[[[\"[[[","extras":)" + std::string(levels, '[') + std::string(levels, ']') +
           "}";
  };
  EXPECT_TRUE(parse(nested(90)));
  EXPECT_THROW(parse(nested(200'000)), Unreadable);
  EXPECT_THROW(parse(nested(200'000).substr(0, 150'000)), Unreadable) << "though it has no end";
}

TEST(GltfJson, ValuesOfWrongTypeGiveDefaults) {
  const json list = json::parse(R"([1, 1.5, -1, 1e300, 1e20, "x", null, {"a": 7}])");
  EXPECT_EQ(whole(list[0]), 1u);
  for (std::size_t i = 1; i < list.size(); ++i) EXPECT_FALSE(whole(list[i])) << i;
  EXPECT_EQ(number(list[1], 3), 1.5f);
  for (const std::size_t i : {3, 5, 6, 7}) EXPECT_EQ(number(list[i], 3), 3) << i;
  EXPECT_EQ(words(list[5]), "x");
  EXPECT_EQ(words(list[0]), "");
  EXPECT_EQ(member(list[7], "a"), 7);
  EXPECT_TRUE(member(list[0], "a").is_null());
  EXPECT_TRUE(at(list[7], 0).is_null());
  EXPECT_TRUE(at(list, 99).is_null());
}

}  // namespace document_test
}  // namespace oriel::models::gltf
