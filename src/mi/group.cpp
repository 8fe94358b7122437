// SPDX-License-Identifier: Apache-2.0
// group ["name"] vectors vertices polygons end group
#include <algorithm>
#include <cstring>

#include "mi/elements.h"
#include "mi/freeform.h"
#include "mi/number.h"
#include "mi/polygons.h"
#include "mi/statements.h"
#include "mi/subdivision.h"

namespace oriel::mi {
namespace {

using scene::kNone;

constexpr std::string_view kGroupWords[] = {
    "v",     "p",       "c",       "cp",      "strip",       "fan",     "merge",
    "curve", "surface", "space",   "connect", "subdivision", "ccmesh",  "approximate",
    "basis", "end",     "visible", "trace",   "shadow",      "caustic", "globillum"};

bool is_group_word(std::string_view word) {
  return std::find(std::begin(kGroupWords), std::end(kGroupWords), word) != std::end(kGroupWords);
}

// Whether c ends a one-letter keyword before it, by the rules of the lexer.
bool ends_word(char c) {
  const auto u = static_cast<unsigned char>(c);
  return !((u >= '0' && u <= '9') || ((u | 0x20) >= 'a' && (u | 0x20) <= 'z') || u == '_' ||
           u >= 0x80);
}

bool is_digit(char c) { return static_cast<unsigned char>(c - '0') < 10; }

// Scans up to `most` indices and moves p past them. Returns their number, or -1 for an index in
// another form.
int scan_indices(const char*& p, std::uint32_t* out, int most) {
  int count = 0;
  while (count < most) {
    const char* const q = skip_blanks(p);
    if (!is_digit(*q)) break;
    const char* const end = scan_index(q, out[count]);
    if (!end) return -1;
    p = end;
    ++count;
  }
  return count;
}

void add_field(VertexRecord& vertex, char field, const std::uint32_t* index, int count) {
  switch (field) {
    case 'n':
      vertex.normal = index[0];
      break;
    case 't':
      vertex.textures.push_back(
          {index[0], count == 3 ? index[1] : kNone, count == 3 ? index[2] : kNone});
      break;
    case 'd':
      vertex.derivative.insert(vertex.derivative.end(), index, index + count);
      break;
    case 'm':
      vertex.motion.insert(vertex.motion.end(), index, index + count);
      break;
    default:
      vertex.user.insert(vertex.user.end(), index, index + count);
  }
}

constexpr int kMaxFieldIndices = 8;

/// Whether text begins a vertex mark of a subdivision surface: cusp, conic, corner, dart.
bool is_mark(const char* q) {
  return std::memcmp(q, "cus", 3) == 0 || std::memcmp(q, "coni", 4) == 0 ||
         std::memcmp(q, "cor", 3) == 0 || std::memcmp(q, "dar", 3) == 0;
}

bool is_field(char c) { return c == 'n' || c == 't' || c == 'd' || c == 'm' || c == 'u'; }
int most_indices(char field) {
  return field == 'n' ? 1 : field == 't' ? 3 : field == 'd' ? 5 : kMaxFieldIndices;
}

// Fast path of read_vertex(): scans a vertex in the usual form after its `v`. Returns null for any
// other form; the caller then reads the vertex from its start.
const char* scan_vertex(const char* p, VertexRecord& vertex) {
  vertex.clear();
  std::uint32_t index[kMaxFieldIndices];
  if (scan_indices(p, &vertex.point, 1) != 1) return nullptr;
  for (;;) {
    const char* const q = skip_blanks(p);
    if (!is_field(*q) || static_cast<unsigned char>(q[1]) > ' ') break;
    const char field = *q;
    p = q + 1;
    const int count = scan_indices(p, index, most_indices(field));
    if (count < 1) return nullptr;
    add_field(vertex, field, index, count);
  }
  // A comment or directive inside the vertex: further fields may follow it.
  const char* const q = skip_blanks(p);
  return *q == '#' || *q == '$' || *q == 0 || is_digit(*q) || is_mark(q) ? nullptr : p;
}

// cusp|conic|corner [level N] | dart
scene::VertexMark read_mark(Parse& parse) {
  using Kind = scene::VertexMark::Kind;
  scene::VertexMark mark;
  const Token word = parse.in.next();
  mark.kind = word.is_word("cusp")    ? Kind::Cusp
              : word.is_word("conic") ? Kind::Conic
              : word.is_word("dart")  ? Kind::Dart
                                      : Kind::Corner;
  if (parse.in.accept_word("level")) mark.level = std::max(0, parse.integer("a level"));
  return mark;
}

// General path: reads a vertex token by token.
void read_vertex(Parse& parse, VertexRecord& vertex) {
  vertex.clear();
  vertex.point = index_of(parse);
  while (parse.in.at(Token::Kind::Word)) {
    const std::string_view word = parse.in.peek().text;
    if (word == "cusp" || word == "conic" || word == "corner" || word == "dart") {
      vertex.mark = read_mark(parse);
      continue;
    }
    if (word.size() != 1 || !is_field(word[0])) return;
    const char field = word[0];
    parse.in.next();
    std::uint32_t index[kMaxFieldIndices] = {index_of(parse)};
    int count = 1;
    while (count < most_indices(field) && parse.at_number()) index[count++] = index_of(parse);
    add_field(vertex, field, index, count);
  }
}

class GroupReader {
 public:
  GroupReader(Parse& parse, scene::Object& object, scene::PolygonGroup& group)
      : parse_(parse), object_(object), group_(group), builder_(parse, group) {}
  void read_body();

