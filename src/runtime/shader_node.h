// SPDX-License-Identifier: Apache-2.0
// A shader of the scene, bound: constant parameters, connections, state; and how it is evaluated.
#pragma once

#include <memory>
#include <new>
#include <span>
#include <vector>

#include "runtime/shader_spec.h"

namespace oriel {

/// Most bytes a parameter struct or a result may have (they live on the stack while evaluated).
inline constexpr std::size_t kMaxParamBytes = 1536;

/// A parameter whose value another shader gives at each point.
struct Connection {
  std::size_t offset;  ///< into this shader's parameters
  ParamType type;      ///< of the parameter
  const ShaderNode* source;
  ParamType source_type;      ///< of the result or its member
  std::size_t source_offset;  ///< of the member in the source's result
  bool unfiltered = false;    ///< the source, and all it asks, look up single texels
};

/// A parameter that another material stands for.
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

  /// Constant parameters, as written or by default; connected ones hold their default.
  template <class P>
  const P& constants() const {
    return *reinterpret_cast<const P*>(constants_.data());
  }
  /// Whether the parameter at `offset` comes from another shader.
  bool connected(std::size_t offset) const;
  /// The shader that gives the parameter at `offset`; null when it is constant.
  const ShaderNode* source(std::size_t offset) const;
  /// The material that stands for the parameter at `offset`; null when there is none.
  const ShaderNode* material_input(std::size_t offset) const;
  const std::vector<MaterialInput>& material_inputs() const { return material_inputs_; }
  /// Connections that only the shader itself evaluates (BindingTraits::deferred,
  /// ParamSpec::asked_for).
  const std::vector<Connection>& connections() const { return deferred_; }
  /// Writes what is connected to the parameter at `offset`, converted to its type. False: nothing
  /// is.
  bool ask(std::size_t offset, ShadingPoint& point, void* target) const;
  /// Whether light may pass one of these materials straight.
  bool inputs_may_transmit() const;

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

  /// Whether it is asked for a value by tracing rays: it is a material, or lies over one.
  bool is_shaded() const {
    return spec_->material.fill && (!spec_->value || !material_inputs_.empty());
  }
  /// Writes the raw result (spec().result_size bytes): what its shader says; of a material its
  /// finished colour at the point and, where it has them, its outputs. Black where nothing can be
  /// traced: in shadow rays, photons, displacement.
  void value(ShadingPoint& point, void* result) const;

 private:
  friend class Binder;
  void evaluate_connections(ShadingPoint& point, std::byte* scratch) const;
  /// Takes those connections aside that the shader asks for itself.
  void defer_connections();

  const ShaderSpec* spec_;
  std::vector<std::max_align_t> storage_;
  std::span<std::byte> constants_;
  std::vector<Connection> connections_, deferred_;
  std::vector<MaterialInput> material_inputs_;
  std::unique_ptr<ShaderState> state_;
  /// Shaders that run for one evaluation, itself included. A shader that several others use runs
  /// once for each.
  float cost_ = 1;
  int max_lobes_ = 1;  ///< of its closure, with those of the materials it is connected to
};

/// Shaders of a list run in order, each on what the one before left at the point.
using NodeList = std::vector<const ShaderNode*>;

/// Converts between the types of values a connection may join: a scalar fills a colour or vector, a
/// colour gives a scalar by the mean of its channels, numbers are true when not 0.
void convert_value(ParamType from, const void* source, ParamType to, void* target);
std::size_t size_of(ParamType type);

}  // namespace oriel
