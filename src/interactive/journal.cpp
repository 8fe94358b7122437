// SPDX-License-Identifier: Apache-2.0
#include "interactive/journal.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/file_access.h"

namespace oriel::interactive {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxJournal = std::size_t{64} << 20;

/// Line breaks and backslashes of an edit.
std::string escaped(const std::string& edit) {
  std::string line;
  for (const char c : edit) {
    if (c == '\\' || c == '\n') line += '\\';
    line += c == '\n' ? 'n' : c;
  }
  return line;
}

std::string unescaped(const std::string& line) {
  std::string edit;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] != '\\' || i + 1 == line.size()) {
      edit += line[i];
      continue;
    }
    ++i;
    edit += line[i] == 'n' ? '\n' : line[i];
  }
  return edit;
}

}  // namespace

std::vector<std::string> EditJournal::read() const {
  OpenFile file = open_regular(path_);
  if (!file) return {};
  const std::string text = file.read(kMaxJournal);
  std::vector<std::string> edits;
  std::size_t at = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', at)) {
    if (end > at) edits.push_back(unescaped(text.substr(at, end - at)));
    at = end + 1;
  }
  return edits;
}

void EditJournal::write(const std::vector<std::string>& edits) const {
  std::error_code error;
  if (edits.empty()) {
    fs::remove(path_, error);
    return;
  }
  std::string text;
  for (const std::string& edit : edits) text += escaped(edit) + "\n";
  fs::create_directories(fs::path(path_).parent_path(), error);
  // Not flushed to the disk: what the system holds survives the end of the process, and flushing
  // would delay each edit by a tenth of a second.
  const std::string next = path_ + ".new";
  std::ofstream stream(next, std::ios::binary | std::ios::trunc);
  stream << text;
  stream.close();
  // The edits are still in the session; a full disk must not end it.
  if (stream) fs::rename(next, path_, error);
}

std::string journal_path(const std::string& scene) {
  const char* const state = std::getenv("XDG_STATE_HOME");
  const char* const home = std::getenv("HOME");
  fs::path base;
  if (state != nullptr && *state == '/')
    base = state;
  else if (home != nullptr && *home == '/')
    base = fs::path(home) / ".local" / "state";
  else
    return {};
  std::error_code error;
  const std::string path = fs::weakly_canonical(fs::absolute(scene, error), error).string();
  // FNV-1a, 64 bits (Fowler, Noll and Vo).
  std::uint64_t value = 14695981039346656037ull;
  for (const char c : path) value = (value ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  char name[24];
  std::snprintf(name, sizeof name, "%016llx", static_cast<unsigned long long>(value));
  return (base / "oriel" / "studio" / (std::string(name) + ".edits")).string();
}

}  // namespace oriel::interactive
