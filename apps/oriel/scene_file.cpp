// SPDX-License-Identifier: Apache-2.0
#include "scene_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "scene/option_table.h"
#include "shaders/registry.h"
#include "suggest.h"
#include "templates.h"

namespace oriel::app {
namespace {

using scene::Value;

struct Edit {
  std::string element, parameter, value;
};

/// Names may hold dots: the element is the longest part before a dot that names one.
Edit split_edit(const scene::Scene& scene, const std::string& edit) {
  const std::size_t equals = edit.find('=');
  if (equals == std::string::npos || edit.find('.') > equals)
    throw UsageError(fmt::format("--set {}: expected element.parameter=value", edit));
  const std::string left = edit.substr(0, equals);
  for (std::size_t dot = left.rfind('.'); dot != std::string::npos && dot > 0;
       dot = left.rfind('.', dot - 1))
    if (scene.find(left.substr(0, dot)))
      return {left.substr(0, dot), left.substr(dot + 1), edit.substr(equals + 1)};

  const std::string wanted = left.substr(0, left.rfind('.'));
  std::vector<std::string> names;
  for (const scene::Element& e : scene.elements()) names.push_back(name_of(e));
  const std::string near = nearest_name(wanted, names);
  throw UserError(fmt::format("--set: the scene has no element \"{}\"{}", wanted,
                              near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near)));
}

Value parse_value(const std::string& text) {
  Value value;
  if (text == "on" || text == "true" || text == "off" || text == "false") {
    value.kind = Value::Kind::Boolean;
    value.boolean = text == "on" || text == "true";
    return value;
  }
  if (text.starts_with('=')) {
    value.kind = Value::Kind::Connection;
    value.text = text.substr(1);
    return value;
  }
  const char* at = text.c_str();
  value.integral = true;
  while (*at) {
    char* end = nullptr;
    const double number = std::strtod(at, &end);
    if (end == at) break;
    value.numbers.push_back(number);
    value.integral =
        value.integral && std::string_view(at, end).find_first_of(".eE") == std::string_view::npos;
    at = end + std::strspn(end, " ,");
  }
  if (*at == 0 && !value.numbers.empty()) {
    value.kind = Value::Kind::Numbers;
    return value;
  }
  value = {};
  value.kind = Value::Kind::Text;
  value.text = text;
  return value;
}

std::vector<std::string> parameters_of(const scene::Scene& scene, const std::string& type,
                                       const Registry& registry) {
  std::vector<std::string> names;
  if (const ShaderSpec* spec = registry.find(type))
    for (const ParamSpec& p : spec->params) names.emplace_back(p.name);
  else if (const scene::Phenomenon* phenomenon = scene.find_phenomenon(type))
    for (const scene::ParamDecl& p : phenomenon->declaration.parameters) names.push_back(p.name);
  else if (const scene::ShaderDeclaration* declaration = scene.find_declaration(type))
    for (const scene::ParamDecl& p : declaration->parameters) names.push_back(p.name);
  return names;
}

/// Sets it in the first call of the list that has such a parameter.
bool set_in_list(scene::Scene& scene, scene::ShaderList& list, const Edit& edit,
                 const Registry& registry, std::vector<std::string>& candidates, int depth = 0) {
  constexpr int kMaxReferences = 16;  // named shaders may refer to each other in a circle
  for (scene::ShaderUse& use : list) {
    if (!use.reference.empty()) {
      auto* named = scene.get<scene::ShaderElement>(use.reference);
      if (named && depth < kMaxReferences &&
          set_in_list(scene, named->functions, edit, registry, candidates, depth + 1))
        return true;
      continue;
    }
    const std::vector<std::string> names = parameters_of(scene, use.type, registry);
    candidates.insert(candidates.end(), names.begin(), names.end());
    if (std::find(names.begin(), names.end(), edit.parameter) == names.end()) continue;
    std::erase_if(use.arguments, [&](const auto& a) { return a.name == edit.parameter; });
    use.arguments.push_back({edit.parameter, parse_value(edit.value), {}});
    return true;
  }
  return false;
}

void set_option(scene::Options& options, const Edit& edit) {
  scene::Statement statement;
  statement.keyword = edit.parameter;
  const scene::StatementRow* row = scene::option_table().find(edit.parameter);
  if (const auto* string_option = scene::option_table().find(fmt::format("\"{}\"", edit.parameter)))
    row = string_option;
  if (!row) {
    std::vector<std::string> names;
    for (const scene::StatementRow& known : scene::option_table().rows())
      names.push_back(scene::name_of(known));
    throw UserError(fmt::format("--set: there is no option \"{}\"{}", edit.parameter,
                                suggestion(edit.parameter, names)));
  }
  statement.quoted = scene::is_string_option(*row);
  Value value = parse_value(edit.value);
  value.bare = value.kind == Value::Kind::Text && !statement.quoted;
  statement.values.push_back(std::move(value));
  options.statements.push_back(std::move(statement));
}

}  // namespace

