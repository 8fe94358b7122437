// SPDX-License-Identifier: Apache-2.0
#include "base/printable.h"

#include <gtest/gtest.h>

namespace oriel {
namespace printable_test {

TEST(Printable, TextIsUnchanged) {
  for (const char* text : {"", "plain text", "a\n\tb", "Größe 5 m² – 树 🌳", "back\\slash"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, ControlCharactersAreEscaped) {
  EXPECT_EQ(printable("\x1b[31mred\x1b]0;title\x07"), "\\x1b[31mred\\x1b]0;title\\x07");
  EXPECT_EQ(printable(std::string_view("a\0b\rc\x08", 6)), "a\\x00b\\x0dc\\x08");
  EXPECT_EQ(printable("\x7f"), "\\u007f");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\u009b31m");
  EXPECT_EQ(printable("\xe2\x80\xae"
                      "gpj.exe"),
            "\\u202egpj.exe");
}

TEST(Printable, BytesThatAreNotUtf8AreEscaped) {
  // A byte of an 8-bit terminal, a lone continuation, an overlong ESC, a surrogate, a cut sequence.
  EXPECT_EQ(printable("\x9b"
                      "31m"),
            "\\x9b31m");
  EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b");
  EXPECT_EQ(printable("\xe0\x80\x9b"), "\\xe0\\x80\\x9b");
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");
  EXPECT_EQ(printable("a\xe2\x82"), "a\\xe2\\x82");
  EXPECT_EQ(printable("\xf5\x80\x80\x80"), "\\xf5\\x80\\x80\\x80");
}

TEST(Printable, IncompleteCharactersAtTheEndAreCounted) {
  EXPECT_EQ(incomplete_end(""), 0u);
  EXPECT_EQ(incomplete_end("abc"), 0u);
  EXPECT_EQ(incomplete_end("a\xc3\xa4"), 0u);
  EXPECT_EQ(incomplete_end("a\xc3"), 1u);
  EXPECT_EQ(incomplete_end("a\xe2\x82"), 2u);
  EXPECT_EQ(incomplete_end("\xf0\x9f\x8c"), 3u);
  EXPECT_EQ(incomplete_end("\x80\x80\x80\x80"), 0u);
}

}  // namespace printable_test
}  // namespace oriel
