// SPDX-License-Identifier: Apache-2.0
// Line ends and encodings of scene files.
#include "mi/source.h"

#include "mi/testing/test_support.h"

namespace oriel::mi {
namespace source_test {

/// Two elements, a comment between them and an unknown statement in line 4.
constexpr const char* kLines[] = {"#mi 3.14", "options \"o\" trace on end options # \"",
                                  "camera \"c\" focal 2", "frobnicate 3", "end camera"};
std::string lines(const std::string& newline) {
  std::string text;
  for (const char* line : kLines) text += line + newline;
  return text;
}
void expect_read(const std::string& text, const std::string& what) {
  const Snippet read(text);
  EXPECT_FLOAT_EQ(read.get<scene::Camera>("c").focal.value_or(0), 2) << what;
  EXPECT_EQ(read.get<scene::Options>("o").statements.size(), 1u) << what;
  ASSERT_EQ(read.diagnostics.all().size(), 1u) << what << read.messages();
  EXPECT_EQ(read.message(code::kUnknownStatement).where.line, 4u) << what;
}
std::string utf16(const std::u16string& text, bool little) {
  std::string bytes;
  for (const char16_t c : u'\ufeff' + text) {
    const char low = static_cast<char>(c & 0xff), high = static_cast<char>(c >> 8);
    bytes += little ? low : high;
    bytes += little ? high : low;
  }
  return bytes;
}

TEST(LineEndsAndEncodings, AllThreeLineEndsGiveTheSameLines) {
  for (const char* newline : {"\n", "\r\n", "\r"}) expect_read(lines(newline), newline);
}

TEST(LineEndsAndEncodings, Utf16IsReadInBothByteOrders) {
  const std::string text = lines("\r\n");
  for (const bool little : {true, false})
    expect_read(utf16(std::u16string(text.begin(), text.end()), little), little ? "LE" : "BE");
}

TEST(LineEndsAndEncodings, Utf16BecomesUtf8) {
  // One, two, three and four bytes in UTF-8, and an unpaired surrogate.
  const Snippet read(utf16(u"echo \"z\u00df\u6c34\U0001f34b\xd800\" ", true));
  ASSERT_EQ(read.scene.commands.size(), 1u) << read.messages();
  EXPECT_EQ(read.scene.commands[0].values[0].text,
            "z\xc3\x9f\xe6\xb0\xb4\xf0\x9f\x8d\x8b\xef\xbf\xbd");
}

TEST(LineEndsAndEncodings, TrailingZeroBytesAreIgnored) {
  for (const std::size_t count : {1u, 5000u})
    expect_read(lines("\n") + std::string(count, '\0'), "zeros");
  const Snippet within(std::string("options \"o\" ") + '\0' + " end options");
  EXPECT_EQ(within.count(code::kBadCharacter), 1u) << within.messages();
}

TEST(LineEndsAndEncodings, FilesAndTextAreDecodedAlike) {
  const TemporaryFolder folder;
  const std::string text = lines("\r") + std::string(7, '\0');
  const std::string path = (folder.path() / "scene.mi").string();
  std::ofstream(path, std::ios::binary) << utf16(std::u16string(text.begin(), text.end()), true);
  Diagnostics diagnostics;
  const scene::Scene scene = read_scene(path, Snippet::known_shaders(), diagnostics);
  EXPECT_NE(scene.get<scene::Camera>("c"), nullptr);
  EXPECT_EQ(diagnostics.all().size(), 1u);
}

}  // namespace source_test
}  // namespace oriel::mi
