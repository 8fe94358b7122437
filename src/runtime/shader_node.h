// SPDX-License-Identifier: Apache-2.0
// A bound shader of the scene: constant parameters, connections, state; and its evaluation.
#pragma once

#include <memory>
#include <new>
#include <span>
#include <vector>

#include "runtime/shader_spec.h"

namespace oriel {

/// Maximum size in bytes of a parameter struct or a result, which are allocated on the stack.
inline constexpr std::size_t kMaxParamBytes = 1536;

/// A parameter whose value is the result of another shader.
struct Connection {
  std::size_t offset;  ///< into this shader's parameters
  ParamType type;      ///< of the parameter
  const ShaderNode* source;
  ParamType source_type;              ///< of the result or its member
  std::size_t source_offset;          ///< of the member in the source's result
  LookUp look_up = LookUp::Filtered;  ///< of the source and its inputs
};

/// A parameter with a connected material.
struct MaterialInput {
  std::size_t offset;  ///< into this shader's parameters
  const ShaderNode* source;
};

/// One bound shader. Immutable while rendering.
class ShaderNode {
 public:
  explicit ShaderNode(const ShaderSpec& spec) : spec_(&spec) {}

  const ShaderSpec& spec() const { return *spec_; }
  const ShaderState* state() const { return state_.get(); }

  /// Constant parameters, set or default; connected ones contain their default.
  template <class P>
  const P& constants() const {
    return *reinterpret_cast<const P*>(constants_.data());
  }
  /// Whether any parameter is connected to another shader.
  bool has_inputs() const {
    return !connections_.empty() || !deferred_.empty() || !material_inputs_.empty();
  }
  /// Whether the parameter at `offset` is connected to another shader.
  bool connected(std::size_t offset) const;
  /// The shader connected to the parameter at `offset`; null if it is constant.
  const ShaderNode* source(std::size_t offset) const;
  /// Whether source() is not null for some parameter.
  bool has_connections() const { return !connections_.empty() || !deferred_.empty(); }
  /// The material connected to the parameter at `offset`; null if there is none.
  const ShaderNode* material_input(std::size_t offset) const;
  const std::vector<MaterialInput>& material_inputs() const { return material_inputs_; }
  /// Connections that only the shader itself evaluates (BindingTraits::deferred,
  /// ParamSpec::asked_for).
  const std::vector<Connection>& connections() const { return deferred_; }
  /// Writes the value connected to the parameter at `offset`, converted to its type. False: nothing
  /// is connected.
  bool ask(std::size_t offset, ShadingPoint& point, void* target) const;
  /// Whether light may pass one of the connected materials straight.
  bool inputs_may_transmit() const;
  /// Whether it, or a shader connected to it, comes from a library of users.
  bool runs_code_of_users() const;

  /// Calls f(Call) with all connections evaluated at the point.
  template <class F>
  auto with_params(ShadingPoint& point, F&& f) const {
    if (connections_.empty()) return f(Call{constants_.data(), state_.get(), point, this});
    alignas(16) std::byte scratch[kMaxParamBytes];
    evaluate_connections(point, scratch);
    return f(Call{scratch, state_.get(), point, this});
  }

  /// Evaluates as a value and converts to T = Rgba, float, Vec3, int or bool.
  Rgba color(ShadingPoint& point) const;
  float scalar(ShadingPoint& point) const;
  Vec3 vector(ShadingPoint& point) const;

  /// Whether its value needs rays: it is a material, or is connected to one.
  bool is_shaded() const {
    return spec_->material.fill && (!spec_->value || !material_inputs_.empty());
  }
  /// Writes the raw result (spec().result_size bytes): the shader's result; of a material its
  /// shaded colour at the point and, if it has them, its outputs. Black where no rays can be
  /// traced: in shadow rays, photons, displacement.
  void value(ShadingPoint& point, void* result) const;

 private:
  friend class Binder;
  void evaluate_connections(ShadingPoint& point, std::byte* scratch) const;
  /// Separates the connections that the shader evaluates itself.
  void defer_connections();

  const ShaderSpec* spec_;
  std::vector<std::max_align_t> storage_;
  std::span<std::byte> constants_;
  std::vector<Connection> connections_, deferred_;
  std::vector<MaterialInput> material_inputs_;
  std::unique_ptr<ShaderState> state_;
  /// Number of shaders of one evaluation, including itself. A shader with several users counts once
  /// for each.
  float cost_ = 1;
  int max_lobes_ = 1;  ///< of its closure, including connected materials
};

/// Shaders of a list run in order, each on the result of the previous one.
using NodeList = std::vector<const ShaderNode*>;

/// Converts between the types that connections permit: a scalar sets all channels of a colour or
/// vector, a colour is reduced to the mean of its channels, a number is true if it is not 0.
void convert_value(ParamType from, const void* source, ParamType to, void* target);
std::size_t size_of(ParamType type);

}  // namespace oriel
