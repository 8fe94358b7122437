// SPDX-License-Identifier: Apache-2.0
#include "interactive/structured_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace oriel::interactive {
namespace {

using scene::Value;

std::string quoted_string(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

/// Reads from the front of a text. Functions return false for other forms.
class ValueReader {
 public:
  explicit ValueReader(std::string_view text) : rest_(text) {}

  bool at_end() {
    skip_blanks();
    return rest_.empty();
  }

  bool read(Value& value, int depth = 0) {
    if (depth > kMaxValueDepth) return false;
    skip_blanks();
    if (rest_.empty()) return false;
    switch (rest_.front()) {
      case '[':
        return read_array(value, depth);
      case '{':
        return read_struct(value, depth);
      case '=':
        value.kind = Value::Kind::Connection;
        return take('=') && read_string(value.text);
      case '"':
        value.kind = Value::Kind::Text;
        return read_string(value.text);
      default:
        return std::isalpha(static_cast<unsigned char>(rest_.front())) ? read_word(value)
                                                                       : read_numbers(value);
    }
  }

 private:
  void skip_blanks() {
    while (!rest_.empty() && std::isspace(static_cast<unsigned char>(rest_.front())))
      rest_.remove_prefix(1);
  }
  bool take(char c) {
    skip_blanks();
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  bool read_string(std::string& to) {
    if (!take('"')) return false;
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      if (rest_[i] == '"') {
        rest_.remove_prefix(i + 1);
        return true;
      }
      if (rest_[i] == '\\' && i + 1 < rest_.size()) ++i;
      to += rest_[i];
    }
    return false;
  }
  bool read_word(Value& value) {
    std::size_t length = 0;
    while (length < rest_.size() && std::isalpha(static_cast<unsigned char>(rest_[length])))
      ++length;
    const std::string_view word = rest_.substr(0, length);
    rest_.remove_prefix(length);
    value.kind = word == "null" ? Value::Kind::Null : Value::Kind::Boolean;
    value.boolean = word == "on" || word == "true";
    return value.boolean || word == "off" || word == "false" || word == "null";
  }
  bool read_numbers(Value& value) {
    value.kind = Value::Kind::Numbers;
    value.integral = true;
    for (skip_blanks(); !rest_.empty(); skip_blanks()) {
      const std::size_t length = std::min(rest_.find_first_of(" \t\r\n,]}[{\"="), rest_.size());
      const std::string number(rest_.substr(0, length));
      char* end = nullptr;
      const double parsed = std::strtod(number.c_str(), &end);
      if (number.empty() || *end != 0) break;
      value.numbers.push_back(parsed);
      value.integral = value.integral && number.find_first_of(".eE") == std::string::npos;
      rest_.remove_prefix(length);
    }
    return !value.numbers.empty();
  }
  bool read_array(Value& value, int depth) {
    value.kind = Value::Kind::Array;
    take('[');
    if (take(']')) return true;
    do {
      if (!read(value.items.emplace_back(), depth + 1)) return false;
    } while (take(','));
    return take(']');
  }
  bool read_struct(Value& value, int depth) {
    value.kind = Value::Kind::Struct;
    take('{');
    if (take('}')) return true;
    do {
      scene::Argument& member = value.members.emplace_back();
      if (!read_string(member.name) || !read(member.value, depth + 1)) return false;
    } while (take(','));
    return take('}');
  }

  std::string_view rest_;
};

}  // namespace

bool is_structured(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first != std::string_view::npos && (text[first] == '[' || text[first] == '{');
}

std::optional<Value> parse_structured(std::string_view text) {
  Value value;
  ValueReader reader(text);
  if (!is_structured(text) || !reader.read(value) || !reader.at_end()) return std::nullopt;
  return value;
}

std::string structured_text(const Value& value) {
  std::string text;
  const auto separate = [&] {
    if (text.size() > 1) text += ", ";
  };
  switch (value.kind) {
    case Value::Kind::Null:
      return "null";
    case Value::Kind::Boolean:
      return value.boolean ? "on" : "off";
    case Value::Kind::Numbers:
      for (const double number : value.numbers)
        text += fmt::format("{}{}", text.empty() ? "" : " ", number);
      return text;
    case Value::Kind::Text:
      return quoted_string(value.text);
    case Value::Kind::Connection:
    case Value::Kind::Interface:
      return "= " + quoted_string(value.text);
    case Value::Kind::Array:
      text = "[";
      for (const Value& item : value.items) separate(), text += structured_text(item);
      return text + "]";
    case Value::Kind::Struct:
      text = "{";
      for (const scene::Argument& member : value.members)
        separate(), text += quoted_string(member.name) + " " + structured_text(member.value);
      return text + "}";
  }
  return text;
}

}  // namespace oriel::interactive
