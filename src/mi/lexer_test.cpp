// SPDX-License-Identifier: Apache-2.0
#include "mi/lexer.h"

#include <fmt/format.h>

#include <cfloat>
#include <cstdlib>
#include <random>

#include "mi/number.h"
#include "mi/testing/test_support.h"

namespace oriel::mi {
namespace lexer_test {

using scene::Value;

struct NumberCase {
  const char* text;
  double value;
  bool integral;
};

// acceptance: H1
TEST(Number, AcceptsAllNumberFormats) {
  for (const NumberCase& c : {NumberCase{"0", 0, true},
                              {"-0", 0, true},
                              {"+7", 7, true},
                              {"12345678", 12345678, true},
                              {"1.", 1, false},
                              {".5", .5, false},
                              {"-.25", -.25, false},
                              {"1e-05", 1e-5, false},
                              {"1e+06", 1e6, false},
                              {"1E3", 1e3, false},
                              {"2d2", 200, false},
                              {"2.5D-1", .25, false},
                              {"1e+30", 1e30, false},
                              {"-8e-22", -8e-22, false},
                              {"4294967295", 4294967295.0, true}}) {
    ScannedNumber n;
    ASSERT_TRUE(scan_number(c.text, n)) << c.text;
    EXPECT_EQ(n.value, c.value) << c.text;
    EXPECT_EQ(n.integral, c.integral) << c.text;
    EXPECT_EQ(*n.end, 0) << c.text;
    float f = 0;
    bool overflow = false;
    ASSERT_NE(scan_float(c.text, f, overflow), nullptr) << c.text;
    EXPECT_EQ(f, static_cast<float>(c.value)) << c.text;
    EXPECT_FALSE(overflow) << c.text;
  }
}

TEST(Number, RejectsInvalidNumbers) {
  ScannedNumber n;
  for (const char* text : {"", "-", "+.", ".", "e5", "1e", "1e+", "3dsmax", "1.2.3", "7_", "nan"})
    EXPECT_FALSE(scan_number(text, n)) << text;
}

TEST(Number, MatchesTheStandardLibraryOnRandomDecimals) {
  std::mt19937 random(5489);
  const auto digits = [&](int most) {
    std::string s;
    for (int i = 0, n = static_cast<int>(random() % static_cast<unsigned>(most + 1)); i < n; ++i)
      s += static_cast<char>('0' + random() % 10);
    return s;
  };
  for (int i = 0; i < 200000; ++i) {
    std::string text =
        fmt::format("{}{}.{}", random() % 2 ? "-" : "", digits(9), digits(random() % 4 ? 9 : 25));
    if (text.find_first_of("0123456789") == std::string::npos) continue;
    if (random() % 3 == 0) text += fmt::format("e{}", static_cast<int>(random() % 90) - 50);
    ScannedNumber n;
    ASSERT_TRUE(scan_number(text.c_str(), n)) << text;
    ASSERT_EQ(n.value, std::strtod(text.c_str(), nullptr)) << text;
    float f = 0;
    bool overflow = false;
    ASSERT_NE(scan_float(text.c_str(), f, overflow), nullptr);
    const float expected = std::strtof(text.c_str(), nullptr);
    if (std::isfinite(expected))
      ASSERT_EQ(f, expected) << text;
    else
      ASSERT_TRUE(overflow && std::abs(f) == FLT_MAX) << text;
  }
}

TEST(Number, HalfwayCasesRoundToEvenFloat) {
  // 2^24 + 1 is halfway between two floats; a slightly larger number must round up, also via
  // double.
  for (const char* text : {"16777217", "16777217.0000000001", "16777219", "16777218.9999999999",
                           "0.50000002980232238769531250", "0.50000002980232238769531251"}) {
    float f = 0;
    bool overflow = false;
    scan_float(text, f, overflow);
    EXPECT_EQ(f, std::strtof(text, nullptr)) << text;
  }
}

TEST(Number, OverflowIsReportedAndClamped) {
  const Snippet read(
      "shader \"x\" \"s\" ( \"p\" 1e999 )\nobject \"o\" group -1e99 0 1e-99 end group "
      "end object");
  EXPECT_EQ(read.count(code::kNumberRange), 2u) << read.messages();
  EXPECT_EQ(read.get<scene::ShaderElement>("x").functions[0].arguments[0].value.numbers[0],
            DBL_MAX);
  EXPECT_EQ(read.get<scene::Object>("o").groups[0].vectors[0], Vec3(-FLT_MAX, 0, 0));
}

// acceptance: H1
TEST(Lexer, StringsUnescapeQuotesOnly) {
  EXPECT_EQ(value_of(R"("")").text, "");
  EXPECT_EQ(value_of(R"("C:\Users\temp\file")").text, R"(C:\Users\temp\file)");
  EXPECT_EQ(value_of(R"("say \"hi\"")").text, R"(say "hi")");
  EXPECT_EQ(value_of("\"# no comment $include\"").text, "# no comment $include");
  EXPECT_EQ(value_of("\"two\nlines\"").text, "two\nlines");
  EXPECT_EQ(value_of("\"\u00e4\u3042\"").text, "\u00e4\u3042");
  const std::string kilobytes(50000, 'x');
  EXPECT_EQ(value_of(fmt::format("\"<a b=\\\"c\\\">\n{}\"", kilobytes)).text.size(),
            kilobytes.size() + 10);
}

// acceptance: H1
TEST(Lexer, LineEndsTabsAndByteOrderMarkAreWhiteSpace) {
  const Snippet read(
      "\xef\xbb\xbf# mi\r\nmaterial \"m\"\r\n\t= \"s1\"\r\nend material\r\n"
      "shader \"s1\" \"s\"\t( )\r\n");
  EXPECT_TRUE(read.diagnostics.all().empty()) << read.messages();
  EXPECT_EQ(read.get<scene::Material>("m").shaders[0].reference, "s1");
}

TEST(Lexer, CommentsAreAllowedAnywhere) {
  const Snippet read(
      "#mi 3.0\nshader \"x\" # a\n\"s\" ( \"p\" #: min 0\n 1, # \u3042\n \"q\" 2 #----\n)");
  EXPECT_TRUE(read.diagnostics.all().empty()) << read.messages();
  EXPECT_EQ(read.get<scene::ShaderElement>("x").functions[0].arguments.size(), 2u);
}

TEST(Lexer, KeywordsAreCaseSensitive) {
  const Snippet read("Material \"m\" end material");
  EXPECT_EQ(read.message(code::kSyntax).hint, "did you mean material?");
}

TEST(Lexer, BinaryVectorsMayContainTheClosingQuote) {
  // 0x60606060 is four backquotes.
  const std::string payload("\x3f\x80\x00\x00````\xc0\x00\x00\x00", 12);
  const Snippet read(fmt::format("object \"o\" group `{}` 0 0 1 end group end object", payload));
  EXPECT_TRUE(read.diagnostics.all().empty()) << read.messages();
  const auto& vectors = read.get<scene::Object>("o").groups[0].vectors;
  ASSERT_EQ(vectors.size(), 2u);
  EXPECT_EQ(vectors[0].x, 1);
  EXPECT_EQ(vectors[0].z, -2);
  EXPECT_GT(vectors[0].y, 6e19f);
}

TEST(Lexer, MissingQuoteAffectsOneElement) {
  const Snippet read(
      "shader \"a\" \"s\" (\n \"p 1,\n \"q\" 2,\n \"r\" 3 )\nshader \"b\" \"s\" ( \"p\" \"v\" )\n"
      "options \"o\" samples 0 2 end options");
  EXPECT_EQ(read.count(code::kUnterminated), 1u) << read.messages();
  EXPECT_EQ(read.message(code::kUnterminated).where.line, 2u);
  EXPECT_EQ(read.get<scene::Options>("o").statements.size(), 1u);
  EXPECT_NE(read.scene.find("b"), nullptr);
}

// acceptance: H1
TEST(Lexer, ValuesOfEveryKindAreKeptAsWritten) {
  EXPECT_EQ(value_of("null").kind, Value::Kind::Null);
  EXPECT_TRUE(value_of("true").boolean);
  EXPECT_EQ(value_of("off").kind, Value::Kind::Boolean);
  EXPECT_EQ(value_of("1 .5 2").numbers, (std::vector<double>{1, .5, 2}));
  EXPECT_FALSE(value_of("1 .5 2").integral);
  EXPECT_TRUE(value_of("1 2").integral);
  EXPECT_TRUE(value_of("symbol").bare);
  EXPECT_EQ(value_of("= \"x\"").kind, Value::Kind::Connection);
  EXPECT_EQ(value_of("= interface \"i\"").kind, Value::Kind::Interface);
  EXPECT_EQ(value_of("{ \"a\" 1, \"b\" { \"c\" on } }").members[1].value.members[0].name, "c");
  EXPECT_EQ(value_of("[ ]").items.size(), 0u);
  EXPECT_EQ(value_of("[ 1 2 3, 4 5 6 ]").items[1].numbers[2], 6);
  EXPECT_EQ(value_of("colorprofile \"p\" 1 2 3").numbers.size(), 3u);
  EXPECT_EQ(value_of(std::string("`\0\0\0\0\x3f\x80\0\0\x40\0\0\0`", 14)).numbers,
            (std::vector<double>{0, 1, 2}));
}

}  // namespace lexer_test
}  // namespace oriel::mi
