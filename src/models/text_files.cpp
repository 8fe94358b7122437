// SPDX-License-Identifier: Apache-2.0
#include "models/text_files.h"

#include <assimp/MemoryIOWrapper.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <optional>

#include "base/math.h"
#include "base/vec.h"

namespace oriel::models {
namespace {

constexpr std::string_view kLittleEndian = "\xff\xfe", kBigEndian = "\xfe\xff";

void append_utf8(std::string& text, char32_t c) {
  const auto tail = [&](int shift) { text += static_cast<char>(0x80 | (c >> shift & 0x3f)); };
  if (c < 0x80) {
    text += static_cast<char>(c);
  } else if (c < 0x800) {
    text += static_cast<char>(0xc0 | c >> 6);
    tail(0);
  } else if (c < 0x10000) {
    text += static_cast<char>(0xe0 | c >> 12);
    tail(6), tail(0);
  } else {
    text += static_cast<char>(0xf0 | c >> 18);
    tail(12), tail(6), tail(0);
  }
}

bool is_utf16(std::string_view bytes) {
  return bytes.starts_with(kLittleEndian) || bytes.starts_with(kBigEndian);
}

/// Reads only the byte order mark.
bool is_utf16_file(const OpenFile& file) {
  char mark[2] = {};
  return ::pread(file.descriptor(), mark, sizeof mark, 0) == sizeof mark &&
         is_utf16({mark, sizeof mark});
}

/// A file in memory. It does not depend on the position of the descriptor, which other streams may
/// share.
class MappedFile {
 public:
  explicit MappedFile(const OpenFile& file) : size_(static_cast<std::size_t>(file.size())) {
    if (size_ > 0) start_ = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file.descriptor(), 0);
    if (start_ == MAP_FAILED) throw std::bad_alloc();
  }
  ~MappedFile() {
    if (size_ > 0) ::munmap(start_, size_);
  }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  const std::uint8_t* data() const { return static_cast<const std::uint8_t*>(start_); }
  std::size_t size() const { return size_; }

 private:
  std::size_t size_;
  void* start_ = nullptr;
};

class MappedStream final : private MappedFile, public Assimp::MemoryIOStream {
 public:
  explicit MappedStream(const OpenFile& file) : MappedFile(file), MemoryIOStream(data(), size()) {}
};

/// An element <name ...>number</name>: where it is and its number.
struct NumberElement {
  std::size_t start = 0, size = 0;
  float value = 0;
};

std::optional<NumberElement> number_element(const std::string& xml, const std::string& name) {
  const std::size_t start = xml.find("<" + name), content = xml.find('>', start);
  const std::string closing = "</" + name + ">";
  const std::size_t end = xml.find(closing, content);
  if (end == xml.npos) return std::nullopt;
  const std::string text = xml.substr(content + 1, end - content - 1);
  char* rest = nullptr;
  const float value = std::strtof(text.c_str(), &rest);
  if (rest == text.c_str() || !(value > 0)) return std::nullopt;
  return NumberElement{start, end + closing.size() - start, value};
}

/// The beginning of one <perspective>, up to its closing tag.
std::string with_horizontal_angle(std::string_view perspective, float aspect) {
  std::string text(perspective);
  // Angles below that are radians: see widen_narrow_cameras.
  constexpr float kNarrow = 1.5f;
  const auto tangent = [](float angle) {
    return math::tan((angle < kNarrow ? angle : angle * kPi / 180) / 2);
  };
  const auto x = number_element(text, "xfov"), y = number_element(text, "yfov");
  if (!y) return text;
  const auto written = number_element(text, "aspect_ratio");
  if (x) {
    if (!written)
      text.replace(
          y->start, y->size,
          fmt::format("<aspect_ratio>{}</aspect_ratio>", tangent(x->value) / tangent(y->value)));
    return text;
  }
  const float shape = written ? written->value : aspect;
  const float radians = 2 * math::atan(tangent(y->value) * shape);
  const float angle = y->value < kNarrow ? radians : radians * 180 / kPi;
  text.replace(y->start, y->size,
               fmt::format("<xfov>{}</xfov>{}", angle,
                           written ? "" : fmt::format("<aspect_ratio>{}</aspect_ratio>", shape)));
  return text;
}

}  // namespace

