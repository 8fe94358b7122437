// SPDX-License-Identifier: Apache-2.0
// A scene of several files (see Files) that include each other, themselves and files that do not
// exist.
#include "file.h"
#include "fuzzers.h"
#include "mi/reader.h"

int oriel::fuzz::fuzz_include(const std::uint8_t* data, std::size_t size) {
  const Files files(data, size);
  if (files.names().empty()) return 0;
  mi::ReadOptions options;
  options.files.set_untrusted(true);
  options.budgets.set("includes=1000");
  options.limits.include_depth = 8;
  Diagnostics diagnostics;
  mi::read_scene(files.path(files.names().front()), options, diagnostics);
  for (const Diagnostic& d : diagnostics.all()) diagnostics.format(d);
  return 0;
}
