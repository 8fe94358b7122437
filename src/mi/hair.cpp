// SPDX-License-Identifier: Apache-2.0
// hair options... hair fields vertex fields scalar [N] numbers hair [M] offsets end hair
#include <fmt/format.h>

#include <algorithm>

#include "mi/elements.h"
#include "mi/number.h"
#include "mi/polygons.h"

namespace oriel::mi {
namespace {

using scene::Hair;
using Kind = Hair::Field::Kind;

// Limits the memory that the field counts of a small file can request.
constexpr int kMaxNumbers = 256;

class HairReader {
 public:
  HairReader(Parse& parse, Hair& hair) : parse_(parse), hair_(hair) {}

  void read() {
    for (;;) {
      if (parse_.in.accept_word("material"))
        hair_.material = parse_.referenced_name(parse_.name("the name of a material"));
      else if (parse_.in.accept_word("radius"))
        hair_.radius = std::max(0.0f, parse_.real("a radius"));
      else if (parse_.in.accept_word("approximate"))
        hair_.approximate = parse_.integer("a number of pieces");
      else if (parse_.in.accept_word("degree"))
        hair_.degree = std::clamp(parse_.integer("a degree"), 1, 3);
      else if (parse_.in.accept_word("max"))
        read_max();
      else if (parse_.in.accept_word("vertex"))
        read_fields(hair_.per_vertex);
      else if (parse_.in.accept_word("scalar"))
        read_scalars();
      else if (parse_.in.accept_word("hair"))
        parse_.in.at_punct('[') || parse_.at_number() ? read_offsets()
                                                      : read_fields(hair_.per_hair);
      else
        break;
    }
    parse_.expect_end("hair");
    check();
  }

 private:
  void read_max() {
    if (parse_.in.accept_word("depth")) {
      hair_.max_depth = parse_.integer("a depth");
    } else {
      parse_.expect_word("size");
      hair_.max_size = parse_.integer("a size");
    }
  }

  // n | m [N] | t [N] | radius | u [N]
  void read_fields(std::vector<Hair::Field>& fields) {
    constexpr std::pair<std::string_view, Kind> kWords[] = {{"n", Kind::Normal},
                                                            {"m", Kind::Motion},
                                                            {"t", Kind::Texture},
                                                            {"radius", Kind::Radius},
                                                            {"u", Kind::User}};
    for (;;) {
      const auto* word = std::find_if(std::begin(kWords), std::end(kWords),
                                      [this](auto& w) { return parse_.in.at_word(w.first); });
      if (word == std::end(kWords)) return;
      // `radius 0.1` is the radius of all hairs, which may follow the fields.
      parse_.in.next();
      Hair::Field field{word->second, 1};
      if (parse_.at_number()) {
        if (field.kind == Kind::Radius) {
          hair_.radius = std::max(0.0f, parse_.real("a radius"));
          continue;
        }
        field.count = std::clamp(parse_.integer("a number"), 0, kMaxNumbers);
      }
      fields.push_back(field);
      if (fields.size() > kMaxNumbers) parse_.unexpected("fewer fields");
    }
  }

  /// `[N]`; some files omit the brackets.
  std::size_t count() {
    const bool bracketed = parse_.in.accept_punct('[');
    const double value = parse_.number("how many there are");
    if (bracketed) parse_.expect_punct(']');
    return value > 0 && value < scene::kNone ? static_cast<std::size_t>(value) : 0;
  }

  void complain(SourceLocation at, std::string_view what, std::size_t found, std::size_t wanted) {
    if (found != wanted)
      parse_.diagnostics.error(
          code::kBadCount, at,
          fmt::format("this hair announces {} {} and has {}", wanted, what, found));
  }

  void read_scalars() {
    const SourceLocation at = parse_.in.where();
    const std::size_t wanted = count();
    std::vector<float>& list = hair_.scalars;
    if (parse_.in.at(Token::Kind::Binary)) {
      const auto bytes = parse_.in.binary(wanted * sizeof(float));
      list.reserve(bytes.size() / 4);
      for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4)
        list.push_back(big_endian_float(bytes.data() + i));
    } else {
      while (parse_.at_number()) {
        const char* p = parse_.in.raw();
        Room room(parse_.in.source(), p, 'h', list.empty());
        for (;;) {
          p = skip_blanks(p);
          float value = 0;
          bool overflow = false;
          const char* const end = scan_float(p, value, overflow);
          if (!end) break;
          p = end;
          room.push(list, value, p);
        }
        parse_.in.set_raw(p);
      }
    }
    std::replace_if(
        list.begin(), list.end(), [](float f) { return !std::isfinite(f); }, 0.0f);
    complain(at, "numbers", list.size(), wanted);
  }

  void read_offsets() {
    const SourceLocation at = parse_.in.where();
    const std::size_t wanted = count();
    std::vector<std::uint32_t>& list = hair_.first;
    if (parse_.in.at(Token::Kind::Binary)) {
      const auto bytes = parse_.in.binary(wanted * 4);
      list.reserve(bytes.size() / 4);
      for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4)
        list.push_back(big_endian_int(bytes.data() + i));
    } else {
      while (parse_.at_number()) {
        const double value = parse_.in.next().number;
        list.push_back(value >= 0 && value < scene::kNone ? static_cast<std::uint32_t>(value)
                                                          : scene::kNone);
      }
    }
    complain(at, "offsets", list.size(), wanted);
  }

  /// Drops hairs with numbers out of range, so that each hair is a valid span of the scalars.
  void check() {
    std::vector<std::uint32_t>& first = hair_.first;
    const auto good = std::is_sorted_until(first.begin(), first.end());
    const auto end = std::find_if(first.begin(), good,
                                  [&](std::uint32_t i) { return i > hair_.scalars.size(); });
    if (end == first.end()) return;
    parse_.warn(code::kBadIndex, hair_.where,
                fmt::format("{} of {} hairs name numbers that do not exist; dropped",
                            first.end() - end, hair_.size()));
    first.erase(end, first.end());
  }

  Parse& parse_;
  Hair& hair_;
};

}  // namespace

void read_hair(Parse& parse, scene::Object& object, SourceLocation at) {
  Hair& hair = object.hairs.emplace_back();
  hair.where = at;
  HairReader(parse, hair).read();
}

}  // namespace oriel::mi
