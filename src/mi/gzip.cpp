// SPDX-License-Identifier: Apache-2.0
#include "mi/gzip.h"

#include <zlib.h>

#include <memory>

namespace oriel::mi {

bool is_gzip(std::FILE* file) {
  const int first = std::fgetc(file), second = std::fgetc(file);
  std::rewind(file);
  return first == 0x1f && second == 0x8b;  // RFC 1952, 2.3.1
}

std::optional<std::string> read_gzip(const std::string& path, std::uint64_t max_size,
                                     std::string& reason) {
  constexpr unsigned kChunk = 1u << 20;
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "rb"), gzclose_r);
  if (!file) {
    reason = "cannot be opened";
    return std::nullopt;
  }
  gzbuffer(file.get(), kChunk);
  std::string text;
  std::size_t used = 0;
  for (;;) {
    // A small file may decompress to an unbounded size.
    if (used > max_size) {
      reason = "its text is larger than " + std::to_string(max_size) + " bytes";
      return std::nullopt;
    }
    if (text.size() < used + kChunk) text.resize(2 * used + kChunk);
    const int read = gzread(file.get(), text.data() + used, kChunk);
    if (read <= 0) break;
    used += static_cast<std::size_t>(read);
  }
  int error = Z_OK;
  const char* message = gzerror(file.get(), &error);
  if (error != Z_OK && error != Z_STREAM_END) {
    reason = std::string("damaged: ") + message;
    return std::nullopt;
  }
  text.resize(used);
  return text;
}

}  // namespace oriel::mi
