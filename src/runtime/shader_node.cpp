// SPDX-License-Identifier: Apache-2.0
#include "runtime/shader_node.h"

#include <algorithm>
#include <cstring>
#include <functional>

#include "base/assert.h"
#include "runtime/tracer.h"

namespace oriel {

namespace {

bool has_alias(const ShaderSpec& spec, std::string_view name) {
  std::string_view rest = spec.fallback.aliases;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    if (same_but_for_case(rest.substr(0, end), name)) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

}  // namespace

const ShaderSpec* Registry::find(std::string_view name) const {
  for (const ShaderSpec* s : specs_)
    if (s->name == name) return s;
  constexpr std::string_view kNewer = "adskMaya";
  const bool newer = same_but_for_case(name.substr(0, kNewer.size()), kNewer);
  const std::string older =
      newer ? "maya_" + std::string(name.substr(kNewer.size())) : std::string(name);
  for (const ShaderSpec* s : specs_)
    if (s->fallback.is_fallback && (same_but_for_case(s->name, older) || has_alias(*s, older)))
      return s;
  return nullptr;
}

bool same_but_for_case(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(),
                                            [&](char x, char y) { return lower(x) == lower(y); });
}

std::size_t size_of(ParamType type) {
  switch (type) {
    case ParamType::Boolean:
      return sizeof(bool);
    case ParamType::Integer:
      return sizeof(int);
    case ParamType::Scalar:
      return sizeof(float);
    case ParamType::Color:
      return sizeof(Rgba);
    case ParamType::Vector:
      return sizeof(Vec3);
    case ParamType::Transform:
      return sizeof(Mat4);
    case ParamType::String:
      return sizeof(std::string_view);
    case ParamType::Light:
      return sizeof(LightRef);
    case ParamType::Array:
      return sizeof(ArrayView<int>);
    default:
      return sizeof(void*);
  }
}

void convert_value(ParamType from, const void* source, ParamType to, void* target) {
  if (from == to) {
    std::memcpy(target, source, size_of(to));
    return;
  }
  Rgba c(0);
  switch (from) {
    case ParamType::Boolean:
      c = Rgba(*static_cast<const bool*>(source) ? 1.0f : 0.0f);
      break;
    case ParamType::Integer:
      c = Rgba(static_cast<float>(*static_cast<const int*>(source)));
      break;
    case ParamType::Scalar:
      c = Rgba(*static_cast<const float*>(source));
      break;
    case ParamType::Color:
      c = *static_cast<const Rgba*>(source);
      break;
    case ParamType::Vector: {
      const Vec3& v = *static_cast<const Vec3*>(source);
      c = Rgba(v.x, v.y, v.z, 1);
      break;
    }
    default:
      return;
  }
  const bool single = from != ParamType::Color && from != ParamType::Vector;
  const float mean = single ? c.r : (c.r + c.g + c.b) / 3;
  switch (to) {
    case ParamType::Boolean:
      *static_cast<bool*>(target) = mean != 0;
      break;
    case ParamType::Integer:
      // The range of int, less a rounding error: infinite values must not overflow.
      *static_cast<int*>(target) =
          std::isfinite(mean) ? static_cast<int>(clamp(mean, -2.1e9f, 2.1e9f)) : 0;
      break;
    case ParamType::Scalar:
      *static_cast<float*>(target) = mean;
      break;
    case ParamType::Color:
      if (single) c.a = 1;
      *static_cast<Rgba*>(target) = c;
      break;
    case ParamType::Vector:
      *static_cast<Vec3*>(target) = Vec3(c.r, c.g, c.b);
      break;
    default:
      break;
  }
}

bool ShaderNode::connected(std::size_t offset) const {
  return material_input(offset) != nullptr || source(offset) != nullptr;
}

const ShaderNode* ShaderNode::source(std::size_t offset) const {
  for (const std::vector<Connection>* list : {&connections_, &deferred_})
    for (const Connection& c : *list)
      if (c.offset == offset) return c.source;
  return nullptr;
}

bool ShaderNode::ask(std::size_t offset, ShadingPoint& point, void* target) const {
  for (const Connection& c : deferred_) {
    if (c.offset != offset) continue;
    alignas(16) std::byte result[kMaxParamBytes];
    c.source->value(point, result);
    convert_value(c.source_type, result + c.source_offset, c.type, target);
    return true;
  }
  return false;
}

const ShaderNode* ShaderNode::material_input(std::size_t offset) const {
  for (const MaterialInput& input : material_inputs_)
    if (input.offset == offset) return input.source;
  return nullptr;
}

bool ShaderNode::inputs_may_transmit() const {
  return std::any_of(material_inputs_.begin(), material_inputs_.end(), [](const MaterialInput& i) {
    const ShaderSpec& spec = i.source->spec();
    return spec.material.may_transmit && spec.material.may_transmit(*i.source);
  });
}

bool ShaderNode::runs_code_of_users() const {
  const auto runs = [](const auto& input) { return input.source->runs_code_of_users(); };
  return spec_->library == std::string_view("user") ||
         std::any_of(connections_.begin(), connections_.end(), runs) ||
         std::any_of(deferred_.begin(), deferred_.end(), runs) ||
         std::any_of(material_inputs_.begin(), material_inputs_.end(), runs);
}

void ShaderNode::defer_connections() {
  const auto is_asked_for = [&](const Connection& c) {
    return spec_->binding.deferred ||
           std::any_of(spec_->params.begin(), spec_->params.end(),
                       [&](const ParamSpec& p) { return p.asked_for && p.offset == c.offset; });
  };
  const auto first =
      std::stable_partition(connections_.begin(), connections_.end(), std::not_fn(is_asked_for));
  deferred_.insert(deferred_.end(), first, connections_.end());
  connections_.erase(first, connections_.end());
}

void ShaderNode::evaluate_connections(ShadingPoint& point, std::byte* scratch) const {
  std::memcpy(scratch, constants_.data(), spec_->params_size);
  alignas(16) std::byte result[kMaxParamBytes];
  for (std::size_t i = 0; i < connections_.size(); ++i) {
    const Connection& c = connections_[i];
    // Shaders of a list may change the normal for later ones; evaluation as a value must not.
    const Vec3 normal = point.normal;
    // Neighbouring connections to one source (a struct's members) evaluate it once.
    if (i == 0 || connections_[i - 1].source != c.source ||
        connections_[i - 1].look_up != c.look_up) {
      const LookUp of_parameter = point.look_up;
      point.look_up = std::max(of_parameter, c.look_up);
      c.source->value(point, result);
      point.look_up = of_parameter;
    }
    if (c.type == ParamType::Vector) point.normal = normal;
    convert_value(c.source_type, result + c.source_offset, c.type, scratch + c.offset);
  }
}

namespace {

/// Unbiased estimates of materials as values.
void shade_as_value(const ShaderNode& node, const ShadingPoint& at, void* result) {
  const ShaderSpec& spec = node.spec();
  std::memset(result, 0, spec.result_size);
  if (!at.tracer) return;
  ShadingPoint point = at;  // materials change its normal
  const bool has_outputs = spec.results.size() == kMaterialResults;
  MaterialOutputs outputs{};
  auto* colours = static_cast<Rgba*>(result);
  colours[0] = at.tracer->shade({&node}, point, has_outputs ? &outputs : nullptr);
  if (!has_outputs) return;
  constexpr std::size_t kOpacity = kMaterialResults - 1;
  for (std::size_t i = 1; i < kOpacity; ++i)
    colours[i] = Rgba(outputs[i].x, outputs[i].y, outputs[i].z, colours[0].a);
  *reinterpret_cast<float*>(colours + kOpacity) = outputs[kOpacity].x;
}

}  // namespace

void ShaderNode::value(ShadingPoint& point, void* result) const {
  if (is_shaded()) return shade_as_value(*this, point, result);
  ORIEL_ASSERT(spec_->value != nullptr);
  with_params(point, [&](const Call& call) { spec_->value(call, result); });
}

Rgba ShaderNode::color(ShadingPoint& point) const {
  alignas(16) std::byte result[kMaxParamBytes];
  value(point, result);
  // The main result of a struct is its first member.
  const ParamType type =
      spec_->result == ParamType::Struct ? spec_->results[0].type : spec_->result;
  Rgba c(0);
  convert_value(type, result, ParamType::Color, &c);
  return c;
}

float ShaderNode::scalar(ShadingPoint& point) const {
  const Rgba c = color(point);
  float s;
  convert_value(ParamType::Color, &c, ParamType::Scalar, &s);
  return s;
}

Vec3 ShaderNode::vector(ShadingPoint& point) const {
  const Rgba c = color(point);
  return Vec3(c.r, c.g, c.b);
}

}  // namespace oriel
