// SPDX-License-Identifier: Apache-2.0
#include "mi/subdivision.h"

#include <fmt/format.h>

#include <algorithm>

#include "mi/elements.h"

namespace oriel::mi {
namespace {

using scene::kNone;
using scene::SubdivisionSurface;
using Form = SubdivisionSurface::Form;
using TextureRule = SubdivisionSurface::TextureRule;

class SubdivisionReader {
 public:
  SubdivisionReader(Parse& parse, scene::PolygonGroup& group, GroupBuilder& builder)
      : parse_(parse), builder_(builder), surface_(group.subdivisions.emplace_back()) {}

  void read(SourceLocation at) {
    surface_.where = at;
    const bool ccmesh = parse_.in.next().is_word("ccmesh");
    surface_.form = ccmesh ? Form::CcMesh : Form::Surface;
    if (!ccmesh) parse_.expect_word("surface");
    surface_.name = parse_.name("the name of this surface");
    read_head();
    while (parse_.in.at_word("p")) read_face();
    while (parse_.in.accept_word("derivative")) read_derivative();
    parse_.expect_end(ccmesh ? "ccmesh" : "subdivision");
    if (!ccmesh) parse_.in.accept_word("surface");
  }

 private:
  void read_head() {
    for (;;) {
      if (parse_.in.accept_word("polygon") || parse_.in.accept_word("vertex")) {
        while (parse_.at_number()) surface_.announced.push_back(parse_.integer("a size"));
      } else if (parse_.in.accept_word("texture")) {
        parse_.expect_word("space");
        parse_.expect_punct('[');
        while (!parse_.in.accept_punct(']')) {
          read_texture_rule();
          parse_.in.accept_punct(',');
        }
      } else {
        return;
      }
    }
  }

  void read_texture_rule() {
    const bool face = parse_.in.at_word("face");
    // An exporter writes "vertex" for the smooth rule.
    if (!face && !parse_.in.at_word("subdivision") && !parse_.in.at_word("vertex"))
      parse_.unexpected("'face' or 'subdivision'");
    parse_.in.next();
    surface_.texture_rules.push_back(face ? TextureRule::Face : TextureRule::Subdivision);
  }

  // p [material|label] corners [crease...] [trim N | detail ... | { ... }]...
  void read_face() {
    const SourceLocation at = parse_.in.where();
    parse_.expect_word("p");
    std::uint32_t material = parse_.tagged ? kNone : builder_.last_material;
    if (parse_.tagged && parse_.at_number())
      material = index_of(parse_);
    else if (parse_.in.at(Token::Kind::String))
      material = builder_.last_material = builder_.material_index(parse_.in.next().str());
    corners_.clear();
    while (parse_.at_number()) corners_.push_back(index_of(parse_));
    const bool valid = is_face(at);
    if (valid) add_face(material);
    const auto face = static_cast<std::uint32_t>(surface_.faces.size() - 1);
    for (;;) {
      const SourceLocation here = parse_.in.where();
      if (parse_.in.accept_word("crease")) {
        read_creases(face, valid);
        continue;
      }
      if (parse_.in.accept_word("trim")) {
        const std::uint32_t parts = index_of(parse_);
        if (valid) surface_.trims.push_back({face, parts});
        continue;
      }
      scene::UninterpretedStatement text{"", "", here};
      if (parse_.in.at_punct('{')) {
        text.keyword = "{";
        parse_.in.next();
        read_braces(text.text);
      } else if (parse_.in.at_word("detail")) {
        text.keyword = parse_.in.next().text;
        while (parse_.at_number()) append_source(text.text, parse_.in.next());
      } else {
        return;
      }
      if (valid) surface_.details.push_back({face, std::move(text)});
    }
  }

  // Reads after an opening brace, up to and including the closing brace.
  void read_braces(std::string& text) {
    for (int depth = 1; depth > 0;) {
      if (parse_.in.at_end()) parse_.unexpected("a closing brace");
      const Token token = parse_.in.next();
      depth += token.is_punct('{') ? 1 : token.is_punct('}') ? -1 : 0;
      append_source(text, token);
    }
  }

  bool is_face(SourceLocation at) const {
    const bool exist = std::all_of(corners_.begin(), corners_.end(), [this](std::uint32_t c) {
      return builder_.is_usable_vertex(c);
    });
    if (exist && corners_.size() >= 3) return true;
    parse_.warn(
        code::kBadPolygon, at,
        fmt::format("a face of \"{}\" was dropped: it {}", surface_.name,
                    exist ? "has less than three corners" : "names a vertex that does not exist"));
    return false;
  }

  void add_face(std::uint32_t material) {
    scene::PolygonList& faces = surface_.faces;
    const std::size_t before = faces.size();
    if (faces.first.empty()) faces.first.push_back(0);
    faces.indices.insert(faces.indices.end(), corners_.begin(), corners_.end());
    faces.first.push_back(static_cast<std::uint32_t>(faces.indices.size()));
    if (faces.material.empty() && material == kNone) return;
    faces.material.resize(before, kNone);
    faces.material.push_back(material);
  }

  void read_creases(std::uint32_t face, bool valid) {
    constexpr std::size_t kMaskBits = 32;
    const auto edges = static_cast<std::uint32_t>(corners_.size());
    std::uint32_t mask = kNone;
    if (surface_.form == Form::Surface) mask = index_of(parse_);
    float value = 1;
    for (std::uint32_t edge = 0; edge < edges; ++edge) {
      if (edge < kMaskBits && !(mask >> edge & 1u)) continue;
      if (parse_.at_number())
        value = parse_.real("a sharpness");
      else if (surface_.form == Form::CcMesh)
        break;
      if (valid && value > 0) surface_.creases.push_back({face, edge, std::min(value, 1.0f)});
    }
    while (parse_.at_number()) parse_.in.next();
  }

  // derivative N [space N]
  void read_derivative() {
    SubdivisionSurface::Derivative derivative{parse_.integer("an order"), {}};
    if (parse_.in.accept_word("space")) derivative.space = parse_.integer("a texture space");
    surface_.derivatives.push_back(derivative);
  }

  Parse& parse_;
  GroupBuilder& builder_;
  SubdivisionSurface& surface_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

void read_subdivision(Parse& parse, scene::PolygonGroup& group, GroupBuilder& builder,
                      SourceLocation at) {
  SubdivisionReader(parse, group, builder).read(at);
}

}  // namespace oriel::mi
