// SPDX-License-Identifier: Apache-2.0
// Errors of requests.
#pragma once

#include <stdexcept>
#include <string>

namespace oriel::studio {

/// An error of a request, with its code in docs/dev/studio-protocol.md.
struct RequestError : std::runtime_error {
  RequestError(std::string error_code, const std::string& message)
      : std::runtime_error(message), code(std::move(error_code)) {}
  std::string code;
};

}  // namespace oriel::studio
