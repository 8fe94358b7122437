// SPDX-License-Identifier: Apache-2.0
#include "sdk/call_work.h"

#include <utility>

namespace oriel::sdk {
namespace {

using scene::Value;

bool is_scalar(const Value& v) { return v.kind == Value::Kind::Numbers && v.numbers.size() == 1; }

/// Appends the numbers of `more`; returns false if one of the values is not numeric.
bool extend(Value& value, const Value& more) {
  if (value.kind != Value::Kind::Numbers || !is_scalar(more)) return false;
  value.integral = value.integral && more.integral;
  value.numbers.push_back(more.numbers[0]);
  return true;
}

/// Groups scalars to elements of `width` numbers.
void group_items(std::vector<Value>& items, std::size_t width) {
  if (width < 2 || items.size() % width != 0) return;
  std::vector<Value> grouped;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!is_scalar(items[i])) return;
    if (i % width == 0)
      grouped.push_back(items[i]);
    else
      extend(grouped.back(), items[i]);
  }
  items = std::move(grouped);
}

}  // namespace

std::string CallWork::parameter() const {
  std::string whole;
  for (const Open& open : open_)
    if (!open.parameter.empty()) whole += open.parameter + ".";
  return whole.empty() || !parameter_.empty() ? whole + parameter_
                                              : whole.substr(0, whole.size() - 1);
}

void CallWork::name(std::string parameter) {
  parameter_ = std::move(parameter);
  continues_ = false;
}

void CallWork::add_item(Open& array, Value value) {
  std::vector<Value>& items = array.value.items;
  const bool begins = std::exchange(array.begins, false) || !array.separated || items.empty();
  if (!parameter_.empty()) {
    // A named value is a member of a struct element.
    if (begins && (array.separated || items.empty())) {
      items.emplace_back();
      items.back().kind = Value::Kind::Struct;
    }
    std::vector<scene::Argument>& members = items.back().members;
    if (!(continues_ && !members.empty() && extend(members.back().value, value)))
      members.push_back({parameter_, std::move(value), {}});
    return;
  }
  if (begins || !extend(items.back(), value)) items.push_back(std::move(value));
}

void CallWork::value(Value value) {
  if (!open_.empty() && open_.back().value.kind == Value::Kind::Array) {
    add_item(open_.back(), std::move(value));
  } else {
    std::vector<scene::Argument>& to = open_.empty() ? use_.arguments : open_.back().value.members;
    if (!(continues_ && !to.empty() && extend(to.back().value, value)))
      to.push_back({parameter_, std::move(value), {}});
  }
  continues_ = true;
}

void CallWork::push(bool is_array) {
  Open open;
  open.parameter = std::exchange(parameter_, {});
  open.value.kind = is_array ? Value::Kind::Array : Value::Kind::Struct;
  open_.push_back(std::move(open));
  continues_ = false;
}

bool CallWork::pop(std::size_t width) {
  if (open_.empty()) return false;
  Open closed = std::move(open_.back());
  open_.pop_back();
  if (!closed.separated) group_items(closed.value.items, width);
  parameter_ = std::move(closed.parameter);
  continues_ = false;
  value(std::move(closed.value));
  continues_ = false;
  return true;
}

bool CallWork::new_element() {
  if (open_.empty() || open_.back().value.kind != Value::Kind::Array) return false;
  Open& array = open_.back();
  std::vector<Value>& items = array.value.items;
  // Scalars before the first separator form one element.
  if (!array.separated && items.size() > 1) group_items(items, items.size());
  array.separated = array.begins = true;
  parameter_.clear();
  continues_ = false;
  return true;
}

scene::ShaderUse CallWork::finish() {
  while (pop(1)) {
  }
  return std::move(use_);
}

}  // namespace oriel::sdk
