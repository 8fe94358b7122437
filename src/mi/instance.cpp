// SPDX-License-Identifier: Apache-2.0
// instance "name" ... end instance; instgroup "name" ... end instgroup
#include <fmt/format.h>

#include <cmath>

#include "mi/elements.h"
#include "mi/statements.h"
#include "scene/element_settings.h"

namespace oriel::mi {
namespace {

using scene::Instance;

const FormTable& instance_forms() {
  static constexpr std::string_view kOthers[] = {"transform", "material", "light"};
  static const FormTable table(scene::instance_table(), kOthers);
  return table;
}

// Reads a world-to-local matrix. A singular matrix has no local-to-world transform and becomes the
// identity.
Mat4 read_matrix(Parse& parse, SourceLocation at) {
  Mat4 m;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      m[row][column] = parse.real("one of the sixteen numbers of a transform");
  // double: a scene in millimetres below a world in kilometres has tiny but valid determinants.
  const auto cofactor = [&](int a, int b) {
    return static_cast<double>(m[1][a]) * m[2][b] - static_cast<double>(m[1][b]) * m[2][a];
  };
  const double determinant =
      m[0][0] * cofactor(1, 2) - m[0][1] * cofactor(0, 2) + m[0][2] * cofactor(0, 1);
  if (determinant != 0 && std::isfinite(determinant)) return m;
  parse.warn(code::kSingular, at, "this transform cannot be inverted; the identity is used instead",
             "an axis is scaled to nothing");
  return Mat4();
}

void read_transform(Parse& parse, Instance& instance, SourceLocation at) {
  instance.transform.reset();
  instance.transform_shaders.clear();
  if (parse.at_number())
    instance.transform = read_matrix(parse, at);
  else
    instance.transform_shaders = read_shader_list(parse);
}

void read_motion(Parse& parse, Instance& instance, StatementList& flags, SourceLocation at) {
  if (parse.in.accept_word("transform")) {
    instance.motion_transform.reset();
    if (parse.at_number()) instance.motion_transform = read_matrix(parse, at);
    return;
  }
  scene::Statement statement{"motion", false, {}, at};
  bool ignored = false;
  if (!Parse::is_boolean(parse.in.peek(), ignored)) parse.unexpected("'transform' or 'off'");
  statement.values.push_back(read_value(parse));
  instance.motion_transform.reset();
  flags.add(std::move(statement));
}

std::vector<std::string> read_names(Parse& parse, char close) {
  std::vector<std::string> names;
  while (!parse.in.accept_punct(close)) {
    if (parse.in.accept_punct(',')) continue;
    names.push_back(parse.referenced_name(parse.name("a name")));
  }
  return names;
}

// Whether the next token is a name: a string, or a word that is not a keyword of an instance.
bool at_name(Parse& parse) {
  const Token& token = parse.in.peek();
  return token.kind == Token::Kind::String ||
         (token.kind == Token::Kind::Word && token.text != "end" &&
          !instance_forms().starts_statement(token.text));
}

void read_materials(Parse& parse, Instance& instance) {
  instance.material_list = parse.in.accept_punct('[');
  instance.materials.clear();
  if (instance.material_list) {
    instance.materials = read_names(parse, ']');
  } else if (at_name(parse)) {
    instance.materials.push_back(parse.referenced_name(parse.name("the name of a material")));
  }
}

// light ["exclusive"] [ list ]; removes the restriction if the list is missing.
bool read_links(Parse& parse, std::optional<scene::LightLinks>& links) {
  scene::LightLinks read;
  if (parse.in.at(Token::Kind::String) || parse.in.at_word("exclusive")) {
    const std::string word = parse.in.next().str();
    read.exclusive = word == "exclusive";
  }
  if (!parse.in.accept_punct('[')) {
    links.reset();
    return false;
  }
  read.lights = read_names(parse, ']');
  links = std::move(read);
  return true;
}

void read_light_links(Parse& parse, Instance& instance, StatementList& flags) {
  const SourceLocation at = parse.in.where();
  if (!parse.in.accept_word("shadow")) {
    read_links(parse, instance.light_links);
    return;
  }
  bool value = false;
  if (parse.at_number() || Parse::is_boolean(parse.in.peek(), value)) {
    // A bare `light` followed by the flag `shadow`.
    instance.light_links.reset();
    flags.add({"shadow", false, {read_value(parse)}, at});
    return;
  }
  read_links(parse, instance.shadow_links);
}

void read_instance_statement(Parse& parse, Instance& instance, StatementList& flags) {
  const SourceLocation at = parse.in.where();
  if (parse.in.accept_word("transform")) return read_transform(parse, instance, at);
  if (parse.in.accept_word("motion")) return read_motion(parse, instance, flags, at);
  if (parse.in.accept_word("material")) return read_materials(parse, instance);
  if (parse.in.accept_word("light")) return read_light_links(parse, instance, flags);
  if (parse.in.accept_word("data")) return flags.add(read_data_reference(parse, at));
  if (parse.in.accept_word("approximate")) {
    if (!parse.in.accept_punct('[')) return flags.add(read_approximate(parse, "approximate", at));
    while (!parse.in.accept_punct(']')) {
      parse.in.accept_word("approximate");
      scene::Statement statement = read_approximate(parse, "approximate", at);
      if (statement.values.empty()) parse.unexpected("an approximation");
      flags.add(std::move(statement));
      parse.in.accept_punct(',');
    }
    return;
  }
  if (parse.in.accept_punct('(')) {
    instance.parameters = read_arguments(parse, ')');
    return;
  }
  if (auto statement = read_statement(parse, instance_forms(), "an instance"))
    flags.add(std::move(*statement));
}

// "element" | geometry shaders
void read_instanced(Parse& parse, Instance& instance) {
  if (parse.in.accept_word("geometry")) {
    instance.geometry = read_shader_list(parse);
    return;
  }
  if (at_name(parse)) {
    const SourceLocation at = parse.in.where();
    std::string name = parse.in.next().str();
    instance.geometry.clear();
    if (!parse.in.at_punct('(')) {
      instance.element = parse.referenced_name(std::move(name));
      return;
    }
    instance.geometry.push_back(read_call(parse, std::move(name), at));
  }
  for (scene::ShaderUse& use : read_shader_list(parse)) instance.geometry.push_back(std::move(use));
}

}  // namespace

void read_instance(Parse& parse, SourceLocation at) {
  parse.element<Instance>("instance", at, [&](Instance& instance) {
    StatementList flags(instance.flags, parse.incremental);
    read_instanced(parse, instance);
    while (!parse.in.at_word("end")) read_instance_statement(parse, instance, flags);
    parse.expect_end("instance");
  });
}

void read_instance_group(Parse& parse, SourceLocation at) {
  parse.element<scene::InstanceGroup>("instgroup", at, [&](scene::InstanceGroup& group) {
    StatementList settings(group.settings, parse.incremental);
    bool replace = parse.incremental;
    while (!parse.in.at_word("end")) {
      const SourceLocation here = parse.in.where();
      if (parse.in.at_word("merge") || parse.in.at_word("tag")) {
        scene::Statement statement{std::string(parse.in.next().text), false, {}, here};
        if (parse.at_number()) statement.values.push_back(read_numbers(parse));
        settings.add(std::move(statement));
      } else if (parse.in.accept_word("data")) {
        settings.add(read_data_reference(parse, here));
      } else {
        std::string member = parse.name("the name of an instance or 'end instgroup'");
        if (replace) group.members.clear();
        replace = false;
        group.members.push_back(parse.referenced_name(std::move(member)));
        parse.in.accept_punct(',');
      }
    }
    parse.expect_end("instgroup");
  });
}

}  // namespace oriel::mi
