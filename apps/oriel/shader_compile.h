// SPDX-License-Identifier: Apache-2.0
// Compiles shader sources to object files, several at the same time.
#pragma once

#include <string>
#include <vector>

#include "build_hints.h"
#include "compiler.h"

namespace oriel::app {

/// A source and what it is compiled to.
struct CompiledSource {
  std::string source, object;
  bool c = false;
  std::vector<std::string> flags;  ///< the last words for the compiler
};

/// Compilers of both languages with what they do to make old sources safe.
class ShaderCompilers {
 public:
  /// `work`: a folder for probes.
  ShaderCompilers(const std::string& cc, const std::string& cxx,
                  const std::vector<std::string>& standards, std::string work);

  /// Compiles all; messages go to stderr in the order of the sources. Returns how many failed.
  std::size_t compile(const std::vector<CompiledSource>& sources,
                      const std::vector<std::string>& flags, int jobs, BuildHints& hints);

  Compiler& of(bool c) { return c ? cc_ : cxx_; }

 private:
  void choose_standard(const std::string& standard);
  std::vector<std::string> safe_returns();
  std::vector<std::string> dialect(bool c) const;

  std::string work_;
  Compiler cc_, cxx_;
  std::string c_standard_ = "gnu99", cxx_standard_ = "gnu++14";
};

}  // namespace oriel::app
