// SPDX-License-Identifier: Apache-2.0
// Statements that are a keyword and values: one reader for all, driven by tables.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "mi/parse.h"
#include "scene/statement_table.h"

namespace oriel::mi {

using Form = scene::ParserForm;

/// The forms of the statements of one element, by keyword.
class FormTable {
 public:
  /// `others`: first words of what else may stand in the element, read without a form.
  FormTable(std::vector<Form> forms, std::span<const std::string_view> others);
  FormTable(std::initializer_list<Form> forms) : FormTable(std::vector<Form>(forms), {}) {}
  explicit FormTable(const scene::StatementTable& rows,
                     std::span<const std::string_view> others = {});
  const Form* find(std::string_view keyword) const;
  bool is_prefix(std::string_view words) const;        ///< of a keyword with more words
  bool starts_statement(std::string_view word) const;  ///< first word of any keyword, or other
  /// The keyword or first word nearest to `keyword`; empty: none is near.
  std::string nearest(std::string_view keyword) const;
  /// Words that follow the keyword in the longer keywords of the table.
  std::vector<std::string> continuations(std::string_view keyword) const;

 private:
  std::vector<Form> forms_;
  std::set<std::string, std::less<>> prefixes_, first_words_;
};

/// Adds statements to an element. In an incremental change the first statement of a keyword
/// replaces what the element had of it; further ones add up as in any element.
class StatementList {
 public:
  StatementList(std::vector<scene::Statement>& list, bool incremental)
      : list_(list), incremental_(incremental) {}
  void add(scene::Statement statement);

 private:
  std::vector<scene::Statement>& list_;
  bool incremental_;
  std::set<std::string, std::less<>> touched_;
};

/// Reads one statement of the table if one begins here. An unknown word is reported, skipped with
/// its values, and nullopt returned; so is what is no word.
std::optional<scene::Statement> read_statement(Parse& parse, const FormTable& table,
                                               std::string_view element);
/// `"name" value`: a string option.
scene::Statement read_string_option(Parse& parse);
/// `[visible trace ...] approximate technique...`; the words before it were read into `flags`.
scene::Statement read_approximate(Parse& parse, std::string keyword, SourceLocation at);
/// `data "name"` or `data null` inside an element.
scene::Statement read_data_reference(Parse& parse, SourceLocation at);
/// Consecutive numbers, at most that many, as one value.
scene::Value read_numbers(Parse& parse, std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace oriel::mi
