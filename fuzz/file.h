// SPDX-License-Identifier: Apache-2.0
// The bytes of a fuzzer as files, for readers that take a path.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/temporary_folder.h"

namespace oriel::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Lives in memory; its path is good as long as it lives.
class MemoryFile {
 public:
  MemoryFile(const std::uint8_t* data, std::size_t size) : number_(memfd_create("fuzz", 0)) {
    if (::write(number_, data, size) < 0) ::_exit(1);
  }
  ~MemoryFile() { ::close(number_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::string path() const { return "/proc/self/fd/" + std::to_string(number_); }

 private:
  int number_;
};

/// One input as several files in a temporary folder: the line "--- NAME" starts a file. The folder
/// contains nothing else, and names that leave it start no file.
class Files {
 public:
  Files(const std::uint8_t* data, std::size_t size) {
    constexpr std::string_view kMark = "--- ";
    std::string_view rest = text_of(data, size);
    while (rest.starts_with(kMark)) {
      rest.remove_prefix(kMark.size());
      const std::string name(rest.substr(0, rest.find('\n')));
      rest.remove_prefix(std::min(name.size() + 1, rest.size()));
      const std::size_t end = rest.find("\n--- ");
      const std::string_view content = rest.substr(0, end);
      rest = end == rest.npos ? std::string_view() : rest.substr(end + 1);
      if (!is_plain(name)) continue;
      std::ofstream(folder_.file(name), std::ios::binary)
          .write(content.data(), static_cast<std::streamsize>(content.size()));
      names_.push_back(name);
    }
  }
  const std::vector<std::string>& names() const { return names_; }
  std::string path(const std::string& name) const { return folder_.file(name); }
  std::string folder() const { return folder_.path().string(); }

 private:
  static bool is_plain(const std::string& name) {
    return !name.empty() && name.size() < 64 && name[0] != '.' &&
           name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789._-") == name.npos;
  }

  TemporaryFolder folder_;
  std::vector<std::string> names_;
};

/// Numbers from the bytes of a fuzzer; 0 after their end.
class Numbers {
 public:
  Numbers(const std::uint8_t* data, std::size_t size) : rest_(text_of(data, size)) {}
  bool at_end() const { return rest_.empty(); }
  template <class T>
  T next() {
    T value{};
    const std::size_t count = std::min(sizeof value, rest_.size());
    rest_.copy(reinterpret_cast<char*>(&value), count);
    rest_.remove_prefix(count);
    return value;
  }
  /// 0 ... limit - 1
  std::size_t below(std::size_t limit) { return next<std::uint8_t>() % limit; }
  std::string text(std::size_t most) {
    std::string out(rest_.substr(0, most));
    rest_.remove_prefix(out.size());
    return out;
  }

 private:
  std::string_view rest_;
};

}  // namespace oriel::fuzz
