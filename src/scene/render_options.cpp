// SPDX-License-Identifier: Apache-2.0
#include "scene/render_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "scene/option_table.h"

namespace oriel::scene {
namespace {

const std::unordered_map<std::string_view, const OptionRow*>& rows_by_keyword() {
  static const auto rows = [] {
    std::unordered_map<std::string_view, const OptionRow*> map;
    for (const OptionRow& row : option_table()) map.emplace(row.keyword, &row);
    return map;
  }();
  return rows;
}

const OptionRow* find_row(const std::string& keyword) {
  const auto found = rows_by_keyword().find(keyword);
  return found == rows_by_keyword().end() ? nullptr : found->second;
}

void add_words(std::vector<OptionItem>& items, std::string_view words, const Value* value) {
  for (std::size_t at = 0; at < words.size();) {
    const auto end = std::min(words.find(' ', at), words.size());
    items.push_back({.value = value, .text = words.substr(at, end - at)});
    at = end + 1;
  }
}

/// Words of the keyword, then the values: where a reader stops calling words a keyword is its own
/// affair (`shadow segments`, `filter clip gauss`), so both look the same here.
std::vector<OptionItem> items_of(const Statement& s) {
  std::vector<OptionItem> items;
  if (!s.quoted) add_words(items, s.keyword, nullptr);
  for (const Value& v : s.values) {
    if (v.kind == Value::Kind::Numbers)
      for (const double n : v.numbers) items.push_back({.value = &v, .number = n});
    else if (v.bare)
      add_words(items, v.text, &v);
    else
      items.push_back({.value = &v, .text = v.text});
  }
  return items;
}

struct Match {
  const OptionRow* row = nullptr;
  std::size_t words = 0;  ///< items that belong to the row's keyword
};

/// The row with the longest keyword that the leading words spell.
Match find_longest(const std::vector<OptionItem>& items) {
  constexpr std::size_t kMostWords = 3;
  Match best;
  std::string keyword;
  for (std::size_t n = 0; n < std::min(items.size(), kMostWords); ++n) {
    if (items[n].text.empty()) break;
    if (n) keyword += ' ';
    keyword += items[n].text;
    if (const OptionRow* row = find_row(keyword)) best = {row, n + 1};
  }
  return best;
}

std::string describe(const OptionItem& item) {
  if (!item.value) return std::string(item.text);
  switch (item.value->kind) {
    case Value::Kind::Boolean:
      return item.value->boolean ? "on" : "off";
    case Value::Kind::Numbers:
      return fmt::format("{}", item.number);
    case Value::Kind::Text:
      return item.value->bare ? item.value->text : fmt::format("\"{}\"", item.value->text);
    case Value::Kind::Array:
      return "[...]";
    default:
      return "(other)";
  }
}

class Interpreter {
 public:
  /// `unified`: the sampling of mental ray 3.11 on is not switched off.
  Interpreter(RenderOptions& options, bool unified, Diagnostics& diagnostics)
      : options_(options), unified_(unified), diagnostics_(diagnostics) {}

  void read(const Statement& s) {
    if (s.quoted && s.keyword.starts_with(kLightGroup)) return read_light_group(s);
    std::vector<OptionItem> items = items_of(s);
    const Match match =
        s.quoted ? Match{find_row(fmt::format("\"{}\"", s.keyword)), 0} : find_longest(items);
    if (!match.row && is_of_other_method(s))
      return keep(fmt::format("\"{}\"", s.keyword), WithoutEffect::Reason::Harmless, s.where);
    if (!match.row) return s.quoted ? keep_string(s.keyword) : report_unknown(s);
    if (s.quoted && s.keyword.starts_with("samples ") && !unified_)
      return keep(match.row->keyword, WithoutEffect::Reason::Harmless, s.where);
    const auto values = std::span(items).subspan(match.words);
    if (!fits_form(match.row->form, values)) return report_misfit(s, *match.row, values);
    if (match.row->set) match.row->set(options_, OptionValues(values));
    note_effect(*match.row, OptionValues(values), s.where);
  }

  void keep(std::string_view keyword, WithoutEffect::Reason reason, SourceLocation where) {
    std::erase_if(options_.without_effect, [&](const auto& w) { return w.keyword == keyword; });
    options_.without_effect.push_back({std::string(keyword), reason, where});
  }