 private:
  void read_vertices();
  void read_polygons();
  const char* scan_polygon(const char* p, Room& room);
  void read_polygon(Room& room);
  void read_strip(bool fan);
  void read_mesh_name(std::uint32_t& material);
  bool read_freeform(SourceLocation at);
  void read_flags_of_approximation(SourceLocation at);

  Parse& parse_;
  scene::Object& object_;
  scene::PolygonGroup& group_;
  GroupBuilder builder_;
  std::string_view last_name_;  // last material name, compared before a search
};

void GroupReader::read_vertices() {
  VertexRecord vertex;
  const char* p = parse_.in.raw();
  Room room(parse_.in.source(), p, 'p', group_.vertices.point.empty());
  for (;;) {
    p = skip_blanks(p);
    if (*p != 'v' || !ends_word(p[1])) break;
    const Place place{&parse_.in.source(), p};
    const char* const end = scan_vertex(p + 1, vertex);
    if (!end) {
      parse_.in.set_raw(p);
      parse_.expect_word("v");
      read_vertex(parse_, vertex);
    }
    builder_.add_vertex(vertex, place, room);
    p = end ? end : parse_.in.raw();
  }
  parse_.in.set_raw(p);
}

// Fast path of read_polygon(). Returns null for any other form, without changes to the group.
const char* GroupReader::scan_polygon(const char* p, Room& room) {
  const Place place{&parse_.in.source(), p};
  p = skip_blanks(p + (p[0] == 'c' && p[1] == 'p' ? 2 : 1));
  std::uint32_t material = parse_.tagged ? kNone : builder_.last_material;
  std::string_view name;
  const bool named = *p == '"';
  if (parse_.tagged && is_digit(*p)) {
    p = scan_index(p, material);
  } else if (named) {
    const char* const begin = p + 1;
    for (++p; *p != '"' && *p != '\\' && *p != '\n' && *p != '\r' && *p != 0;) ++p;
    if (*p != '"') return nullptr;
    name = {begin, static_cast<std::size_t>(p - begin)};
    if (name != last_name_ || last_name_.data() == nullptr) {
      builder_.last_material = builder_.material_index(name);
      last_name_ = name;
    }
    material = builder_.last_material;
    ++p;
  } else if (!is_digit(*p)) {
    return nullptr;  // e.g. an unquoted name
  }
  if (!p || (parse_.tagged && named)) return nullptr;

  builder_.begin_polygon();
  for (;;) {
    const char* const q = skip_blanks(p);
    if (is_digit(*q)) {
      std::uint32_t index = 0;
      const char* const end = scan_index(q, index);
      if (!end) break;
      builder_.corner(index, q, room);
      p = end;
    } else if (std::memcmp(q, "hole", 4) == 0 && static_cast<unsigned char>(q[4]) <= ' ') {
      builder_.begin_hole();
      p = q + 4;
    } else if (*q >= 'a' && *q <= 'z') {
      builder_.end_polygon(material, place, room);
      return q;
    } else {
      break;
    }
  }
  builder_.abandon_polygon();
  return nullptr;
}

void GroupReader::read_mesh_name(std::uint32_t& material) {
  material = parse_.tagged ? kNone : builder_.last_material;
  if (parse_.tagged && parse_.at_number()) {
    material = index_of(parse_);
  } else if (parse_.in.peek().is_name()) {
    const SourceLocation at = parse_.in.where();
    const std::string name = parse_.in.next().str();
    if (parse_.tagged) {
      parse_.warn(code::kSyntax, at, "a tagged object requires labels, not names of materials",
                  "the instance's material list is indexed by the label");
      return;
    }
    material = builder_.last_material = builder_.material_index(name);
    last_name_ = {};
  }
}

void GroupReader::read_polygon(Room& room) {
  const Token keyword = parse_.in.next();
  const Place place{keyword.source, keyword.raw.data()};
  std::uint32_t material = kNone;
  read_mesh_name(material);
  builder_.begin_polygon();
  const char* const p = place.at;
  while (parse_.at_number() || parse_.in.at_word("hole")) {
    if (parse_.in.accept_word("hole"))
      builder_.begin_hole();
    else
      builder_.corner(index_of(parse_), p, room);
  }
  builder_.end_polygon(material, place, room);
}

void GroupReader::read_polygons() {
  const char* p = parse_.in.raw();
  Room room(parse_.in.source(), p, 'e', group_.polygons.indices.empty());
  for (;;) {
    p = skip_blanks(p);
    const bool polygon = ((*p == 'p' || *p == 'c') && ends_word(p[1])) ||
                         (*p == 'c' && p[1] == 'p' && ends_word(p[2]));
    if (!polygon) break;
    const char* const end = scan_polygon(p, room);
    if (!end) {
      parse_.in.set_raw(p);
      read_polygon(room);
    }
    p = end ? end : parse_.in.raw();
  }
  parse_.in.set_raw(p);
}

// Converts a strip or fan to triangles. Every second triangle of a strip is reversed to preserve
// the orientation.
void GroupReader::read_strip(bool fan) {
  const Token keyword = parse_.in.next();
  const Place place{keyword.source, keyword.raw.data()};
  std::uint32_t material = kNone;
  read_mesh_name(material);
  const char* const p = place.at;
  Room room(*place.source, p, 'e', false);
  std::uint32_t first = 0, before = 0;
  for (std::uint32_t count = 0; parse_.at_number(); ++count) {
    const std::uint32_t vertex = index_of(parse_);
    if (count >= 2) {
      const bool turned = !fan && count % 2 == 1;
      builder_.begin_polygon();
      builder_.corner(turned ? before : first, p, room);
      builder_.corner(turned ? first : before, p, room);
      builder_.corner(vertex, p, room);
      builder_.end_polygon(material, place, room);
    }
    if (count == 0 || !fan) first = count == 0 ? vertex : before;
    before = vertex;
  }
}

bool GroupReader::read_freeform(SourceLocation at) {
  if (parse_.in.accept_word("surface")) {
    read_surface(parse_, object_, group_, builder_, at);
    last_name_ = {};
  } else if (parse_.in.accept_word("space")) {
    parse_.expect_word("curve");
    read_curve(parse_, object_, group_, true, at);
  } else if (parse_.in.accept_word("curve")) {
    read_curve(parse_, object_, group_, false, at);
  } else if (parse_.in.accept_word("connect")) {
    read_connection(parse_, group_, at);
  } else if (parse_.in.accept_word("basis")) {
    read_basis(parse_, object_, at);
  } else {
    return false;
  }
  return true;
}

// visible trace approximate ...
void GroupReader::read_flags_of_approximation(SourceLocation at) {
  std::string keyword;
  while (!parse_.in.at_word("approximate")) {
    const std::string_view word = parse_.in.peek().text;
    if (word != "visible" && word != "trace" && word != "shadow" && word != "caustic" &&
        word != "globillum")
      parse_.unexpected("'approximate'");
    keyword += std::string(parse_.in.next().text) + " ";
  }
  parse_.in.next();
  group_.settings.push_back(read_approximate(parse_, keyword + "approximate", at));
}

void GroupReader::read_body() {
  for (;;) {
    const Token token = parse_.in.peek();
    const SourceLocation at = parse_.in.where();
    if (token.kind == Token::Kind::Number || token.kind == Token::Kind::Binary) {
      read_vectors(parse_, group_.vectors);
    } else if (token.is_word("v")) {
      read_vertices();
    } else if (token.is_word("p") || token.is_word("c") || token.is_word("cp")) {
      read_polygons();
    } else if (token.is_word("strip") || token.is_word("fan")) {
      read_strip(token.is_word("fan"));
    } else if (token.is_word("subdivision") || token.is_word("ccmesh")) {
      read_subdivision(parse_, group_, builder_, at);
      last_name_ = {};
    } else if (token.is_word("end")) {
      return;
    } else if (token.is_word("merge")) {
      parse_.in.next();
      // One number at most: vectors may follow directly.
      group_.settings.push_back({"merge", false, {read_numbers(parse_, 1)}, at});
    } else if (token.is_word("approximate") || token.is_word("visible") || token.is_word("trace") ||
               token.is_word("shadow") || token.is_word("caustic") || token.is_word("globillum")) {
      read_flags_of_approximation(at);
    } else if (!read_freeform(at)) {
      static const std::vector<std::string> names(std::begin(kGroupWords), std::end(kGroupWords));
      parse_.unexpected("vectors, vertices, polygons or 'end group'", names);
    }
  }
}

}  // namespace

void read_group(Parse& parse, scene::Object& object, SourceLocation at) {
  scene::PolygonGroup& group = object.groups.emplace_back();
  group.where = at;
  const Token token = parse.in.peek();
  if (token.kind == Token::Kind::String ||
      (token.kind == Token::Kind::Word && !is_group_word(token.text)))
    group.name = parse.in.next().str();
  GroupReader(parse, object, group).read_body();
  parse.expect_end("group");
}

}  // namespace oriel::mi
