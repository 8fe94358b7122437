// SPDX-License-Identifier: Apache-2.0
#include "studio/page_files.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <utility>

#include "base/file_access.h"

namespace oriel::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxPageFile = std::size_t{16} << 20;

std::string_view type_of_suffix(std::string_view suffix) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kTypes = {{
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".mjs", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".json", "application/json; charset=utf-8"},
      {".svg", "image/svg+xml; charset=utf-8"},
      {".png", "image/png"},
      {".ico", "image/x-icon"},
      {".woff2", "font/woff2"},
      {".glsl", "text/plain; charset=utf-8"},
  }};
  for (const auto& [known, type] : kTypes)
    if (known == suffix) return type;
  return {};
}

/// FNV-1a, 64 bits (Fowler, Noll and Vo): differs where contents do, nothing more is needed.
std::string content_tag(std::string_view bytes) {
  std::uint64_t value = 14695981039346656037ull;
  for (const char c : bytes) value = (value ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), "\"%016llx\"", static_cast<unsigned long long>(value));
  return text.data();
}

}  // namespace

PageFiles::PageFiles(const fs::path& folder) {
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error)) {
    const fs::path& path = at->path();
    const std::string name = path.filename().string();
    if (name.starts_with(".") || name == "node_modules" || name == "tests") {
      at.disable_recursion_pending();
      continue;
    }
    const std::string_view type = type_of_suffix(path.extension().string());
    if (type.empty() || !fs::is_regular_file(at->symlink_status(error))) continue;
    files_["/" + path.lexically_relative(folder).generic_string()] = {path, type};
  }
}

std::optional<PageFile> PageFiles::find(std::string_view target) const {
  const auto found = files_.find(target == "/" ? "/index.html" : target);
  if (found == files_.end()) return std::nullopt;
  OpenFile file = open_regular(found->second.path.string());
  if (!file || file.size() > kMaxPageFile) return std::nullopt;
  PageFile result{file.read(kMaxPageFile), found->second.type, {}};
  result.tag = content_tag(result.bytes);
  return result;
}

}  // namespace oriel::studio
