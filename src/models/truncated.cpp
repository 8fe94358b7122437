// SPDX-License-Identifier: Apache-2.0
#include "models/truncated.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include "base/file_text.h"

namespace oriel::models {
namespace {

namespace fs = std::filesystem;

/// Bytes at the start and at the end of files that are examined; blanks and comments may follow the
/// last statement.
constexpr std::size_t kPart = std::size_t{64} << 10;

constexpr std::string_view kSpaces = " \t\r\n\f\v";

struct Ends {
  std::string head, tail;
  std::size_t size = 0;
};

Ends ends_of(const std::string& path) {
  Ends ends;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  if (size <= 0) return ends;
  ends.size = static_cast<std::size_t>(size);
  ends.head.resize(std::min(ends.size, kPart));
  ends.tail.resize(ends.head.size());
  file.seekg(0);
  file.read(ends.head.data(), static_cast<std::streamsize>(ends.head.size()));
  file.seekg(-static_cast<std::streamoff>(ends.tail.size()), std::ios::end);
  file.read(ends.tail.data(), static_cast<std::streamsize>(ends.tail.size()));
  return ends;
}

template <class T>
std::optional<T> number_at(std::string_view bytes, std::size_t offset) {
  if (offset > bytes.size() || sizeof(T) > bytes.size() - offset) return std::nullopt;
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

/// The end without blanks.
std::string_view without_tail_blanks(std::string_view text) {
  const std::size_t last = text.find_last_not_of(kSpaces);
  return last == text.npos ? std::string_view() : text.substr(0, last + 1);
}

std::string sizes(std::uint64_t size, std::uint64_t whole) {
  return fmt::format("the file is truncated: {} of {} bytes", size, whole);
}
std::string no_end(bool has_end) { return has_end ? "" : "the file is truncated: it has no end"; }

/// A binary file has 50 bytes for each triangle. A text may start like one and vice versa.
std::string stl(const Ends& ends) {
  constexpr std::uint64_t kHeader = 84, kTriangle = 50;
  const auto triangles = number_at<std::uint32_t>(ends.head, 80);
  const std::uint64_t whole = triangles ? kHeader + kTriangle * *triangles : kHeader;
  if (triangles && whole == ends.size) return {};
  const std::size_t first = ends.head.find_first_not_of(kSpaces);
  if (first != ends.head.npos && std::string_view(ends.head).substr(first, 5) == "solid")
    return no_end(ends.tail.find("endsolid") != ends.tail.npos);
  return ends.size < whole ? sizes(ends.size, whole) : "";
}

std::string chunks_3ds(const Ends& ends) {
  const auto whole = number_at<std::uint32_t>(ends.head, 2);
  if (!whole) return no_end(false);
  return ends.size < *whole ? sizes(ends.size, *whole) : "";
}

/// Each record begins with the offset of its end; an empty record ends the list.
std::string fbx_records(const std::string& path, const Ends& ends) {
  constexpr std::size_t kVersion = 23, kFirst = 27;
  const bool is_wide = number_at<std::uint32_t>(ends.head, kVersion).value_or(0) >= 7500;
  std::ifstream file(path, std::ios::binary);
  for (std::uint64_t offset = kFirst;;) {
    std::string record(is_wide ? 8 : 4, '\0');
    file.seekg(static_cast<std::streamoff>(offset));
    if (!file.read(record.data(), static_cast<std::streamsize>(record.size())))
      return no_end(false);
    const std::uint64_t end =
        is_wide ? *number_at<std::uint64_t>(record, 0) : *number_at<std::uint32_t>(record, 0);
    if (end == 0) return {};
    if (end > ends.size)
      return fmt::format("the file is truncated: it has {} bytes, and more than {} are expected",
                         ends.size, end);
    if (end <= offset) return {};  // damaged; reported by assimp
    offset = end;
  }
}

/// Braces outside strings and comments.
bool has_balanced_braces(const std::string& text) {
  int depth = 0;
  bool in_string = false, in_comment = false;
  for (const char c : text) {
    if (c == '\n') in_comment = false;
    if (in_comment) continue;
    if (c == '"') in_string = !in_string;
    if (in_string) continue;
    if (c == ';') in_comment = true;
    if (c == '{') ++depth;
    if (c == '}') --depth;
  }
  return depth <= 0 && !in_string;
}

std::string fbx(const std::string& path, const Ends& ends) {
  constexpr std::string_view kBinary = "Kaydara FBX Binary";
  if (std::string_view(ends.head).substr(0, kBinary.size()) == kBinary)
    return fbx_records(path, ends);
  const std::string text = file_text(path);
  return no_end(has_balanced_braces(text) && text.find("Connections:") != text.npos);
}

struct PlyProperty {
  std::size_t count_size = 0;  ///< 0: no list
  std::size_t size = 0;
};
struct PlyElement {
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

std::size_t ply_size(const std::string& type) {
  if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
  if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
  return type == "double" || type == "float64" ? 8 : 4;
}

/// Values of an element in text; false if there are too few.
bool skip_text(std::istringstream& data, const PlyElement& element) {
  std::string word;
  for (const PlyProperty& property : element.properties) {
    std::uint64_t count = 1;
    if (property.count_size > 0 && !(data >> count)) return false;
    for (std::uint64_t i = 0; i < count; ++i)
      if (!(data >> word)) return false;
  }
  return true;
}

bool skip_bytes(std::string_view bytes, std::size_t& offset, const PlyElement& element,
                bool is_big) {
  for (const PlyProperty& property : element.properties) {
    std::uint64_t count = 1;
    if (property.count_size > 0) {
      if (property.count_size > bytes.size() - offset) return false;
      count = 0;
      for (std::size_t i = 0; i < property.count_size; ++i) {
        const std::size_t byte = is_big ? i : property.count_size - 1 - i;
        count = count << 8 | static_cast<unsigned char>(bytes[offset + byte]);
      }
      offset += property.count_size;
    }
    if (count > (bytes.size() - offset) / property.size) return false;
    offset += count * property.size;
  }
  return true;
}

/// The data behind the header.
std::string ply_data(const std::string& text, std::size_t header,
                     const std::vector<PlyElement>& elements, const std::string& format) {
  std::istringstream words(format == "ascii" ? text.substr(header) : "");
  std::size_t offset = header;
  for (const PlyElement& element : elements)
    for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i)
      if (format == "ascii" ? !skip_text(words, element)
                            : !skip_bytes(text, offset, element, format == "binary_big_endian"))
        return fmt::format("the file is truncated: an element has {} of {} items", i,
                           element.count);
  return {};
}

std::string ply(const std::string& path) {
  const std::string text = file_text(path);
  std::istringstream lines(text);
  std::string line, format = "ascii";
  std::vector<PlyElement> elements;
  while (std::getline(lines, line, text.find('\n') == text.npos ? '\r' : '\n')) {
    std::istringstream words(line);
    std::string keyword, type;
    words >> keyword;
    if (keyword == "format") words >> format;
    if (keyword == "element") {
      elements.emplace_back();
      words >> type >> elements.back().count;
    } else if (keyword == "property" && !elements.empty() && words >> type) {
      PlyProperty property;
      if (type == "list") {
        words >> type;
        property.count_size = ply_size(type);
        words >> type;
      }
      property.size = ply_size(type);
      elements.back().properties.push_back(property);
    } else if (keyword == "end_header") {
      if (lines.eof()) break;
      return ply_data(text, static_cast<std::size_t>(lines.tellg()), elements, format);
    }
  }
  if (without_tail_blanks(text).ends_with("end_header"))
    return ply_data(text, text.size(), elements, format);
  return "its header is incomplete";
}

/// Whether the text does not end within a value. Other errors are reported by the reader.
bool has_whole_json(const std::string& text) {
  try {
    const nlohmann::json::parser_callback_t drop = [](int, auto, auto&) { return false; };
    [[maybe_unused]] const auto parsed = nlohmann::json::parse(text, drop);
  } catch (const nlohmann::json::parse_error& error) {
    return error.byte <= text.size();
  }
  return true;
}

/// Values that a statement of OBJ and MTL files has at least; 0 for others.
std::size_t least_values(std::string_view keyword) {
  constexpr std::string_view kThree[] = {"v", "vn", "f", "Ka", "Kd", "Ks", "Ke", "Tf"};
  constexpr std::string_view kOne[] = {"usemtl", "mtllib", "newmtl", "Ns", "Ni",
                                       "d",      "Tr",     "illum",  "Pr", "Pm"};
  if (std::find(std::begin(kThree), std::end(kThree), keyword) != std::end(kThree)) return 3;
  if (std::find(std::begin(kOne), std::end(kOne), keyword) != std::end(kOne)) return 1;
  if (keyword == "vt") return 2;
  return keyword.starts_with("map_") ? 1 : 0;
}

/// Whether the last line has no end and too few values.
bool breaks_off(const std::string& tail) {
  if (tail.empty() || tail.back() == '\n' || tail.back() == '\r') return false;
  std::istringstream words(tail.substr(tail.find_last_of("\r\n") + 1));  // npos + 1 is 0
  std::string keyword, word;
  words >> keyword;
  std::size_t values = 0;
  while (words >> word) ++values;
  return values < least_values(keyword) || word == "-" || word.ends_with('/');
}

std::string obj(const std::string& path, const Ends& ends, const ModelFiles& files) {
  if (breaks_off(ends.tail)) return "the file is truncated: its last line is incomplete";
  std::istringstream lines(ends.head);
  for (std::string line; std::getline(lines, line);) {
    constexpr std::string_view kLibrary = "mtllib ";
    if (!line.starts_with(kLibrary)) continue;
    const std::string name(without_tail_blanks(std::string_view(line).substr(kLibrary.size())));
    const fs::path library = fs::path(path).parent_path() / name;
    const OpenFile opened = files.access.open(library.string(), files.use);
    if (!opened) continue;  // reported elsewhere
    const Ends material = ends_of(opened.descriptor_path());
    if (material.size == 0) return fmt::format("its material file '{}' is empty", name);
    constexpr std::size_t kSmallest = 6;  // assimp refuses smaller files
    if (material.size < kSmallest || breaks_off(material.tail))
      return fmt::format("its material file '{}' is truncated: its last line is incomplete", name);
  }
  return {};
}

}  // namespace

std::string truncation_of(const std::string& path, const std::string& suffix,
                          const ModelFiles& files) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return {};
  const Ends ends = ends_of(path);
  if (ends.size == 0) return "the file is empty";
  // Texts of 16 bits are decoded when they are read.
  if (ends.head.starts_with("\xff\xfe") || ends.head.starts_with("\xfe\xff")) return {};
  if (suffix == ".glb" && ends.size < 12) return no_end(false);
  if (suffix == ".gltf") return no_end(has_whole_json(file_text(path)));
  if (suffix == ".dae") {
    // Comments may follow the last tag.
    const std::size_t last = ends.tail.rfind("</");
    const std::size_t name = last == ends.tail.npos ? last : ends.tail.find("COLLADA", last);
    return no_end(name != ends.tail.npos && ends.tail.find('>', name) != ends.tail.npos);
  }
  if (suffix == ".ifc") return no_end(ends.tail.find("END-ISO-10303-21") != ends.tail.npos);
  if (suffix == ".stl") return stl(ends);
  if (suffix == ".3ds") return chunks_3ds(ends);
  if (suffix == ".fbx") return fbx(path, ends);
  if (suffix == ".ply") return ply(path);
  if (suffix == ".obj") return obj(path, ends, files);
  return {};
}

}  // namespace oriel::models
