// SPDX-License-Identifier: Apache-2.0
// Scene data: all elements by name, in the order of definition.
#pragma once

#include <array>
#include <set>
#include <string_view>
#include <unordered_map>
#include <variant>
#include <vector>

#include "base/file_access.h"
#include "base/scene_budgets.h"
#include "scene/elements.h"

namespace oriel::scene {

/// declare phenomenon: an interface of parameters and a nested scene.
struct Phenomenon {
  ShaderDeclaration declaration;
  std::vector<ShaderElement> shaders;
  std::vector<Material> materials;
  std::vector<Light> lights;
  std::vector<Instance> instances;
  /// root | output | lens | volume | environment | geometry | contour store | contour contrast
  struct Root {
    std::string keyword;  ///< "root" for a shader list, "root material", "root light", "lens", ...
    std::string name;     ///< root material/light: its name
    ShaderList shaders;
    bool operator==(const Root&) const = default;
  };
  std::vector<Root> roots;
  std::vector<Statement> requirements;  ///< version, apply, priorities: as written in the body
  bool operator==(const Phenomenon&) const = default;
};

using Element =
    std::variant<Options, Camera, Light, Material, Texture, LightProfile, Object, Instance,
                 InstanceGroup, ShaderElement, Assembly, UserData, UninterpretedElement>;

/// Name of an element of any kind.
const std::string& name_of(const Element& element);
SourceLocation place_of(const Element& element);

/// A complete scene. Plain data: front ends fill it, the writer writes it, and it may be edited
/// between frames.
class Scene {
 public:
  /// Adds an element, or replaces the element with the same name in place. Returns true if it is
  /// new.
  bool add(Element element);
  bool remove(std::string_view name);
  /// Revision number of an element, unique in the scene; changes when the element is added or
  /// touched. 0 if there is no such element.
  std::uint64_t revision(std::string_view name) const;
  /// Assigns a new revision. Returns false if there is no such element.
  bool touch(std::string_view name);
  Element* find(std::string_view name);
  const Element* find(std::string_view name) const;
  /// The element with this name if it is a T, otherwise null.
  template <class T>
  const T* get(std::string_view name) const {
    const Element* e = find(name);
    return e ? std::get_if<T>(e) : nullptr;
  }
  template <class T>
  T* get(std::string_view name) {
    Element* e = find(name);
    return e ? std::get_if<T>(e) : nullptr;
  }
  /// All elements in the order of definition.
  const std::vector<Element>& elements() const { return elements_; }
  std::vector<Element>& elements() { return elements_; }

  std::vector<ShaderDeclaration> declarations;
  std::vector<Phenomenon> phenomena;
  std::vector<DataDeclaration> data_declarations;
  /// Statements outside elements without further interpretation: verbose, version, link, set,
  /// echo...
  std::vector<Statement> commands;
  std::vector<std::string> packages;  ///< includes satisfied by libraries of Oriel ("base.mi")
  std::vector<RenderCommand> renders;
  std::set<std::string, std::less<>> loaded;  ///< loaded from placeholder files; not written
  FileAccess files;                           ///< files that elements may name
  SceneBudgets budgets;                       ///< what the elements may expand to

  const ShaderDeclaration* find_declaration(std::string_view name) const;
  const Phenomenon* find_phenomenon(std::string_view name) const;
  const DataDeclaration* find_data_declaration(std::string_view name) const;

  /// Ignores revisions, the policy for files and the budgets.
  bool operator==(const Scene& other) const;

 private:
  struct StringHash {
    using is_transparent = void;
    std::size_t operator()(std::string_view s) const { return std::hash<std::string_view>{}(s); }
  };
  std::vector<Element> elements_;
  std::vector<std::uint64_t> revisions_;  // of the elements
  std::uint64_t last_revision_ = 0;
  std::unordered_map<std::string, std::size_t, StringHash, std::equal_to<>> by_name_;
};

}  // namespace oriel::scene
