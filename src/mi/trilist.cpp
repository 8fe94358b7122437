// SPDX-License-Identifier: Apache-2.0
// trilist ... end trilist in both layouts, stored as a polygon group.
//
// Old: trilist vector [V] vertex [N] p fields triangle [T] [vectors] [indices] [triangles]
// New: trilist vertex N p fields triangle T [border B] [data K M] lines triangles ...
// A line of the new layout contains the vectors of one vertex, in the order of the fields.
// Source: published grammar (versions 3.3 and 3.4).
#include <fmt/format.h>

#include <algorithm>

#include "mi/elements.h"
#include "mi/number.h"
#include "mi/polygons.h"

namespace oriel::mi {
namespace {

using scene::kNone;

// One vector or index of a vertex line: its field, and the number of its components.
struct Part {
  char field = 'p';
  int numbers = 3;
};

// Maximum number of parts per vertex; limits the memory that a small file can request.
constexpr std::size_t kMaxParts = 256;

void store(VertexRecord& vertex, char field, std::uint32_t index, bool second_basis) {
  const auto without_basis = [&]() -> VertexRecord::Texture& {
    for (VertexRecord::Texture& t : vertex.textures)
      if ((second_basis ? t.basis_v : t.basis_u) == kNone) return t;
    return vertex.textures.emplace_back();
  };
  switch (field) {
    case 'p':
      vertex.point = index;
      break;
    case 'n':
      vertex.normal = index;
      break;
    case 't':
      vertex.textures.push_back({index, kNone, kNone});
      break;
    case 'b':
      (second_basis ? without_basis().basis_v : without_basis().basis_u) = index;
      break;
    case 'd':
      vertex.derivative.push_back(index);
      break;
    case 'm':
      vertex.motion.push_back(index);
      break;
    default:
      vertex.user.push_back(index);
  }
}

class TrilistReader {
 public:
  TrilistReader(Parse& parse, scene::PolygonGroup& group)
      : parse_(parse), group_(group), builder_(parse, group) {}
  void read();

 private:
  std::size_t count(std::string_view what);
  void read_fields(bool indexed);
  void read_vertex_vectors();
  void read_vertex_indices();
  void read_triangles(bool keep);
  void read_triangle_tokens();
  void add_triangles(const std::vector<std::uint32_t>& corners,
                     const std::vector<std::uint32_t>& labels);
  void add_vertices_of_lines();
  void read_rest();
  std::vector<std::uint32_t> read_integers(std::size_t expected);
  void complain(SourceLocation at, std::string_view what, std::size_t found, std::size_t wanted) {
    parse_.diagnostics.error(
        code::kBadCount, at,
        fmt::format("this trilist announces {} {} and has {}", wanted, what, found));
  }

