// SPDX-License-Identifier: Apache-2.0
// Messages of shaders, and termination.
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "oriel/sdk/shader/system.h"
#include "sdk/call.h"
#include "sdk/current.h"
#include "sdk/host.h"

namespace {

using oriel::Severity;
using oriel::sdk::current_host;
using oriel::sdk::Host;

std::string formatted(const char* format, std::va_list arguments) {
  std::va_list again;
  va_copy(again, arguments);
  const int length = std::vsnprintf(nullptr, 0, format, again);
  va_end(again);
  if (length < 0) return format;
  std::string text(static_cast<std::size_t>(length) + 1, '\0');
  std::vsnprintf(text.data(), text.size(), format, arguments);
  text.pop_back();
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text;
}

void say(Severity severity, const char* format, std::va_list arguments, int number = 0) {
  std::string text = formatted(format, arguments);
  if (number != 0) text += " (" + std::to_string(number) + ")";
  if (Host* host = current_host())
    host->say(severity, std::move(text));
  else
    std::fprintf(stderr, "%s\n", text.c_str());
}

/// Does not return; shaders rely on that.
void end() {
  mi_abort();
  oriel::sdk::leave_stopped_shader();
}

/// The variable name at `at`, in braces or up to the first other character; moves `at` behind it.
std::string variable_at(const char*& at) {
  const bool braces = *at == '{';
  if (braces) ++at;
  std::string name;
  const auto belongs = [&](char c) {
    return braces ? c != '}' && c != '\0'
                  : (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                        c == '_';
  };
  while (belongs(*at)) name += *at++;
  if (braces && *at == '}') ++at;
  return name;
}

}  // namespace

#define ORIEL_MESSAGE(name, severity)           \
  void name(const char* format, ...) {          \
    std::va_list arguments;                     \
    va_start(arguments, format);                \
    say(Severity::severity, format, arguments); \
    va_end(arguments);                          \
  }

ORIEL_MESSAGE(mi_error, Error)
ORIEL_MESSAGE(mi_warning, Warning)
ORIEL_MESSAGE(mi_info, Note)
ORIEL_MESSAGE(mi_progress, Note)
ORIEL_MESSAGE(mi_debug, Note)
ORIEL_MESSAGE(mi_vdebug, Note)

#undef ORIEL_MESSAGE

void mi_nerror(int number, const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  say(Severity::Error, format, arguments, number);
  va_end(arguments);
}

void mi_nwarning(int number, const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  say(Severity::Warning, format, arguments, number);
  va_end(arguments);
}

void mi_fatal(const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  say(Severity::Error, format, arguments);
  va_end(arguments);
  end();
}

void mi_nfatal(int number, const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  say(Severity::Error, format, arguments, number);
  va_end(arguments);
  end();
}

int mi_par_aborted(void) {
  const Host* host = current_host();
  return host && host->stopped ? 1 : 0;
}

void mi_abort(void) {
  if (Host* host = current_host()) host->stopped = true;
}

// Converts file names of other systems: $NAME and ${NAME} are environment variables, backslashes
// are slashes.
char* mi_string_substitute(char* dst, const char* src, int max) {
  if (max <= 0) return dst;
  std::string text;
  for (const char* at = src ? src : ""; *at != '\0';) {
    const char c = *at++;
    if (c == '$') {
      const char* value = std::getenv(variable_at(at).c_str());
      if (value) text += value;
    } else {
      text += c == '\\' ? '/' : c;
    }
  }
  std::snprintf(dst, static_cast<std::size_t>(max), "%s", text.c_str());
  return dst;
}
