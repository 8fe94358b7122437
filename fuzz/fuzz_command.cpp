// SPDX-License-Identifier: Apache-2.0
// Words of a command line, one a line: parsed, and the arguments of a render interpreted, without
// running the command. A wrong command line is one message.
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "../apps/oriel/command.h"
#include "../apps/oriel/render_plan.h"
#include "../apps/oriel/suggest.h"
#include "file.h"
#include "fuzzers.h"
#include "shaders/registry.h"

namespace {

using namespace oriel::app;

/// Arguments whose text render_plan() interprets.
constexpr struct {
  const char* name;
  std::string RenderArguments::*value;
} kTexts[] = {{"--gi", &RenderArguments::gi},
              {"--size", &RenderArguments::size},
              {"--crop", &RenderArguments::crop},
              {"--camera", &RenderArguments::camera},
              {"--layers", &RenderArguments::layers},
              {"--sun", &RenderArguments::sun},
              {"--cryptomatte", &RenderArguments::cryptomatte},
              {"--frames", &RenderArguments::frames},
              {"--denoiser", &RenderArguments::denoiser},
              {"--exr", &RenderArguments::exr},
              {"--checkpoint", &RenderArguments::checkpoint},
              {"--resume", &RenderArguments::resume}};

void interpret(const CLI::App& render) {
  const auto results = [&](const char* name) { return render.get_option(name)->results(); };
  RenderArguments a;
  for (const auto& text : kTexts)
    if (const auto values = results(text.name); !values.empty()) a.*text.value = values.back();
  a.outputs = results("--output");
  a.light_groups = results("--light-group");
  render_plan(a);
  for (const std::string& output : a.outputs) frame_path(output, 12);
}

}  // namespace

int oriel::fuzz::fuzz_command(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> words;
  std::istringstream lines{std::string(text_of(data, size))};
  for (std::string line; words.size() < 64 && std::getline(lines, line);) words.push_back(line);
  CLI::App program("", "oriel");
  program.set_version_flag("--version", "oriel");
  program.require_subcommand(1);
  // The commands own what the parser writes to.
  const std::vector<Command> commands = add_commands(program);
  try {
    program.parse(std::vector<std::string>(words.rbegin(), words.rend()));
    if (program.get_subcommand("render")->parsed()) interpret(*program.get_subcommand("render"));
  } catch (const CLI::ParseError& e) {
    std::ostringstream text;
    if (e.get_exit_code() == 0)
      program.exit(e, text, text);
    else if (usage_message(program, e, words).empty())
      std::abort();
  } catch (const UsageError&) {  // a message is what is asked for
  } catch (const UserError&) {
  }
  return 0;
}
