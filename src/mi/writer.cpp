// SPDX-License-Identifier: Apache-2.0
#include "mi/writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <ostream>
#include <streambuf>
#include <string_view>

#include "base/durable_file.h"
#include "mi/write_parts.h"

namespace oriel::mi {
namespace {

/// Commands without effect are written too; `$code` and hexadecimal `code` have their own syntax.
void write_command(TextSink& out, const scene::Statement& command) {
  if (command.keyword == "$code" && command.values.size() == 1) {
    out.put("$code");
    out.put(command.values[0].text);
    out.put("$end code\n");
  } else if (command.keyword == "code" && !command.values.empty() && command.values[0].bare) {
    // Hexadecimal bytes.
    out.put("code");
    for (const scene::Value& bytes : command.values) {
      out.put(" '");
      out.put(bytes.text);
      out.put('\'');
    }
    out.put('\n');
  } else {
    write_statement(out, command, 0);
  }
}

void write_render(TextSink& out, const scene::RenderCommand& render) {
  out.put("render");
  for (const std::string* name : {&render.root, &render.camera, &render.options}) {
    out.put(' ');
    out.quoted(*name);
  }
  out.put('\n');
}

/// Source: G. Fowler, L. C. Noll, P. Vo; 64 bits, FNV-1a.
class SceneChecksum {
 public:
  void add(std::string_view text) {
    for (const char c : text) hash_ = (hash_ ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  }
  /// The last line of a file whose other lines have this checksum.
  std::string line() const { return fmt::format("# oriel checksum {:016x}\n", hash_); }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

/// Sends a stream to a file, which remembers errors until its commit().
class SceneFileBuffer final : public std::streambuf {
 public:
  explicit SceneFileBuffer(DurableFile& file) : file_(file) {}
  const SceneChecksum& checksum() const { return checksum_; }

 private:
  std::streamsize xsputn(const char* text, std::streamsize size) override {
    const std::string_view part(text, static_cast<std::size_t>(size));
    checksum_.add(part);
    file_.write(part);
    return size;
  }
  int overflow(int c) override {
    const char character = traits_type::to_char_type(c);
    xsputn(&character, 1);
    return c;
  }

  DurableFile& file_;
  SceneChecksum checksum_;
};

}  // namespace

void write_scene(const scene::Scene& scene, std::ostream& stream) {
  TextSink out(stream);
  out.put("#mi Oriel\n");
  for (const auto& command : scene.commands) write_command(out, command);
  for (const std::string& package : scene.packages) {
    out.put("$include <");
    out.put(package);
    out.put(">\n");
  }
  for (const auto& d : scene.data_declarations) write_declaration(out, d);
  for (const auto& d : scene.declarations) write_declaration(out, d);
  for (const auto& p : scene.phenomena) write_phenomenon(out, p);
  for (const auto& element : scene.elements()) {
    if (scene.loaded.contains(scene::name_of(element))) continue;
    out.put('\n');
    std::visit([&](const auto& e) { write_element(out, e, 0); }, element);
  }
  if (!scene.renders.empty()) out.put('\n');
  for (const auto& render : scene.renders) write_render(out, render);
}

bool write_scene(const scene::Scene& scene, const std::string& path, Diagnostics& diagnostics) try {
  DurableFile file(path);
  SceneFileBuffer buffer(file);
  std::ostream stream(&buffer);
  write_scene(scene, stream);
  file.write(buffer.checksum().line());
  file.commit();
  return true;
} catch (const std::runtime_error& e) {
  diagnostics.error("OR-MI-050", {}, fmt::format("'{}' could not be written: {}", path, e.what()));
  return false;
}

bool is_unedited_scene(const std::string& path) {
  if (!target_fault(path).empty()) return false;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff line = static_cast<std::streamoff>(SceneChecksum().line().size());
  std::streamoff rest = static_cast<std::streamoff>(file.tellg()) - line;
  if (!file || rest < 0) return false;
  file.seekg(0);
  SceneChecksum checksum;
  for (std::string block(1 << 16, '\0'); rest > 0 && file;) {
    const std::streamoff size = std::min<std::streamoff>(rest, 1 << 16);
    file.read(block.data(), size);
    checksum.add(std::string_view(block).substr(0, static_cast<std::size_t>(size)));
    rest -= size;
  }
  std::string last(static_cast<std::size_t>(line), '\0');
  file.read(last.data(), line);
  return file && last == checksum.line();
}

}  // namespace oriel::mi
