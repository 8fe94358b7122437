// SPDX-License-Identifier: Apache-2.0
#include "embed/convert_model.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "embed/guard.h"

namespace oriel::embed {

namespace fs = std::filesystem;

bool is_scene(const fs::path& path) {
  return path.extension() == ".mi" ||
         (path.extension() == ".gz" && path.stem().extension() == ".mi");
}

void convert_model(const std::string& program, const std::string& model, const std::string& scene) {
  std::string words[] = {program, "convert", model, scene, "--daylight"};
  char* arguments[std::size(words) + 1] = {};
  for (std::size_t i = 0; i < std::size(words); ++i) arguments[i] = words[i].data();
  pid_t child = 0;
  if (const int error = posix_spawnp(&child, program.c_str(), nullptr, nullptr, arguments, environ))
    throw EmbedError(ORIEL_FAILED, "cannot run " + program + ": " + std::strerror(error));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw EmbedError(ORIEL_FAILED, model + " could not be converted");
}

}  // namespace oriel::embed
