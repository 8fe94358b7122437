// SPDX-License-Identifier: Apache-2.0
#include "interactive/save_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <sstream>

#include "base/durable_file.h"
#include "interactive/element_statements.h"
#include "interactive/text_patch.h"
#include "mi/writer.h"

namespace oriel::interactive {
namespace {

namespace fs = std::filesystem;
using scene::Value;

constexpr std::size_t kMaxSceneText = std::size_t{1} << 31;

std::string quoted_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '\\';
    quoted += c;
  }
  // A backslash before the closing quote would escape it.
  if (quoted.back() == '\\') quoted.back() = '/';
  return quoted + "\"";
}

bool is_bare_word(const std::string& text) {
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) &&
         std::all_of(text.begin(), text.end(), [](char c) {
           return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == ' ' || c == '-';
         });
}

/// The value of an edit as the scene language writes it.
std::string written_value(const SceneEdit& edit, bool bare_words) {
  const Value value = parse_edit_value(edit.value);
  switch (value.kind) {
    case Value::Kind::Boolean:
      return value.boolean ? "on" : "off";
    case Value::Kind::Connection:
      return "= " + quoted_text(value.text);
    case Value::Kind::Numbers: {
      std::string text = edit.value;
      std::replace(text.begin(), text.end(), ',', ' ');
      return text;
    }
    case Value::Kind::Array:
    case Value::Kind::Struct:
      return edit.value;
    default:
      if (edit.value.find('\n') != std::string::npos)
        throw SaveError(edit.target() + ": a text with line breaks cannot be written");
      if (!bare_words) return quoted_text(edit.value);
      if (!is_bare_word(edit.value))
        throw SaveError(edit.target() + ": the value is no word of the language");
      return edit.value;
  }
}

std::size_t token_count(const std::vector<Value>& values) {
  std::size_t count = 0;
  for (const Value& value : values)
    count += value.kind == Value::Kind::Numbers ? value.numbers.size() : 1;
  return count;
}

std::string_view end_word(const scene::Element& element) {
  if (std::holds_alternative<scene::Options>(element)) return "options";
  if (std::holds_alternative<scene::Camera>(element)) return "camera";
  if (std::holds_alternative<scene::Light>(element)) return "light";
  if (std::holds_alternative<scene::Instance>(element)) return "instance";
  return {};
}

/// Collects patches of files.
class SavedFiles {
 public:
  SavedFiles(const Diagnostics& files, const std::string& folder) : files_(files) {
    std::error_code error;
    folder_ = fs::weakly_canonical(fs::absolute(folder, error), error);
  }

  struct File {
    fs::path path;  ///< canonical
    std::string text;
    std::vector<TextPatch> patches;
  };

  File& file(SourceLocation where, const std::string& target) {
    const std::string& name = files_.file(where.file);
    const auto known = opened_.find(name);
    if (known != opened_.end()) return known->second;
    std::error_code error;
    File file;
    file.path = fs::weakly_canonical(fs::absolute(name, error), error);
    if (!lies_below(file.path.string(), folder_.string()))
      throw SaveError(
          fmt::format("{}: its file {} is outside of the scene's folder", target, name));
    OpenFile open = open_regular(file.path.string());
    if (!open) throw SaveError(fmt::format("{}: {} cannot be read", target, name));
    file.text = open.read(kMaxSceneText);
    if (file.text.find('\0') != std::string::npos || file.text.starts_with("\x1f\x8b"))
      throw SaveError(fmt::format("{}: {} is compressed or no plain text", target, name));
    return opened_.emplace(name, std::move(file)).first->second;
  }

  std::vector<std::string> write() const {
    std::vector<std::string> names;
    for (const auto& entry : opened_) {
      const File& file = entry.second;
      write_durably(file.path.string(), patched(file.text, file.patches));
      names.push_back(file.path.lexically_relative(folder_).generic_string());
    }
    return names;
  }

