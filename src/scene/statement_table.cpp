// SPDX-License-Identifier: Apache-2.0
#include "scene/statement_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace oriel::scene {
namespace {

constexpr std::string_view kAny = "...";

/// Removes and returns the text up to `separator`.
std::string_view take(std::string_view& text, char separator) {
  const auto end = std::min(text.find(separator), text.size());
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return part;
}

bool is_word(const FormItem& item, std::string_view word) {
  if (!item.value || item.value->kind == Value::Kind::Text) {
    return item.text.size() == word.size() &&
           std::equal(word.begin(), word.end(), item.text.begin(),
                      [](char w, char c) { return w == c || (w == '_' && c == ' '); });
  }
  return item.value->kind == Value::Kind::Boolean && word == (item.value->boolean ? "on" : "off");
}

bool is_alternative(const FormItem& item, std::string_view alternative) {
  const auto kind = item.value ? item.value->kind : Value::Kind::Null;
  const bool whole = kind == Value::Kind::Numbers && item.number == std::floor(item.number);
  if (alternative == "bool") return kind == Value::Kind::Boolean;
  if (alternative == "float") return kind == Value::Kind::Numbers;
  // A scalar with a whole value is accepted as an integer: exporters write `500.`.
  if (alternative == "int") return whole && std::abs(item.number) < 2147483648.0;
  if (alternative == "flag_bits") return whole && item.number >= 0 && item.number <= 15;
  if (alternative == "string") return kind == Value::Kind::Text;
  if (alternative == "list") return kind == Value::Kind::Array;
  return is_word(item, alternative);
}

bool fits_atom(std::string_view atom, FormItem& item) {
  for (item.choice = 0; !atom.empty(); ++item.choice)
    if (is_alternative(item, take(atom, '|'))) return true;
  return false;
}

/// The literal words of a form for the parser: separated by '|', each after `prefix`.
std::string literal_words(std::string_view form, const std::string& prefix) {
  constexpr std::string_view kTyped[] = {"bool", "int",       "float", "string", "list",
                                         "on",   "flag_bits", "off",   kAny,     ""};
  std::string words;
  while (!form.empty()) {
    std::string_view atom = take(form, ' ');
    while (!atom.empty()) {
      std::string word(take(atom, '|'));
      std::erase_if(word, [](char c) { return c == '[' || c == ']'; });
      if (std::find(std::begin(kTyped), std::end(kTyped), word) != std::end(kTyped)) continue;
      std::replace(word.begin(), word.end(), '_', ' ');
      words += (words.empty() ? "" : "|") + prefix + word;
    }
  }
  return words;
}

int count_strings(std::string_view form) {
  int strings = 0;
  while (!form.empty()) {
    const std::string_view atom = take(form, ' ');
    strings += atom.find("string") != std::string_view::npos;
  }
  return strings;
}

void add_words(std::vector<FormItem>& items, std::string_view words, const Value* value) {
  while (!words.empty()) items.push_back({.value = value, .text = take(words, ' ')});
}

/// Splits a statement into the words of its keyword and its values. The reader may count a word as
/// part of the keyword or as a value (`shadow segments`, `filter clip gauss`); the items are the
/// same.
void put_items(const Statement& s, std::vector<FormItem>& items) {
  items.clear();
  if (!s.quoted) add_words(items, s.keyword, nullptr);
  for (const Value& v : s.values) {
    if (v.kind == Value::Kind::Numbers)
      for (const double n : v.numbers) items.push_back({.value = &v, .number = n});
    else if (v.bare)
      add_words(items, v.text, &v);
    else
      items.push_back({.value = &v, .text = v.text});
  }
}

}  // namespace

Rgba StatementValues::color() const {
  if (size() == 1) return {number(0), number(0), number(0), 1};
  return {number(0), number(1), number(2), size() > 3 ? number(3) : 1.0f};
}

bool StatementValues::is_number(std::size_t i) const {
  return i < size() && items_[i].value && items_[i].value->kind == Value::Kind::Numbers;
}

double StatementValues::number_or(std::size_t i, double missing) const {
  for (std::size_t k = 0; k <= i; ++k)
    if (!is_number(k)) return missing;
  return items_[i].number;
}

std::vector<double> StatementValues::numbers() const {
  std::vector<double> all;
  for (std::size_t i = 0; i < size(); ++i)
    if (is_number(i)) all.push_back(items_[i].number);
  return all;
}

