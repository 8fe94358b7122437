// SPDX-License-Identifier: Apache-2.0
#include "command.h"

namespace oriel::app {

std::vector<std::string>& command_words() {
  static std::vector<std::string> words;
  return words;
}

std::vector<Command> add_commands(CLI::App& program) {
  return {add_render_command(program),     add_ray_command(program),
          add_check_command(program),      add_shaders_command(program),
          add_tonemap_command(program),    add_diff_command(program),
          add_denoise_command(program),    add_recombine_command(program),
          add_sun_command(program),        add_profile_command(program),
          add_measure_command(program),    add_explain_command(program),
          add_falsecolor_command(program), add_shader_build_command(program),
          add_convert_command(program),    add_quick_command(program),
          add_studio_command(program),     add_merge_command(program),
          add_pack_command(program),       add_submit_command(program),
          add_status_command(program),     add_work_command(program),
          add_interactive_command(program)};
}

}  // namespace oriel::app
