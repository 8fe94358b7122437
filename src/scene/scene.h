// SPDX-License-Identifier: Apache-2.0
// The scene as data: every element by name, in the order it was defined. No behaviour.
#pragma once

#include <array>
#include <set>
#include <string_view>
#include <unordered_map>
#include <variant>
#include <vector>

#include "scene/elements.h"

namespace oriel::scene {

/// declare phenomenon: parameters outside, a small scene inside.
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

/// Name of an element, whatever its kind.
const std::string& name_of(const Element& element);
SourceLocation place_of(const Element& element);

/// A whole scene between two renderings. Plain data that front ends fill and the writer writes
/// back; may be edited between frames.
class Scene {
 public:
  /// Adds an element; one of the same name is replaced in place. Returns true when it was new.
  bool add(Element element);
  bool remove(std::string_view name);
  /// A number that only an element has which was not added or touched since; 0: there is none.
  std::uint64_t revision(std::string_view name) const;
  /// Gives it another revision; false when there is none of that name.
  bool touch(std::string_view name);
  Element* find(std::string_view name);
  const Element* find(std::string_view name) const;
  /// The element of that name if it is a T, else null.
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
  /// Statements outside elements that only have to be kept: verbose, version, link, set, echo...
  std::vector<Statement> commands;
  std::vector<std::string> packages;  ///< includes that Oriel's own libraries satisfied ("base.mi")
  std::vector<RenderCommand> renders;
  std::set<std::string, std::less<>> loaded;  ///< elements from files of placeholders; not written

  const ShaderDeclaration* find_declaration(std::string_view name) const;
  const Phenomenon* find_phenomenon(std::string_view name) const;
  const DataDeclaration* find_data_declaration(std::string_view name) const;

  /// Revisions do not count.
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
