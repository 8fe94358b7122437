// SPDX-License-Identifier: Apache-2.0
// framebuffer "name" items... inside a camera
#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "mi/elements.h"
#include "mi/statements.h"

namespace oriel::mi {
namespace {

using scene::FrameBuffer;

// Items stored as statements. Only `quality` has an effect on output files.
// Source: items written for later versions of mental ray 3.x; see the grammar of the camera.
constexpr std::string_view kModifiers[] = {
    "colorprofile", "compression", "field",      "quality",       "dod",
    "dpi",          "useopacity",  "useprimary", "premultiplied", "tiled"};
// Items with a bare word as their value. A word after any other item is the next item.
constexpr std::string_view kWorded[] = {"colorprofile", "compression", "field"};

bool is_one_of(std::span<const std::string_view> words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// First words of items and camera statements. They end an unknown item.
std::vector<std::string_view> ending_words() {
  std::vector<std::string_view> words = {"datatype",  "filename", "filetype",
                                         "filtering", "primary",  "user"};
  words.insert(words.end(), std::begin(kModifiers), std::end(kModifiers));
  words.insert(words.end(), std::begin(kCameraWords), std::end(kCameraWords));
  // Camera statements that are missing in kCameraWords.
  for (const std::string_view word : {"stereo", "eye", "parallax", "tag", "shift", "motion"})
    words.push_back(word);
  return words;
}

const std::vector<std::string_view>& ends() {
  static const std::vector<std::string_view> words = ending_words();
  return words;
}

bool ends_an_item(const Token& token) {
  return token.kind == Token::Kind::Word && (token.text == "end" || is_one_of(ends(), token.text));
}

// Reads an item with at most one value: numbers, string, boolean or word.
void read_modifier(Parse& parse, FrameBuffer& buffer) {
  scene::Statement statement;
  statement.where = parse.in.where();
  statement.keyword = parse.in.next().text;
  const Token& value = parse.in.peek();
  bool ignored = false;
  if (value.kind == Token::Kind::Number || value.kind == Token::Kind::String ||
      Parse::is_boolean(value, ignored) ||
      (value.kind == Token::Kind::Word && is_one_of(kWorded, statement.keyword) &&
       !ends_an_item(value)))
    statement.values.push_back(read_value(parse));
  buffer.modifiers.push_back(std::move(statement));
}

void keep_unknown(Parse& parse, FrameBuffer& buffer) {
  const SourceLocation at = parse.in.where();
  const Token token = parse.in.peek();
  scene::UninterpretedStatement uninterpreted{std::string(token.raw), "", at};
  parse.in.next();
  uninterpreted.text = keep_until_word(parse, ends());
  const std::vector<std::string> known(ends().begin(), ends().end());
  const std::string near = nearest_name(uninterpreted.keyword, known);
  parse.diagnostics.note(code::kIgnored, at,
                         fmt::format("item '{}' of framebuffer \"{}\" is kept but has no meaning",
                                     uninterpreted.keyword, buffer.name),
                         near.empty() ? "" : "did you mean " + near + "?");
  buffer.uninterpreted.push_back(std::move(uninterpreted));
}

// Skips an extra value or one of the wrong kind.
void skip_values(Parse& parse, const FrameBuffer& buffer) {
  const SourceLocation at = parse.in.where();
  const std::string shown = parse.shown(parse.in.peek());
  keep_until_word(parse, ends());
  parse.diagnostics.note(
      code::kIgnored, at,
      fmt::format("{} has no place in framebuffer \"{}\"; skipped", shown, buffer.name));
}

// on, off, true, false, 0 or 1 (default on).
bool read_flag(Parse& parse) {
  if (parse.at_number()) return parse.number("on or off") != 0;
  return parse.boolean_or(true);
}

// Returns false at the next statement of the camera.
bool read_item(Parse& parse, FrameBuffer& buffer) {
  const Token token = parse.in.peek();
  if (token.kind == Token::Kind::End || Parse::starts_element(token)) return false;
  if (token.kind != Token::Kind::Word) return skip_values(parse, buffer), true;
  const auto accept = [&](std::string_view word) { return parse.in.accept_word(word); };
  const auto text = [&](std::string& into, std::string_view what) {
    into = parse.name(what);
    return true;
  };
  if (accept("datatype")) return text(buffer.datatype, "a pixel type such as \"rgba_fp\"");
  if (accept("filename")) return text(buffer.filename, "the name of a file");
  if (accept("filetype")) return text(buffer.filetype, "a file format such as \"exr\"");
  if (accept("filtering")) return buffer.filtering = read_flag(parse), true;
  if (accept("primary")) return buffer.primary = read_flag(parse), true;
  if (accept("user")) return buffer.user = read_flag(parse), true;
  if (is_one_of(kModifiers, token.text)) return read_modifier(parse, buffer), true;
  if (ends_an_item(token)) return false;
  return keep_unknown(parse, buffer), true;
}

}  // namespace

void read_frame_buffer(Parse& parse, scene::Camera& camera, SourceLocation at) {
  FrameBuffer buffer;
  buffer.where = at;
  buffer.name = parse.name("the name of the frame buffer");
  while (read_item(parse, buffer)) {
  }
  const auto same = std::find_if(camera.frame_buffers.begin(), camera.frame_buffers.end(),
                                 [&](const FrameBuffer& b) { return b.name == buffer.name; });
  if (parse.incremental && same != camera.frame_buffers.end())
    *same = std::move(buffer);
  else
    camera.frame_buffers.push_back(std::move(buffer));
}

}  // namespace oriel::mi
