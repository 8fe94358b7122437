// SPDX-License-Identifier: Apache-2.0
#include "scene/render_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "scene/option_table.h"

namespace oriel::scene {
namespace {

std::string describe(const FormItem& item) {
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
  using Table = ElementTable<RenderOptions>;

 public:
  Interpreter(RenderOptions& options, Diagnostics& diagnostics)
      : options_(options), diagnostics_(diagnostics) {}

  void read(const Statement& s) {
    if (s.quoted && s.keyword.starts_with(kLightGroup)) return read_light_group(s);
    const auto match = option_table().match(s, items_);
    if (!match.row && is_of_other_method(s))
      return keep(fmt::format("\"{}\"", s.keyword), Support::Harmless, s.where);
    if (!match.row) return s.quoted ? keep_string(s.keyword) : report_unknown(s);
    if (s.quoted && s.keyword.starts_with("samples ") && !unified_)
      return keep(match.row->keyword, Support::Harmless, s.where);
    if (!match.fits) return report_misfit(s, *match.row, match.values);
    const StatementValues values(match.values, s.where);
    Table::set(*match.row, options_, values);
    note_effect(*match.row, values);
  }

  /// `"unified sampling"` affects the meaning of other statements before and after it.
  void read_unified_sampling(const Statement& s) {
    if (!s.quoted || s.keyword != "unified sampling") return;
    const auto match = option_table().match(s, items_);
    if (match.fits) Table::set(*match.row, options_, {match.values, s.where});
    unified_ = options_.unified_sampling;
  }

  void keep(std::string_view keyword, Support support, SourceLocation where) {
    std::erase_if(options_.without_effect, [&](const auto& w) { return w.keyword == keyword; });
    options_.without_effect.push_back({std::string(keyword), support, where});
  }

 private:
  static constexpr std::string_view kLightGroup = "light group ";

  /// Settings of methods that path tracing replaces.
  static bool is_of_other_method(const Statement& s) {
    constexpr std::string_view kFamilies[] = {
        "gi ", "environment lighting ", "progressive", "irradiance particles", "importon", "rast "};
    return s.quoted && std::any_of(std::begin(kFamilies), std::end(kFamilies),
                                   [&](std::string_view f) { return s.keyword.starts_with(f); });
  }

  /// The only string option with a name in its keyword.
  void read_light_group(const Statement& s) {
    LightGroup group{s.keyword.substr(kLightGroup.size()), {}};
    if (s.values.size() == 1) group.patterns = split_patterns(s.values[0].text);
    const std::string complaint = light_group_complaint(group);
    if (complaint.empty()) return set_light_group(options_.light_groups, std::move(group));
    diagnostics_.warning("OR-SC-104", s.where,
                         fmt::format("\"{}\" is ignored: {}", s.keyword, complaint),
                         "expected: \"light group NAME\" \"PATTERN,PATTERN,...\"");
  }

  /// Records a statement without effect, unless it sets the default (`caustic off`).
  void note_effect(const StatementRow& row, const StatementValues& values) {
    if (row.support == Support::Effective) return;
    const std::string name = name_of(row);
    if (row.support == Support::NotYet) {
      RenderOptions alone;
      Table::set(row, alone, values);
      if (alone == RenderOptions{}) {
        std::erase_if(options_.without_effect, [&](const auto& w) { return w.keyword == name; });
        return;
      }
    }
    keep(name, row.support, values.where());
  }

  void keep_string(const std::string& name) {
    auto& known = options_.unknown_strings;
    if (std::find(known.begin(), known.end(), name) == known.end()) known.push_back(name);
  }

  void report_unknown(const Statement& s) {
    std::vector<std::string> keywords;
    for (const StatementRow& row : option_table().rows())
      if (!is_string_option(row)) keywords.push_back(name_of(row));
    const std::string near = nearest_name(s.keyword, keywords);
    diagnostics_.warning("OR-SC-102", s.where, fmt::format("unknown option '{}'", s.keyword),
                         near.empty() ? "" : fmt::format("did you mean '{}'?", near));
  }

  /// "; did you mean box?" for a value that is near a word of the row.
  static std::string nearest_word(const Statement& s, const StatementRow& row) {
    std::vector<std::string> words;
    std::string word;
    for (const char c : std::string(row.form) + " ") {
      const bool letter = c != ' ' && c != '|' && c != '[' && c != ']';
      if (letter)
        word += c;
      else if (!word.empty())
        words.push_back(std::exchange(word, {}));
    }
    for (const Value& value : s.values) {
      const std::string near =
          value.kind == Value::Kind::Text ? nearest_name(value.text, words) : "";
      if (!near.empty() && near != value.text) return fmt::format("; did you mean {}?", near);
    }
    return {};
  }

  void report_misfit(const Statement& s, const StatementRow& row, std::span<FormItem> values) {
    std::string found;
    for (const FormItem& item : values) found += ' ' + describe(item);
    // String options of the wrong type are documented as ignored, so they only get a note.
    diagnostics_.report(s.quoted ? Severity::Note : Severity::Warning,
                        s.quoted ? "OR-SC-103" : "OR-SC-101", s.where,
                        fmt::format("{}{} is ignored", name_of(row), found),
                        fmt::format("expected: {} {} ({}){}", name_of(row), row.form, row.meaning,
                                    nearest_word(s, row)));
  }

  RenderOptions& options_;
  Diagnostics& diagnostics_;
  bool unified_ = true;
  std::vector<FormItem> items_;  // of the statement being read
};

}  // namespace

float default_filter_width(FilterKind kind) {
  constexpr float kWidths[] = {1, 2, 3, 4, 4, 4, 4};
  return kWidths[static_cast<int>(kind)];
}

RenderOptions interpret_options(const Options& options, Diagnostics& diagnostics) {
  RenderOptions result;
  Interpreter interpreter(result, diagnostics);
  for (const Statement& s : options.statements) interpreter.read_unified_sampling(s);
  for (const Statement& s : options.statements) interpreter.read(s);
  for (const UninterpretedStatement& k : options.uninterpreted)
    interpreter.keep(k.keyword, Support::Uninterpreted, k.where);
  return result;
}

}  // namespace oriel::scene