  Parse& parse_;
  scene::PolygonGroup& group_;
  GroupBuilder builder_;
  std::vector<Part> parts_;
  std::size_t vertices_ = 0, triangles_ = 0;
};

// `[N]` in the old layout, `N` in the new one.
std::size_t TrilistReader::count(std::string_view what) {
  const bool bracketed = parse_.in.accept_punct('[');
  const double value = parse_.number(what);
  if (bracketed) parse_.expect_punct(']');
  return value > 0 && value < 4294967295.0 ? static_cast<std::size_t>(value) : 0;
}

// n | d | d2 | m [k] | b [k] | t [k | sizes] | u [k | sizes]
void TrilistReader::read_fields(bool indexed) {
  parts_.push_back({'p', 3});
  while (parse_.in.at(Token::Kind::Word) && !parse_.in.at_word("triangle")) {
    const Token token = parse_.in.next();
    const std::string_view word = token.text;
    std::vector<int> sizes;
    while (parse_.at_number()) sizes.push_back(std::clamp(parse_.integer("a size"), 0, 256));
    const auto repeat = [&](int otherwise) {
      for (int i = 0; i < (sizes.empty() ? otherwise : sizes[0]); ++i)
        parts_.push_back({word[0], 3});
    };
    if (word == "n") {
      parts_.push_back({'n', 3});
    } else if (word == "d" || word == "d2") {
      for (int i = 0; i < (word == "d" ? 2 : 3); ++i) parts_.push_back({'d', 3});
    } else if (word == "m" || word == "b" || ((word == "t" || word == "u") && indexed)) {
      repeat(word == "b" ? 2 : 1);
    } else if (word == "t" || word == "u") {
      if (sizes.empty()) sizes.push_back(word == "t" ? 2 : 1);
      for (const int size : sizes)
        if (size > 0) parts_.push_back({word[0], size});
    } else {
      parse_.warn(code::kUnknownStatement, parse_.in.locate(token),
                  fmt::format("unknown vertex field {}", parse_.shown(token)));
    }
    if (parts_.size() > kMaxParts) parse_.unexpected("fewer fields per vertex");
  }
}

// Reads the lines of the new layout: vertex i has parts_.size() consecutive vectors.
void TrilistReader::read_vertex_vectors() {
  const SourceLocation at = parse_.in.where();
  std::size_t width = 0;
  for (const Part& part : parts_) width += static_cast<std::size_t>(part.numbers);
  float xyz[3] = {};
  int number = 0;
  std::size_t part = 0;
  const char* p = nullptr;
  std::optional<Room> room;
  const auto take = [&](float value) {
    if (number < 3) xyz[number] = value;
    if (++number < parts_[part].numbers) return;
    room->push(group_.vectors, Vec3(xyz[0], xyz[1], xyz[2]), p);
    xyz[0] = xyz[1] = xyz[2] = 0;
    number = 0;
    part = (part + 1) % parts_.size();
  };
  if (parse_.in.accept_word("scalar")) {
    room.emplace(parse_.in.source(), parse_.in.source().end(), ']', false);
    p = parse_.in.source().end();
    const auto bytes = parse_.in.binary(vertices_ * width * sizeof(float));
    for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4) {
      const float value = big_endian_float(bytes.data() + i);
      take(std::isfinite(value) ? value : 0.0f);
    }
  } else {
    parse_.expect_punct('[');
    do {
      p = parse_.in.raw();
      room.emplace(parse_.in.source(), p, ']', group_.vectors.empty());
      for (;;) {
        p = skip_blanks(p);
        float value = 0;
        bool overflow = false;
        const char* const end = scan_float(p, value, overflow);
        if (!end) break;
        if (overflow)
          parse_.warn(code::kNumberRange, parse_.in.source().locate(p),
                      "this number is too large and was clamped");
        p = end;
        take(value);
      }
      parse_.in.set_raw(p);
    } while (parse_.at_number());
    parse_.expect_punct(']');
  }
  const std::size_t found = group_.vectors.size() / parts_.size();
  if (found != vertices_ || part != 0 || number != 0) complain(at, "vertices", found, vertices_);
  vertices_ = std::min(found, vertices_);
  group_.vectors.resize(vertices_ * parts_.size());
}

void TrilistReader::add_vertices_of_lines() {
  Room room(parse_.in.source(), parse_.in.source().end(), ' ', false);
  const Place place{&parse_.in.source(), parse_.in.raw()};
  VertexRecord vertex;
  group_.vertices.point.reserve(vertices_);
  for (std::size_t i = 0; i < vertices_; ++i) {
    vertex.clear();
    bool second = false;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      store(vertex, parts_[k].field, static_cast<std::uint32_t>(i * parts_.size() + k), second);
      second = parts_[k].field == 'b' && !second;
    }
    builder_.add_vertex(vertex, place, room);
  }
}

// [ ints ] or integer `bytes`.
std::vector<std::uint32_t> TrilistReader::read_integers(std::size_t expected) {
  std::vector<std::uint32_t> result;
  if (parse_.in.accept_word("integer")) {
    const auto bytes = parse_.in.binary(expected * 4);
    result.reserve(bytes.size() / 4);
    for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4)
      result.push_back(big_endian_int(bytes.data() + i));
    return result;
  }
  parse_.expect_punct('[');
  do {
    const char* p = parse_.in.raw();
    Room room(parse_.in.source(), p, ']', result.empty());
    for (;;) {
      p = skip_blanks(p);
      std::uint32_t index = 0;
      const char* const end = scan_index(p, index);
      if (!end) break;
      p = end;
      room.push(result, index, p);
    }
    parse_.in.set_raw(p);
    if (parse_.at_number()) {
      const double value = parse_.in.next().number;
      result.push_back(value >= 0 && value < kNone ? static_cast<std::uint32_t>(value) : kNone - 1);
    }
  } while (!parse_.in.at_punct(']') && parse_.at_number());
  parse_.expect_punct(']');
  return result;
}

void TrilistReader::read_vertex_indices() {
  const SourceLocation at = parse_.in.where();
  const std::vector<std::uint32_t> indices = read_integers(vertices_ * parts_.size());
  const std::size_t found = indices.size() / parts_.size();
  if (found * parts_.size() != indices.size() || found != vertices_)
    complain(at, "vertices", found, vertices_);
  Room room(parse_.in.source(), parse_.in.source().end(), ' ', false);
  const Place place{&parse_.in.source(), parse_.in.raw()};
  VertexRecord vertex;
  vertices_ = std::min(found, vertices_);
  for (std::size_t i = 0; i < vertices_; ++i) {
    vertex.clear();
    bool second = false;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      store(vertex, parts_[k].field, indices[i * parts_.size() + k], second);
      second = parts_[k].field == 'b' && !second;
    }
    builder_.add_vertex(vertex, place, room);
  }
}

