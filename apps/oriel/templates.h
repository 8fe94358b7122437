// SPDX-License-Identifier: Apache-2.0
// The ready materials that come with the program: where their file is and what is in it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace oriel::app {

/// The folder of the files that come with the program: ../share/oriel from the program, else that
/// of the source tree it was built from. Every scene may include files from it.
std::string data_folder();

/// A paragraph of a file of templates: a comment, then elements, the last one the material.
struct Template {
  std::string name;                ///< of the material
  std::vector<std::string> lines;  ///< the comment
  std::string text;                ///< the whole paragraph
};

/// The paragraphs that define a material, in the order of the file.
///
/// Checked: TemplatesProgram.*
std::vector<Template> parse_templates(std::string_view file);

/// oriel shaders --templates: a list of all when `name` is empty, or one to paste into a scene.
/// The "template_" in front of a name may be left out.
///
/// Errors:  UserError when there is no such template, or the file is not there.
void print_templates(const std::string& name, bool as_json);

}  // namespace oriel::app
