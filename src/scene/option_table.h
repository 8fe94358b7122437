// SPDX-License-Identifier: Apache-2.0
// The language of options as one table: keyword, form of its values, meaning, what it acts on.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "scene/render_options.h"

namespace oriel::scene {

enum class OptionSupport : std::uint8_t {
  Effective,      ///< changes the picture as documented
  NotYet,         ///< typed here, nothing acts on it
  Uninterpreted,  ///< kept as written, not interpreted
  Harmless        ///< the picture does not depend on it
};

/// One value of a statement. A row of numbers counts as one item per number.
struct OptionItem {
  const Value* value = nullptr;  ///< null for a word that was part of the keyword
  double number = 0;             ///< double: as the scene holds it
  std::string_view text = {};
  int choice = 0;  ///< which alternative of the form it matched
};

/// The values of a statement that fits its form.
class OptionValues {
 public:
  explicit OptionValues(std::span<const OptionItem> items) : items_(items) {}
  std::size_t size() const { return items_.size(); }
  bool on(std::size_t i) const { return items_[i].value->boolean; }
  int integer(std::size_t i) const { return static_cast<int>(items_[i].number); }
  float number(std::size_t i) const { return static_cast<float>(items_[i].number); }
  std::string text(std::size_t i) const { return std::string(items_[i].text); }
  int choice(std::size_t i) const { return items_[i].choice; }
  const Value& value(std::size_t i) const { return *items_[i].value; }
  /// One number for all components, or three or four; alpha is 1 unless written.
  Rgba color() const;
  /// One, two or three numbers: both r and sum 2r; sum r + t; as written.
  TraceDepth depth() const;

 private:
  std::span<const OptionItem> items_;
};

/// A row of the table.
struct OptionRow {
  std::string_view keyword;  ///< words joined by single blanks; in quotes for a string option
  /// What may follow: `bool`, `int`, `float`, `string`, `list` or a literal word, alternatives
  /// separated by `|`, `_` for a blank within one, optional rests in brackets; `...` = anything.
  std::string_view form;
  OptionSupport support = OptionSupport::Uninterpreted;
  std::string_view meaning;
  void (*set)(RenderOptions&, const OptionValues&) = nullptr;
};

/// All rows, string options last.
std::span<const OptionRow> option_table();

/// Whether `items` fit the form; fills in OptionItem::choice.
bool fits_form(std::string_view form, std::span<OptionItem> items);

}  // namespace oriel::scene
