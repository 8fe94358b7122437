// SPDX-License-Identifier: Apache-2.0
// Test support: compares two lists of names, including the number of occurrences.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

namespace oriel::testing {

/// Fails with the names that only one of the lists holds. A name that one list holds more often
/// than the other counts as missing from the other.
inline void expect_same_names(std::vector<std::string> tabled, std::vector<std::string> shown) {
  std::sort(tabled.begin(), tabled.end());
  std::sort(shown.begin(), shown.end());
  std::vector<std::string> without_case, without_row;
  std::set_difference(tabled.begin(), tabled.end(), shown.begin(), shown.end(),
                      std::back_inserter(without_case));
  std::set_difference(shown.begin(), shown.end(), tabled.begin(), tabled.end(),
                      std::back_inserter(without_row));
  EXPECT_EQ(without_case, std::vector<std::string>()) << "parameters without a case";
  EXPECT_EQ(without_row, std::vector<std::string>())
      << "cases without a parameter, or second cases";
}

}  // namespace oriel::testing