void add_scene_arguments(CLI::App& command, SceneArguments& arguments) {
  command.add_option("SCENE", arguments.path, "Scene file (.mi)")->required();
  command
      .add_option("-I,--include", arguments.include_paths,
                  "Search folder for include files; repeatable")
      ->allow_extra_args(false)
      ->type_name("DIR");
  command
      .add_option("--set", arguments.edits,
                  "Set a parameter of a shader, material, light or options block; repeatable")
      ->allow_extra_args(false)
      ->type_name("ELEMENT.PARAM=VALUE");
  command
      .add_option(
          "--shader-path", arguments.shader_path,
          "Folders from which `link` may load shader libraries, separated by colons; those of "
          "ORIEL_SHADER_PATH are searched as well, except with --untrusted")
      ->type_name("DIRS");
  command.add_flag("--trust-code", arguments.trust_code,
                   "Compile and run C sources in the scene ($code and `code` statements); only "
                   "for scenes from trusted authors");
  add_trust_options(command, arguments.trust);
}

mi::ReadOptions read_options(const SceneArguments& arguments, const Registry& registry) {
  mi::ReadOptions options;
  options.include_paths = arguments.include_paths;
  options.include_paths.push_back(data_folder());
  options.packages = builtin_packages();
  options.trusts_code = arguments.trust_code;
  if (arguments.trust_code && arguments.trust.untrusted)
    throw UsageError("--trust-code and --untrusted exclude each other");
  options.files = file_access(arguments.trust);
  options.budgets = scene_budgets(arguments.trust);
  options.knows_shader = [&registry](std::string_view name) { return registry.find(name); };
  return options;
}

void apply_edit(scene::Scene& scene, const std::string& text, const Registry& registry) {
  const Edit edit = split_edit(scene, text);
  scene::Element* element = scene.find(edit.element);
  if (auto* options = std::get_if<scene::Options>(element)) return set_option(*options, edit);

  scene::ShaderList* list = nullptr;
  if (auto* shader = std::get_if<scene::ShaderElement>(element)) list = &shader->functions;
  if (auto* material = std::get_if<scene::Material>(element)) list = &material->shaders;
  if (auto* light = std::get_if<scene::Light>(element)) list = &light->shaders;
  if (!list)
    throw UserError(fmt::format("--set: \"{}\" is not a shader, material, light or options block",
                                edit.element));
  std::vector<std::string> candidates;
  if (set_in_list(scene, *list, edit, registry, candidates)) return;
  const std::string near = nearest_name(edit.parameter, candidates);
  throw UserError(fmt::format("--set: \"{}\" has no parameter \"{}\"{}", edit.element,
                              edit.parameter,
                              near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near)));
}

void DiagnosticPrinter::print_new() {
  for (; printed_ < diagnostics_.all().size(); ++printed_) {
    const Diagnostic& d = diagnostics_.all()[printed_];
    if (d.severity < least_) continue;
    if (json_) {
      nlohmann::json line = to_json(d, diagnostics_);
      line["event"] = "diagnostic";
      print_json(line);
    } else {
      fmt::print(stderr, "{}\n", diagnostics_.format(d));
    }
  }
}

nlohmann::json to_json(const Diagnostic& d, const Diagnostics& all) {
  constexpr const char* kSeverities[] = {"note", "warning", "error"};
  nlohmann::json json = {{"severity", kSeverities[static_cast<int>(d.severity)]},
                         {"code", d.code},
                         {"message", d.message}};
  if (d.where.file) json["file"] = all.file(d.where.file);
  if (d.where.line) json["line"] = d.where.line, json["column"] = d.where.column;
  if (!d.hint.empty()) json["hint"] = d.hint;
  return json;
}

void print_json(const nlohmann::json& line) {
  fmt::print("{}\n", line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  std::fflush(stdout);
}

}  // namespace oriel::app
