// SPDX-License-Identifier: Apache-2.0
// Conversion of scene values to parameter structs: defaults, numbers, names, arrays, connections.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <new>

#include "base/assert.h"
#include "runtime/binder.h"
#include "runtime/closure.h"

namespace oriel {
namespace {

using scene::Value;

/// Stores a value in a parameter struct.
template <class T>
void store(std::byte* target, const T& value) {
  new (target) T(value);
}

std::string describe(const Value& value) {
  switch (value.kind) {
    case Value::Kind::Null:
      return "null";
    case Value::Kind::Boolean:
      return value.boolean ? "on" : "off";
    case Value::Kind::Numbers:
      return fmt::format("{} number(s)", value.numbers.size());
    case Value::Kind::Text:
      return fmt::format("\"{}\"", value.text);
    case Value::Kind::Connection:
      return fmt::format("= \"{}\"", value.text);
    case Value::Kind::Interface:
      return fmt::format("= interface \"{}\"", value.text);
    case Value::Kind::Struct:
      return "a struct";
    case Value::Kind::Array:
      return "an array";
  }
  return "a value";
}

/// Writes `count` floats as a value of `type`.
void store_numbers(std::byte* target, ParamType type, const float* v, std::size_t count) {
  const auto at = [&](std::size_t i, float missing) { return i < count ? v[i] : missing; };
  switch (type) {
    case ParamType::Boolean: {
      const bool b = at(0, 0) != 0;
      store(target, b);
      break;
    }
    case ParamType::Integer: {
      const int i = static_cast<int>(clamp(at(0, 0), -2.1e9f, 2.1e9f));
      store(target, i);
      break;
    }
    case ParamType::Scalar: {
      const float f = at(0, 0);
      store(target, f);
      break;
    }
    case ParamType::Color: {
      // One number is a grey; three numbers have alpha 1.
      const Rgba c =
          count == 1 ? Rgba(v[0], v[0], v[0], 1) : Rgba(at(0, 0), at(1, 0), at(2, 0), at(3, 1));
      store(target, c);
      break;
    }
    case ParamType::Vector: {
      const Vec3 p = count == 1 ? Vec3(v[0]) : Vec3(at(0, 0), at(1, 0), at(2, 0));
      store(target, p);
      break;
    }
    case ParamType::Transform:
      if (count == 16) std::memcpy(target, v, sizeof(Mat4));
      break;
    default:
      break;
  }
}

/// Whether a value of the type may have this number of components.
bool count_fits(ParamType type, std::size_t count) {
  switch (type) {
    case ParamType::Boolean:
    case ParamType::Integer:
    case ParamType::Scalar:
      return count == 1;
    case ParamType::Color:
      return count == 1 || count == 3 || count == 4;
    case ParamType::Vector:
      return count == 1 || count == 3;
    case ParamType::Transform:
      return count == 16;
    default:
      return false;
  }
}

}  // namespace

void Binder::set_default(const ParamSpec& param, ParamType type, std::byte* target) {
  if (type == ParamType::Light) {
    const LightRef none;
    store(target, none);
  } else if (type == ParamType::String) {
    const std::string_view text = param.text ? param.text : "";
    store(target, text);
  } else if (type == ParamType::Transform) {
    const Mat4 identity;
    store(target, identity);
  } else {
    // A declared colour is opaque; without declared default and value it is all zero.
    const bool opaque = param.declared_default && param.fallback[3] == 0;
    const std::size_t count = type == ParamType::Color && opaque ? 3 : 4;
    store_numbers(target, type, param.fallback.data(), count);
  }
}

void Binder::set_defaults(ShaderNode& node) {
  const ShaderSpec& spec = node.spec();
  ORIEL_ASSERT(spec.binding.deferred || spec.params_size <= kMaxParamBytes);
  ORIEL_ASSERT(spec.result_size <= kMaxParamBytes);
  node.storage_.resize(spec.params_size / sizeof(std::max_align_t) + 1);
  auto* bytes = reinterpret_cast<std::byte*>(node.storage_.data());
  std::memset(bytes, 0, node.storage_.size() * sizeof(std::max_align_t));
  node.constants_ = {bytes, spec.params_size};
  for (const ParamSpec& param : spec.params) set_default(param, param.type, bytes + param.offset);
}

void Binder::bind_argument(ShaderNode& node, const scene::Argument& argument, Scope* scope) {
  const ShaderSpec& spec = node.spec();
  const auto found = std::find_if(spec.params.begin(), spec.params.end(), [&](const ParamSpec& p) {
    if (argument.name == p.name || (p.alias && argument.name == p.alias)) return true;
    return spec.fallback.is_fallback && same_but_for_case(argument.name, p.name);
  });
  const bool grouped = argument.value.kind == Value::Kind::Struct;
  if (spec.fallback.is_fallback && (found == spec.params.end() || grouped))
    return bind_parts(node, argument, scope);
  if (found == spec.params.end() && argument.value.kind == Value::Kind::Struct) {
    // Members of a struct are separate parameters, "outer.inner".
    for (const scene::Argument& member : argument.value.members)
      bind_argument(node, {argument.name + "." + member.name, member.value, member.where}, scope);
    return;
  }
  if (found == spec.params.end()) {
    std::vector<std::string> names;
    for (const ParamSpec& p : spec.params) names.emplace_back(p.name);
    const std::string near = nearest_name(argument.name, names);
    diagnostics_.warning(
        "OR-RT-010", argument.where,
        fmt::format("shader \"{}\" has no parameter \"{}\"; skipped", spec.name, argument.name),
        near.empty() ? fmt::format("`oriel shaders {}` lists its parameters", spec.name)
                     : fmt::format("did you mean \"{}\"?", near));
    return;
  }
  const std::vector<std::byte> before(node.constants_.begin(), node.constants_.end());
  const std::size_t connections = node.connections_.size();
  bind_value(node, *found, found->offset, found->type, argument.value, scope);
  const bool changed = connections != node.connections_.size() ||
                       !std::equal(before.begin(), before.end(), node.constants_.begin());
  if (changed && found->support != Support::Exact) {
    auto& list = found->support == Support::Ignored ? report_.ignored : report_.approximated;
    ++list[fmt::format("{}.{}", spec.name, found->name)];
  }
}

void Binder::bind_value(ShaderNode& node, const ParamSpec& param, std::size_t offset,
                        ParamType type, const Value& value, Scope* scope) {
  switch (value.kind) {
    case Value::Kind::Null:
      return;
    case Value::Kind::Boolean:
      if (type == ParamType::Boolean || type == ParamType::Integer) {
        const float v = value.boolean ? 1.0f : 0.0f;
        store_numbers(node.constants_.data() + offset, type, &v, 1);
      } else {
        mismatch(node, param, value);
      }
      return;
    case Value::Kind::Numbers:
      return bind_numbers(node, param, offset, type, value);
    case Value::Kind::Text:
      return bind_text(node, param, offset, type, value, scope);
    case Value::Kind::Connection: {
      if (type == ParamType::Shader || type == ParamType::LightProfile ||
          type == ParamType::ColorTexture || type == ParamType::ScalarTexture ||
          type == ParamType::VectorTexture)
        return bind_text(node, param, offset, type, value, scope);
      const Resolved source = resolve(value.text, value.where, scope);
      if (!source.node) return;
      // A member of its result is a value; the whole result is the material.
      const bool whole = source.offset == 0 && source.type == ParamType::Color;
      if (param.takes_material && whole && source.node->spec().material.fill) {
        bind_input(node, offset, *source.node, value.where);
        return;
      }
      if (!source.node->spec().value && !source.node->spec().material.fill) {
        diagnostics_.warning(
            "OR-RT-012", value.where,
            fmt::format("shader \"{}\" gives no value that \"{}\" of \"{}\" can use",
                        source.node->spec().name, param.name, node.spec().name),
            "its declared default is used");
        return;
      }
      const bool again = !node.connections_.empty() &&
                         node.connections_.back().source == source.node &&
                         node.connections_.back().look_up == param.look_up;
      const float cost = source.node->cost_ * node.spec().binding.evaluations;
      if (!again && !(reaches(node, source.node, value.where) && afford(node, cost, value.where)))
        return;
      node.connections_.push_back(
          {offset, type, source.node, source.type, source.offset, param.look_up});
      return;
    }
    case Value::Kind::Interface: {
      if (!scope) {
        diagnostics_.warning("OR-RT-013", value.where,
                             "an interface value outside of a phenomenon; skipped");
        return;
      }
      if (const Value* outer = interface_value(value.text, *scope))
        bind_value(node, param, offset, type, *outer, const_cast<Scope*>(scope->outer));
      return;
    }
    case Value::Kind::Array:
      if (type == ParamType::Array) return bind_array(node, param, value, scope);
      return mismatch(node, param, value);
    case Value::Kind::Struct:
      return mismatch(node, param, value);
  }
}

bool Binder::bind_input(ShaderNode& node, std::size_t offset, const ShaderNode& source,
                        SourceLocation where) {
  if (!reaches(node, &source, where) || !afford(node, source.cost_, where)) return false;
  node.material_inputs_.push_back({offset, &source});
  return true;
}

void Binder::count_lobes(ShaderNode& node, SourceLocation where) {
  const ShaderSpec& spec = node.spec();
  if (!spec.material.fill) return;
  const int own = spec.material.max_lobes ? spec.material.max_lobes(node) : 1;
  int of_inputs = 0;
  for (std::size_t i = 0; i < node.material_inputs_.size(); ++i) {
    const ShaderNode& source = *node.material_inputs_[i].source;
    const int all = spec.material.one_material ? std::max(of_inputs, source.max_lobes_)
                                               : of_inputs + source.max_lobes_;
    if (own + all > Closure::kMaxLobes) {
      diagnostics_.warning(
          "OR-RT-008", where,
          fmt::format("shader \"{}\" under \"{}\" would scatter light in more than {} ways",
                      source.spec().name, spec.name, Closure::kMaxLobes),
          "it is left out");
      node.material_inputs_.erase(node.material_inputs_.begin() + static_cast<std::ptrdiff_t>(i--));
      continue;
    }
    of_inputs = all;
  }
  node.max_lobes_ = own + of_inputs;
}

bool Binder::reaches(const ShaderNode& node, const ShaderNode* source, SourceLocation where) {
  // Each link of a chain needs some kilobytes of stack when it is evaluated.
  constexpr int kLongestChain = 500;
  const auto length_of = [&](const ShaderNode* n) {
    const auto known = chain_.find(n);
    return known == chain_.end() ? 1 : known->second;
  };
  const int length = length_of(source) + 1;
  if (length > kLongestChain) {
    diagnostics_.error("OR-RT-009", where,
                       fmt::format("more than {1} shaders are connected in a chain to \"{0}\"",
                                   node.spec().name, kLongestChain),
                       "the declared default is used here");
    return false;
  }
  int& own = chain_[&node];
  own = std::max(own, length);
  return true;
}

bool Binder::afford(ShaderNode& node, float cost, SourceLocation where) {
  // In a graph where each layer evaluates the next one twice, the cost doubles with each layer.
  constexpr float kMaxEvaluations = 1e5f;
  if (node.cost_ + cost > kMaxEvaluations) {
    diagnostics_.error("OR-RT-007", where,
                       fmt::format("connections of \"{}\" would evaluate more than {} shaders",
                                   node.spec().name, static_cast<int>(kMaxEvaluations)),
                       "the declared default is used here");
    return false;
  }
  node.cost_ += cost;
  return true;
}

void Binder::bind_numbers(ShaderNode& node, const ParamSpec& param, std::size_t offset,
                          ParamType type, const Value& value) {
  // An extra number of a colour is reported; the rest is used.
  if (!count_fits(type, value.numbers.size())) return mismatch(node, param, value);
  std::vector<float> v(value.numbers.begin(), value.numbers.end());
  store_numbers(node.constants_.data() + offset, type, v.data(), v.size());
}

void Binder::bind_text(ShaderNode& node, const ParamSpec& param, std::size_t offset, ParamType type,
                       const Value& value, Scope* scope) {
  std::byte* target = node.constants_.data() + offset;
  switch (type) {
    case ParamType::String: {
      world_.strings.push_back(value.text);
      const std::string_view text = world_.strings.back();
      store(target, text);
      return;
    }
    case ParamType::Shader: {
      if (value.text.empty()) return;
      const ShaderRef ref{resolve(value.text, value.where, scope).node};
      if (!ref.node) return;
      if (param.takes_material && ref.node->spec().material.fill) {
        if (bind_input(node, offset, *ref.node, value.where)) store(target, ref);
      } else if (reaches(node, ref.node, value.where) &&
                 afford(node, ref.node->cost_, value.where)) {
        store(target, ref);
      }
      return;
    }
    case ParamType::Light: {
      if (value.text.empty()) return;
      const auto found = lights_by_name_.find(value.text);
      if (found == lights_by_name_.end() || found->second.empty()) {
        std::vector<std::string> names;
        for (const auto& [name, indices] : lights_by_name_) names.push_back(name);
        const std::string near = nearest_name(value.text, names);
        diagnostics_.warning(
            "OR-RT-015", value.where,
            fmt::format("there is no light instance \"{}\" in the rendered scene", value.text),
            near.empty() ? "lights are named by their instances"
                         : fmt::format("did you mean \"{}\"?", near));
        return;
      }
      const LightRef ref{found->second[0]};
      store(target, ref);
      return;
    }
    case ParamType::ColorTexture:
    case ParamType::ScalarTexture:
    case ParamType::VectorTexture: {
      if (value.text.empty()) return;
      const ColorTextureRef ref{texture(value.text, value.where, scope)};
      const auto cost = texture_cost_.find(ref.texture);
      if (cost == texture_cost_.end() || afford(node, cost->second, value.where))
        store(target, ref);
      return;
    }
    case ParamType::LightProfile: {
      if (value.text.empty()) return;
      const LightProfileRef ref{light_profile(value.text, value.where)};
      store(target, ref);
      return;
    }
    case ParamType::Material:
    case ParamType::Geometry:
    case ParamType::Data: {
      if (value.text.empty()) return;
      world_.strings.push_back(value.text);
      store(target, ElementRef{&world_.strings.back()});
      return;
    }
    case ParamType::Spectrum:
      return;
    default:
      return mismatch(node, param, value);
  }
}

void Binder::mismatch(const ShaderNode& node, const ParamSpec& param, const Value& value) {
  diagnostics_.warning("OR-RT-011", value.where,
                       fmt::format("parameter \"{}\" of \"{}\" is a {}{}, not {}; skipped",
                                   param.name, node.spec().name, scene::type_name(param.type),
                                   param.type == ParamType::Array
                                       ? fmt::format(" of {}", scene::type_name(param.element))
                                       : std::string(),
                                   describe(value)));
}

}  // namespace oriel
