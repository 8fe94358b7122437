// SPDX-License-Identifier: Apache-2.0
#include "mi/statements.h"

#include <fmt/format.h>

#include <algorithm>

#include "mi/elements.h"

namespace oriel::mi {
namespace {

using scene::Statement;
using scene::Value;

// Whether `wanted` is one of the alternatives, or the first word of one if `begins` is set.
bool is_alternative(std::string_view words, std::string_view wanted, bool begins = false) {
  while (!words.empty()) {
    const std::size_t bar = words.find('|');
    const std::string_view one = words.substr(0, bar);
    if (one == wanted || (begins && one.substr(0, one.find(' ')) == wanted)) return true;
    words = bar == std::string_view::npos ? std::string_view{} : words.substr(bar + 1);
  }
  return false;
}

Value bare_text(std::string text, SourceLocation at) {
  Value value;
  value.kind = Value::Kind::Text;
  value.text = std::move(text);
  value.bare = true;
  value.where = at;
  return value;
}

// Reads one of the alternatives, which have one or two words.
Value read_word(Parse& parse, std::string_view words) {
  const SourceLocation at = parse.in.where();
  std::string word(parse.in.next().text);
  if (parse.in.at(Token::Kind::Word)) {
    const std::string two = fmt::format("{} {}", word, parse.in.peek().text);
    if (is_alternative(words, two)) {
      parse.in.next();
      word = two;
    }
  }
  if (!is_alternative(words, word)) parse.unexpected(fmt::format("one of {}", words));
  return bare_text(std::move(word), at);
}

// Skips an unknown statement up to the next known one or the next line.
void skip_statement(Parse& parse, const FormTable& table) {
  while (!parse.in.at_end()) {
    const Token& token = parse.in.peek();
    if (token.kind == Token::Kind::Word &&
        (token.text == "end" || table.starts_statement(token.text) ||
         token.source->starts_line(token.raw.data())))
      return;
    if (token.kind == Token::Kind::String && token.source->starts_line(token.raw.data())) return;
    parse.in.next();
  }
}

void read_statement_values(Parse& parse, const Form& form, Statement& statement) {
  int strings = form.strings;
  bool had_word = false, had_boolean = false;
  for (;;) {
    const Token token = parse.in.peek();
    Value value;
    value.where = parse.in.where();
    if (token.kind == Token::Kind::Number) {
      value = read_numbers(parse);
    } else if (!had_boolean && Parse::is_boolean(token, value.boolean)) {
      value.kind = Value::Kind::Boolean;
      had_boolean = true;
      parse.in.next();
    } else if (token.kind == Token::Kind::Word && !had_word &&
               is_alternative(form.words, token.text, true)) {
      value = read_word(parse, form.words);
      had_word = true;
    } else if (strings > 0 && (token.kind == Token::Kind::String || token.is_punct('['))) {
      value = read_value(parse);
      --strings;
    } else {
      return;
    }
    statement.values.push_back(std::move(value));
  }
}

// "filter bax", "trace dpeth": a word after a statement that starts none and is near a word of its
// form, or of a longer keyword.
void skip_misspelt_word(Parse& parse, const FormTable& table, const Form& form) {
  const Token token = parse.in.peek();
  if (token.kind != Token::Kind::Word || token.text == "end" ||
      table.starts_statement(token.text) || Parse::starts_element(token))
    return;
  std::vector<std::string> words = table.continuations(form.keyword);
  for (std::string_view rest = form.words; !rest.empty();) {
    const std::size_t bar = std::min(rest.find('|'), rest.size());
    words.emplace_back(rest.substr(0, bar));
    rest.remove_prefix(std::min(bar + 1, rest.size()));
  }
  const std::string near = nearest_name(token.text, words);
  if (near.empty()) return;
  parse.warn(code::kUnknownStatement, parse.in.where(),
             fmt::format("unknown value {} of '{}' was skipped", parse.shown(token), form.keyword),
             "did you mean " + near + "?");
  parse.in.next();
  skip_statement(parse, table);
}

}  // namespace

FormTable::FormTable(const scene::StatementTable& rows, std::span<const std::string_view> others)
    : FormTable(rows.forms(), others) {
  for (const std::string_view word : rows.special_words()) first_words_.emplace(word);
}

FormTable::FormTable(std::vector<Form> forms, std::span<const std::string_view> others)
    : forms_(std::move(forms)) {
  for (const std::string_view word : others) first_words_.emplace(word);
  std::sort(forms_.begin(), forms_.end(),
            [](const Form& a, const Form& b) { return a.keyword < b.keyword; });
  for (const Form& form : forms_) {
    first_words_.insert(form.keyword.substr(0, form.keyword.find(' ')));
    for (auto blank = form.keyword.find(' '); blank != std::string::npos;
         blank = form.keyword.find(' ', blank + 1))
      prefixes_.insert(form.keyword.substr(0, blank));
  }
}

const Form* FormTable::find(std::string_view keyword) const {
  const auto found =
      std::lower_bound(forms_.begin(), forms_.end(), keyword,
                       [](const Form& form, std::string_view k) { return form.keyword < k; });
  return found != forms_.end() && found->keyword == keyword ? &*found : nullptr;
}

std::string FormTable::nearest(std::string_view keyword) const {
  std::vector<std::string> names(first_words_.begin(), first_words_.end());
  for (const Form& form : forms_) names.push_back(form.keyword);
  return nearest_name(keyword, names);
}

std::vector<std::string> FormTable::continuations(std::string_view keyword) const {
  std::vector<std::string> words;
  const std::string begin = std::string(keyword) + ' ';
  for (const Form& form : forms_)
    if (form.keyword.starts_with(begin)) words.push_back(form.keyword.substr(begin.size()));
  return words;
}

bool FormTable::is_prefix(std::string_view words) const { return prefixes_.contains(words); }
bool FormTable::starts_statement(std::string_view word) const {
  return first_words_.contains(word);
}

void StatementList::add(Statement statement) {
  if (incremental_ && touched_.insert(statement.keyword).second)
    std::erase_if(list_, [&](const Statement& s) { return s.keyword == statement.keyword; });
  list_.push_back(std::move(statement));
}

std::optional<Statement> read_statement(Parse& parse, const FormTable& table,
                                        std::string_view element) {
  Statement statement;
  statement.where = parse.in.where();
  if (!parse.in.at(Token::Kind::Word)) {
    if (parse.in.at_end()) parse.unexpected(fmt::format("a statement of {}", element));
    parse.warn(code::kStrayToken, statement.where,
               fmt::format("{} in {} belongs to no statement and was skipped",
                           parse.shown(parse.in.peek()), element));
    parse.in.next();
    skip_statement(parse, table);
    return std::nullopt;
  }
  if (parse.starts_element(parse.in.peek()) && !table.starts_statement(parse.in.peek().text))
    parse.unexpected(fmt::format("the end of {}", element));
  const Token first = parse.in.next();
  statement.keyword = first.text;
  // The longest keyword that matches the words.
  while (parse.in.at(Token::Kind::Word) && table.is_prefix(statement.keyword)) {
    const std::string longer = statement.keyword + " " + std::string(parse.in.peek().text);
    if (!table.find(longer) && !table.is_prefix(longer)) break;
    statement.keyword = longer;
    parse.in.next();
  }
  const Form* form = table.find(statement.keyword);
  if (!form) {
    const std::string near = table.nearest(statement.keyword);
    parse.warn(code::kUnknownStatement, statement.where,
               fmt::format("unknown statement {} in {} was skipped", parse.shown(first), element),
               near.empty() ? "" : "did you mean " + near + "?");
    skip_statement(parse, table);
    return std::nullopt;
  }
  read_statement_values(parse, *form, statement);
  skip_misspelt_word(parse, table, *form);
  return statement;
}

Statement read_string_option(Parse& parse) {
  Statement statement;
  statement.where = parse.in.where();
  statement.quoted = true;
  statement.keyword = parse.in.next().str();
  bool ignored = false;
  // Any other word begins the next statement; the option then has no value.
  if (!parse.in.at(Token::Kind::Word) || parse.in.at_word("null") ||
      Parse::is_boolean(parse.in.peek(), ignored))
    statement.values.push_back(read_value(parse));
  return statement;
}

Statement read_approximate(Parse& parse, std::string keyword, SourceLocation at) {
  static constexpr std::string_view kWords =
      "surface|subdivision|ccmesh|displace|curve|space|trim|trilist|view|any|offscreen|tree|grid|"
      "delaunay|fine|nosmoothing|sharp|length|distance|angle|spatial|curvature|grading|parametric|"
      "regular|implicit|max|samples|shared|all";
  Statement statement{std::move(keyword), false, {}, at};
  for (;;) {
    const Token token = parse.in.peek();
    const SourceLocation here = parse.in.where();
    if (token.kind == Token::Kind::Number) {
      statement.values.push_back(read_numbers(parse));
    } else if (token.kind == Token::Kind::String) {
      statement.values.push_back(read_value(parse));
    } else if (token.is_punct('%') ||
               (token.kind == Token::Kind::Word && is_alternative(kWords, token.text))) {
      parse.in.next();
      statement.values.push_back(bare_text(std::string(token.text), here));
    } else {
      return statement;
    }
  }
}

Statement read_data_reference(Parse& parse, SourceLocation at) {
  Statement statement{"data", false, {}, at};
  Value value;
  value.where = parse.in.where();
  if (parse.in.accept_word("null")) {
    value.kind = Value::Kind::Null;
  } else {
    value.kind = Value::Kind::Text;
    value.text = parse.referenced_name(parse.name("the name of a data element"));
  }
  statement.values.push_back(std::move(value));
  return statement;
}

Value read_numbers(Parse& parse, std::size_t most) {
  Value value;
  value.kind = Value::Kind::Numbers;
  value.integral = true;
  value.where = parse.in.where();
  while (value.numbers.size() < most && parse.at_number()) {
    const Token token = parse.in.next();
    value.numbers.push_back(token.number);
    value.integral &= token.integral;
  }
  return value;
}

}  // namespace oriel::mi
