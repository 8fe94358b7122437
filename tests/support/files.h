// SPDX-License-Identifier: Apache-2.0
// A temporary folder of a test, and the bytes of files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "base/temporary_folder.h"

namespace oriel {

/// A new folder for the files of one test; removed with all that is in it.
class TestFolder : public TemporaryFolder {
 public:
  int count() const {
    return int(std::distance(std::filesystem::directory_iterator(path()),
                             std::filesystem::directory_iterator()));
  }
};

inline std::vector<char> bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return std::vector<char>(std::istreambuf_iterator<char>(in), {});
}

inline std::string text_of(const std::string& path) {
  const std::vector<char> bytes = bytes_of(path);
  return std::string(bytes.begin(), bytes.end());
}

inline void write_bytes(const std::string& path, const std::vector<char>& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
}

}  // namespace oriel
