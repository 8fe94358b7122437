// SPDX-License-Identifier: Apache-2.0
// Turns shader calls of the scene into bound nodes: names, types, defaults, connections, phenomena.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/diagnostic.h"
#include "runtime/world.h"
#include "scene/scene.h"

namespace oriel {

/// What a name in the scene was bound with; `oriel check` lists it.
struct BindingReport {
  /// shader type -> how many calls
  std::map<std::string, int> shaders;
  /// "shader.parameter" set by the scene but not followed exactly -> places
  std::map<std::string, int> approximated, ignored;
  /// Types of unavailable shaders; those with a fallback shader are also in `guessed`.
  std::vector<std::string> missing_shaders, missing_textures;
  std::map<std::string, int> fallbacks;        ///< shader type of a host -> how many calls
  std::map<std::string, std::string> guessed;  ///< shader type -> what was taken for what
};

/// Binds shader lists into `world`. Keep one per World: named shaders are shared.
///
/// Errors: OR-RT-nnn diagnostics; an unknown shader becomes what its parameters' names say, or a
///         visible placeholder (magenta); a parameter that is unknown or of the wrong type is
///         skipped.
class Binder {
 public:
  /// `lights_by_name` maps light instances and groups of them to indices into World::lights.
  Binder(const scene::Scene& scene, const Registry& registry, World& world,
         const std::unordered_map<std::string, std::vector<int>>& lights_by_name,
         Diagnostics& diagnostics);

  NodeList bind(const scene::ShaderList& list);
  /// A shader by name; null and a diagnostic when there is none.
  const ShaderNode* named(const std::string& name, SourceLocation where);
  /// A light profile by its element's name; null when there is none or its file cannot be used.
  const photometry::LightProfile* light_profile(const std::string& name, SourceLocation where);
  /// A material; phenomena whose root is a material are expanded.
  Material bind_material(const scene::Material& material);

  /// A point without surface, for parameters that must not depend on one.
  ShadingPoint& constant_point() { return constant_point_; }

  const BindingReport& report() const { return report_; }

 private:
  /// Inside of one call of a phenomenon.
  struct Scope {
    const scene::Phenomenon* phenomenon;
    const std::vector<scene::Argument>* arguments;
    const Scope* outer;
    std::map<std::string, const ShaderNode*> named;
  };
  struct Resolved {
    const ShaderNode* node = nullptr;
    ParamType type = ParamType::Color;
    std::size_t offset = 0;
  };

  NodeList bind_list(const scene::ShaderList& list, Scope* scope);
  const ShaderNode* bind_use(const scene::ShaderUse& use, Scope* scope);
  const ShaderNode* bind_call(const std::string& type, const std::vector<scene::Argument>& args,
                              SourceLocation where, Scope* scope);
  const ShaderNode* bind_phenomenon(const scene::Phenomenon& phenomenon,
                                    const std::vector<scene::Argument>& args, SourceLocation where,
                                    Scope* scope);
  Material bind_material(const scene::Material& material, Scope* scope);
  /// The slot `shadow`, as far as other shaders than the surface stand there.
  void bind_shadow(const scene::ShaderList& list, Scope* scope, Material& bound);
  /// Those of the list that give a value to move by.
  NodeList bind_displacement(const scene::ShaderList& list, Scope* scope);
  NodeList bind_volume(const scene::ShaderList& list, Scope* scope);
  const ShaderNode* find_named(const std::string& name, Scope* scope);
  /// Among the shaders of the phenomena around; null when there is none.
  const ShaderNode* find_local(const std::string& name, Scope* scope);
  const ShaderNode* bind_named(const scene::ShaderElement& element, Scope* scope,
                               std::map<std::string, const ShaderNode*>& known);
  /// The shader that a phenomenon's parameter names.
  const ShaderNode* interface_shader(const std::string& name, SourceLocation where, Scope* scope);
  Resolved resolve(const std::string& dotted, SourceLocation where, Scope* scope);
  const scene::Value* interface_value(const std::string& name, const Scope& scope) const;

