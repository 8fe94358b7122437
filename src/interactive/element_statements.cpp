// SPDX-License-Identifier: Apache-2.0
#include "interactive/element_statements.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/element_settings.h"
#include "scene/option_table.h"

namespace oriel::interactive {
namespace {

using scene::Value;

bool is_numbers(const Value& value, std::size_t count) {
  return value.kind == Value::Kind::Numbers && value.numbers.size() == count &&
         std::all_of(value.numbers.begin(), value.numbers.end(),
                     [](double n) { return std::isfinite(n); });
}

Value numbers_of(std::initializer_list<double> numbers) {
  Value value;
  value.kind = Value::Kind::Numbers;
  value.numbers = numbers;
  return value;
}

/// A field of an element that is no entry of its statement list.
struct FieldEdit {
  const char* name;
  /// Null: the value has the wrong form. Otherwise sets the field.
  std::function<std::function<void()>(const Value&)> prepare;
  std::function<std::optional<Value>()> read;
};

FieldEdit float_field(const char* name, std::optional<float>& field) {
  return {name,
          [&field](const Value& v) -> std::function<void()> {
            if (!is_numbers(v, 1)) return {};
            return [&field, number = static_cast<float>(v.numbers[0])] { field = number; };
          },
          [&field] {
            return field ? std::optional(numbers_of({static_cast<double>(*field)})) : std::nullopt;
          }};
}

FieldEdit vector_field(const char* name, std::optional<Vec3>& field) {
  return {name,
          [&field](const Value& v) -> std::function<void()> {
            if (!is_numbers(v, 3)) return {};
            const Vec3 vector(static_cast<float>(v.numbers[0]), static_cast<float>(v.numbers[1]),
                              static_cast<float>(v.numbers[2]));
            return [&field, vector] { field = vector; };
          },
          [&field]() -> std::optional<Value> {
            if (!field) return std::nullopt;
            return numbers_of({field->x, field->y, field->z});
          }};
}

FieldEdit matrix_field(const char* name, std::optional<Mat4>& field) {
  return {name,
          [&field](const Value& v) -> std::function<void()> {
            if (!is_numbers(v, 16)) return {};
            Mat4 matrix;
            for (int i = 0; i < 16; ++i)
              matrix[i / 4][i % 4] = static_cast<float>(v.numbers[static_cast<std::size_t>(i)]);
            return [&field, matrix] { field = matrix; };
          },
          [&field]() -> std::optional<Value> {
            if (!field) return std::nullopt;
            Value value;
            value.kind = Value::Kind::Numbers;
            for (int i = 0; i < 16; ++i)
              value.numbers.push_back(static_cast<double>((*field)[i / 4][i % 4]));
            return value;
          }};
}

FieldEdit resolution_field(scene::Camera& camera) {
  return {"resolution",
          [&camera](const Value& v) -> std::function<void()> {
            if (!is_numbers(v, 2) || !v.integral) return {};
            const auto pixels = [](double n) {
              return static_cast<int>(std::clamp(n, 1.0, 65536.0));
            };
            const std::array size{pixels(v.numbers[0]), pixels(v.numbers[1])};
            return [&camera, size] { camera.resolution = size; };
          },
          [&camera]() -> std::optional<Value> {
            if (!camera.resolution) return std::nullopt;
            return numbers_of({static_cast<double>((*camera.resolution)[0]),
                               static_cast<double>((*camera.resolution)[1])});
          }};
}

FieldEdit file_field(scene::Texture& texture) {
  return {"file",
          [&texture](const Value& v) -> std::function<void()> {
            if (v.kind != Value::Kind::Text || v.text.empty()) return {};
            return [&texture, file = v.text] { texture.file = file; };
          },
          [&texture]() -> std::optional<Value> {
            if (texture.file.empty()) return std::nullopt;
            Value value;
            value.kind = Value::Kind::Text;
            value.text = texture.file;
            return value;
          }};
}

/// What can be edited in an element.
struct EditableStatements {
  const scene::StatementTable* table = nullptr;
  std::vector<std::string_view> keywords;  ///< of the table
  std::vector<scene::Statement>* statements = nullptr;
  std::vector<FieldEdit> fields;
  bool string_options = false;
};

template <class T>
std::vector<std::string_view> keywords_of(const scene::ElementTable<T>& table) {
  std::vector<std::string_view> keywords;
  for (const auto& row : table.rows())
    if (!row.form.starts_with('<')) keywords.push_back(row.keyword);
  return keywords;
}

EditableStatements editable(scene::Element& element) {
  EditableStatements e;
  if (auto* options = std::get_if<scene::Options>(&element)) {
    e.table = &scene::option_table();
    for (const auto& row : scene::option_table().rows()) e.keywords.push_back(row.keyword);
    e.statements = &options->statements;
    e.string_options = true;
  } else if (auto* camera = std::get_if<scene::Camera>(&element)) {
    e.table = &scene::camera_table();
    e.keywords = keywords_of(scene::camera_table());
    e.statements = &camera->other;
    e.fields.push_back(float_field("focal", camera->focal));
    e.fields.push_back(float_field("aperture", camera->aperture));
    e.fields.push_back(float_field("aspect", camera->aspect));
    e.fields.push_back(resolution_field(*camera));
  } else if (auto* light = std::get_if<scene::Light>(&element)) {
    e.table = &scene::light_table();
    e.keywords = keywords_of(scene::light_table());
    e.statements = &light->other;
    e.fields.push_back(vector_field("origin", light->origin));
    e.fields.push_back(vector_field("direction", light->direction));
    e.fields.push_back(float_field("spread", light->spread));
  } else if (auto* instance = std::get_if<scene::Instance>(&element)) {
    e.table = &scene::instance_table();
    e.keywords = keywords_of(scene::instance_table());
    e.statements = &instance->flags;
    e.fields.push_back(matrix_field("transform", instance->transform));
  } else if (auto* texture = std::get_if<scene::Texture>(&element)) {
    e.fields.push_back(file_field(*texture));
  }
  return e;
}

const scene::StatementRow* find_row(const EditableStatements& e, const std::string& name) {
  if (!e.table) return nullptr;
  if (e.string_options)
    if (const auto* row = e.table->find("\"" + name + "\"")) return row;
  const auto* row = e.table->find(name);
  return row && row->form.starts_with('<') && !e.string_options ? nullptr : row;
}

}  // namespace

StatementEdit set_statement(scene::Element& element, const std::string& name, const Value& value,
                            const std::function<void(const scene::Element&)>& before,
                            std::vector<std::string>& known) {
  const EditableStatements e = editable(element);
  if (!e.statements && e.fields.empty()) return StatementEdit::NoStatements;
  for (const FieldEdit& field : e.fields) {
    if (field.name != name) continue;
    const std::function<void()> set = field.prepare(value);
    if (!set) return StatementEdit::BadValue;
    if (before) before(element);
    set();
    return StatementEdit::Done;
  }
  const scene::StatementRow* row = find_row(e, name);
  if (!row) {
    for (const FieldEdit& field : e.fields) known.emplace_back(field.name);
    for (const std::string_view keyword : e.keywords) {
      const bool quoted = keyword.starts_with('"');
      known.emplace_back(quoted ? keyword.substr(1, keyword.size() - 2) : keyword);
    }
    return StatementEdit::Unknown;
  }
  scene::Statement statement;
  statement.keyword = name;
  statement.quoted = scene::is_string_option(*row);
  statement.values.push_back(value);
  Value& written = statement.values.back();
  written.bare = written.kind == Value::Kind::Text && !statement.quoted;
  if (before) before(element);
  // The last statement of a keyword counts in options; other elements have one of each.
  if (!e.string_options)
    std::erase_if(*e.statements, [&](const scene::Statement& s) { return s.keyword == name; });
  e.statements->push_back(std::move(statement));
  return StatementEdit::Done;
}

std::vector<StatementValue> statements_of(const scene::Element& element) {
  scene::Element copy = element;
  const EditableStatements e = editable(copy);
  std::vector<StatementValue> result;
  for (const FieldEdit& field : e.fields) {
    StatementValue s{field.name, {}, {}, false, {}};
    if (const std::optional<Value> value = field.read()) s.values.push_back(*value);
    result.push_back(std::move(s));
  }
  for (const std::string_view keyword : e.keywords) {
    const scene::StatementRow* row = e.table->find(keyword);
    if (!row) continue;
    std::string name = scene::name_of(*row);
    std::erase(name, '"');
    StatementValue s{name, row->form, row->meaning, scene::is_string_option(*row), {}};
    for (const scene::Statement& statement : *e.statements)
      if (statement.keyword == name) s.values = statement.values;
    result.push_back(std::move(s));
  }
  return result;
}

}  // namespace oriel::interactive
