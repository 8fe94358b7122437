// SPDX-License-Identifier: Apache-2.0
// What the subcommands share: their form, exit codes, and messages of user errors.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace oriel::app {

/// Picture complete; could not do it; wrong usage; the state is saved, and the same command
/// continues (EX_TEMPFAIL of sysexits.h).
enum ExitCode : int { kExitDone = 0, kExitFailed = 1, kExitUsage = 2, kExitResume = 75 };

/// The words of the command line after the name of the command. Set by main().
std::vector<std::string>& command_words();

/// Something the user can put right: one line on stderr, exit code kExitFailed.
struct UserError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// The command line itself is wrong: exit code kExitUsage.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A subcommand: its place on the command line and what it does.
struct Command {
  CLI::App* app;
  std::function<int()> run;
};

Command add_render_command(CLI::App& program);
Command add_merge_command(CLI::App& program);
Command add_ray_command(CLI::App& program);
Command add_check_command(CLI::App& program);
Command add_shaders_command(CLI::App& program);
Command add_tonemap_command(CLI::App& program);
Command add_diff_command(CLI::App& program);
Command add_denoise_command(CLI::App& program);
Command add_recombine_command(CLI::App& program);
Command add_sun_command(CLI::App& program);
Command add_profile_command(CLI::App& program);
Command add_explain_command(CLI::App& program);
Command add_measure_command(CLI::App& program);
Command add_falsecolor_command(CLI::App& program);
Command add_shader_build_command(CLI::App& program);
Command add_convert_command(CLI::App& program);
Command add_quick_command(CLI::App& program);
Command add_studio_command(CLI::App& program);
Command add_pack_command(CLI::App& program);
Command add_submit_command(CLI::App& program);
Command add_status_command(CLI::App& program);
Command add_work_command(CLI::App& program);
Command add_interactive_command(CLI::App& program);
/// All of them.
std::vector<Command> add_commands(CLI::App& program);

}  // namespace oriel::app
