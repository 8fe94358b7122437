// SPDX-License-Identifier: Apache-2.0
// Test support: reads a snippet of .mi text and finds its diagnostics.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "base/temporary_folder.h"
#include "mi/codes.h"
#include "mi/reader.h"

namespace oriel::mi {

/// A snippet and the diagnostics of reading it.
struct Snippet {
  Diagnostics diagnostics;
  scene::Scene scene;

  explicit Snippet(std::string_view text, ReadOptions options = known_shaders()) {
    scene = read_text(text, std::move(options), diagnostics);
  }
  /// All diagnostics as the user sees them, for the output of a failing test.
  std::string messages() const {
    std::string all;
    for (const Diagnostic& d : diagnostics.all()) all += diagnostics.format(d) + "\n";
    return all;
  }
  std::size_t count(std::string_view code) const {
    std::size_t n = 0;
    for (const Diagnostic& d : diagnostics.all()) n += d.code == code;
    return n;
  }
  /// The first diagnostic with this code; the test fails if there is none.
  Diagnostic message(std::string_view code) const {
    for (const Diagnostic& d : diagnostics.all())
      if (d.code == code) return d;
    ADD_FAILURE() << "no message " << code << "\n" << messages();
    return {};
  }
  template <class T>
  const T& get(std::string_view name) const {
    static const T none{};
    const T* e = scene.get<T>(name);
    EXPECT_NE(e, nullptr) << name << "\n" << messages();
    return e ? *e : none;
  }

  /// Options of a host with the shader types "s", "t" and all that begin with "mib_".
  static ReadOptions known_shaders() {
    ReadOptions options;
    options.knows_shader = [](std::string_view type) {
      return type == "s" || type == "t" || type.starts_with("mib_");
    };
    return options;
  }
};

/// A test with its own temporary folder.
class FolderTest : public ::testing::Test {
 protected:
  std::string write(const std::string& name, std::string_view text) {
    const auto path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
  }

 private:
  const TemporaryFolder temporary_;

 protected:
  const std::filesystem::path& folder_ = temporary_.path();
};

/// The value of parameter "p" of the shader element in `shader "x" "s" ( "p" <value> )`.
inline scene::Value value_of(std::string_view value) {
  const Snippet read(fmt::format("shader \"x\" \"s\" ( \"p\" {} )", value));
  EXPECT_TRUE(read.diagnostics.all().empty()) << value << "\n" << read.messages();
  const auto& shader = read.get<scene::ShaderElement>("x");
  if (shader.functions.size() != 1 || shader.functions[0].arguments.size() != 1) {
    ADD_FAILURE() << value;
    return {};
  }
  return shader.functions[0].arguments[0].value;
}

}  // namespace oriel::mi
