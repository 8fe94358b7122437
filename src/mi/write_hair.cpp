// SPDX-License-Identifier: Apache-2.0
// Writes hair in the syntax of hair.cpp.
#include "mi/write_parts.h"

namespace oriel::mi {
namespace {

using scene::Hair;

void write_fields(TextSink& out, std::string_view keyword, const std::vector<Hair::Field>& fields,
                  int depth) {
  if (fields.empty()) return;
  constexpr std::string_view kNames[] = {" n", " m", " t", " radius", " u"};
  write_indent(out, depth);
  out.put(keyword);
  for (const Hair::Field& field : fields) {
    out.put(kNames[static_cast<std::size_t>(field.kind)]);
    if (field.kind == Hair::Field::Kind::Normal || field.kind == Hair::Field::Kind::Radius)
      continue;
    out.put(' ');
    out.integer(field.count);
  }
  out.put('\n');
}

void write_option(TextSink& out, std::string_view keyword, const std::optional<int>& value,
                  int depth) {
  if (!value) return;
  write_indent(out, depth);
  out.put(keyword);
  out.put(' ');
  out.integer(*value);
  out.put('\n');
}

/// Writes `keyword [ N ]` and the entries; `put` writes one entry.
template <typename Put>
void write_list(TextSink& out, std::string_view keyword, std::size_t size, int depth, Put&& put) {
  write_indent(out, depth);
  out.put(keyword);
  out.put(" [ ");
  out.integer(static_cast<double>(size));
  out.put(" ]\n");
  constexpr std::size_t kInOneLine = 12;
  for (std::size_t i = 0; i < size; ++i) {
    put(i);
    out.put(i % kInOneLine == kInOneLine - 1 || i + 1 == size ? '\n' : ' ');
  }
}

}  // namespace

void write_hair(TextSink& out, const Hair& hair, int depth) {
  write_indent(out, depth);
  out.put("hair\n");
  const int inner = depth + 1;
  if (!hair.material.empty()) {
    write_indent(out, inner);
    out.put("material ");
    out.quoted(hair.material);
    out.put('\n');
  }
  if (hair.radius) {
    write_indent(out, inner);
    out.put("radius ");
    out.number(*hair.radius);
    out.put('\n');
  }
  write_option(out, "approximate", hair.approximate, inner);
  write_option(out, "degree", hair.degree, inner);
  write_option(out, "max size", hair.max_size, inner);
  write_option(out, "max depth", hair.max_depth, inner);
  write_fields(out, "hair", hair.per_hair, inner);
  write_fields(out, "vertex", hair.per_vertex, inner);
  write_list(out, "scalar", hair.scalars.size(), inner,
             [&](std::size_t i) { out.number(hair.scalars[i]); });
  write_list(out, "hair", hair.first.size(), inner,
             [&](std::size_t i) { out.index(hair.first[i]); });
  write_indent(out, depth);
  out.put("end hair\n");
}

}  // namespace oriel::mi
