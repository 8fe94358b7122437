// SPDX-License-Identifier: Apache-2.0
// camera "name" ... end camera
#include <algorithm>
#include <array>

#include "mi/elements.h"
#include "mi/number.h"
#include "mi/statements.h"
#include "scene/element_settings.h"

namespace oriel::mi {
namespace {

using scene::Camera;
using scene::Output;

const FormTable& camera_forms() {
  static const FormTable table(scene::camera_table(), kCameraWords);
  return table;
}

constexpr std::string_view kFormats[] = {
    "rla",    "rlb",     "pic", "zpic", "als",  "rgb", "tif",  "tifu", "tga", "bmp",
    "jpg",    "ppm",     "png", "exr",  "hdr",  "iff", "map",  "dds",  "ps",  "eps",
    "qntpal", "qntntsc", "ct",  "ct16", "ctfp", "st",  "st16", "vt",   "wt",  "zt",
    "nt",     "mt",      "tt",  "bit",  "null", "sgi", "jpeg", "tiff"};

bool is_format(std::string_view word) {
  return std::find(std::begin(kFormats), std::end(kFormats), word) != std::end(kFormats);
}

bool read_modifier(Parse& parse, Output& output) {
  const SourceLocation at = parse.in.where();
  const Token token = parse.in.peek();
  scene::Statement modifier{std::string(token.text), false, {}, at};
  if (token.is_word("quality") || token.is_word("dpi")) {
    parse.in.next();
    modifier.values.push_back(read_numbers(parse));
  } else if (token.is_word("compress")) {
    parse.in.next();
    modifier.values.push_back(read_value(parse));
  } else if (token.is_word("even") || token.is_word("odd") || token.is_word("dod")) {
    parse.in.next();
  } else {
    return false;
  }
  output.modifiers.push_back(std::move(modifier));
  return true;
}

// Two strings are a file format and a file name according to the manual. Many files write pixel
// types in place of the format and rely on the suffix of the file name. "rgb" is both a format and
// a pixel type; the suffix decides.
void assign_first_of_two(Output& output, const std::string& first) {
  const std::size_t dot = output.file.rfind('.');
  const std::string suffix = dot == std::string::npos ? "" : output.file.substr(dot + 1);
  const bool types = !is_format(first) || (first == "rgb" && suffix != "rgb");
  (types ? output.types : output.format) = first;
}

// Types and formats may be unquoted before a string; a file name is always quoted.
bool at_output_string(Parse& parse) {
  const Token& token = parse.in.peek();
  if (token.kind != Token::Kind::Word) return token.kind == Token::Kind::String;
  const char* next = skip_blanks(token.raw.data() + token.raw.size());
  while ((*next >= 'a' && *next <= 'z') || (*next >= '0' && *next <= '9') || *next == '_') ++next;
  next = skip_blanks(next);
  const bool modifier = token.text == "compress" || token.text == "even" || token.text == "odd" ||
                        token.text == "dod";
  return *next == '"' && !modifier && !camera_forms().starts_statement(token.text);
}

// output ["types"] ["format"] modifiers "file" | output ["types"] shaders
void read_output(Parse& parse, Camera& camera, SourceLocation at) {
  Output output;
  output.where = at;
  std::vector<std::string> strings;
  for (;;) {
    if (at_output_string(parse) && strings.size() < 3) {
      const SourceLocation here = parse.in.where();
      strings.push_back(parse.in.next().str());
      if (!parse.in.at_punct('(')) continue;
      output.shaders.push_back(read_call(parse, strings.back(), here));
      strings.pop_back();
      break;
    }
    if (!read_modifier(parse, output)) break;
  }
  for (scene::ShaderUse& use : read_shader_list(parse)) output.shaders.push_back(std::move(use));
  if (!output.shaders.empty()) {
    if (!strings.empty()) output.types = strings[0];
  } else if (strings.empty()) {
    camera.outputs.clear();
    return;
  } else {
    output.file = strings.back();
    if (strings.size() == 2) assign_first_of_two(output, strings[0]);
    if (strings.size() == 3) {
      output.types = strings[0];
      output.format = strings[1];
    }
  }
  camera.outputs.push_back(std::move(output));
}

// A pass ends at the next statement of the camera.
void keep_pass(Parse& parse, Camera& camera, SourceLocation at) {
  scene::UninterpretedStatement uninterpreted{"pass", keep_until_word(parse, kCameraWords), at};
  if (parse.incremental) {
    const std::string name = uninterpreted.text.substr(0, uninterpreted.text.find(' '));
    std::erase_if(camera.uninterpreted, [&](const scene::UninterpretedStatement& k) {
      return k.keyword == uninterpreted.keyword && k.text.substr(0, k.text.find(' ')) == name;
    });
  }
  camera.uninterpreted.push_back(std::move(uninterpreted));
}

// Appends the shaders to the list. The bare keyword clears the list.
void extend_list(Parse& parse, scene::ShaderList& list) {
  scene::ShaderList more = read_shader_list(parse);
  if (more.empty()) list.clear();
  for (scene::ShaderUse& use : more) list.push_back(std::move(use));
}

void read_camera_statement(Parse& parse, Camera& camera, StatementList& other) {
  const SourceLocation at = parse.in.where();
  if (parse.in.accept_word("output")) return read_output(parse, camera, at);
  if (parse.in.accept_word("framebuffer")) return read_frame_buffer(parse, camera, at);
  if (parse.in.accept_word("pass")) return keep_pass(parse, camera, at);
  if (parse.in.accept_word("lens")) return extend_list(parse, camera.lens);
  if (parse.in.accept_word("volume")) return extend_list(parse, camera.volume);
  if (parse.in.accept_word("environment")) return extend_list(parse, camera.environment);
  if (parse.in.accept_word("data")) return other.add(read_data_reference(parse, at));
  if (parse.in.accept_word("focal")) {
    camera.orthographic = parse.in.accept_word("infinity");
    camera.focal.reset();
    if (!camera.orthographic) camera.focal = parse.real("the focal length or infinity");
  } else if (parse.in.accept_word("aperture")) {
    camera.aperture = parse.real("the aperture");
  } else if (parse.in.accept_word("aspect")) {
    camera.aspect = parse.real("the aspect ratio");
  } else if (parse.in.accept_word("resolution")) {
    const int width = parse.integer("the width in pixels");
    camera.resolution = std::array<int, 2>{width, parse.integer("the height in pixels")};
  } else if (auto statement = read_statement(parse, camera_forms(), "a camera")) {
    other.add(std::move(*statement));
  }
}

}  // namespace

void read_camera(Parse& parse, SourceLocation at) {
  parse.element<Camera>("camera", at, [&](Camera& camera) {
    StatementList other(camera.other, parse.incremental);
    while (!parse.in.at_word("end")) read_camera_statement(parse, camera, other);
    parse.expect_end("camera");
  });
}

}  // namespace oriel::mi