std::string utf8_of(std::string_view bytes) {
  if (!is_utf16(bytes)) return std::string(bytes);
  constexpr char32_t kReplacement = 0xfffd;
  const std::size_t high = bytes.starts_with(kBigEndian) ? 0 : 1;
  const auto unit = [&](std::size_t i) -> char32_t {
    return static_cast<unsigned char>(bytes[i + high]) * 256u +
           static_cast<unsigned char>(bytes[i + 1 - high]);
  };
  std::string text;
  text.reserve(bytes.size() / 2);
  std::size_t i = 2;
  for (; i + 1 < bytes.size(); i += 2) {
    const char32_t c = unit(i);
    const bool first = c >= 0xd800 && c < 0xdc00, second = c >= 0xdc00 && c < 0xe000;
    const char32_t next = first && i + 3 < bytes.size() ? unit(i + 2) : 0;
    if (first && next >= 0xdc00 && next < 0xe000) {
      append_utf8(text, 0x10000 + ((c - 0xd800) << 10) + (next - 0xdc00));
      i += 2;
    } else {
      append_utf8(text, first || second ? kReplacement : c);
    }
  }
  if (i < bytes.size()) append_utf8(text, kReplacement);
  return text;
}

std::string without_blanks_before_numbers(std::string_view xml) {
  constexpr std::string_view kBlanks = " \t\r\n", kNumbers = "+-.0123456789";
  std::string tidy;
  tidy.reserve(xml.size());
  for (std::size_t i = 0; i < xml.size();) {
    const char c = xml[i++];
    tidy += c;
    if (c != '>') continue;
    const std::size_t next = xml.find_first_not_of(kBlanks, i);
    if (next != xml.npos && kNumbers.find(xml[next]) != kNumbers.npos) i = next;
  }
  return tidy;
}

std::string with_whole_cameras(std::string_view xml, float aspect) {
  constexpr std::string_view kCamera = "<camera ", kStart = "<perspective", kEnd = "</perspective>";
  std::string made;
  made.reserve(xml.size());
  for (std::size_t at = 0;;) {
    const std::size_t camera = xml.find(kCamera, at), tag = xml.find('>', camera);
    if (tag == xml.npos) return made.append(xml.substr(at));
    made += xml.substr(at, camera + kCamera.size() - at);
    at = camera + kCamera.size();
    if (xml.substr(at, tag - at).find("name=") == xml.npos) made += "name=\"camera\" ";
    const std::size_t next = xml.find(kCamera, at), start = xml.find(kStart, at),
                      end = xml.find(kEnd, start);
    if (end == xml.npos || start > next) continue;
    made += xml.substr(at, start - at);
    made += with_horizontal_angle(xml.substr(start, end - start), aspect);
    at = end;
  }
}

OpenFile TextFiles::open(const std::string& file) const {
  return file == files_.model ? open_regular(file) : files_.access.open(file, files_.use);
}

bool TextFiles::Exists(const char* file) const { return file && bool(open(file)); }

Assimp::IOStream* TextFiles::Open(const char* file, const char* mode) {
  if (!file || !mode || std::strpbrk(mode, "wa+")) return nullptr;
  OpenFile opened = open(file);
  if (!opened) {
    if (opened.fault() != OpenFile::Fault::Missing)
      files_.refused.emplace(
          file, opened.hint().empty() ? opened.reason() : opened.reason() + "; " + opened.hint());
    return nullptr;
  }
  if (!rewrite_ && !is_utf16_file(opened)) return new MappedStream(opened);
  auto found = changed_.find(file);
  if (found == changed_.end()) {
    std::string text = utf8_of(opened.read());
    if (rewrite_) text = rewrite_(text);
    found = changed_.emplace(file, std::move(text)).first;
  }
  const std::string& text = found->second;
  return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(text.data()),
                                    text.size());
}

}  // namespace oriel::models
