// SPDX-License-Identifier: Apache-2.0
// Table-driven reader of statements that consist of a keyword and values.
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

/// The statement forms of one element, by keyword.
class FormTable {
 public:
  /// `others`: first words of statements that are read without a form.
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
/// replaces all existing ones with this keyword; later ones are appended.
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

/// Reads the next statement. Returns nullopt for an unknown statement or a stray token, after a
/// warning; its values are skipped.
std::optional<scene::Statement> read_statement(Parse& parse, const FormTable& table,
                                               std::string_view element);
/// Reads `"name" value`, a string option.
scene::Statement read_string_option(Parse& parse);
/// Reads the rest of `[visible trace ...] approximate technique...`; `keyword` contains all words
/// up to `approximate`.
scene::Statement read_approximate(Parse& parse, std::string keyword, SourceLocation at);
/// Reads the rest of `data "name"` or `data null` inside an element.
scene::Statement read_data_reference(Parse& parse, SourceLocation at);
/// Reads at most `most` consecutive numbers as one value.
scene::Value read_numbers(Parse& parse, std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace oriel::mi
