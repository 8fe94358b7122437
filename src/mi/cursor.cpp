// SPDX-License-Identifier: Apache-2.0
#include "mi/cursor.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "mi/codes.h"

namespace oriel::mi {
Cursor::Cursor(const ReadOptions& options, Diagnostics& diagnostics)
    : options_(&options),
      diagnostics_(&diagnostics),
      files_(options.files),
      variables_(options.variables) {
  for (const std::string& path : options.include_paths) files_.permit(path);
}

bool Cursor::open(const std::string& path) {
  OpenFile file = open_regular(path);
  auto source = load(file, path, {});
  if (!source) {
    open_text("", path);
    return false;
  }
  permit_folder_of(path);
  push(std::move(source), file.path(), {});
  return true;
}

std::unique_ptr<Source> Cursor::load(OpenFile& file, const std::string& path, SourceLocation at) {
  const bool is_include = at.line > 0;
  const SourceLocation where = is_include ? at : SourceLocation{diagnostics_->add_file(path), 0, 0};
  const auto fail = [&](std::string_view code, const std::string& reason, std::string hint) {
    const std::string message =
        fmt::format("cannot read {}{}: {}", is_include ? "include " : "", path, reason);
    if (is_include && code == code::kUnreadable)
      diagnostics_->warning(code, where, message, std::move(hint));
    else
      diagnostics_->error(code, where, message, std::move(hint));
    return nullptr;
  };
  if (!file) {
    const std::string near =
        file.fault() == OpenFile::Fault::Missing ? nearest_file(path) : std::string();
    return fail(code::kUnreadable, file.reason(),
                near.empty() ? file.hint() : fmt::format("did you mean \"{}\"?", near));
  }
  const std::uint64_t most = options_->budgets[Budget::Text];
  SourceFault fault;
  auto source = Source::load(file, path,
                             {.text = most - std::min(totals_->bytes, most),
                              .expansion = options_->budgets[Budget::Expansion]},
                             fault);
  if (source) {
    totals_->bytes += source->size();
    return source;
  }
  return fault.budget ? fail(code::kTextBudget, options_->budgets.excess(*fault.budget),
                             SceneBudgets::hint(*fault.budget))
                      : fail(code::kUnreadable, fault.reason, "");
}

void Cursor::permit_folder_of(const std::string& path) {
  files_.permit(std::filesystem::path(path).parent_path().string());
}

void Cursor::open_text(std::string_view text, std::string name) {
  push(Source::from_text(text, std::move(name)), "", {});
}

void Cursor::push(std::unique_ptr<Source> source, std::string canonical, SourceLocation from) {
  source->file = diagnostics_->add_file(source->path(), from);
  Source& text = *source;
  stack_.push_back({Lexer(text), std::move(source), std::move(canonical), 0});
}

void Cursor::pop() {
  if (stack_.back().conditionals > 0)
    diagnostics_->warning(code::kConditional, source().locate(source().end()),
                          "the file ends inside $ifdef", "close it with $endif");
  finished_.push_back(std::move(stack_.back().source));
  stack_.pop_back();
}

bool Cursor::accept_word(std::string_view word) {
  const bool found = at_word(word);
  if (found) next();
  return found;
}

bool Cursor::accept_punct(char c) {
  const bool found = at_punct(c);
  if (found) next();
  return found;
}

void Cursor::fetch() {
  for (;;) {
    stack_.back().lexer.next(token_);
    if (token_.problem != Token::Problem::None) report_problem(token_);
    switch (token_.kind) {
      case Token::Kind::End:
        if (stack_.size() == 1) {
          if (stack_.back().conditionals > 0) {
            diagnostics_->warning(code::kConditional, locate(token_), "the file ends inside $ifdef",
                                  "close it with $endif");
            stack_.back().conditionals = 0;
          }
          ready_ = true;
          return;
        }
        pop();
        break;
      case Token::Kind::Directive:
        directive(token_);
        break;
      case Token::Kind::Bad:
        diagnostics_->warning(code::kBadCharacter, locate(token_),
                              "characters that have no meaning in a scene file were skipped");
        break;
      default:
        ready_ = true;
        return;
    }
  }
}

void Cursor::report_problem(const Token& token) {
  if (token.problem == Token::Problem::NumberRange) {
    diagnostics_->warning(
        code::kNumberRange, locate(token),
        fmt::format("number {} is too large and was clamped", token.text.substr(0, 40)));
  } else {
    const std::string_view what = token.kind == Token::Kind::String ? "string"
                                  : token.kind == Token::Kind::Hex  ? "pixel block"
                                                                    : "binary block";
    diagnostics_->error(code::kUnterminated, locate(token),
                        fmt::format("this {} is never closed", what));
  }
}

void Cursor::forget_what_was_read() {
  for (Frame& frame : stack_) {
    const bool ahead = ready_ && token_.source == frame.source.get();
    frame.source->forget_before(ahead ? token_.raw.data() : frame.lexer.position());
  }
}

const char* Cursor::raw() {
  if (ready_) {
    if (token_.kind == Token::Kind::End) return token_.raw.data();
    set_raw(token_.raw.data());
    ready_ = false;
  }
  return stack_.back().lexer.position();
}

std::string Cursor::folder() {
  return std::filesystem::path(source().path()).parent_path().string();
}

std::span<const char> Cursor::binary(std::size_t bytes) {
  const Token& token = peek();
  if (token.kind != Token::Kind::Binary) return {};
  const char* const payload = token.raw.data() + 1;
  const auto available = static_cast<std::size_t>(token.source->end() - payload);
  if (available > bytes && payload[bytes] == '`') {
    set_raw(payload + bytes + 1);
    ready_ = false;
    return {payload, bytes};
  }
  diagnostics_->error(code::kBadBinary, where(),
                      fmt::format("expected a binary block of {} bytes", bytes));
  next();
  return {};
}

std::vector<std::string> Cursor::take_packages() { return std::exchange(packages_, {}); }
std::vector<Cursor::CodeBlock> Cursor::take_code() { return std::exchange(code_, {}); }

}  // namespace oriel::mi
