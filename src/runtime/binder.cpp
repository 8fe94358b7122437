// SPDX-License-Identifier: Apache-2.0
// Binding of lists, calls, phenomena and connections by name. Values: binder_values.cpp.
#include "runtime/binder.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/fallback_shader.h"

namespace oriel {
namespace {

/// Maximum nesting of calls and phenomena; deeper ones are errors or attacks.
constexpr int kMaxDepth = 200;

template <class Range, class Name>
std::vector<std::string> names_of(const Range& range, Name name) {
  std::vector<std::string> names;
  names.reserve(std::size(range));
  for (const auto& item : range) names.emplace_back(name(item));
  return names;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string near = nearest_name(name, candidates);
  return near.empty() ? std::string() : fmt::format("did you mean \"{}\"?", near);
}

}  // namespace

Binder::Binder(const scene::Scene& scene, const Registry& registry, World& world,
               const std::unordered_map<std::string, std::vector<int>>& lights_by_name,
               Diagnostics& diagnostics)
    : scene_(scene),
      registry_(registry),
      world_(world),
      lights_by_name_(lights_by_name),
      diagnostics_(diagnostics) {}

NodeList Binder::bind(const scene::ShaderList& list) { return bind_list(list, nullptr); }

NodeList Binder::bind_list(const scene::ShaderList& list, Scope* scope) {
  NodeList nodes;
  for (const scene::ShaderUse& use : list)
    if (const ShaderNode* node = bind_use(use, scope)) nodes.push_back(node);
  return nodes;
}

const ShaderNode* Binder::bind_use(const scene::ShaderUse& use, Scope* scope) {
  if (use.interface) return interface_shader(use.reference, use.where, scope);
  if (use.reference.empty()) return bind_call(use.type, use.arguments, use.where, scope);
  return resolve(use.reference, use.where, scope).node;
}

const ShaderNode* Binder::named(const std::string& name, SourceLocation where) {
  return resolve(name, where, nullptr).node;
}

const ShaderNode* Binder::interface_shader(const std::string& name, SourceLocation where,
                                           Scope* scope) {
  if (!scope) {
    diagnostics_.warning("OR-RT-013", where, "an interface value outside of a phenomenon; skipped");
    return nullptr;
  }
  const scene::Value* value = interface_value(name, *scope);
  if (!value || value->text.empty()) return nullptr;
  Scope* outer = const_cast<Scope*>(scope->outer);
  if (value->kind == scene::Value::Kind::Interface)
    return interface_shader(value->text, value->where, outer);
  return resolve(value->text, value->where, outer).node;
}

const ShaderNode* Binder::bind_named(const scene::ShaderElement& element, Scope* scope,
                                     std::map<std::string, const ShaderNode*>& known) {
  if (const auto found = known.find(element.name); found != known.end()) return found->second;
  const std::pair<const Scope*, std::string> key(scope, element.name);
  if (std::find(binding_.begin(), binding_.end(), key) != binding_.end()) {
    diagnostics_.error("OR-RT-004", element.where,
                       fmt::format("shader \"{}\" is connected to itself", element.name),
                       "break the cycle; the declared default is used here");
    return nullptr;
  }
  binding_.push_back(key);
  const NodeList nodes = bind_list(element.functions, scope);
  binding_.pop_back();
  if (!nodes.empty()) world_.names.try_emplace(nodes.back(), element.name);
  return known[element.name] = nodes.empty() ? nullptr : nodes.back();
}

const ShaderNode* Binder::find_local(const std::string& name, Scope* scope) {
  for (Scope* s = scope; s; s = const_cast<Scope*>(s->outer))
    for (const scene::ShaderElement& element : s->phenomenon->shaders)
      if (element.name == name) return bind_named(element, s, s->named);
  return nullptr;
}

const ShaderNode* Binder::find_named(const std::string& name, Scope* scope) {
  if (const ShaderNode* local = find_local(name, scope)) return local;
  const auto* element = scene_.get<scene::ShaderElement>(name);
  return element ? bind_named(*element, nullptr, named_) : nullptr;
}

Binder::Resolved Binder::resolve(const std::string& dotted, SourceLocation where, Scope* scope) {
  const auto main_result = [](const ShaderNode* node) {
    const ShaderSpec& spec = node->spec();
    return Resolved{node, spec.result == ParamType::Struct ? spec.results[0].type : spec.result, 0};
  };
  if (const ShaderNode* node = find_named(dotted, scope)) return main_result(node);
  const std::size_t dot = dotted.rfind('.');
  if (dot != std::string::npos && dotted.size() == dot + 2 && dotted.find('.') < dot) {
    // One component of a member: "file1.outColor.r".
    Resolved whole = resolve(dotted.substr(0, dot), where, scope);
    const bool color = whole.type == ParamType::Color;
    const std::size_t i = std::string_view(color ? "rgba" : "xyz").find(dotted[dot + 1]);
    if (whole.node && (color || whole.type == ParamType::Vector) && i != std::string_view::npos)
      return {whole.node, ParamType::Scalar, whole.offset + i * sizeof(float)};
    return whole;
  }
  if (dot != std::string::npos) {
    if (const ShaderNode* node = find_named(dotted.substr(0, dot), scope)) {
      const std::string member = dotted.substr(dot + 1);
      for (const ParamSpec& result : node->spec().results)
        if (member == result.name) return {node, result.type, result.offset};
      // Other programs address the single result of a shader by name ("file1.outColor").
      if (node->spec().results.empty()) return main_result(node);
      diagnostics_.warning(
          "OR-RT-006", where,
          fmt::format("shader \"{}\" has no result \"{}\"", dotted.substr(0, dot), member),
          did_you_mean(member, names_of(node->spec().results, [](auto& r) { return r.name; })));
      return main_result(node);
    }
  }
  if (!scene_.find(dotted)) {
    std::vector<std::string> shaders;
    for (const scene::Element& e : scene_.elements())
      if (std::holds_alternative<scene::ShaderElement>(e)) shaders.push_back(scene::name_of(e));
    diagnostics_.warning("OR-RT-005", where, fmt::format("there is no shader \"{}\"", dotted),
                         did_you_mean(dotted, shaders));
  }
  return {};
}

ShaderNode* Binder::make_node(const ShaderSpec& spec) {
  world_.nodes.push_back(std::make_unique<ShaderNode>(spec));
  ShaderNode* node = world_.nodes.back().get();
  set_defaults(*node);
  return node;
}

const ShaderNode* Binder::fallback() {
  if (!fallback_) fallback_ = make_node(kFallbackShader);
  return fallback_;
}

const ShaderNode* Binder::bind_call(const std::string& type,
                                    const std::vector<scene::Argument>& args, SourceLocation where,
                                    Scope* scope) {
  if (depth_ >= kMaxDepth) {
    diagnostics_.error("OR-RT-003", where, "shader calls are nested too deeply");
    return fallback();
  }
  struct Deeper {
    int& depth;
    explicit Deeper(int& d) : depth(d) { ++depth; }
    ~Deeper() { --depth; }
  } deeper(depth_);

  if (const scene::Phenomenon* phenomenon = scene_.find_phenomenon(type))
    return bind_phenomenon(*phenomenon, args, where, scope);
  const ShaderSpec* spec = registry_.find(type);
  if (!spec) return bind_unknown(type, args, where, scope);
  ++report_.shaders[type];
  ShaderNode* node = make_node(*spec);
  if (spec->fallback.is_fallback) {
    ++report_.fallbacks[type];
    if (const auto* own = scene_.find_declaration(type)) bind_declared(*node, own->parameters);
  }
  for (const scene::Argument& argument : args) bind_argument(*node, argument, scope);
  count_lobes(*node, where);
  node->defer_connections();
  if (spec->binding.prepare) node->state_ = spec->binding.prepare(node->constants_.data(), world_);
  if (spec->binding.prepare_call)
    node->state_ = spec->binding.prepare_call(
        {node->constants_.data(), nullptr, constant_point_, node}, world_);
  return node;
}

const ShaderNode* Binder::bind_phenomenon(const scene::Phenomenon& phenomenon,
                                          const std::vector<scene::Argument>& args,
                                          SourceLocation where, Scope* scope) {
  for (const Scope* s = scope; s; s = s->outer)
    if (s->phenomenon == &phenomenon) {
      diagnostics_.error(
          "OR-RT-004", where,
          fmt::format("phenomenon \"{}\" calls itself", phenomenon.declaration.name));
      return fallback();
    }
  scopes_.push_back(std::make_unique<Scope>(Scope{&phenomenon, &args, scope, {}}));
  Scope* inner = scopes_.back().get();
  for (const scene::Phenomenon::Root& root : phenomenon.roots) {
    if (root.keyword == "root") {
      const NodeList nodes = bind_list(root.shaders, inner);
      if (!nodes.empty()) return nodes.back();
    }
    if (root.keyword == "root material") {
      // A material phenomenon that is used as a shader returns its surface.
      for (const scene::Material& material : phenomenon.materials)
        if (material.name == root.name) {
          const NodeList nodes = bind_list(material.shaders, inner);
          if (!nodes.empty()) return nodes.back();
        }
    }
  }
  diagnostics_.warning(
      "OR-RT-002", where,
      fmt::format("phenomenon \"{}\" has no root shader", phenomenon.declaration.name));
  return fallback();
}

NodeList Binder::bind_displacement(const scene::ShaderList& list, Scope* scope) {
  NodeList nodes;
  for (const ShaderNode* node : bind_list(list, scope)) {
    if (node->spec().value && node != fallback_)
      nodes.push_back(node);
    else if (node != fallback_)
      diagnostics_.warning(
          "OR-RT-030", list.front().where,
          fmt::format("shader \"{}\" gives no value to displace by; skipped", node->spec().name));
  }
  return nodes;
}

NodeList Binder::bind_volume(const scene::ShaderList& list, Scope* scope) {
  NodeList nodes;
  for (const ShaderNode* node : bind_list(list, scope)) {
    if (node->spec().volume.evaluate)
      nodes.push_back(node);
    else if (node != fallback_)
      diagnostics_.warning(
          "OR-RT-046", list.front().where,
          fmt::format("shader \"{}\" does not act as a volume; skipped", node->spec().name));
  }
  return nodes;
}

void Binder::bind_shadow(const scene::ShaderList& list, Scope* scope, Material& bound) {
  bound.has_shadow_shader = !list.empty();
  const auto in_surface = [&](auto&& matches) {
    return std::any_of(bound.surface.begin(), bound.surface.end(), matches);
  };
  bool others = false;
  Material slot;
  for (const scene::ShaderUse& use : list) {
    const ShaderNode* node = bind_use(use, scope);
    if (!node || node == fallback_) continue;
    const ShaderSpec& spec = node->spec();
    // The surface itself. A call of its shader without arguments uses the surface's arguments.
    const bool bare = use.reference.empty() && !use.interface && use.arguments.empty();
    const auto itself = std::find_if(
        bound.surface.begin(), bound.surface.end(),
        [&](const ShaderNode* n) { return n == node || (bare && &n->spec() == &spec); });
    if (spec.material.shadow && itself != bound.surface.end()) {
      // One call serves both, with one set of parameters.
      slot.shadow.push_back(*itself);
      others = true;
      continue;
    }
    // A fallback without shadow function leaves shadows to the surface.
    const bool none = spec.fallback.is_fallback && !spec.material.shadow && !spec.material.fill;
    if (none || in_surface([&](const ShaderNode* n) {
          return n == node || (bare && !spec.material.shadow && &n->spec() == &spec);
        })) {
      slot.shadow_surface = bound.surface;
    } else if (spec.material.shadow) {
      slot.shadow.push_back(node);
      others = true;
    } else if (spec.material.fill) {
      slot.shadow_surface.push_back(node);
      others = true;
    } else {
      diagnostics_.warning(
          "OR-RT-031", use.where,
          fmt::format("shader \"{}\" does not act on shadows; skipped", spec.name));
    }
  }
  if (!others) return;
  bound.shadow = std::move(slot.shadow);
  bound.shadow_surface = std::move(slot.shadow_surface);
}

Material Binder::bind_material(const scene::Material& material) {
  return bind_material(material, nullptr);
}

Material Binder::bind_material(const scene::Material& material, Scope* scope) {
  // A surface that is one call of a phenomenon with a root material uses all slots of that
  // material.
  if (material.shaders.size() == 1) {
    const scene::ShaderUse* use = &material.shaders[0];
    if (const auto* element = scene_.get<scene::ShaderElement>(use->reference);
        element && element->functions.size() == 1)
      use = &element->functions[0];
    if (const scene::Phenomenon* phenomenon = scene_.find_phenomenon(use->type)) {
      for (const scene::Phenomenon::Root& root : phenomenon->roots)
        for (const scene::Material& inner : phenomenon->materials)
          if (root.keyword == "root material" && inner.name == root.name && depth_ < kMaxDepth) {
            scopes_.push_back(
                std::make_unique<Scope>(Scope{phenomenon, &use->arguments, scope, {}}));
            ++depth_;
            Material bound = bind_material(inner, scopes_.back().get());
            --depth_;
            bound.name = material.name;
            return bound;
          }
    }
  }
  Material bound;
  bound.name = material.name;
  bound.opaque = material.opaque;
  bound.surface = bind_list(material.shaders, scope);
  if (const auto* list = material.slot("environment")) bound.environment = bind_list(*list, scope);
  if (const auto* list = material.slot("displace"))
    bound.displace = bind_displacement(*list, scope);
  if (const auto* list = material.slot("shadow")) bind_shadow(*list, scope, bound);
  if (const auto* list = material.slot("volume"); list && world_.options.volume)
    bound.volume = bind_volume(*list, scope);
  world_.has_object_volumes |= !bound.volume.empty();
  if (const auto* list = material.slot("photon")) {
    for (const ShaderNode* node : bind_list(*list, scope)) {
      const ShaderSpec& spec = node->spec();
      if (spec.photon.scatter)
        bound.photon.push_back(node);
      else if (spec.material.fill && !spec.fallback.is_fallback)
        bound.photon_surface.push_back(node);
    }
  }
  if (const auto* list = material.slot("lightmap");
      list && !list->empty() && world_.options.lightmap != scene::MapMode::Off)
    diagnostics_.warning(
        "OR-RT-045", material.where,
        fmt::format("material \"{}\" requests a light map; it is not written", material.name),
        "rendering does not require it; existing light map textures are read");
  const auto transmits = [](const ShaderNode* node) {
    return node->spec().material.may_transmit && node->spec().material.may_transmit(*node);
  };
  const auto some_transmit = [&](const NodeList& nodes) {
    return std::any_of(nodes.begin(), nodes.end(), transmits);
  };
  bound.may_have_holes = some_transmit(bound.surface);
  bound.may_transmit =
      bound.filters_shadows()
          ? std::all_of(bound.shadow.begin(), bound.shadow.end(), transmits) &&
                (bound.shadow_surface.empty() || some_transmit(bound.shadow_surface))
          : bound.may_have_holes;
  bound.may_transmit = bound.may_transmit && bound.has_shadow_shader && !bound.opaque;
  if (bound.surface.size() == 1) {
    const ShaderNode* node = bound.surface.front();
    const MaterialRole& role = node->spec().material;
    if (role.straight_by_angle && !bound.filters_shadows() && role.straight_by_angle(*node))
      bound.straight_by_angle = node;
    if (role.even_emission) bound.even_emission = role.even_emission(*node);
  }
  for (const ShaderNode* node : bound.surface) {
    if (node->spec().material.has_outputs) bound.outputs = node->spec().material.has_outputs(*node);
  }
  return bound;
}

const scene::Value* Binder::interface_value(const std::string& name, const Scope& scope) const {
  const std::size_t dot = name.find('.');
  const std::string head = name.substr(0, dot);
  const scene::Value* value = nullptr;
  for (const scene::Argument& argument : *scope.arguments)
    if (argument.name == head) value = &argument.value;
  if (!value)
    for (const scene::ParamDecl& param : scope.phenomenon->declaration.parameters)
      if (param.name == head && param.default_value) value = &*param.default_value;
  if (value && dot != std::string::npos) {
    const std::string member = name.substr(dot + 1);
    for (const scene::Argument& argument : value->members)
      if (argument.name == member) return &argument.value;
    return nullptr;
  }
  return value;
}

}  // namespace oriel
