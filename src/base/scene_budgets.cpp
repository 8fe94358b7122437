// SPDX-License-Identifier: Apache-2.0
#include "base/scene_budgets.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace oriel {
namespace {

// Memory: an instance takes about 1 kB, a triangle 0.1 to 0.2 kB, a photon 0.1 kB. Text is
// compressed about 5 times, repeated statements 50 times, a file of equal bytes 1000 times.
constexpr BudgetRow kTable[kBudgets] = {
    {Budget::Text, "text", 16e9, "bytes of scene text"},
    {Budget::Expansion, "expansion", 100, "bytes for each compressed byte"},
    {Budget::Includes, "includes", 100e3, "included files and placeholders"},
    {Budget::Instances, "instances", 2e6, "placed elements"},
    {Budget::Triangles, "triangles", 16e6, "triangles of tessellation and displacement"},
    {Budget::Pixels, "pixels", 16e9, "bytes of pixels in memory"},
    {Budget::Photons, "photons", 5e6, "stored photons"},
    {Budget::MapPoints, "map-points", 8e6, "points or photons of a map file"},
    {Budget::TextureTile, "texture-tile", 256e6, "bytes of one texture tile"},
};

const BudgetRow& row_of(Budget b) { return kTable[static_cast<std::size_t>(b)]; }

}  // namespace

std::span<const BudgetRow> budget_table() { return kTable; }

SceneBudgets::SceneBudgets() {
  for (std::size_t i = 0; i < kBudgets; ++i)
    values_[i] = static_cast<std::uint64_t>(kTable[i].standard);
}

std::string SceneBudgets::set(std::string_view text) {
  const std::size_t equals = text.find('=');
  const std::string_view name = text.substr(0, equals);
  for (const BudgetRow& row : kTable) {
    if (name != row.name || equals == text.npos) continue;
    const std::string_view value = text.substr(equals + 1);
    double number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    const std::string_view suffix(end, static_cast<std::size_t>(value.data() + value.size() - end));
    const double factor = suffix.empty()  ? 1
                          : suffix == "k" ? 1e3
                          : suffix == "M" ? 1e6
                          : suffix == "G" ? 1e9
                                          : 0;
    number *= factor;
    if (error != std::errc() || factor == 0 || !(number >= 1 && number <= 1e18))
      return fmt::format("\"{}\" is not a number from 1 to 1e18, such as 50000 or 200M", value);
    set(row.budget, static_cast<std::uint64_t>(number));
    return {};
  }
  std::string names;
  for (const BudgetRow& row : kTable)
    names += fmt::format("{}{}", names.empty() ? "" : ", ", row.name);
  return fmt::format("\"{}\" is not NAME=VALUE with one of the names {}", text, names);
}

std::string SceneBudgets::excess(Budget b, std::uint64_t wanted) const {
  return fmt::format("{} {} exceed the budget of {}", wanted, row_of(b).counts, (*this)[b]);
}

std::string SceneBudgets::excess(Budget b) const {
  return fmt::format("more than {} {}", (*this)[b], row_of(b).counts);
}

std::string SceneBudgets::hint(Budget b, std::uint64_t wanted) {
  return wanted > 0 ? fmt::format("--budget {}={} permits it", row_of(b).name, wanted)
                    : fmt::format("--budget {}=VALUE raises the budget", row_of(b).name);
}

}  // namespace oriel
