// SPDX-License-Identifier: Apache-2.0
// light "name" ... end light; lightprofile "name" ... end lightprofile
#include <algorithm>

#include "mi/elements.h"
#include "mi/statements.h"
#include "scene/element_settings.h"

namespace oriel::mi {
namespace {

using scene::Light;

constexpr std::string_view kAreas[] = {"rectangle", "disc", "sphere", "cylinder", "object", "user"};
constexpr std::string_view kOtherLightWords[] = {"emitter",   "origin", "direction", "spread",
                                                 "rectangle", "disc",   "sphere",    "cylinder",
                                                 "object",    "user"};

const FormTable& light_forms() {
  static const FormTable table(scene::light_table(), kOtherLightWords);
  return table;
}

Vec3 read_vector(Parse& parse, std::string_view what) {
  const float x = parse.real(what), y = parse.real(what);
  return {x, y, parse.real(what)};
}

// rectangle u v samples... | object "instance" samples... ; the bare keyword removes the area.
void read_area(Parse& parse, Light& light, SourceLocation at) {
  scene::Statement area{std::string(parse.in.next().text), false, {}, at};
  const Token& token = parse.in.peek();
  const bool keyword = token.kind == Token::Kind::Word &&
                       (token.text == "end" || light_forms().starts_statement(token.text));
  if (area.keyword == "object" && token.is_name() && !keyword) {
    scene::Value name;
    name.kind = scene::Value::Kind::Text;
    name.where = parse.in.where();
    name.text = parse.referenced_name(parse.in.next().str());
    area.values.push_back(std::move(name));
  }
  if (parse.at_number()) area.values.push_back(read_numbers(parse));
  if (area.values.empty() && area.keyword != "user")
    light.area.reset();
  else
    light.area = std::move(area);
}

// In an incremental change the first list replaces the existing one.
void take_list(scene::ShaderList& list, scene::ShaderList more, bool& replace) {
  if (replace) list.clear();
  replace = false;
  for (scene::ShaderUse& use : more) list.push_back(std::move(use));
}

}  // namespace

void read_light(Parse& parse, SourceLocation at) {
  parse.element<Light>("light", at, [&](Light& light) {
    StatementList other(light.other, parse.incremental);
    bool replace_shaders = parse.incremental, replace_emitters = parse.incremental;
    while (!parse.in.at_word("end")) {
      const SourceLocation here = parse.in.where();
      const Token& token = parse.in.peek();
      if (at_shader(parse)) {
        take_list(light.shaders, read_shader_list(parse), replace_shaders);
      } else if (parse.in.accept_word("emitter")) {
        take_list(light.emitters, read_shader_list(parse), replace_emitters);
      } else if (parse.in.accept_word("origin")) {
        light.origin = read_vector(parse, "a coordinate of the origin");
      } else if (parse.in.accept_word("direction")) {
        light.direction = read_vector(parse, "a coordinate of the direction");
      } else if (parse.in.accept_word("spread")) {
        light.spread = parse.real("the cosine of the cone");
      } else if (parse.in.accept_word("data")) {
        other.add(read_data_reference(parse, here));
      } else if (token.kind == Token::Kind::Word &&
                 std::find(std::begin(kAreas), std::end(kAreas), token.text) != std::end(kAreas)) {
        read_area(parse, light, here);
      } else if (auto statement = read_statement(parse, light_forms(), "a light")) {
        other.add(std::move(*statement));
      }
    }
    parse.expect_end("light");
  });
}

void read_light_profile(Parse& parse, SourceLocation at) {
  parse.element<scene::LightProfile>("lightprofile", at, [&](scene::LightProfile& profile) {
    static const FormTable forms(scene::light_profile_table());
    StatementList statements(profile.statements, parse.incremental);
    while (!parse.in.at_word("end"))
      if (auto statement = read_statement(parse, forms, "a light profile"))
        statements.add(std::move(*statement));
    parse.expect_end("lightprofile");
    profile.directory = parse.in.folder();
  });
}

}  // namespace oriel::mi
