// SPDX-License-Identifier: Apache-2.0
// Any text to a scene, to text, to a scene again: the two are equal.
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string_view>

#include "fuzzers.h"
#include "mi/reader.h"
#include "mi/writer.h"

int oriel::fuzz::fuzz_mi(const std::uint8_t* data, std::size_t size) {
  using namespace oriel;
  Diagnostics diagnostics;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const scene::Scene scene = mi::read_text(text, {}, diagnostics);
  // What was mended while it was read need not come back as it was.
  if (!diagnostics.all().empty()) return 0;
  std::ostringstream written;
  mi::write_scene(scene, written);
  const scene::Scene again = mi::read_text(written.str(), {}, diagnostics);
  if (!(scene == again)) std::abort();
  return 0;
}
