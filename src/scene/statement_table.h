// SPDX-License-Identifier: Apache-2.0
// The statements of an element as one table: keyword, form of the values, support, typed field.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/vec.h"
#include "scene/value.h"

namespace oriel::scene {

enum class Support : std::uint8_t {
  Effective,      ///< changes the picture as documented
  NotYet,         ///< typed here, nothing acts on it
  Uninterpreted,  ///< kept as written; has no effect on the picture
  Harmless        ///< the picture does not depend on it
};

/// What the parser, `oriel check` and the documentation know of a statement.
struct StatementRow {
  /// Words joined by single blanks; in quotes for a string option. `bsp: size|depth` are the
  /// statements `bsp size` and `bsp depth`, both reported as `bsp`. `filter (clip)` is the
  /// statement `filter` whose first value is the word `clip`.
  std::string_view keyword;
  /// Values: `bool`, `int`, `float`, `string`, `list`, `flag_bits` (0 to 15) or a literal word.
  /// Alternatives are separated by `|`, `_` is a blank in a word, optional rests are in brackets.
  /// A form that begins with `...` fits any values. A form in `<>` has a reader of its own.
  std::string_view form;
  Support support = Support::Uninterpreted;
  std::string_view meaning;
};

/// One value of a statement. A row of numbers counts as one item per number.
struct FormItem {
  const Value* value = nullptr;  ///< null for a word that was part of the keyword
  double number = 0;             ///< double: as the scene holds it
  std::string_view text = {};
  int choice = 0;  ///< which alternative of the form it matched
};

/// The values of a statement that fits its form.
class StatementValues {
 public:
  StatementValues(std::span<const FormItem> items, SourceLocation where)
      : items_(items), where_(where) {}
  std::size_t size() const { return items_.size(); }
  bool on(std::size_t i) const { return items_[i].value->boolean; }
  int integer(std::size_t i) const { return static_cast<int>(items_[i].number); }
  float number(std::size_t i) const { return static_cast<float>(items_[i].number); }
  std::string text(std::size_t i) const { return std::string(items_[i].text); }
  int choice(std::size_t i) const { return items_[i].choice; }
  const Value& value(std::size_t i) const { return *items_[i].value; }
  SourceLocation where() const { return where_; }  ///< of the statement
  /// One number for all components, or three or four; alpha is 1 unless written.
  Rgba color() const;

  // For forms that fit any values ---------------------------------------------------------------
  bool is_number(std::size_t i) const;
  /// The number at `i` if all values up to there are numbers.
  double number_or(std::size_t i, double missing) const;
  std::vector<double> numbers() const;  ///< those among the values
  bool is_on() const;                   ///< no value, `on`, or a number other than 0
  bool is_off() const;                  ///< the word `off`
  std::string word() const;             ///< the first value, if it is text

 private:
  std::span<const FormItem> items_;
  SourceLocation where_;
};

/// How the parser reads a statement. Numbers and one boolean may always follow the keyword.
struct ParserForm {
  std::string keyword;
  std::string words = {};  ///< that may stand as a value, alternatives by '|'
  int strings = 0;         ///< how many may follow
};

/// The form fits any values.
bool is_open(std::string_view form);

/// The rows of one element, by keyword.
class StatementTable {
 public:
  struct Match {
    const StatementRow* row = nullptr;  ///< null: unknown
    std::span<FormItem> values;         ///< part of the items
    bool fits = false;                  ///< the values fit the row's form
    bool has_other_words = false;       ///< words of the keyword are among the values
  };

  template <class Row>
  explicit StatementTable(std::span<const Row> rows) {
    for (const Row& row : rows) add(row);
  }
  StatementTable(const StatementTable&) = delete;
  StatementTable& operator=(const StatementTable&) = delete;

  const StatementRow* find(std::string_view keyword) const;
  /// The row with the longest keyword that the leading words of the statement spell. `items` is
  /// filled with the words and values.
  Match match(const Statement& s, std::vector<FormItem>& items) const;
  const std::vector<ParserForm>& forms() const { return forms_; }
  /// First words of the statements whose form is in `<>`.
  const std::vector<std::string_view>& special_words() const { return special_words_; }

 protected:
  static void report_misfit(const Statement& s, const StatementRow& row, Diagnostics& diagnostics);

 private:
  struct Hash : std::hash<std::string_view> {
    using is_transparent = void;
  };
  void add(const StatementRow& row);
  std::unordered_map<std::string, const StatementRow*, Hash, std::equal_to<>> rows_;
  std::vector<ParserForm> forms_;
  std::vector<std::string_view> special_words_;
};

/// A row whose statement fills a field of T.
template <class T>
struct Row : StatementRow {
  void (*set)(T&, const StatementValues&) = nullptr;
};

/// The rows that fill a T.
template <class T>
class ElementTable : public StatementTable {
 public:
  explicit ElementTable(std::span<const Row<T>> rows) : StatementTable(rows), rows_(rows) {}
  std::span<const Row<T>> rows() const { return rows_; }

  static void set(const StatementRow& row, T& target, const StatementValues& values) {
    if (const auto set = static_cast<const Row<T>&>(row).set) set(target, values);
  }

  /// Reads the statements in order; later ones override earlier ones. Unknown statements are
  /// skipped. Errors: OR-SC-201 values that do not fit (the statement is skipped).
  T read(const std::vector<Statement>& statements, Diagnostics* diagnostics = nullptr) const {
    T target;
    std::vector<FormItem> items;
    for (const Statement& s : statements) {
      const Match match = this->match(s, items);
      // `shadow approximate` is another statement than `shadow`.
      if (!match.row || (match.has_other_words && (!match.fits || is_open(match.row->form))))
        continue;
      if (match.fits)
        set(*match.row, target, {match.values, s.where});
      else if (diagnostics)
        report_misfit(s, *match.row, *diagnostics);
    }
    return target;
  }

 private:
  std::span<const Row<T>> rows_;
};

/// The keyword as messages name it.
std::string name_of(const StatementRow& row);
inline bool is_string_option(const StatementRow& row) { return row.keyword.starts_with('"'); }
/// Whether `items` fit the form; fills in FormItem::choice.
bool fits_form(std::string_view form, std::span<FormItem> items);

}  // namespace oriel::scene
