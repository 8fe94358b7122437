// SPDX-License-Identifier: Apache-2.0
// Values in the JSON of messages: reading with checks, writing.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/measure.h"
#include "base/vec.h"
#include "scene/value.h"

namespace oriel::studio {

// The following read a field of a request; they throw RequestError("bad-request") if it is missing
// or has another type.
std::string text_field(const nlohmann::json& request, const char* name);
double number_field(const nlohmann::json& request, const char* name);
int int_field(const nlohmann::json& request, const char* name);
Vec3 vector_field(const nlohmann::json& request, const char* name);
std::vector<std::string> texts_field(const nlohmann::json& request, const char* name);
// The same for optional fields; null counts as missing.
std::optional<double> optional_number(const nlohmann::json& request, const char* name);
std::string optional_text(const nlohmann::json& request, const char* name);

nlohmann::json json_of(const Vec3& v);
nlohmann::json json_of(const Reading& r);
/// Numbers, texts and booleans; connections as `=name`; null for other values.
nlohmann::json json_of(const scene::Value& v);

/// Text without invalid UTF-8.
std::string dumped(const nlohmann::json& message);

}  // namespace oriel::studio
