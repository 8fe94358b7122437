// SPDX-License-Identifier: Apache-2.0
#include "mi/writer.h"

#include <fmt/format.h>

#include <cerrno>
#include <filesystem>
#include <fstream>

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

bool write_scene(const scene::Scene& scene, const std::string& path, Diagnostics& diagnostics) {
  // Atomic: written to a temporary file, which is then renamed.
  const std::string part = path + ".part";
  std::error_code error;
  {
    std::ofstream stream(part, std::ios::binary);
    if (stream) write_scene(scene, stream);
    stream.close();
    if (!stream) error = std::error_code(errno ? errno : EIO, std::generic_category());
  }
  if (!error) std::filesystem::rename(part, path, error);
  if (!error) return true;
  diagnostics.error("OR-MI-050", {},
                    fmt::format("'{}' could not be written: {}", path, error.message()));
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
  return false;
}

}  // namespace oriel::mi
