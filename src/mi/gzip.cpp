// SPDX-License-Identifier: Apache-2.0
#include "mi/gzip.h"

#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <memory>
#include <new>

namespace oriel::mi {
namespace {

constexpr unsigned kChunk = 1u << 20;
/// Short files may consist of few bytes, such as a list of zeros.
constexpr std::uint64_t kAnyExpansion = std::uint64_t{64} << 20;

std::optional<std::string> decompressed(gzFile file, const TextLimits& limits, SourceFault& fault) {
  std::string text;
  std::size_t used = 0;
  for (;;) {
    // While reading, so that a small file cannot fill the memory before it is refused.
    const auto compressed = static_cast<std::uint64_t>(std::max<z_off_t>(gzoffset(file), 1));
    if (used > kAnyExpansion && used / compressed >= limits.expansion)
      fault.budget = Budget::Expansion;
    if (used > limits.text) fault.budget = Budget::Text;
    if (fault.budget) return std::nullopt;
    if (text.size() < used + kChunk) text.resize(2 * used + kChunk);
    const int read = gzread(file, text.data() + used, kChunk);
    if (read <= 0) break;
    used += static_cast<std::size_t>(read);
  }
  int error = Z_OK;
  const char* message = gzerror(file, &error);
  if (error != Z_OK && error != Z_STREAM_END) {
    fault.reason = std::string("damaged: ") + message;
    return std::nullopt;
  }
  text.resize(used);
  return text;
}

}  // namespace

bool is_gzip(const OpenFile& file) {
  unsigned char magic[2] = {};
  return ::pread(file.descriptor(), magic, sizeof magic, 0) == sizeof magic && magic[0] == 0x1f &&
         magic[1] == 0x8b;  // RFC 1952, 2.3.1
}

std::optional<std::string> read_gzip(const OpenFile& file, const TextLimits& limits,
                                     SourceFault& fault) {
  fault = {};
  const int descriptor = ::dup(file.descriptor());
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> stream(gzdopen(descriptor, "rb"), gzclose_r);
  if (!stream) {
    if (descriptor >= 0) ::close(descriptor);
    fault.reason = "cannot be opened";
    return std::nullopt;
  }
  gzbuffer(stream.get(), kChunk);
  try {
    return decompressed(stream.get(), limits, fault);
  } catch (const std::bad_alloc&) {
    fault.reason = "not enough memory for its text";
    return std::nullopt;
  }
}

}  // namespace oriel::mi
