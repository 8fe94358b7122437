// SPDX-License-Identifier: Apache-2.0
// Numbers as arguments of several commands write them.
#pragma once

#include <string>
#include <vector>

namespace oriel::app {

/// Unsigned integers of at most six digits, one separator between two; empty: it is none of these.
std::vector<int> parse_integers(const std::string& text, char separator);

struct PictureSize {
  int width = 0, height = 0;  ///< pixels
};
/// Value of --size, "WIDTHxHEIGHT". Errors: UsageError.
PictureSize parse_size(const std::string& text);

}  // namespace oriel::app
