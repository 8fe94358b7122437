// SPDX-License-Identifier: Apache-2.0
#include "interactive/edit_history.h"

#include <utility>

namespace oriel::interactive {

void EditHistory::push(Edits edits, const std::string& gesture) {
  const bool continues = !gesture.empty() && gesture == gesture_ && at_ > 0;
  gesture_ = gesture;
  steps_.resize(at_ + 1);
  if (continues) {
    steps_[at_] = std::move(edits);
    return;
  }
  if (edits == steps_[at_]) return;
  steps_.push_back(std::move(edits));
  if (steps_.size() > kMaxSteps) steps_.erase(steps_.begin());
  at_ = steps_.size() - 1;
}

bool EditHistory::undo() {
  gesture_.clear();
  if (at_ == 0) return false;
  --at_;
  return true;
}

bool EditHistory::redo() {
  gesture_.clear();
  if (redo_count() == 0) return false;
  ++at_;
  return true;
}

}  // namespace oriel::interactive
