// SPDX-License-Identifier: Apache-2.0
// Statement table of an element: keyword, form of the values, support level, typed field.
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
  Effective,      ///< affects the image as documented
  NotYet,         ///< parsed and typed, without effect so far
  Uninterpreted,  ///< stored as written, without effect
  Harmless        ///< has no influence on the image
};

/// Description of a statement for the parser, `oriel check` and the documentation.
struct StatementRow {
  /// Words joined by single blanks; in quotes for a string option. `bsp: size|depth` are the
  /// statements `bsp size` and `bsp depth`, both reported as `bsp`. `filter (clip)` is the
  /// statement `filter` whose first value is the word `clip`.
  std::string_view keyword;
  /// Values: `bool`, `int`, `float`, `string`, `list`, `flag_bits` (0 to 15) or a literal word.
  /// Values: `bool`, `int`, `float`, `string`, `list`, `flag_bits` (0 to 15) or a literal word.
  /// Alternatives are separated by `|`, `_` is a blank in a word, optional trailing values are in
  /// brackets. A form that begins with `...` matches any values. A form in `<>` has a separate
  /// parser.
  std::string_view form;
  Support support = Support::Uninterpreted;
  std::string_view meaning;
};

/// One value of a statement. Each number of a row is a separate item.
struct FormItem {
  const Value* value = nullptr;  ///< null for a word of the keyword
  double number = 0;             ///< double, like the scene
  std::string_view text = {};
  int choice = 0;  ///< index of the matched alternative of the form
};

/// The values of a statement that matches its form.
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
  /// One number for all components, or three or four; alpha is 1 by default.
  Rgba color() const;

  // For forms that match any values
  bool is_number(std::size_t i) const;
  /// Number i if all values up to it are numbers, otherwise `missing`.
  double number_or(std::size_t i, double missing) const;
  std::vector<double> numbers() const;  ///< the numbers among the values
  bool is_on() const;                   ///< no value, `on`, or a number other than 0
  bool is_off() const;                  ///< the word `off`
  std::string word() const;             ///< the first value if it is text, otherwise empty

 private:
  std::span<const FormItem> items_;
  SourceLocation where_;
};

/// How the parser reads a statement. Numbers and one boolean are always allowed after the keyword.
struct ParserForm {
  std::string keyword;
  std::string words = {};  ///< allowed value words, separated by '|'
  int strings = 0;         ///< maximum number of strings
};

/// Whether the form matches any values.
bool is_open(std::string_view form);

/// The rows of one element, by keyword.
class StatementTable {
 public:
  struct Match {
    const StatementRow* row = nullptr;  ///< null: unknown
    std::span<FormItem> values;         ///< subrange of the items
    bool fits = false;                  ///< the values match the form of the row
    bool has_other_words = false;       ///< the values include words of the keyword
  };

  template <class Row>
  explicit StatementTable(std::span<const Row> rows) {
    for (const Row& row : rows) add(row);
  }
  StatementTable(const StatementTable&) = delete;
  StatementTable& operator=(const StatementTable&) = delete;

  const StatementRow* find(std::string_view keyword) const;
  /// The row with the longest keyword that matches the leading words of the statement. Fills
  /// `items` with the words and values.
  Match match(const Statement& s, std::vector<FormItem>& items) const;
  const std::vector<ParserForm>& forms() const { return forms_; }
  /// First words of the statements with a form in `<>`.
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

/// A row with a setter for a field of T.
template <class T>
struct Row : StatementRow {
  void (*set)(T&, const StatementValues&) = nullptr;
};

/// The rows for the fields of T.
template <class T>
class ElementTable : public StatementTable {
 public:
  explicit ElementTable(std::span<const Row<T>> rows) : StatementTable(rows), rows_(rows) {}
  std::span<const Row<T>> rows() const { return rows_; }

  static void set(const StatementRow& row, T& target, const StatementValues& values) {
    if (const auto set = static_cast<const Row<T>&>(row).set) set(target, values);
  }

  /// Reads the statements in order; later ones override earlier ones. Unknown statements are
  /// skipped. Errors: OR-SC-201 invalid values (the statement is skipped).
  T read(const std::vector<Statement>& statements, Diagnostics* diagnostics = nullptr) const {
    T target;
    std::vector<FormItem> items;
    for (const Statement& s : statements) {
      const Match match = this->match(s, items);
      // `shadow approximate` is a different statement from `shadow`.
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

/// The keyword as shown in diagnostics.
std::string name_of(const StatementRow& row);
inline bool is_string_option(const StatementRow& row) { return row.keyword.starts_with('"'); }
/// Whether `items` match the form. Sets FormItem::choice.
bool fits_form(std::string_view form, std::span<FormItem> items);

}  // namespace oriel::scene
