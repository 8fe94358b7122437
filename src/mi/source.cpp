// SPDX-License-Identifier: Apache-2.0
#include "mi/source.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "base/input_files.h"
#include "mi/gzip.h"
#include "mi/utf16.h"

namespace oriel::mi {
namespace {

constexpr std::size_t kWorthForgetting = std::size_t{4} << 20;  // each release is a system call
constexpr std::size_t kPadding = 16;  // zero bytes after the text; scans read a few bytes ahead

}  // namespace

Source::Source(std::size_t size, std::string path)
    : text_(std::make_unique_for_overwrite<char[]>(size + kPadding)),
      size_(size),
      path_(std::move(path)) {
  std::memset(text_.get() + size, 0, kPadding);
  last_ = line_start_ = text_.get();
}

std::unique_ptr<Source> Source::load(const std::string& path, std::uint64_t max_size,
                                     std::string& reason) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    reason = error ? error.message() : "not a regular file";
    return nullptr;
  }
  const std::uint64_t size = std::filesystem::file_size(path, error);
  if (error || size > max_size) {
    reason = error ? error.message() : "larger than " + std::to_string(max_size) + " bytes";
    return nullptr;
  }
  std::FILE* const file = std::fopen(path.c_str(), "rb");
  if (!file) {
    reason = std::strerror(errno);
    return nullptr;
  }
  note_input_file(path, InputKind::Scene);
  if (is_gzip(file)) {
    std::fclose(file);
    const std::optional<std::string> text = read_gzip(path, max_size, reason);
    return text ? from_text(*text, path) : nullptr;
  }
  auto source = std::unique_ptr<Source>(new Source(size, path));
  const std::size_t read = std::fread(source->text_.get(), 1, size, file);
  std::fclose(file);
  source->size_ = read;  // shorter if the file was truncated meanwhile
  std::memset(source->text_.get() + read, 0, kPadding);
  if (is_utf16({source->begin(), source->size()}))
    return from_text({source->begin(), source->size()}, path);
  source->examine();
  return source;
}

std::unique_ptr<Source> Source::from_text(std::string_view text, std::string path) {
  if (is_utf16(text)) return from_text(utf8_of_utf16(text), std::move(path));
  auto source = std::unique_ptr<Source>(new Source(text.size(), std::move(path)));
  std::memcpy(source->text_.get(), text.data(), text.size());
  source->examine();
  return source;
}

void Source::examine() {
  while (size_ > 0 && text_[size_ - 1] == 0) --size_;
  const char* first = begin();
  while (first < end() && *first != '\n' && *first != '\r') ++first;
  if (first < end() && *first == '\r' && first[1] != '\n') newline_ = '\r';
}

SourceLocation Source::locate(const char* at) {
  if (at < last_) {
    line_ -= static_cast<std::uint32_t>(std::count(at, last_, newline_));
    if (at < line_start_) {
      line_start_ = at;
      while (line_start_ > begin() && line_start_[-1] != newline_) --line_start_;
    }
  } else {
    const char* p = last_;
    while (const void* found = std::memchr(p, newline_, static_cast<std::size_t>(at - p))) {
      p = static_cast<const char*>(found) + 1;
      line_start_ = p;
      ++line_;
    }
  }
  last_ = at;
  return {file, line_, static_cast<std::uint32_t>(at - line_start_ + 1)};
}

bool Source::starts_line(const char* at) const {
  while (at > begin() && (at[-1] == ' ' || at[-1] == '\t')) --at;
  return at == begin() || at[-1] == '\n' || at[-1] == '\r';
}

void Source::forget_before(const char* at) {
  if (static_cast<std::size_t>(at - begin()) < forgotten_ + kWorthForgetting) return;
  locate(at);
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const auto address = reinterpret_cast<std::uintptr_t>(begin());
  const std::uintptr_t first = (address + forgotten_ + page - 1) / page * page;
  const std::uintptr_t end = reinterpret_cast<std::uintptr_t>(line_start_) / page * page;
  if (end < first + kWorthForgetting) return;
  // Whole pages inside our own allocation: the memory is released, the address range stays
  // allocated.
  if (madvise(reinterpret_cast<void*>(first), end - first, MADV_DONTNEED) == 0)
    forgotten_ = end - address;
}

}  // namespace oriel::mi
