// SPDX-License-Identifier: Apache-2.0
// oriel shaders: the library's manual pages, made from the shaders' own tables.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "command.h"
#include "scene_file.h"
#include "shaders/default_text.h"
#include "shaders/registry.h"
#include "suggest.h"
#include "templates.h"

namespace oriel::app {
namespace {

using nlohmann::json;

struct ShadersArguments {
  std::string name, library, template_name;
  bool templates = false;  ///< template_name empty: all
  bool as_json = false;
};

std::string range_text(const ParamSpec& p) {
  const bool low = std::isfinite(p.min), high = std::isfinite(p.max);
  if (low && high) return fmt::format("{} ... {}", p.min, p.max);
  if (low) return fmt::format(">= {}", p.min);
  return high ? fmt::format("<= {}", p.max) : "";
}

const char* support_text(Support support) {
  constexpr const char* kTexts[] = {"exact", "approximated", "ignored"};
  return kTexts[static_cast<int>(support)];
}

json to_json(const ShaderSpec& spec) {
  json params = json::array();
  for (const ParamSpec& p : spec.params) {
    json param = {{"name", p.name}, {"type", type_text(p)}, {"support", support_text(p.support)}};
    if (const std::string text = default_text(p); !text.empty()) param["default"] = text;
    if (std::isfinite(p.min)) param["min"] = p.min;
    if (std::isfinite(p.max)) param["max"] = p.max;
    if (*p.unit) param["unit"] = p.unit;
    if (*p.doc) param["doc"] = p.doc;
    if (p.alias) param["alias"] = p.alias;
    params.push_back(std::move(param));
  }
  return {{"name", spec.name},
          {"library", spec.library},
          {"version", spec.version},
          {"doc", spec.doc},
          {"result", scene::type_name(spec.result)},
          {"parameters", params}};
}

void print_page(const ShaderSpec& spec) {
  fmt::print("{}  ({}, version {}, gives {})\n  {}\n\n", spec.name, spec.library, spec.version,
             scene::type_name(spec.result), spec.doc);
  for (const ParamSpec& p : spec.params) {
    std::string facts = type_text(p);
    if (const std::string text = default_text(p); !text.empty()) facts += ", default " + text;
    if (const std::string text = range_text(p); !text.empty()) facts += ", " + text;
    if (*p.unit) facts += fmt::format(", {}", p.unit);
    if (p.support != Support::Exact) facts += fmt::format("; {}", support_text(p.support));
    fmt::print("  {:<26} {}\n", p.name, facts);
    if (p.alias) fmt::print("  {:<26} also written {}\n", "", p.alias);
    if (*p.doc) fmt::print("  {:<26} {}\n", "", p.doc);
  }
}

const ShaderSpec& find_shader(const Registry& registry, const std::string& name) {
  if (const ShaderSpec* spec = registry.find(name)) return *spec;
  std::vector<std::string> names;
  for (const ShaderSpec* spec : registry.all()) names.emplace_back(spec->name);
  const std::string near = nearest_name(name, names);
  throw UserError(fmt::format(
      "there is no shader \"{}\"{}", name,
      near.empty() ? "; 'oriel shaders' lists them" : fmt::format("; did you mean \"{}\"?", near)));
}

void print_list(const Registry& registry) {
  for (const std::string& library : builtin_packages()) {
    bool titled = false;
    for (const ShaderSpec* spec : registry.all()) {
      if (library != spec->library) continue;
      if (!titled) fmt::print("{}\n", library);
      titled = true;
      fmt::print("  {:<28} {}\n", spec->name, spec->doc);
    }
  }
}

int run_shaders(const ShadersArguments& a) {
  const Registry& registry = builtin_shaders();
  if (a.templates) {
    print_templates(a.template_name, a.as_json);
  } else if (!a.library.empty()) {
    const auto& libraries = builtin_packages();
    if (std::find(libraries.begin(), libraries.end(), a.library) == libraries.end())
      throw UserError(fmt::format("there is no library \"{}\": {}", a.library,
                                  expected_one_of(a.library, libraries)));
    fmt::print("{}", mi_declarations(registry, a.library));
  } else if (!a.name.empty()) {
    const ShaderSpec& spec = find_shader(registry, a.name);
    if (a.as_json)
      print_json(to_json(spec));
    else
      print_page(spec);
  } else if (a.as_json) {
    for (const ShaderSpec* spec : registry.all()) print_json(to_json(*spec));
  } else {
    print_list(registry);
  }
  return kExitDone;
}

}  // namespace

Command add_shaders_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand("shaders", "Print manual pages of the built-in shaders");
  auto a = std::make_shared<ShadersArguments>();
  CLI::Option* name = app->add_option("NAME", a->name, "Shader name (default: list all shaders)");
  CLI::Option* mi = app->add_option("--mi", a->library, "Print the .mi declarations of a library")
                        ->type_name("LIBRARY")
                        ->excludes(name);
  CLI::Option* templates = app->add_option("--templates", a->template_name,
                                           "List the materials of templates.mi, or print one")
                               ->type_name("TEMPLATE")
                               ->expected(0, 1)
                               ->excludes(name)
                               ->excludes(mi);
  app->add_flag("--json", a->as_json, "JSON, one line for each shader or template");
  return {app, [a, templates] {
            a->templates = templates->count() > 0;
            return run_shaders(*a);
          }};
}

}  // namespace oriel::app