bool StatementValues::is_on() const {
  if (is_number(0)) return items_[0].number != 0;
  return size() == 0 || (items_[0].value && items_[0].value->boolean);
}

bool StatementValues::is_off() const { return size() > 0 && is_word(items_[0], "off"); }

std::string StatementValues::word() const {
  return size() > 0 && items_[0].value ? items_[0].value->text : std::string();
}

std::string name_of(const StatementRow& row) {
  std::string name(row.keyword.substr(0, row.keyword.find(':')));
  std::erase_if(name, [](char c) { return c == '(' || c == ')'; });
  return name;
}

bool is_open(std::string_view form) { return form.starts_with(kAny) || form.starts_with('<'); }

bool fits_form(std::string_view form, std::span<FormItem> items) {
  if (is_open(form)) return true;
  std::size_t used = 0;
  while (!form.empty()) {
    // A bracket starts an optional part of the form.
    if (form.front() == '[' && used == items.size()) return true;
    if (form.front() == ' ' || form.front() == '[' || form.front() == ']') {
      form.remove_prefix(1);
      continue;
    }
    const auto end = std::min(form.find_first_of(" ]"), form.size());
    if (used == items.size() || !fits_atom(form.substr(0, end), items[used])) return false;
    ++used;
    form.remove_prefix(end);
  }
  return used == items.size();
}

void StatementTable::add(const StatementRow& row) {
  std::string_view keyword = row.keyword;
  rows_.emplace(name_of(row), &row);
  if (is_string_option(row)) return;
  if (row.form.starts_with('<')) {
    special_words_.push_back(take(keyword, ' '));
    return;
  }
  if (const auto colon = keyword.find(": "); colon != std::string_view::npos) {
    std::string_view words = keyword.substr(colon + 2);
    while (!words.empty()) {
      std::string spelling = fmt::format("{} {}", keyword.substr(0, colon), take(words, '|'));
      rows_.emplace(spelling, &row);
      forms_.push_back({std::move(spelling), literal_words(row.form, ""), count_strings(row.form)});
    }
    return;
  }
  const auto bracket = keyword.find(" (");
  if (bracket == std::string_view::npos) {
    forms_.push_back({std::string(keyword), literal_words(row.form, ""), count_strings(row.form)});
    return;
  }
  const std::string word(keyword.substr(bracket + 2, keyword.size() - bracket - 3));
  const std::string two = literal_words(row.form, word + " ");
  for (ParserForm& form : forms_)
    if (form.keyword == keyword.substr(0, bracket))
      form.words += (form.words.empty() ? "" : "|") + (two.empty() ? word : two);
}

const StatementRow* StatementTable::find(std::string_view keyword) const {
  const auto found = rows_.find(keyword);
  return found == rows_.end() ? nullptr : found->second;
}

StatementTable::Match StatementTable::match(const Statement& s,
                                            std::vector<FormItem>& items) const {
  put_items(s, items);
  Match match;
  std::size_t words = 0;
  if (s.quoted) {
    match.row = find(fmt::format("\"{}\"", s.keyword));
  } else {
    constexpr std::size_t kMaxWords = 3;
    std::string keyword;
    for (std::size_t n = 0; n < std::min(items.size(), kMaxWords); ++n) {
      if (items[n].text.empty()) break;
      if (n) keyword += ' ';
      keyword += items[n].text;
      const StatementRow* row = find(keyword);
      if (!row) continue;
      match.row = row;
      words = n + 1;
    }
  }
  if (!match.row) return match;
  // The words after the name in `bsp: size|depth` count as values.
  match.values = std::span(items).subspan(words);
  match.has_other_words = !match.values.empty() && !match.values[0].value;
  match.fits = fits_form(match.row->form, match.values);
  return match;
}

void StatementTable::report_misfit(const Statement& s, const StatementRow& row,
                                   Diagnostics& diagnostics) {
  std::string form(row.form);
  std::erase_if(form, [](char c) { return c == '[' || c == ']'; });
  std::replace(form.begin(), form.end(), '_', ' ');
  diagnostics.warning("OR-SC-201", s.where, fmt::format("flag '{}' is ignored", s.keyword),
                      fmt::format("expected: {} {}", s.keyword, form));
}

}  // namespace oriel::scene
