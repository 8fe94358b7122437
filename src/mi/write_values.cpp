// SPDX-License-Identifier: Apache-2.0
// Values, arguments, shader lists, statements.
#include <cmath>

#include "mi/write_parts.h"

namespace oriel::mi {
namespace {

using scene::Argument;
using scene::ShaderUse;
using scene::Value;

constexpr std::string_view kIndent = "    ";

bool is_whole(double n) { return n == std::floor(n) && std::isfinite(n); }

void write_numbers(TextSink& out, const Value& value) {
  // If no number is fractional, the last one is written with a decimal point.
  bool shows = false;
  for (const double n : value.numbers) shows |= !is_whole(n);
  for (std::size_t i = 0; i < value.numbers.size(); ++i) {
    if (i) out.put(' ');
    const double n = value.numbers[i];
    if (value.integral && is_whole(n))
      out.integer(n);
    else if (!shows && i + 1 == value.numbers.size())
      out.scalar(n);
    else
      out.number(n);
  }
}

void write_shader(TextSink& out, const ShaderUse& use, int depth) {
  if (use.type.empty()) {
    out.put(use.interface ? "= interface " : "= ");
    out.quoted(use.reference);
    return;
  }
  out.quoted(use.type);
  out.put(' ');
  write_arguments(out, use.arguments, '(', ')', depth);
}

}  // namespace

void write_indent(TextSink& out, int depth) {
  for (int i = 0; i < depth; ++i) out.put(kIndent);
}

void write_value(TextSink& out, const Value& value, int depth) {
  switch (value.kind) {
    case Value::Kind::Null:
      return out.put("null");
    case Value::Kind::Boolean:
      return out.put(value.boolean ? "on" : "off");
    case Value::Kind::Numbers:
      return write_numbers(out, value);
    case Value::Kind::Text:
      return value.bare && !value.text.empty() ? out.put(value.text) : out.quoted(value.text);
    case Value::Kind::Connection:
      out.put("= ");
      return out.quoted(value.text);
    case Value::Kind::Interface:
      out.put("= interface ");
      return out.quoted(value.text);
    case Value::Kind::Struct:
      return write_arguments(out, value.members, '{', '}', depth);
    case Value::Kind::Array:
      out.put('[');
      for (std::size_t i = 0; i < value.items.size(); ++i) {
        out.put(i ? ", " : " ");
        write_value(out, value.items[i], depth);
      }
      return out.put(" ]");
  }
}

void write_arguments(TextSink& out, const std::vector<Argument>& arguments, char open, char close,
                     int depth) {
  out.put(open);
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    out.put(i ? ",\n" : "\n");
    write_indent(out, depth + 1);
    out.quoted(arguments[i].name);
    out.put(' ');
    write_value(out, arguments[i].value, depth + 1);
  }
  if (!arguments.empty()) {
    out.put('\n');
    write_indent(out, depth);
  }
  out.put(close);
}

void write_shader_list(TextSink& out, const scene::ShaderList& list, int depth) {
  for (const ShaderUse& use : list) {
    out.put(' ');
    write_shader(out, use, depth);
  }
}

void write_statement(TextSink& out, const scene::Statement& statement, int depth) {
  write_indent(out, depth);
  statement.quoted ? out.quoted(statement.keyword) : out.put(statement.keyword);
  for (const Value& value : statement.values) {
    out.put(' ');
    write_value(out, value, depth);
  }
  out.put('\n');
}

void write_statements(TextSink& out, const std::vector<scene::Statement>& statements, int depth) {
  for (const auto& statement : statements) write_statement(out, statement, depth);
}

void write_uninterpreted(TextSink& out,
                         const std::vector<scene::UninterpretedStatement>& uninterpreted,
                         int depth) {
  for (const auto& k : uninterpreted) {
    write_indent(out, depth);
    out.put(k.keyword);
    out.put(' ');
    out.put(k.text);
    out.put('\n');
  }
}

void write_names(TextSink& out, const std::vector<std::string>& names) {
  out.put('[');
  for (std::size_t i = 0; i < names.size(); ++i) {
    out.put(i ? ", " : " ");
    out.quoted(names[i]);
  }
  out.put(" ]");
}

void write_matrix(TextSink& out, const Mat4& matrix, int depth) {
  for (int row = 0; row < 4; ++row) {
    out.put('\n');
    write_indent(out, depth);
    for (int column = 0; column < 4; ++column) {
      if (column) out.put(' ');
      out.number(matrix[row][column]);
    }
  }
}

}  // namespace oriel::mi
