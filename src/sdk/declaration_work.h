// SPDX-License-Identifier: Apache-2.0
// A shader declaration while a geometry shader makes it.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "oriel/sdk/shader/declare.h"
#include "scene/shader.h"

/// One parameter; `list` is shared by all elements of the list it is part of.
struct miParameter {
  oriel::scene::ParamDecl declared;
  std::shared_ptr<std::vector<miParameter*>> list;
  std::vector<miParameter*> children = {};
};

namespace oriel::sdk {

struct DeclarationWork {
  std::deque<miParameter> parameters;  ///< all that were made; the last takes defaults
  miFunction_decl data = {};
  /// The declaration under way; without a value where it exists already.
  std::optional<scene::ShaderDeclaration> declaration;
};

}  // namespace oriel::sdk
