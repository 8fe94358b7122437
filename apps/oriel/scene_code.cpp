// SPDX-License-Identifier: Apache-2.0
#include "scene_code.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <optional>

#include "base/durable_file.h"
#include "base/file_access.h"
#include "base/file_text.h"
#include "mi/number.h"
#include "scene/asset_path.h"
#include "shader_build.h"
#include "shader_sources.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

/// FNV-1a, 64 bits (Fowler, Noll and Vo): names differ where texts do, nothing more is asked.
class Fingerprint {
 public:
  void add(std::string_view text) {
    for (const char c : text) value_ = (value_ ^ static_cast<unsigned char>(c)) * 1099511628211ull;
    value_ = (value_ ^ 0xff) * 1099511628211ull;  // "a", "b" is not "ab"
  }
  std::string text() const { return fmt::format("{:016x}", value_); }

 private:
  std::uint64_t value_ = 14695981039346656037ull;
};

/// Everything beside a source may be included by it.
void add_headers(const fs::path& folder, Fingerprint& fingerprint) {
  std::vector<fs::path> headers;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, error))
    if (entry.path().extension().string().starts_with(".h")) headers.push_back(entry.path());
  std::sort(headers.begin(), headers.end());
  for (const fs::path& header : headers) {
    fingerprint.add(header.filename().string());
    fingerprint.add(file_text(header));
  }
}

/// The bytes of '2369..'; nothing where it is no such thing.
std::optional<std::string> bytes_of_hex(std::string_view digits) {
  std::string bytes, plain;
  std::copy_if(digits.begin(), digits.end(), std::back_inserter(plain),
               [](char c) { return c > ' '; });
  if (plain.size() % 2 != 0) return std::nullopt;
  for (std::size_t i = 0; i < plain.size(); i += 2) {
    const int high = mi::hex_digit(plain[i]), low = mi::hex_digit(plain[i + 1]);
    if (high < 0 || low < 0) return std::nullopt;
    bytes += static_cast<char>(16 * high + low);
  }
  return bytes;
}

}  // namespace

SceneCode::SceneCode(const SceneArguments& arguments, Diagnostics& diagnostics)
    : arguments_(arguments),
      diagnostics_(diagnostics),
      trusted_(sdk::trusted_folders(arguments.shader_path, arguments.trust.untrusted)) {}

void SceneCode::compile(scene::Scene& scene) {
  if (!arguments_.trust_code) return;
  const std::size_t count = scene.commands.size();
  for (; seen_ < count; ++seen_) {
    const scene::Statement command = scene.commands[seen_];
    if (command.keyword == "code" || command.keyword == "$code") link(command, scene);
  }
  seen_ = scene.commands.size();
}

fs::path SceneCode::find(const std::string& written) const {
  std::error_code error;
  const std::string portable = scene::with_slashes(written);
  for (const fs::path& folder : trusted_)
    if (const fs::path path = folder / fs::path(portable).filename();
        fs::is_regular_file(path, error))
      return path;
  const fs::path scene_folder = fs::path(arguments_.path).parent_path() / ".";
  const fs::path path = fs::weakly_canonical(fs::absolute(scene_folder / portable), error);
  const fs::path root = fs::weakly_canonical(fs::absolute(scene_folder), error);
  return fs::is_regular_file(path, error) && lies_below(path.string(), root.string()) ? path
                                                                                      : fs::path();
}

bool SceneCode::make_cache(SourceLocation where) {
  if (!cache_.empty()) return true;
  const char* const asked = std::getenv("XDG_CACHE_HOME");
  const char* const home = std::getenv("HOME");
  fs::path base;
  if (asked != nullptr && *asked == '/')
    base = asked;
  else if (home != nullptr && *home == '/')
    base = fs::path(home) / ".cache";
  const fs::path folder = base / "oriel" / "code";
  std::error_code error;
  if (!base.empty()) fs::create_directories(folder, error);
  // What others could write there would be run here.
  struct stat about {};
  const bool own = !base.empty() && stat(folder.c_str(), &about) == 0 && S_ISDIR(about.st_mode) &&
                   about.st_uid == geteuid() && (about.st_mode & (S_IWGRP | S_IWOTH)) == 0;
  if (!own) {
    diagnostics_.error(
        "OR-SDK-031", where,
        fmt::format("the cache folder for compiled code is missing or writable by others{}",
                    base.empty() ? "" : ": " + folder.string()),
        "set XDG_CACHE_HOME (or HOME) to a folder that only you can write");
    return false;
  }
  cache_ = folder;
  trusted_.push_back(folder);
  return true;
}

void SceneCode::link(const scene::Statement& command, scene::Scene& scene) {
  const auto fail = [&](std::string message, std::string hint) {
    diagnostics_.error("OR-SDK-030", command.where, std::move(message), std::move(hint));
  };
  std::string text;
  fs::path source;
  Fingerprint fingerprint;
  fingerprint.add(ORIEL_VERSION);
  for (const scene::Value& value : command.values) {
    if (command.keyword == "$code") {
      text = value.text;
    } else if (value.bare) {
      const std::optional<std::string> bytes = bytes_of_hex(value.text);
      if (!bytes) return fail("the bytes of this code are no hexadecimal digits", "");
      text += *bytes;
    } else {
      source = find(value.text);
      if (source.empty())
        return fail(fmt::format("the source \"{}\" was not found", value.text),
                    "it has to lie in a folder of --shader-path or below the scene's own");
      text = file_text(source);
      add_headers(source.parent_path(), fingerprint);
    }
  }
  fingerprint.add(text);
  if (!make_cache(command.where)) return;
  const std::string name = "scene-code-" + fingerprint.text();
  const fs::path library = cache_ / (name + ".so");
  std::error_code error;
  try {
    if (!fs::exists(library, error)) {
      if (source.empty()) {
        source = cache_ / (name + ".c");
        write_durably(source.string(), text);
      }
      build_shaders(
          {.sources = find_shader_sources({source.string()}), .output = library.string()});
    }
  } catch (const std::runtime_error& failed) {
    return fail(fmt::format("code of the scene could not be compiled: {}", failed.what()),
                "its shaders are missing in this picture");
  }
  scene::Value written;
  written.kind = scene::Value::Kind::Text;
  written.text = name;
  scene.commands.push_back({"link", false, {written}, command.where});
}

}  // namespace oriel::app
