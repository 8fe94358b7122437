// SPDX-License-Identifier: Apache-2.0
#include "farm/pack_text.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace oriel::farm {
namespace pack_text_test {

using Kind = FileReference::Kind;

FileReference at(Kind kind, std::string written, std::uint32_t line, std::uint32_t column,
                 int before = 0) {
  return {kind, std::move(written), "found", {}, {1, line, column}, before};
}

TEST(PackText, OnlyTheNameChanges) {
  const std::string text =
      "# \"a.png\"\n  color texture \"a.png\"  \"a.png\" # \"a.png\"\nlight \"a.png\"";
  const FileReference texture = at(Kind::Texture, "a.png", 2, 3, 1);
  EXPECT_EQ(with_names(text, '\n', {{&texture, "maps/b.png"}}),
            "# \"a.png\"\n  color texture \"a.png\"  \"maps/b.png\" # \"a.png\"\nlight \"a.png\"");
}

TEST(PackText, BothFormsOfIncludes) {
  const std::string text = "$include <a.mi>\r$include \"b.mi\"\r";
  const FileReference a = at(Kind::Include, "a.mi", 1, 1), b = at(Kind::Include, "b.mi", 2, 1);
  EXPECT_EQ(with_names(text, '\r', {{&a, "x/a.mi"}, {&b, "y/b.mi"}}),
            "$include \"x/a.mi\"\r$include \"y/b.mi\"\r");
}

TEST(PackText, NamesOfAListAreToldApart) {
  const std::string text = "finalgather file [\"m\", \"m\", \"n\"]";
  const FileReference second = at(Kind::Map, "m", 1, 1, 1);
  EXPECT_EQ(with_names(text, '\n', {{&second, "o"}}), "finalgather file [\"m\", \"o\", \"n\"]");
}

TEST(PackText, QuotesInNamesAreUnderstood) {
  const std::string text = R"(data "d" "6\" nail")";
  const FileReference data = at(Kind::UserData, "6\" nail", 1, 1, 1);
  EXPECT_EQ(with_names(text, '\n', {{&data, "nail"}}), R"(data "d" "nail")");
}

TEST(PackText, AMissingPlaceIsAnError) {
  const FileReference texture = at(Kind::Texture, "a.png", 1, 1, 1);
  EXPECT_THROW(with_names("color texture \"a\" \"b.png\"", '\n', {{&texture, "c"}}),
               std::runtime_error);
  const FileReference beyond = at(Kind::Texture, "a.png", 7, 1, 1);
  EXPECT_THROW(with_names("x", '\n', {{&beyond, "c"}}), std::runtime_error);
}

}  // namespace pack_text_test
}  // namespace oriel::farm
