// SPDX-License-Identifier: Apache-2.0
// How a render tells how far it is: a bar on a terminal, a line now and then elsewhere, or JSON.
#pragma once

#include <string>

#include "render/progressive.h"

namespace oriel::app {

class ProgressLine {
 public:
  enum class Style { Bar, Lines, Json, Quiet };

  explicit ProgressLine(Style style) : style_(style) {}
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Bar where stderr is a terminal, lines elsewhere.
  static Style style_for(bool json, bool quiet);

  /// Not from two threads at once.
  void update(const Progress& progress);
  /// Removes the bar, so that something else can be printed.
  void clear();

 private:
  Style style_;
  double last_line_ = 0;
  bool drawn_ = false;
};

/// "43 %  64 samples  noise 0.012  1:20, about 2:05 left"
std::string progress_text(const Progress& progress);

/// "3.2 s", "1:20", "2:03:10"
std::string duration_text(double seconds);

}  // namespace oriel::app
