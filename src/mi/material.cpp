// SPDX-License-Identifier: Apache-2.0
// material "name" flags shaders { slot shaders }... end material
#include <fmt/format.h>

#include <algorithm>

#include "mi/elements.h"

namespace oriel::mi {
namespace {

using scene::Material;

const std::vector<std::string>& slot_words() {
  static const std::vector<std::string> words{"displace",    "shadow",   "volume",
                                              "environment", "contour",  "photon",
                                              "photonvol",   "lightmap", "hardware"};
  return words;
}

void read_slot(Parse& parse, Material& material) {
  const std::string keyword(parse.in.next().text);
  scene::ShaderList shaders = read_shader_list(parse);
  const auto old = std::find_if(material.slots.begin(), material.slots.end(),
                                [&](const Material::Slot& s) { return s.keyword == keyword; });
  if (old != material.slots.end())
    old->shaders = std::move(shaders);
  else
    material.slots.push_back({keyword, std::move(shaders)});
}

}  // namespace

void read_material(Parse& parse, SourceLocation at) {
  parse.element<Material>("material", at, [&](Material& material) {
    bool replace = parse.incremental;
    while (!parse.in.at_word("end")) {
      const Token token = parse.in.peek();
      if (at_shader(parse)) {
        if (replace) material.shaders.clear();
        replace = false;
        for (scene::ShaderUse& use : read_shader_list(parse))
          material.shaders.push_back(std::move(use));
      } else if (parse.in.accept_word("nocontour")) {
        material.nocontour = parse.boolean_or(true);
      } else if (parse.in.accept_word("opaque")) {
        material.opaque = parse.boolean_or(true);
      } else if (token.kind == Token::Kind::Word &&
                 std::find(slot_words().begin(), slot_words().end(), token.text) !=
                     slot_words().end()) {
        read_slot(parse, material);
      } else {
        if (parse.in.at_end() || Parse::starts_element(token))
          parse.unexpected("a shader, a keyword of a material or 'end material'", slot_words());
        const std::string near = token.is_name() ? nearest_name(token.text, slot_words()) : "";
        parse.warn(code::kStrayToken, parse.in.where(),
                   fmt::format("{} in a material belongs to no statement and was skipped",
                               parse.shown(token)),
                   near.empty() ? "" : "did you mean " + near + "?");
        parse.in.next();
      }
    }
    parse.expect_end("material");
  });
}

}  // namespace oriel::mi
