// SPDX-License-Identifier: Apache-2.0
// $ directives: includes, conditions, inline code.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <utility>

#include "mi/codes.h"
#include "mi/cursor.h"
#include "scene/asset_path.h"

namespace oriel::mi {
namespace {

namespace fs = std::filesystem;

// File name of a path with slashes or backslashes.
std::string file_name(std::string_view path) {
  const std::size_t slash = path.find_last_of("/\\");
  return std::string(slash == std::string_view::npos ? path : path.substr(slash + 1));
}

}  // namespace

void Cursor::directive(const Token& command) {
  const std::string_view word = command.text;
  if (word == "include") return include(Token(command));
  if (word == "code") return skip_code(Token(command));
  if (word == "ifdef" || word == "ifndef" || word == "else" || word == "endif")
    return conditional(Token(command));
  const std::string known[] = {"include", "code", "ifdef", "ifndef", "else", "endif"};
  const std::string near = nearest_name(word, known);
  diagnostics_->warning(code::kUnknownDirective, locate(command),
                        fmt::format("unknown command ${} was skipped", word.substr(0, 40)),
                        near.empty() ? "" : "did you mean $" + near + "?");
}

void Cursor::include(const Token& command) {
  // The name is the rest of the line: "file" or <file>. Angle brackets are delimiters only here.
  const SourceLocation at = locate(command);
  Lexer& lexer = stack_.back().lexer;
  const char* p = lexer.position();
  while (*p == ' ' || *p == '\t') ++p;
  const bool angled = *p == '<';
  const char close = angled ? '>' : '"';
  const char* const begin = p + 1;
  const char* q = begin;
  while (*q != close && *q != '\n' && *q != '\r' && *q != 0) ++q;
  if ((*p != '"' && !angled) || *q != close || q == begin) {
    lexer.set_position(*p == 0 ? p : q);
    diagnostics_->error(code::kSyntax, at, "$include requires a \"file\" or <file>");
    return;
  }
  lexer.set_position(q + 1);
  include(std::string(begin, q), angled, at);
}

void Cursor::include(const std::string& name, bool angled, SourceLocation at) {
  if (satisfied_by_package(name)) return;
  std::string path;
  OpenFile file = find_include(name, angled, path);
  if (file.is_refused()) {
    if (!reported_missing_.insert(name).second) return;
    missing_.push_back(name);
    diagnostics_->warning(code::kForbiddenInclude, at,
                          fmt::format("include \"{}\" is not read: {}", name, file.reason()),
                          file.hint());
    return;
  }
  if (path.empty()) {
    if (!reported_missing_.insert(name).second) return;
    missing_.push_back(name);
    unreported_.push_back({name, at});
    return;
  }
  const bool cycle = std::any_of(stack_.begin(), stack_.end(), [&](const Frame& f) {
    return !f.canonical.empty() && f.canonical == file.path();
  });
  if (cycle)
    return diagnostics_->error(code::kIncludeCycle, at,
                               fmt::format("\"{}\" includes itself; skipped here", name));
  if (static_cast<int>(stack_.size()) > options_->limits.include_depth)
    return diagnostics_->error(code::kIncludeLimit, at,
                               fmt::format("include \"{}\" exceeds the limit of {} nested files",
                                           name, options_->limits.include_depth));
  if (++totals_->includes > options_->budgets[Budget::Includes])
    return diagnostics_->error(code::kIncludeLimit, at,
                               fmt::format("include \"{}\" is skipped: {}", name,
                                           options_->budgets.excess(Budget::Includes)),
                               SceneBudgets::hint(Budget::Includes));
  auto source = load(file, path, at);
  if (source && options_->on_include) options_->on_include({name, path, at});
  if (source) return push(std::move(source), file.path(), at);
  missing_.push_back(name);
}

void Cursor::report_missing_includes(bool used) {
  const std::vector<MissingInclude> missing = std::exchange(unreported_, {});
  if (missing.empty()) return;
  if (used) {
    for (const MissingInclude& m : missing)
      diagnostics_->warning(code::kMissingInclude, m.where,
                            fmt::format("include \"{}\" was not found", m.name),
                            "add the folder that holds it to the include paths");
    return;
  }
  std::string names;
  for (const MissingInclude& m : missing) names += (names.empty() ? "" : ", ") + m.name;
  diagnostics_->note(code::kMissingInclude, missing.front().where,
                     fmt::format("{} include{} not found, and the scene uses nothing of {}: {}",
                                 missing.size(), missing.size() == 1 ? " was" : "s were",
                                 missing.size() == 1 ? "it" : "them", names));
}

bool Cursor::satisfied_by_package(const std::string& name) {
  const std::string file = file_name(name);
  for (const std::string& stem : options_->packages)
    if (file == stem + ".mi") {
      packages_.push_back(file);
      return true;
    }
  return false;
}

OpenFile Cursor::find_include(const std::string& name, bool angled, std::string& path) const {
  std::vector<fs::path> folders;
  if (!angled) folders.push_back(fs::path(stack_.back().source->path()).parent_path());
  folders.insert(folders.end(), options_->include_paths.begin(), options_->include_paths.end());
  // A scene is often shipped with its libraries in the same folder, also for <file>.
  if (angled) folders.push_back(fs::path(stack_.back().source->path()).parent_path());
  OpenFile refused;
  for (const std::string& spelling : scene::spellings_of(name))
    for (const fs::path& folder : folders) {
      path = (folder / spelling).string();
      OpenFile file = files_.open(path, FileUse::Scene);
      if (file || file.fault() == OpenFile::Fault::NotRegular) return file;
      if (file.is_refused() && !refused.is_refused()) refused = std::move(file);
    }
  path.clear();
  return refused;
}

void Cursor::conditional(const Token& command) {
  const SourceLocation at = locate(command);
  int& depth = stack_.back().conditionals;
  if (command.text == "else" || command.text == "endif") {
    if (depth == 0)
      return diagnostics_->warning(code::kConditional, at,
                                   fmt::format("${} without $ifdef", command.text));
    // An $else reached while reading ends the active branch.
    if (command.text == "else") return skip_false_branch(at);
    --depth;
    return;
  }
  Token variable;
  stack_.back().lexer.next(variable);
  if (!variable.is_name()) {
    set_raw(variable.raw.data());
    return diagnostics_->error(code::kSyntax, at,
                               fmt::format("${} requires the name of a variable", command.text));
  }
  const bool defined = variables_.contains(variable.str());
  ++depth;
  if (defined == (command.text == "ifndef")) skip_false_branch(at);
}

void Cursor::skip_false_branch(SourceLocation from) {
  Lexer& lexer = stack_.back().lexer;
  int nested = 0;
  for (Token token;;) {
    lexer.next(token);
    if (token.kind == Token::Kind::End) {
      diagnostics_->warning(code::kConditional, from, "this branch is never closed",
                            "close it with $endif");
      stack_.back().conditionals = 0;
      return;
    }
    if (token.kind != Token::Kind::Directive) continue;
    if (token.text == "ifdef" || token.text == "ifndef") ++nested;
    if (token.text == "else" && nested == 0) return;
    if (token.text == "endif" && nested-- == 0) {
      --stack_.back().conditionals;
      return;
    }
  }
}

void Cursor::skip_code(const Token& command) {
  const char* const begin = stack_.back().lexer.position();
  const std::string_view rest(begin, static_cast<std::size_t>(source().end() - begin));
  std::size_t at = 0;
  do {
    at = rest.find("$end", at + 1);
  } while (at != std::string_view::npos && !source().starts_line(begin + at));
  const bool closed = at != std::string_view::npos;
  const std::string_view body = rest.substr(0, at);
  const SourceLocation at_command = locate(command);
  if (!options_->trusts_code)
    diagnostics_->warning(code::kRefused, at_command, "in-line C code is not compiled or run",
                          std::string(code::kTrustHint));
  code_.push_back({std::string(body), at_command});
  const char* p = begin + body.size();
  if (closed)
    while (*p != source().newline() && *p != 0) ++p;
  set_raw(p);
}

}  // namespace oriel::mi
