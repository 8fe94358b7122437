// SPDX-License-Identifier: Apache-2.0
// A shader declaration under construction by a geometry shader.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "oriel/sdk/shader/declare.h"
#include "scene/shader.h"

/// One parameter; all elements of a list share `list`.
struct miParameter {
  oriel::scene::ParamDecl declared;
  std::shared_ptr<std::vector<miParameter*>> list;
  std::vector<miParameter*> children = {};
};

namespace oriel::sdk {

struct DeclarationWork {
  std::deque<miParameter> parameters;  ///< all parameters; defaults apply to the last one
  miFunction_decl data = {};
  /// The current declaration; unset if it already exists.
  std::optional<scene::ShaderDeclaration> declaration;
};

}  // namespace oriel::sdk
