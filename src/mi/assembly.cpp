// SPDX-License-Identifier: Apache-2.0
// assembly "name" [box min max] [motion box min max] file "file" end assembly
#include "mi/elements.h"
#include "mi/statements.h"
#include "scene/element_settings.h"

namespace oriel::mi {

void read_assembly(Parse& parse, SourceLocation at) {
  static const FormTable forms(scene::assembly_table());
  parse.element<scene::Assembly>("assembly", at, [&](scene::Assembly& assembly) {
    StatementList statements(assembly.statements, parse.incremental);
    assembly.content.clear();
    while (!parse.in.at_word("end")) {
      const SourceLocation here = parse.in.where();
      if (parse.in.accept_word("data"))
        statements.add(read_data_reference(parse, here));
      else if (auto statement = read_statement(parse, forms, "an assembly"))
        statements.add(std::move(*statement));
    }
    parse.expect_end("assembly");
  });
}

}  // namespace oriel::mi
