// SPDX-License-Identifier: Apache-2.0
#include "mi/polygons.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "mi/number.h"

namespace oriel::mi {
namespace {

using scene::kNone;

// A column is empty until a vertex has the field; then it has one entry per vertex.
void put(std::vector<std::uint32_t>& column, std::size_t vertex, std::uint32_t value, Room& room,
         const char* p) {
  if (column.empty() && value == kNone) return;
  if (column.size() < vertex) column.resize(vertex, kNone);
  room.push(column, value, p);
}

void put(std::vector<std::vector<std::uint32_t>>& columns, std::size_t vertex,
         const std::vector<std::uint32_t>& values, Room& room, const char* p) {
  if (columns.size() < values.size()) columns.resize(values.size());
  for (std::size_t i = 0; i < columns.size(); ++i)
    put(columns[i], vertex, i < values.size() ? values[i] : kNone, room, p);
}

bool starts_number(char c) {
  return static_cast<unsigned char>(c - '0') < 10 || c == '-' || c == '.' || c == '+';
}

}  // namespace

Room::Room(const Source& source, const char* p, char stop, bool list_was_empty)
    : begin_(p), end_(source.end()), stop_(stop), fresh_(list_was_empty) {}

std::size_t Room::wanted(std::size_t size, const char* p) const {
  constexpr std::size_t kFirst = 64;
  // Minimum text length for a reliable mean length of an entry.
  constexpr std::ptrdiff_t kEnoughText = 1 << 14;
  const std::size_t doubled = std::max(kFirst, size * 2);
  if (!fresh_ || p < begin_ + kEnoughText || p >= end_) return doubled;
  // Searched here only, a few times per list, so that many short lists stay fast.
  const void* const found = std::memchr(p, stop_, static_cast<std::size_t>(end_ - p));
  const char* const end = found ? static_cast<const char*>(found) : end_;
  const double share = static_cast<double>(p - begin_) / static_cast<double>(end - begin_);
  // Upper bound: an entry has at least two characters.
  const std::size_t most = size + static_cast<std::size_t>(end - p) / 2 + kFirst;
  const auto expected = static_cast<std::size_t>(static_cast<double>(size) / share * 1.02);
  return std::max(size + kFirst, std::min(most, expected + kFirst));
}

void VertexRecord::clear() {
  point = normal = kNone;
  derivative.clear();
  motion.clear();
  user.clear();
  textures.clear();
  mark.reset();
}

bool GroupBuilder::usable(std::uint32_t index, Place place, std::string_view field) {
  if (index < group_.vectors.size()) return true;
  if (index != kNone)
    parse_.warn(code::kBadIndex, place.locate(),
                fmt::format("the {} of this vertex names vector {}, there are {}", field, index,
                            group_.vectors.size()));
  return false;
}

void GroupBuilder::add_vertex(const VertexRecord& v, Place place, Room& room) {
  const char* const at = place.at;
  scene::VertexList& list = group_.vertices;
  const std::size_t n = list.size();
  const auto checked = [&](std::uint32_t index, std::string_view field) {
    return usable(index, place, field) ? index : kNone;
  };
  const auto checked_all = [&](const std::vector<std::uint32_t>& indices, std::string_view field) {
    std::vector<std::uint32_t> result(indices);
    for (std::uint32_t& index : result) index = checked(index, field);
    return result;
  };
  const bool good = usable(v.point, place, "point");
  if (!good && bad_vertices_.size() <= n) bad_vertices_.resize(n + 1);
  if (!good) bad_vertices_[n] = true;
  room.push(list.point, good ? v.point : 0u, at);
  put(list.normal, n, checked(v.normal, "normal"), room, at);
  if (list.textures.size() < v.textures.size()) list.textures.resize(v.textures.size());
  for (std::size_t i = 0; i < list.textures.size(); ++i) {
    const VertexRecord::Texture t = i < v.textures.size() ? v.textures[i] : VertexRecord::Texture{};
    put(list.textures[i].coordinate, n, checked(t.coordinate, "texture"), room, at);
    put(list.textures[i].basis_u, n, checked(t.basis_u, "basis vector"), room, at);
    put(list.textures[i].basis_v, n, checked(t.basis_v, "basis vector"), room, at);
  }
  // Rare fields cost nothing for vertices without them.
  if (v.mark) {
    list.marks.push_back(*v.mark);
    list.marks.back().vertex = static_cast<std::uint32_t>(n);
  }
  if (!list.derivative.empty() || !v.derivative.empty())
    put(list.derivative, n, checked_all(v.derivative, "derivative"), room, at);
  if (!list.motion.empty() || !v.motion.empty())
    put(list.motion, n, checked_all(v.motion, "motion vector"), room, at);
  if (!list.user.empty() || !v.user.empty())
    put(list.user, n, checked_all(v.user, "user vector"), room, at);
}

std::uint32_t GroupBuilder::material_index(std::string_view name) {
  if (name.empty()) return kNone;
  auto& names = group_.materials;
  const std::string full = parse_.referenced_name(std::string(name));
  const auto found = std::find(names.begin(), names.end(), full);
  if (found == names.end()) {
    names.push_back(full);
    return static_cast<std::uint32_t>(names.size() - 1);
  }
  return static_cast<std::uint32_t>(found - names.begin());
}

void GroupBuilder::abandon_polygon() {
  scene::PolygonList& list = group_.polygons;
  list.indices.resize(polygon_begin_);
  while (!list.holes.empty() && list.holes.back() >= polygon_begin_) list.holes.pop_back();
}

// The error in the current polygon, or null.
const char* GroupBuilder::polygon_fault(std::uint32_t& culprit) const {
  const scene::PolygonList& list = group_.polygons;
  const std::size_t vertices = group_.vertices.size();
  for (std::size_t i = polygon_begin_; i < list.indices.size(); ++i) {
    culprit = list.indices[i];
    if (culprit >= vertices) return "it names vertex {}, which does not exist";
    if (culprit < bad_vertices_.size() && bad_vertices_[culprit])
      return "it uses vertex {}, which has no valid point";
  }
  std::size_t end = list.indices.size();
  for (std::size_t h = list.holes.size(); h-- > 0 && list.holes[h] >= polygon_begin_;) {
    if (end - list.holes[h] < 3) return "a hole has fewer than three corners";
    end = list.holes[h];
  }
  return end - polygon_begin_ < 3 ? "it has fewer than three corners" : nullptr;
}

void GroupBuilder::end_polygon(std::uint32_t material, Place place, Room& room) {
  scene::PolygonList& list = group_.polygons;
  std::uint32_t culprit = 0;
  if (const char* fault = polygon_fault(culprit)) {
    parse_.warn(code::kBadPolygon, place.locate(),
                "polygon dropped: " + fmt::format(fmt::runtime(fault), culprit));
    abandon_polygon();
    return;
  }
  const std::size_t index = list.size();
  if (list.first.empty()) room.push(list.first, 0u, place.at);
  room.push(list.first, static_cast<std::uint32_t>(list.indices.size()), place.at);
  put(list.material, index, material, room, place.at);
}

float big_endian_float(const char* bytes) { return std::bit_cast<float>(big_endian_int(bytes)); }

std::uint32_t big_endian_int(const char* bytes) {
  std::uint32_t bits = 0;
  for (int i = 0; i < 4; ++i) bits = bits << 8 | static_cast<unsigned char>(bytes[i]);
  return bits;
}

void read_vectors(Parse& parse, std::vector<Vec3>& vectors) {
  float xyz[3] = {};
  int have = 0;
  for (;;) {
    const char* p = parse.in.raw();
    Room room(parse.in.source(), p, 'v', vectors.empty());
    for (;;) {
      while (static_cast<unsigned char>(*p) <= ' ' && *p != 0) ++p;
      bool overflow = false;
      const char* const end = starts_number(*p) ? scan_float(p, xyz[have], overflow) : nullptr;
      if (!end) break;
      if (overflow)
        parse.warn(code::kNumberRange, parse.in.source().locate(p),
                   "this number is too large and was clamped");
      p = end;
      if (++have < 3) continue;
      room.push(vectors, Vec3(xyz[0], xyz[1], xyz[2]), p);
      have = 0;
    }
    parse.in.set_raw(p);
    // The loop may have stopped at a comment or an include; the list can continue after it.
    if (parse.at_number()) continue;
    if (have != 0 || !parse.in.at(Token::Kind::Binary)) break;
    const auto bytes = parse.in.binary(3 * sizeof(float));
    if (!bytes.empty()) {
      for (std::size_t i = 0; i < 3; ++i) {
        xyz[i] = big_endian_float(bytes.data() + 4 * i);
        if (!std::isfinite(xyz[i])) xyz[i] = 0;
      }
      vectors.emplace_back(xyz[0], xyz[1], xyz[2]);
    }
  }
  if (have != 0) parse.unexpected("another number of this vector");
}

}  // namespace oriel::mi
