// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/uri.h"

#include <gtest/gtest.h>

#include "models/testing/model_file.h"

namespace oriel::models::gltf {
namespace uri_test {

TEST(GltfUri, EscapesAreBytes) {
  EXPECT_EQ(unescaped("my%20model.bin"), "my model.bin");
  EXPECT_EQ(unescaped("%E2%9D%a4"), "\xE2\x9D\xA4");
  // Invalid escapes are kept; names contain no zero byte.
  for (const char* plain : {"100%", "%", "%2", "%zz", "a%00b", ""})
    EXPECT_EQ(unescaped(plain), plain);
}

TEST(GltfUri, DataIsBase64OrText) {
  // RFC 4648, 10.
  for (const auto& [text, bytes] :
       {std::pair("Zg==", "f"), {"Zm8=", "fo"}, {"Zm9v", "foo"}, {"Zm9vYg", "foob"}})
    EXPECT_EQ(data_of(std::string("data:image/png;base64,") + text)->bytes, bytes);
  EXPECT_EQ(data_of("data:image/png;base64,Zg==")->media_type, "image/png");
  EXPECT_EQ(data_of("data:,a%20b")->bytes, "a b");
  for (const char* none : {"file.bin", "data:", "data:;base64", "data:;base64,Zm*v"})
    EXPECT_FALSE(data_of(none)) << none;
}

TEST(GltfUri, NamesAreSearchedDecodedAndAsWritten) {
  const testing::Folder folder;
  folder.write("a b.bin", "x");
  folder.write("50%25.bin", "x");
  const std::string where = folder.path();
  EXPECT_EQ(file_name("a%20b.bin", where, {}), "a b.bin");
  EXPECT_EQ(file_name("50%25.bin", where, {}), "50%25.bin");
  EXPECT_EQ(file_name("none%20.bin", where, {}), "none .bin");
}

}  // namespace uri_test
}  // namespace oriel::models::gltf
