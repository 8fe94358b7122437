// SPDX-License-Identifier: Apache-2.0
// Exceptions become return codes with a text.
#pragma once

#include <stdexcept>
#include <string>

#include "oriel/oriel.h"

namespace oriel::embed {

/// A problem with its return code.
struct EmbedError : std::runtime_error {
  EmbedError(OrielResult result, const std::string& text)
      : std::runtime_error(text), code(result) {}
  OrielResult code;
};

/// Stores the text of oriel_last_error() and returns the code.
OrielResult failed(OrielResult code, const char* text) noexcept;

/// The code of the exception that is being handled.
OrielResult failed_by_exception() noexcept;

/// Runs a function of the interface.
template <class F>
OrielResult guarded(F&& run) noexcept {
  try {
    run();
    return ORIEL_OK;
  } catch (...) {
    return failed_by_exception();
  }
}

/// The object behind a pointer. Errors: EmbedError for null.
template <class T>
T& required(T* pointer, const char* name) {
  if (!pointer) throw EmbedError(ORIEL_BAD_ARGUMENT, std::string(name) + " is null");
  return *pointer;
}

}  // namespace oriel::embed
