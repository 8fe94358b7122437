// SPDX-License-Identifier: Apache-2.0
#include "templates.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/diagnostic.h"
#include "command.h"
#include "scene_file.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

constexpr char kFile[] = "templates.mi";
constexpr std::string_view kPrefix = "template_";

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::vector<Template> read_templates() {
  const fs::path path = fs::path(data_folder()) / kFile;
  std::ifstream file(path);
  if (!file)
    throw UserError(fmt::format("the templates are missing: cannot read {}", path.string()));
  std::ostringstream text;
  text << file.rdbuf();
  return parse_templates(text.str());
}

/// Its texture files with their whole path, since a scene elsewhere has none beside it.
std::string to_paste(const Template& t) {
  constexpr std::string_view kRelative = "\"textures/";
  std::string text = t.text;
  for (std::size_t at = 0; (at = text.find(kRelative, at)) != std::string::npos;) {
    const std::string folder = (fs::path(data_folder()) / "").string();
    text.insert(at + 1, folder);
    at += folder.size() + kRelative.size();
  }
  return text;
}

const Template& find_template(const std::vector<Template>& all, const std::string& name) {
  std::vector<std::string> names;
  for (const Template& t : all) {
    if (t.name == name || t.name == kPrefix.data() + name) return t;
    names.push_back(t.name);
  }
  std::string near = nearest_name(name, names);
  if (near.empty()) near = nearest_name(kPrefix.data() + name, names);
  throw UserError(fmt::format("there is no template \"{}\"{}", name,
                              near.empty() ? "; 'oriel shaders --templates' lists them"
                                           : fmt::format("; did you mean \"{}\"?", near)));
}

}  // namespace

std::string data_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) {
    const fs::path installed = program.parent_path().parent_path() / "share" / "oriel";
    if (fs::exists(installed / kFile, error)) return installed.string();
  }
  return ORIEL_DATA_FOLDER;
}

std::vector<Template> parse_templates(std::string_view file) {
  std::vector<Template> templates;
  Template current;
  bool in_comment = true;
  const auto finish = [&] {
    if (!current.name.empty()) templates.push_back(std::move(current));
    current = {};
    in_comment = true;
  };
  for (const std::string_view line : lines_of(file)) {
    if (line.empty()) {
      finish();
      continue;
    }
    current.text.append(line).append("\n");
    in_comment = in_comment && line.starts_with("#");
    if (in_comment) current.lines.emplace_back(line.substr(std::min<std::size_t>(2, line.size())));
    constexpr std::string_view kMaterial = "material \"";
    if (line.starts_with(kMaterial)) {
      const std::string_view rest = line.substr(kMaterial.size());
      current.name = rest.substr(0, rest.find('"'));
    }
  }
  finish();
  return templates;
}

void print_templates(const std::string& name, bool as_json) {
  const std::vector<Template> all = read_templates();
  const auto print_one = [](const Template& t) {
    print_json({{"name", t.name},
                {"doc", fmt::format("{}", fmt::join(t.lines, " "))},
                {"text", to_paste(t)}});
  };
  if (!name.empty()) {
    const Template& t = find_template(all, name);
    if (as_json)
      print_one(t);
    else
      fmt::print("{}", to_paste(t));
    return;
  }
  for (const Template& t : all) {
    if (as_json)
      print_one(t);
    else
      fmt::print("{}\n  {}\n", t.name, fmt::join(t.lines, "\n  "));
  }
}

}  // namespace oriel::app
