// SPDX-License-Identifier: Apache-2.0
#include "mi/source.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "base/input_files.h"
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

std::unique_ptr<Source> Source::load(OpenFile& file, const std::string& path,
                                     const TextLimits& limits, SourceFault& fault) {
  note_input_file(path, InputKind::Scene);
  if (is_gzip(file)) {
    const std::optional<std::string> text = read_gzip(file, limits, fault);
    return text ? from_text(*text, path) : nullptr;
  }
  if (file.size() > limits.text) {
    fault.budget = Budget::Text;
    return nullptr;
  }
  const auto size = static_cast<std::size_t>(file.size());
  auto source = std::unique_ptr<Source>(new Source(size, path));
  std::size_t read = 0;
  while (read < size) {
    const ssize_t got = ::read(file.descriptor(), source->text_.get() + read, size - read);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    read += static_cast<std::size_t>(got);
  }
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