  // Fallback shaders (binder_fallbacks.cpp):
  /// A shader that is not there, by the names of its parameters where they say something.
  const ShaderNode* bind_unknown(const std::string& type, const std::vector<scene::Argument>& args,
                                 SourceLocation where, Scope* scope);
  /// Applies the defaults of the scene's own declaration to a fallback shader.
  void bind_declared(ShaderNode& node, const std::vector<scene::ParamDecl>& declared);
  /// Handles an argument that the fallback shader does not declare: binds its inputs, or notes it.
  void bind_parts(ShaderNode& node, const scene::Argument& argument, Scope* scope);
  /// Binds an unknown parameter that is connected to a material to the material input of a shader
  /// that passes it through. False: the argument is no such connection.
  bool bind_passed_through(ShaderNode& node, const scene::Argument& argument, Scope* scope);

  void set_defaults(ShaderNode& node);
  static void set_default(const ParamSpec& param, ParamType type, std::byte* target);
  void bind_argument(ShaderNode& node, const scene::Argument& argument, Scope* scope);
  void bind_value(ShaderNode& node, const ParamSpec& param, std::size_t offset, ParamType type,
                  const scene::Value& value, Scope* scope);
  /// Has a material stand for the parameter at `offset`; false: it costs too much.
  bool bind_input(ShaderNode& node, std::size_t offset, const ShaderNode& source,
                  SourceLocation where);
  /// Leaves out materials whose lobes a closure has no room for.
  void count_lobes(ShaderNode& node, SourceLocation where);
  /// Counts the shaders that run for `node` with a source of that cost more; false: too many.
  bool afford(ShaderNode& node, float cost, SourceLocation where);
  /// Notes that `node` asks `source`; false: the chain would be too long.
  bool reaches(const ShaderNode& node, const ShaderNode* source, SourceLocation where);
  void bind_numbers(ShaderNode& node, const ParamSpec& param, std::size_t offset, ParamType type,
                    const scene::Value& value);
  void bind_text(ShaderNode& node, const ParamSpec& param, std::size_t offset, ParamType type,
                 const scene::Value& value, Scope* scope);
  void bind_array(ShaderNode& node, const ParamSpec& param, const scene::Value& value,
                  Scope* scope);
  /// The element at `offset` of an array; its members where it is a struct.
  void bind_element(ShaderNode& node, const ParamSpec& param, std::size_t offset,
                    const scene::Value& value, Scope* scope);
  void bind_members(ShaderNode& node, const ParamSpec& param, std::size_t offset,
                    const std::string& prefix, const std::vector<scene::Argument>& members,
                    Scope* scope);
  /// Room behind the parameters; returns its offset. Arrays bound before move along.
  static std::size_t append_elements(ShaderNode& node, std::size_t bytes);
  void mismatch(const ShaderNode& node, const ParamSpec& param, const scene::Value& value);
  const TextureNode* texture(const std::string& name, SourceLocation where, Scope* scope);
  ShaderNode* make_node(const ShaderSpec& spec);
  const ShaderNode* fallback();

  const scene::Scene& scene_;
  const Registry& registry_;
  World& world_;
  const std::unordered_map<std::string, std::vector<int>>& lights_by_name_;
  Diagnostics& diagnostics_;
  std::map<std::string, const ShaderNode*> named_;
  std::map<std::string, const TextureNode*> textures_;
  std::map<const ShaderNode*, const TextureNode*> procedures_;
  std::map<std::string, const photometry::LightProfile*> light_profiles_;
  std::unordered_map<const ShaderNode*, int> chain_;  ///< shaders one behind the other, most
  std::map<const TextureNode*, float> texture_cost_;  ///< shaders that one look-up runs
  std::vector<std::unique_ptr<Scope>> scopes_;
  std::vector<std::pair<const Scope*, std::string>> binding_;  ///< being bound, to find cycles
  int depth_ = 0;
  const ShaderNode* fallback_ = nullptr;
  std::map<std::string, int> reported_;
  BindingReport report_;
  ShadingPoint constant_point_;
};

}  // namespace oriel
