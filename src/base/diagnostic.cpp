// SPDX-License-Identifier: Apache-2.0
#include "base/diagnostic.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "base/printable.h"

namespace oriel {
namespace {

constexpr std::string_view kSeverityNames[] = {"note", "warning", "error"};

/// Insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`.
/// Source:  F. Damerau, CACM 7(3), 1964, in the restricted form: no part is edited twice.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

/// Text with `with` in place of line feeds, without control characters: a name must not look like
/// a message of its own.
std::string with_line_feeds(std::string_view text, std::string_view with) {
  std::string made;
  for (const char c : printable(text))
    if (c == '\n')
      made += with;
    else
      made += c;
  return made;
}
std::string in_one_line(std::string_view text) { return with_line_feeds(text, "\\n"); }
std::string indented(std::string_view text) { return with_line_feeds(text, "\n    "); }

}  // namespace

Diagnostics::Diagnostics() { files_.push_back({"", {}}); }

std::uint32_t Diagnostics::add_file(std::string path, SourceLocation included_from) {
  const std::scoped_lock lock(mutex_);
  files_.push_back({std::move(path), included_from});
  return static_cast<std::uint32_t>(files_.size() - 1);
}

void Diagnostics::report(Severity severity, std::string_view code, SourceLocation where,
                         std::string message, std::string hint) {
  const std::scoped_lock lock(mutex_);
  const auto same =
      std::count_if(all_.begin(), all_.end(), [&](const Diagnostic& d) { return d.code == code; });
  if (static_cast<std::size_t>(same) > kMaxPerCode) return;
  if (static_cast<std::size_t>(same) == kMaxPerCode) {
    message = "further messages of this kind are suppressed";
    hint.clear();
  }
  all_.push_back({severity, std::string(code), where, std::move(message), std::move(hint)});
}

void Diagnostics::forget_after(std::size_t count) {
  const std::scoped_lock lock(mutex_);
  if (count < all_.size()) all_.resize(count);
}

std::size_t Diagnostics::count(Severity severity) const {
  return static_cast<std::size_t>(std::count_if(
      all_.begin(), all_.end(), [&](const Diagnostic& d) { return d.severity == severity; }));
}

bool Diagnostics::has(std::string_view code) const {
  return std::any_of(all_.begin(), all_.end(), [&](const Diagnostic& d) { return d.code == code; });
}

std::string Diagnostics::format(const Diagnostic& d) const {
  std::string text;
  const auto place = [&](SourceLocation w) {
    const std::string path = in_one_line(files_[w.file].path);
    if (w.line == 0) return w.file ? path : std::string("oriel");
    return fmt::format("{}:{}:{}", path, w.line, w.column);
  };
  for (SourceLocation from = files_[d.where.file].included_from; from.file != 0;
       from = files_[from.file].included_from)
    text = fmt::format("in file included from {}:\n", place(from)) + text;
  text += fmt::format("{}: {}: {} [{}]", place(d.where),
                      kSeverityNames[static_cast<int>(d.severity)], indented(d.message), d.code);
  if (!d.hint.empty()) text += fmt::format("\n    hint: {}", indented(d.hint));
  return text;
}

std::string nearest_name(std::string_view name, std::span<const std::string> candidates) {
  constexpr std::size_t kLongestCompared = 128;
  if (name.size() > kLongestCompared) return {};
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, name.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > kLongestCompared) continue;
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string nearest_file(const std::string& missing) {
  constexpr std::size_t kMaxFiles = 10000;
  const std::filesystem::path path(missing);
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::error_code error;
  std::vector<std::string> names;
  for (std::filesystem::directory_iterator file(folder, error), end;
       !error && file != end && names.size() < kMaxFiles; file.increment(error))
    names.push_back(file->path().filename().string());
  std::sort(names.begin(), names.end());  // the order of a folder is not defined
  return nearest_name(path.filename().string(), names);
}

std::string did_you_mean(std::string_view name, std::span<const std::string> candidates) {
  const std::string near = nearest_name(name, candidates);
  return near.empty() ? "" : fmt::format("did you mean \"{}\"?", near);
}

}  // namespace oriel
