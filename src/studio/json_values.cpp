// SPDX-License-Identifier: Apache-2.0
#include "studio/json_values.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "studio/request_error.h"

namespace oriel::studio {
namespace {

using json = nlohmann::json;

const json* present(const json& request, const char* name) {
  const auto found = request.find(name);
  return found == request.end() || found->is_null() ? nullptr : &*found;
}

const json& required(const json& request, const char* name) {
  if (const json* value = present(request, name)) return *value;
  throw RequestError("bad-request", std::string("the field \"") + name + "\" is missing");
}

[[noreturn]] void wrong_type(const char* name, const char* expected) {
  throw RequestError("bad-request", std::string("the field \"") + name + "\" is not " + expected);
}

double finite_number(const json& value, const char* name) {
  if (!value.is_number()) wrong_type(name, "a number");
  const double number = value.get<double>();
  if (!std::isfinite(number)) wrong_type(name, "a finite number");
  return number;
}

}  // namespace

std::string text_field(const json& request, const char* name) {
  const json& value = required(request, name);
  if (!value.is_string()) wrong_type(name, "a text");
  return value.get<std::string>();
}

double number_field(const json& request, const char* name) {
  return finite_number(required(request, name), name);
}

int int_field(const json& request, const char* name) {
  const double number = number_field(request, name);
  if (std::fabs(number) > 1e9) wrong_type(name, "a number in range");
  return static_cast<int>(std::floor(number));
}

Vec3 vector_field(const json& request, const char* name) {
  const json& value = required(request, name);
  if (!value.is_array() || value.size() != 3) wrong_type(name, "a list of three numbers");
  return {static_cast<float>(finite_number(value[0], name)),
          static_cast<float>(finite_number(value[1], name)),
          static_cast<float>(finite_number(value[2], name))};
}

std::vector<std::string> texts_field(const json& request, const char* name) {
  const json& value = required(request, name);
  if (!value.is_array()) wrong_type(name, "a list of texts");
  std::vector<std::string> texts;
  for (const json& item : value) {
    if (!item.is_string()) wrong_type(name, "a list of texts");
    texts.push_back(item.get<std::string>());
  }
  return texts;
}

std::optional<double> optional_number(const json& request, const char* name) {
  const json* value = present(request, name);
  return value ? std::optional(finite_number(*value, name)) : std::nullopt;
}

std::string optional_text(const json& request, const char* name) {
  return present(request, name) ? text_field(request, name) : std::string();
}

json json_of(const Vec3& v) { return {v.x, v.y, v.z}; }

json json_of(const Reading& r) {
  return {{"value", r.value},
          {"half_width", r.half_width},
          {"samples", r.samples},
          {"precise", r.precise}};
}

json json_of(const scene::Value& v) {
  using Kind = scene::Value::Kind;
  switch (v.kind) {
    case Kind::Boolean:
      return v.boolean;
    case Kind::Numbers:
      return v.numbers.size() == 1 ? json(v.numbers[0]) : json(v.numbers);
    case Kind::Text:
      return v.text;
    case Kind::Connection:
      return "=" + v.text;
    default:
      return nullptr;
  }
}

std::string dumped(const json& message) {
  return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace oriel::studio