// Adds triangles from three corners each. `labels` is empty or has one label per triangle.
void TrilistReader::add_triangles(const std::vector<std::uint32_t>& corners,
                                  const std::vector<std::uint32_t>& labels) {
  const Place place{&parse_.in.source(), parse_.in.raw()};
  Room room(parse_.in.source(), place.source->end(), ' ', false);
  group_.polygons.indices.reserve(corners.size());
  group_.polygons.first.reserve(corners.size() / 3 + 1);
  for (std::size_t i = 0; i + 3 <= corners.size(); i += 3) {
    builder_.begin_polygon();
    for (std::size_t k = 0; k < 3; ++k) builder_.corner(corners[i + k], place.at, room);
    const bool labelled = parse_.tagged && i / 3 < labels.size();
    builder_.end_polygon(labelled ? labels[i / 3] : kNone, place, room);
  }
}

// [ "material" i j k [["material"] i j k]... ]
void TrilistReader::read_triangle_tokens() {
  Room room(parse_.in.source(), parse_.in.source().end(), ' ', false);
  std::uint32_t material = kNone;
  while (!parse_.in.accept_punct(']')) {
    const Token token = parse_.in.peek();
    const Place place{token.source, token.raw.data()};
    if (token.is_name()) material = builder_.material_index(parse_.in.next().str());
    builder_.begin_polygon();
    for (int k = 0; k < 3; ++k) {
      const double index = parse_.number("a corner of a triangle");
      builder_.corner(index >= 0 && index < kNone ? static_cast<std::uint32_t>(index) : kNone - 1,
                      place.at, room);
    }
    builder_.end_polygon(material, place, room);
  }
}

void TrilistReader::read_triangles(bool keep) {
  const SourceLocation at = parse_.in.where();
  if (parse_.in.at_word("integer")) {
    const std::vector<std::uint32_t> corners = read_integers(triangles_ * 3);
    std::vector<std::uint32_t> labels;
    if (parse_.in.at_word("integer")) labels = read_integers(triangles_);
    if (keep) add_triangles(corners, labels);
    return;
  }
  const char* p = parse_.in.raw();
  if (*p == '[') {
    // The list may contain names; then its first token is one.
    parse_.expect_punct('[');
    if (parse_.in.peek().is_name()) return read_triangle_tokens();
    parse_.in.set_raw(p);
    parse_.in.drop_lookahead();
  }
  const std::vector<std::uint32_t> flat = read_integers(triangles_ * 4);
  const std::size_t n = triangles_;
  if (flat.size() != 4 * n && flat.size() != 3 * n)
    complain(at, "triangles", flat.size() / (flat.size() % 4 == 0 ? 4 : 3), n);
  if (!keep) return;
  const bool labelled = flat.size() == 4 * n || (flat.size() != 3 * n && flat.size() % 4 == 0);
  if (!labelled) return add_triangles(flat, {});
  std::vector<std::uint32_t> corners, labels;
  corners.reserve(flat.size() / 4 * 3);
  if (parse_.tagged) labels.reserve(flat.size() / 4);
  for (std::size_t i = 0; i + 4 <= flat.size(); i += 4) {
    if (parse_.tagged) labels.push_back(flat[i]);
    corners.insert(corners.end(), {flat[i + 1], flat[i + 2], flat[i + 3]});
  }
  add_triangles(corners, labels);
}

// Skips data per triangle and topology, which the scene does not store.
void TrilistReader::read_rest() {
  bool reported = false;
  while (!parse_.in.at_word("end")) {
    if (!reported)
      parse_.diagnostics.note(code::kIgnored, parse_.in.where(),
                              "data of triangles behind a trilist is not kept");
    reported = true;
    if (parse_.in.at_punct('[')) {
      std::string ignored;
      keep_brackets(parse_, ignored);
    } else if (parse_.in.at(Token::Kind::Word) || parse_.in.at(Token::Kind::Binary)) {
      parse_.in.next();
    } else {
      parse_.unexpected("'end trilist'");
    }
  }
  parse_.expect_end("trilist");
}

void TrilistReader::read() {
  const bool indexed = parse_.in.accept_word("vector");
  if (indexed) count("the number of vectors");
  parse_.expect_word("vertex");
  vertices_ = count("the number of vertices");
  parse_.expect_word("p");
  read_fields(indexed);
  parse_.expect_word("triangle");
  triangles_ = count("the number of triangles");
  std::size_t border = 0;
  if (parse_.in.accept_word("border")) border = count("the number of border triangles");
  if (parse_.in.accept_word("data")) {
    parse_.number("a count");
    parse_.number("a size");
  }
  if (indexed) {
    parse_.expect_punct('[');
    read_vectors(parse_, group_.vectors);
    parse_.expect_punct(']');
    read_vertex_indices();
  } else {
    read_vertex_vectors();
    add_vertices_of_lines();
  }
  read_triangles(true);
  if (border > 0 && !parse_.in.at_word("end")) {
    triangles_ = border;
    read_triangles(false);
  }
  read_rest();
}

}  // namespace

void read_trilist(Parse& parse, scene::Object& object, SourceLocation at) {
  scene::PolygonGroup& group = object.groups.emplace_back();
  group.where = at;
  TrilistReader(parse, group).read();
}

}  // namespace oriel::mi
