// SPDX-License-Identifier: Apache-2.0
#include "embed/guard.h"

#include <new>

#include "interactive/scene_edit.h"

namespace oriel::embed {
namespace {

thread_local std::string last_error;

}  // namespace

OrielResult failed(OrielResult code, const char* text) noexcept {
  try {
    last_error = text;
  } catch (...) {
    last_error.clear();
  }
  return code;
}

OrielResult failed_by_exception() noexcept {
  try {
    throw;
  } catch (const EmbedError& error) {
    return failed(error.code, error.what());
  } catch (const interactive::EditError& error) {
    return failed(ORIEL_BAD_EDIT, error.what());
  } catch (const std::bad_alloc&) {
    return failed(ORIEL_FAILED, "out of memory");
  } catch (const std::exception& error) {
    return failed(ORIEL_FAILED, error.what());
  } catch (...) {
    return failed(ORIEL_FAILED, "unknown error");
  }
}

}  // namespace oriel::embed

extern "C" const char* oriel_last_error(void) { return oriel::embed::last_error.c_str(); }
