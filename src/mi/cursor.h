// SPDX-License-Identifier: Apache-2.0
// Token stream across includes and $ifdef, with one token of lookahead.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mi/lexer.h"
#include "mi/reader.h"

namespace oriel::mi {

/// Delivers tokens. Executes $ directives and reports lexical errors.
///
/// Token texts stay valid until release_finished_sources().
class Cursor {
 public:
  Cursor(const ReadOptions& options, Diagnostics& diagnostics);
  Cursor(const Cursor&) = delete;
  Cursor& operator=(const Cursor&) = delete;

  bool open(const std::string& path);
  void open_text(std::string_view text, std::string name);
  /// Permits files of the scene in the folder of this file.
  void permit_folder_of(const std::string& path);

  const Token& peek() {
    if (!ready_) fetch();
    return token_;
  }
  Token next() {
    peek();
    ready_ = token_.kind == Token::Kind::End;
    return token_;
  }
  bool at_end() { return peek().kind == Token::Kind::End; }
  bool at(Token::Kind kind) { return peek().kind == kind; }
  bool at_word(std::string_view word) { return peek().is_word(word); }
  bool at_punct(char c) { return peek().is_punct(c); }
  bool accept_word(std::string_view word);
  bool accept_punct(char c);

  SourceLocation where() { return locate(peek()); }  ///< location of the next token
  SourceLocation locate(const Token& token) { return token.source->locate(token.raw.data()); }

  /// Start of the next token in the text, for fast scans of long lists. set_raw() moves the
  /// position. The text ends with a zero byte.
  const char* raw();
  void set_raw(const char* p) { stack_.back().lexer.set_position(p); }
  /// Reads another file at this position, as $include does. Requires that no token was peeked.
  void include(const std::string& name, bool angled, SourceLocation at);
  /// Discards the peeked token; reading continues at the position of set_raw().
  void drop_lookahead() { ready_ = false; }
  Source& source() { return stack_.back().lexer.source(); }
  std::string folder();  ///< folder of the current file
  const FileAccess& files() const { return files_; }

  /// Amounts that count against the budgets.
  struct Totals {
    std::uint64_t includes = 0, bytes = 0;
  };
  bool is_include_budget_spent() const {
    return totals_->includes >= options_->budgets[Budget::Includes];
  }
  /// Reads for the same scene as another cursor, which must outlive this one: with its permissions
  /// and its totals.
  void read_for(Cursor& other) {
    files_ = other.files_;
    totals_ = other.totals_;
  }

  /// The bytes of the next token if it is a binary block of this size. Otherwise an empty span; a
  /// binary block of another size is reported.
  std::span<const char> binary(std::size_t bytes);

  void release_finished_sources() { finished_.clear(); }
  /// Frees the memory of long text before the next token.
  void forget_what_was_read();

  std::map<std::string, std::string, std::less<>>& variables() { return variables_; }
  /// File names of unreadable includes, in order.
  const std::vector<std::string>& missing_includes() const { return missing_; }
  /// Reports includes that were not found since the last call: one warning each if `used`,
  /// otherwise one note for all.
  void report_missing_includes(bool used);
  /// Package includes read since the last call.
  std::vector<std::string> take_packages();
  struct CodeBlock {
    std::string body;
    SourceLocation where;
  };
  /// $code blocks read since the last call.
  std::vector<CodeBlock> take_code();

 private:
  struct Frame {
    Lexer lexer;
    std::unique_ptr<Source> source;
    std::string canonical;  // canonical path, to detect cycles; empty for text
    int conditionals = 0;
  };
  std::unique_ptr<Source> load(OpenFile& file, const std::string& path, SourceLocation at);
  void push(std::unique_ptr<Source> source, std::string canonical, SourceLocation from);
  void pop();
  void fetch();
  void report_problem(const Token& token);
  void directive(const Token& command);
  void include(const Token& command);
  OpenFile find_include(const std::string& name, bool angled, std::string& path) const;
  bool satisfied_by_package(const std::string& name);
  void conditional(const Token& command);
  void skip_false_branch(SourceLocation from);
  void skip_code(const Token& command);

  const ReadOptions* options_;
  Diagnostics* diagnostics_;
  std::vector<Frame> stack_;
  std::vector<std::unique_ptr<Source>> finished_;
  Token token_;
  bool ready_ = false;
  Totals own_totals_;
  Totals* totals_ = &own_totals_;
  FileAccess files_;
  std::map<std::string, std::string, std::less<>> variables_;
  std::set<std::string, std::less<>> reported_missing_;
  std::vector<std::string> missing_, packages_;
  struct MissingInclude {
    std::string name;
    SourceLocation where;
  };
  std::vector<MissingInclude> unreported_;
  std::vector<CodeBlock> code_;
};

}  // namespace oriel::mi
