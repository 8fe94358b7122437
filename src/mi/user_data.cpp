// SPDX-License-Identifier: Apache-2.0
// data "name" [tag N] N [ 'hex'... ] | "file" | "declared" ( parameters )
#include "mi/elements.h"
#include "mi/number.h"

namespace oriel::mi {
void append_hex(Parse& parse, std::vector<std::uint8_t>& bytes) {
  const SourceLocation at = parse.in.where();
  const Token token = parse.in.next();
  int high = -1;
  for (const char c : token.text) {
    if (static_cast<unsigned char>(c) <= ' ') continue;
    const int digit = hex_digit(c);
    if (digit < 0) {
      parse.warn(code::kBadBinary, at,
                 "a block of bytes holds something else than hexadecimal digits");
      return;
    }
    if (high < 0) {
      high = digit;
      continue;
    }
    bytes.push_back(static_cast<std::uint8_t>(high << 4 | digit));
    high = -1;
  }
  if (high >= 0) parse.warn(code::kBadBinary, at, "a block of bytes has an odd number of digits");
}

void read_user_data(Parse& parse, SourceLocation at) {
  parse.element<scene::UserData>("data", at, [&](scene::UserData& data) {
    data = {.name = data.name, .directory = parse.in.folder(), .where = data.where};
    if (parse.in.accept_word("tag"))
      data.label = static_cast<std::uint32_t>(parse.integer("a label"));
    if (parse.in.accept_word("null")) return;
    if (parse.in.at(Token::Kind::String)) {
      std::string text = parse.in.next().str();
      if (!parse.in.accept_punct('(')) {
        data.file = std::move(text);
        return;
      }
      data.declaration = std::move(text);
      data.arguments = read_arguments(parse, ')');
      return;
    }
    if (parse.at_number()) data.size = parse.integer("a number of bytes");
    const bool bracketed = parse.in.accept_punct('[');
    while (parse.in.at(Token::Kind::Hex)) append_hex(parse, data.bytes);
    if (bracketed) parse.expect_punct(']');
  });
}

}  // namespace oriel::mi