 private:
  const Diagnostics& files_;
  fs::path folder_;
  std::map<std::string, File> opened_;
};

void save_parameter(SavedFiles& files, const FoundCall& found, const SceneEdit& edit) {
  const std::string value = written_value(edit, false);
  const auto& arguments = found.call->arguments;
  const auto argument =
      std::find_if(arguments.begin(), arguments.end(),
                   [&](const scene::Argument& a) { return a.name == edit.parameter; });
  std::optional<TextPatch> patch;
  if (argument != arguments.end()) {
    SavedFiles::File& file = files.file(argument->where, edit.target());
    patch = parameter_value(file.text,
                            text_offset(file.text, argument->where.line, argument->where.column),
                            edit.parameter);
    if (patch) {
      patch->text = value;
      file.patches.push_back(*patch);
    }
  } else {
    SavedFiles::File& file = files.file(found.call->where, edit.target());
    patch = parameter_insertion(
        file.text, text_offset(file.text, found.call->where.line, found.call->where.column),
        fmt::format("\"{}\" {}", edit.parameter, value));
    if (patch) file.patches.push_back(*patch);
  }
  if (!patch) throw SaveError(edit.target() + ": its place in the text was not found");
}

void save_statement(SavedFiles& files, const scene::Element& element, const SceneEdit& edit) {
  const SourceLocation where = scene::place_of(element);
  SavedFiles::File& file = files.file(where, edit.target());
  const std::size_t at = text_offset(file.text, where.line, where.column);
  std::optional<TextPatch> patch;
  if (std::holds_alternative<scene::Texture>(element)) {
    patch = texture_file(file.text, at);
    if (patch) patch->text = quoted_text(edit.value);
  } else {
    StatementPlace place{end_word(element), edit.parameter, false, 1};
    for (const StatementValue& s : statements_of(element)) {
      if (s.name != edit.parameter) continue;
      place.values = token_count(s.values);
      place.quoted = s.quoted;
    }
    if (place.kind.empty()) throw SaveError(edit.target() + ": it has no place in the text");
    patch = statement_value(file.text, at, place, written_value(edit, !place.quoted));
  }
  if (!patch) throw SaveError(edit.target() + ": its place in the text was not found");
  file.patches.push_back(*patch);
}

}  // namespace

std::vector<std::string> save_into_files(PreparedScene& edited, const std::string& folder) {
  // Read again: places are those of the present text.
  Diagnostics diagnostics;
  scene::Scene scene;
  mi::Reader reader(edited.source().path, edited.source().read, diagnostics);
  if (!reader.opened() || !reader.next_frame(scene))
    throw SaveError("the scene cannot be read any more");
  SavedFiles files(diagnostics, folder);
  for (const std::string& text : edited.edited().edits()) {
    const SceneEdit edit = parse_edit(scene, text);
    std::vector<std::string> candidates;
    const FoundCall found = find_call(scene, edit, *edited.source().registry, candidates);
    if (found.call)
      save_parameter(files, found, edit);
    else
      save_statement(files, *scene.find(edit.element), edit);
  }
  return files.write();
}

void save_incremental(PreparedScene& edited, const std::string& path) {
  const scene::Scene& scene = edited.scene();
  std::string text = fmt::format(
      "# Changes of {}; the second frame of this file shows them.\n"
      "$include {}\n\n",
      fs::path(edited.source().path).filename().string(),
      quoted_text(fs::path(edited.source().path).filename().string()));
  for (const std::string& name : edited.edited().changed()) {
    scene::Scene one;
    one.add(*scene.find(name));
    std::ostringstream stream;
    mi::write_scene(one, stream);
    text += stream.str() + "\n";
  }
  const scene::RenderCommand& command = edited.command();
  text += fmt::format("render {} {} {}\n", quoted_text(command.root), quoted_text(command.camera),
                      quoted_text(command.options));
  write_durably(path, text);
}

}  // namespace oriel::interactive