 private:
  static constexpr std::string_view kLightGroup = "light group ";

  /// Settings of methods that path tracing takes the place of.
  static bool is_of_other_method(const Statement& s) {
    constexpr std::string_view kFamilies[] = {
        "gi ", "environment lighting ", "progressive", "irradiance particles", "importon", "rast "};
    return s.quoted && std::any_of(std::begin(kFamilies), std::end(kFamilies),
                                   [&](std::string_view f) { return s.keyword.starts_with(f); });
  }

  /// The only string option whose keyword holds a name.
  void read_light_group(const Statement& s) {
    LightGroup group{s.keyword.substr(kLightGroup.size()), {}};
    if (s.values.size() == 1) group.patterns = split_patterns(s.values[0].text);
    const std::string complaint = light_group_complaint(group);
    if (complaint.empty()) return set_light_group(options_.light_groups, std::move(group));
    diagnostics_.warning("OR-SC-104", s.where,
                         fmt::format("\"{}\" is ignored: {}", s.keyword, complaint),
                         "expected: \"light group NAME\" \"PATTERN,PATTERN,...\"");
  }

  /// Lists a statement that does not act. One that asks for what holds anyway (`caustic off`) loses
  /// nothing and is not listed.
  void note_effect(const OptionRow& row, const OptionValues& values, SourceLocation where) {
    if (row.support == OptionSupport::Effective) return;
    if (row.support == OptionSupport::NotYet) {
      RenderOptions alone;
      row.set(alone, values);
      if (alone == RenderOptions{}) {
        std::erase_if(options_.without_effect,
                      [&](const auto& w) { return w.keyword == row.keyword; });
        return;
      }
    }
    using Reason = WithoutEffect::Reason;
    keep(row.keyword,
         row.support == OptionSupport::NotYet     ? Reason::NotYet
         : row.support == OptionSupport::Harmless ? Reason::Harmless
                                                  : Reason::Uninterpreted,
         where);
  }

  void keep_string(const std::string& name) {
    auto& known = options_.unknown_strings;
    if (std::find(known.begin(), known.end(), name) == known.end()) known.push_back(name);
  }

  void report_unknown(const Statement& s) {
    std::vector<std::string> keywords;
    for (const OptionRow& row : option_table())
      if (!row.keyword.starts_with('"')) keywords.emplace_back(row.keyword);
    const std::string near = nearest_name(s.keyword, keywords);
    diagnostics_.warning("OR-SC-102", s.where, fmt::format("unknown option '{}'", s.keyword),
                         near.empty() ? "" : fmt::format("did you mean '{}'?", near));
  }

  void report_misfit(const Statement& s, const OptionRow& row, std::span<OptionItem> values) {
    std::string found;
    for (const OptionItem& item : values) found += ' ' + describe(item);
    // A string option of the wrong type is documented to be ignored, so it is worth no warning.
    diagnostics_.report(s.quoted ? Severity::Note : Severity::Warning,
                        s.quoted ? "OR-SC-103" : "OR-SC-101", s.where,
                        fmt::format("{}{} is ignored", row.keyword, found),
                        fmt::format("expected: {} {} ({})", row.keyword, row.form, row.meaning));
  }

  RenderOptions& options_;
  bool unified_;
  Diagnostics& diagnostics_;
};

}  // namespace

float default_filter_width(FilterKind kind) {
  constexpr float kWidths[] = {1, 2, 3, 4, 4, 4, 4};
  return kWidths[static_cast<int>(kind)];
}

RenderOptions interpret_options(const Options& options, Diagnostics& diagnostics) {
  RenderOptions result;
  const Statement* unified = find_last(options.statements, "unified sampling");
  const Value* value = unified && !unified->values.empty() ? &unified->values[0] : nullptr;
  const bool off = value && (value->kind == Value::Kind::Numbers
                                 ? !value->numbers.empty() && value->numbers[0] == 0
                                 : value->kind == Value::Kind::Boolean && !value->boolean);
  Interpreter interpreter(result, !off, diagnostics);
  for (const Statement& s : options.statements) interpreter.read(s);
  for (const UninterpretedStatement& k : options.uninterpreted)
    interpreter.keep(k.keyword, WithoutEffect::Reason::Uninterpreted, k.where);
  return result;
}

}  // namespace oriel::scene
