// SPDX-License-Identifier: Apache-2.0
// object "name" flags... body end object
#include <algorithm>

#include "mi/elements.h"
#include "mi/freeform.h"
#include "mi/statements.h"
#include "scene/element_settings.h"

namespace oriel::mi {
namespace {

using scene::Object;

constexpr std::string_view kBodyWords[] = {"group", "trilist", "basis",       "hair",
                                           "file",  "data",    "approximate", "intersection"};

const FormTable& object_forms() {
  static const FormTable table(scene::object_table(), kBodyWords);
  return table;
}

void keep_geometry(Parse& parse, Object& object, SourceLocation at) {
  scene::UninterpretedStatement uninterpreted{std::string(parse.in.next().text), "", at};
  uninterpreted.text = keep_until_word(parse, kBodyWords);
  object.uninterpreted.push_back(std::move(uninterpreted));
}

void read_object_statement(Parse& parse, Object& object, StatementList& flags) {
  const SourceLocation at = parse.in.where();
  if (parse.in.accept_word("group")) return read_group(parse, object, at);
  if (parse.in.accept_word("trilist")) return read_trilist(parse, object, at);
  if (parse.in.accept_word("hair")) return read_hair(parse, object, at);
  if (parse.in.accept_word("basis")) return read_basis(parse, object, at);
  if (parse.in.at_word("intersection")) return keep_geometry(parse, object, at);
  if (parse.in.accept_word("data")) return flags.add(read_data_reference(parse, at));
  if (parse.in.accept_word("approximate")) {
    scene::Statement statement = read_approximate(parse, "approximate", at);
    // After a trilist the approximation applies to the trilist.
    if (object.groups.empty()) return flags.add(std::move(statement));
    object.groups.back().settings.push_back(std::move(statement));
    return;
  }
  if (auto statement = read_statement(parse, object_forms(), "an object"))
    flags.add(std::move(*statement));
  parse.tagged = scene::settings_of(object).tagged;
}

}  // namespace

void read_object(Parse& parse, SourceLocation at) {
  parse.tagged = false;
  parse.element<Object>("object", at, [&](Object& object) {
    // An object is always replaced as a whole, also by an incremental change.
    const std::string name = object.name;
    object = Object();
    object.name = name;
    object.where = at;
    StatementList flags(object.flags, false);
    while (!parse.in.at_word("end")) read_object_statement(parse, object, flags);
    parse.expect_end("object");
  });
  parse.tagged = false;
}

}  // namespace oriel::mi
