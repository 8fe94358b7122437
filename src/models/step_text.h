// SPDX-License-Identifier: Apache-2.0
// STEP files (ISO 10303-21) as lists of entities.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::models {

/// #id = NAME ( arguments );
struct StepEntity {
  std::uint64_t id = 0;
  std::string name;                    ///< in capitals
  std::vector<std::string> arguments;  ///< as written, without blanks around them
};

struct StepFile {
  std::string head;  ///< up to and including "DATA;"
  std::vector<StepEntity> entities;
  std::string text() const;
};

/// Inputs:  text: of a STEP file. Comments are dropped, and statements that are no simple entities.
/// Returns: no entities if there is no data section.
/// Source:  ISO 10303-21, 5 to 11.
/// Checked: StepText.*
StepFile parse_step(std::string_view text);

/// The items of a list argument, "(a,b,(c,d))"; none for what is no list.
std::vector<std::string> step_list(std::string_view argument);

/// The id of a reference, "#12"; 0 for other arguments.
std::uint64_t step_reference(std::string_view argument);

}  // namespace oriel::models
