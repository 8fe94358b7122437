// SPDX-License-Identifier: Apache-2.0
// The program `oriel`: subcommands, and the one place where errors become exit codes.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <new>
#include <sstream>
#include <string_view>
#include <vector>

#include "base/confined_process.h"
#include "command.h"
#include "convert_model.h"
#include "image/reader_process.h"
#include "image/reader_protocol.h"
#include "models/import_apart.h"
#include "process_streams.h"
#include "suggest.h"

namespace {

int usage_error(const std::string& message, const std::string& command) {
  fmt::print(stderr, "oriel: {} (see oriel{}{} --help)\n", message, command.empty() ? "" : " ",
             command);
  return oriel::app::kExitUsage;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

int run_program(int argc, char** argv) {
  using namespace oriel::app;
  CLI::App program("Oriel renders mental ray scenes with the architectural shader library.",
                   "oriel");
  program.set_version_flag("--version", "oriel " ORIEL_VERSION);
  program.require_subcommand(1);
  const std::vector<Command> commands = add_commands(program);

  std::string chosen;
  try {
    // A model is rendered as oriel quick does.
    std::vector<char*> words(argv, argv + argc);
    char quick[] = "quick";
    if (argc > 2 && std::string_view(argv[1]) == "render" &&
        std::any_of(argv + 2, argv + argc, is_model))
      words[1] = quick;
    command_words().assign(argv + std::min(argc, 2), argv + argc);
    program.parse(argc, words.data());
    for (const Command& command : commands) {
      if (!command.app->parsed()) continue;
      chosen = command.app->get_name();
      return command.run();
    }
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) {  // --help, --version
      std::ostringstream text;
      const int code = program.exit(e, text, text);
      fmt::print("{}", text.str());
      return code;
    }
    for (const Command& command : commands)
      if (command.app->parsed()) chosen = command.app->get_name();
    return usage_error(usage_message(program, e, {argv + 1, argv + argc}), chosen);
  } catch (const UsageError& e) {
    return usage_error(e.what(), chosen);
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "oriel: not enough memory\n");
  } catch (const std::exception& e) {
    fmt::print(stderr, "oriel: {}\n", first_line(e.what()));
  }
  return kExitFailed;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 4 && std::string_view(argv[1]) == oriel::kReaderArgument)
    return oriel::reader::serve(oriel::confined_limits(argv + 2));
  if (argc == 4 && std::string_view(argv[1]) == oriel::models::kModelReaderArgument)
    return oriel::models::serve_model(oriel::confined_limits(argv + 2));
  oriel::app::prepare_process();
  return oriel::app::close_streams(run_program(argc, argv));
}
