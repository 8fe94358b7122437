// SPDX-License-Identifier: Apache-2.0
// Budgets of a scene: what small files may expand to. Each is a total for the scene.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace oriel {

enum class Budget : std::uint8_t {
  Text,
  Expansion,
  Includes,
  Instances,
  Triangles,
  Pixels,
  Photons,
  MapPoints,
  TextureTile,
};
inline constexpr std::size_t kBudgets = 9;

struct BudgetRow {
  Budget budget;
  const char* name;  ///< in `--budget NAME=VALUE`
  double standard;
  const char* counts;  ///< plural, for messages
};

/// The budgets in the order of the enumeration.
std::span<const BudgetRow> budget_table();

/// The values of all budgets.
///
/// Source:  the defaults are estimates for a machine with 24 GB of memory.
/// Checked: SceneBudgets.*, tests/faults/budget_test.cpp
class SceneBudgets {
 public:
  SceneBudgets();
  std::uint64_t operator[](Budget b) const { return values_[static_cast<std::size_t>(b)]; }
  void set(Budget b, std::uint64_t value) { values_[static_cast<std::size_t>(b)] = value; }

  /// Sets one from "name=value"; the value may be 3e6 or have the suffix k, M or G. Returns a
  /// description of the error, empty if there is none.
  std::string set(std::string_view text);

  /// "5000000 instances exceed the budget of 4000000".
  std::string excess(Budget b, std::uint64_t wanted) const;
  /// Same if the total is unknown: "more than 4000000 instances".
  std::string excess(Budget b) const;
  /// The option that raises the budget to `wanted`, 0 = to a larger value.
  static std::string hint(Budget b, std::uint64_t wanted = 0);

 private:
  std::array<std::uint64_t, kBudgets> values_;
};

}  // namespace oriel
