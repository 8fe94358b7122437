// SPDX-License-Identifier: Apache-2.0
// Test support: random names, numbers and values of every kind.
#pragma once

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace oriel::mi {

/// Generators for the parts of random elements.
class RandomValues {
 protected:
  explicit RandomValues(std::uint32_t seed) : random_(seed) {}

  int pick(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
  bool chance() { return pick(2) == 0; }
  template <std::size_t N>
  const char* one_of(const char* const (&words)[N]) {
    return words[pick(static_cast<int>(N))];
  }

  /// A random finite float.
  float real() {
    for (;;) {
      const float x = std::bit_cast<float>(static_cast<std::uint32_t>(random_()));
      if (chance()) return static_cast<float>(pick(200) - 100) / 8;
      if (std::isfinite(x)) return x;
    }
  }
  double wide() {
    for (;;) {
      const std::uint64_t high = random_();
      const double x = std::bit_cast<double>(high << 32 | random_());
      if (std::isfinite(x)) return x;
    }
  }

  std::string name() {
    static constexpr const char* kOdd[] = {"a b",        "A|B(C 01)", ":Root", "n:shader",
                                           "say \"hi\"", "C:\\x",     "end",   "\xc3\xa4",
                                           "x#y",        "$z"};
    return fmt::format("{}{}", one_of(kOdd), ++names_);
  }

  scene::Value numbers(int count) {
    scene::Value v;
    v.kind = scene::Value::Kind::Numbers;
    v.integral = chance();
    for (int i = 0; i < count; ++i)
      v.numbers.push_back(v.integral ? static_cast<double>(random_()) - 2147483648.0
                          : chance() ? wide()
                                     : pick(9));
    return v;
  }
  scene::Value words(std::string text, bool bare) {
    scene::Value v;
    v.kind = scene::Value::Kind::Text;
    v.text = std::move(text);
    v.bare = bare;
    return v;
  }

  scene::Value value(int depth) {
    scene::Value v;
    const int kinds = depth > 3 ? 6 : 8;
    switch (pick(kinds)) {
      case 0:
        return v;
      case 1:
        v.kind = scene::Value::Kind::Boolean;
        v.boolean = chance();
        return v;
      case 2:
        return numbers(1 + pick(4));
      case 3:
        return words(chance() ? name() : "", false);
      case 4:
        v.kind = scene::Value::Kind::Connection;
        v.text = name() + ".out";
        return v;
      case 5:
        v.kind = scene::Value::Kind::Interface;
        v.text = name();
        return v;
      case 6:
        v.kind = scene::Value::Kind::Struct;
        v.members = arguments(depth + 1);
        return v;
      default:
        v.kind = scene::Value::Kind::Array;
        for (int i = pick(4); i > 0; --i) v.items.push_back(value(depth + 1));
        return v;
    }
  }
  std::vector<scene::Argument> arguments(int depth) {
    std::vector<scene::Argument> list;
    for (int i = pick(4); i > 0; --i) list.push_back({name(), value(depth), {}});
    return list;
  }
  scene::ShaderList shaders(int least) {
    scene::ShaderList list;
    for (int i = least + pick(2); i > 0; --i) {
      scene::ShaderUse use;
      if (chance()) {
        use.reference = name();
      } else {
        use.type = name();
        use.arguments = arguments(0);
      }
      list.push_back(std::move(use));
    }
    return list;
  }

  scene::Statement statement(std::string keyword, std::vector<scene::Value> values,
                             bool quoted = false) {
    return {std::move(keyword), quoted, std::move(values), {}};
  }
  scene::Value boolean() {
    scene::Value v;
    v.kind = scene::Value::Kind::Boolean;
    v.boolean = chance();
    return v;
  }

  std::mt19937 random_;

 private:
  int names_ = 0;
};

}  // namespace oriel::mi
