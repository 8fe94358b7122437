// SPDX-License-Identifier: Apache-2.0
#include "numbers.h"

#include <fmt/format.h>

#include <algorithm>

#include "command.h"

namespace oriel::app {

std::vector<int> parse_integers(const std::string& text, char separator) {
  std::vector<int> numbers;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(separator, at), text.size());
    const std::string part = text.substr(at, end - at);
    if (part.empty() || part.size() > 6 || part.find_first_not_of("0123456789") != part.npos)
      return {};
    numbers.push_back(std::stoi(part));
    at = end + 1;
  }
  return numbers;
}

PictureSize parse_size(const std::string& text) {
  const std::vector<int> size = parse_integers(text, 'x');
  if (size.size() != 2 || size[0] < 1 || size[1] < 1 || size[0] > 65536 || size[1] > 65536)
    throw UsageError(fmt::format("--size {}: expected WIDTHxHEIGHT in pixels", text));
  return {size[0], size[1]};
}

}  // namespace oriel::app
