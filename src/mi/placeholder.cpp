// SPDX-License-Identifier: Apache-2.0
#include "mi/placeholder.h"

#include <fmt/format.h>

#include "mi/elements.h"
#include "scene/element_settings.h"

namespace oriel::mi {
namespace {

using scene::Assembly;
using scene::Element;
using scene::InstanceGroup;
using scene::Object;
using scene::Scene;

/// A placeholder that is not loaded yet.
struct PendingPlaceholder {
  std::string name, file;
  SourceLocation where;
};

std::vector<PendingPlaceholder> pending_in(const Parse& parse) {
  std::vector<PendingPlaceholder> list;
  for (const Element& element : parse.scene->elements()) {
    const auto add = [&](const auto& e) {
      if (const std::string file = scene::settings_of(e).file;
          !file.empty() && e.content.empty() && !parse.reported.contains("placeholder " + e.name))
        list.push_back({e.name, file, e.where});
    };
    if (const auto* object = std::get_if<Object>(&element)) add(*object);
    if (const auto* assembly = std::get_if<Assembly>(&element)) add(*assembly);
  }
  return list;
}

Scene read_file(Parse& parse, const PendingPlaceholder& placeholder) {
  Scene scene;
  Parse inner(parse.options, parse.diagnostics);
  inner.scene = &scene;
  inner.in.read_for(parse.in);
  // Read as an include of the file with the placeholder, for the same folders and limits.
  const std::string text = fmt::format("$include \"{}\"\n", placeholder.file);
  inner.in.open_text(text, std::string(parse.diagnostics.file(placeholder.where.file)));
  while (!inner.in.at_end()) read_top_level(inner);
  finish_reading(inner);
  return scene;
}

/// The content of a placeholder: the element of the same name, or the last one of type T, or null.
template <typename T>
const T* content_of(const Scene& scene, const std::string& name) {
  if (const T* same = scene.get<T>(name)) return same;
  const T* last = nullptr;
  for (const Element& element : scene.elements())
    if (const T* e = std::get_if<T>(&element)) last = e;
  return last;
}

/// Moves the elements into the scene; renames `content` to `as`.
void merge(Parse& parse, const PendingPlaceholder& placeholder, Scene&& from,
           const std::string& content, const std::string& as) {
  Scene& scene = *parse.scene;
  std::size_t in_use = 0;
  std::string first;
  for (Element& element : from.elements()) {
    std::visit(
        [&](auto& e) {
          if (e.name == content) e.name = as;
        },
        element);
    const std::string name = scene::name_of(element);
    if (scene.find(name)) {
      if (in_use++ == 0) first = name;
      continue;
    }
    scene.loaded.insert(name);
    scene.add(std::move(element));
  }
  for (scene::ShaderDeclaration& d : from.declarations)
    if (!scene.find_declaration(d.name)) parse.declare(std::move(d));
  if (in_use > 0)
    parse.warn(code::kRedefined, placeholder.where,
               fmt::format("{} name(s) of \"{}\" are in use, \"{}\" first; those of the scene stay",
                           in_use, placeholder.file, first));
}

void load(Parse& parse, const PendingPlaceholder& placeholder) {
  parse.reported.insert("placeholder " + placeholder.name);
  Scene from = read_file(parse, placeholder);
  const std::string as = placeholder.name + "@file";
  std::string content;
  if (auto* object = parse.scene->get<Object>(placeholder.name)) {
    if (const Object* found = content_of<Object>(from, placeholder.name)) {
      content = found->name;
      object->content = as;
      // Flags of the placeholder override flags in the file. The flag `file` of the content is
      // removed; otherwise a file that names itself would be read endlessly.
      Object& inner = *from.get<Object>(content);
      inner.flags.insert(inner.flags.end(), object->flags.begin(), object->flags.end());
      std::erase_if(inner.flags, [](const scene::Statement& s) { return s.keyword == "file"; });
    }
  } else if (auto* assembly = parse.scene->get<Assembly>(placeholder.name)) {
    if (const auto* found = content_of<InstanceGroup>(from, placeholder.name)) {
      content = found->name;
      assembly->content = as;
    }
  }
  if (!content.empty()) return merge(parse, placeholder, std::move(from), content, as);
  // An unreadable file was already reported.
  if (!from.elements().empty())
    parse.warn(code::kNoContent, placeholder.where,
               fmt::format("\"{}\" contains no element that can replace \"{}\"", placeholder.file,
                           placeholder.name));
}

}  // namespace

void load_placeholders(Parse& parse) {
  for (std::vector<PendingPlaceholder> list = pending_in(parse); !list.empty();
       list = pending_in(parse))
    for (const PendingPlaceholder& placeholder : list) {
      if (parse.in.is_include_budget_spent())
        return parse.diagnostics.error(
            code::kIncludeLimit, placeholder.where,
            fmt::format("placeholder \"{}\" is not read: {}", placeholder.name,
                        parse.options.budgets.excess(Budget::Includes)),
            SceneBudgets::hint(Budget::Includes));
      load(parse, placeholder);
    }
}

void load_placeholder(Scene& scene, const std::string& name, const ReadOptions& options,
                      Diagnostics& diagnostics) {
  Parse parse(options, diagnostics);
  parse.scene = &scene;
  // Other pending placeholders were already tried when the scene was read.
  const std::vector<PendingPlaceholder> before = pending_in(parse);
  for (const PendingPlaceholder& placeholder : before)
    if (placeholder.name != name) parse.reported.insert("placeholder " + placeholder.name);
  load_placeholders(parse);
}

}  // namespace oriel::mi
