// SPDX-License-Identifier: Apache-2.0
#include "base/scene_budgets.h"

#include <gtest/gtest.h>

namespace oriel {
namespace scene_budgets_test {

TEST(SceneBudgets, TheTableHasOneRowForEachBudget) {
  ASSERT_EQ(budget_table().size(), kBudgets);
  const SceneBudgets budgets;
  for (std::size_t i = 0; i < kBudgets; ++i) {
    const BudgetRow& row = budget_table()[i];
    EXPECT_EQ(static_cast<std::size_t>(row.budget), i);
    EXPECT_EQ(static_cast<double>(budgets[row.budget]), row.standard);
  }
}

TEST(SceneBudgets, ValuesHaveSuffixesAndExponents) {
  SceneBudgets budgets;
  for (const auto& [text, value] : {std::pair("instances=20M", 20'000'000ull),
                                    {"instances=3e6", 3'000'000ull},
                                    {"instances=5k", 5'000ull},
                                    {"instances=1.5G", 1'500'000'000ull},
                                    {"instances=7", 7ull}}) {
    EXPECT_EQ(budgets.set(text), "");
    EXPECT_EQ(budgets[Budget::Instances], value) << text;
  }
  for (const char* text : {"instances", "instances=", "instances=x", "instances=-1", "instances=0",
                           "instances=1T", "instances=nan", "instances=1e30", "none=1", "=1", ""})
    EXPECT_NE(budgets.set(text), "") << text;
  EXPECT_EQ(budgets[Budget::Instances], 7u) << "errors change nothing";
}

TEST(SceneBudgets, MessagesNameTheOption) {
  SceneBudgets budgets;
  budgets.set(Budget::Photons, 10);
  EXPECT_EQ(budgets.excess(Budget::Photons, 12), "12 stored photons exceed the budget of 10");
  EXPECT_NE(SceneBudgets::hint(Budget::Photons, 12).find("--budget photons=12"), std::string::npos);
}

}  // namespace scene_budgets_test
}  // namespace oriel
