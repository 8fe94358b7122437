// SPDX-License-Identifier: Apache-2.0
#include "support/program.h"

#include <fcntl.h>

namespace oriel {
namespace {

void redirect(int descriptor, const char* path) {
  const int opened = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (opened < 0 || dup2(opened, descriptor) < 0) _exit(126);
}

}  // namespace

pid_t ProgramTest::start(const std::vector<std::string>& arguments) const {
  const pid_t child = fork();
  if (child != 0) return child;
  if (chdir(folder_.file(".").c_str()) != 0) _exit(126);
  redirect(STDOUT_FILENO, "stdout.txt");
  redirect(STDERR_FILENO, "stderr.txt");
  std::vector<char*> argv = {const_cast<char*>("oriel")};
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  execv(ORIEL_PROGRAM, argv.data());
  _exit(127);
}

RunResult ProgramTest::finish(pid_t child) const {
  int status = 0;
  waitpid(child, &status, 0);
  RunResult result;
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  result.out = text_of(file("stdout.txt"));
  result.err = text_of(file("stderr.txt"));
  return result;
}

std::string small_scene(const std::string& options, const std::string& camera) {
  return "options \"opt\" object space trace depth 4 4 8 \"indirect\" \"path\" " + options +
         " end options\n"
         "camera \"cam\" focal 1 aperture 1 aspect 1.5 resolution 48 32 " +
         camera +
         " end camera\n"
         "instance \"cam_inst\" \"cam\" end instance\n"
         "light \"lamp\" \"mib_light_point\" ( \"color\" 1 1 1 ) origin 0 1 -3 end light\n"
         "instance \"lamp_inst\" \"lamp\" end instance\n"
         "material \"grey\" \"mia_material_x\" ( \"diffuse\" .5 .5 .5, \"reflectivity\" .2, "
         "\"refl_gloss\" .6 ) end material\n"
         "object \"floor\" visible trace shadow tagged group\n"
         "  -4 -1 -8  4 -1 -8  4 -1 0  -4 -1 0  -4 -1 -8  4 -1 -8  4 3 -8  -4 3 -8\n"
         "  v 0 v 1 v 2 v 3 v 4 v 5 v 6 v 7\n"
         "  p 0 3 2 1 0 p 0 4 5 6 7\n"
         "end group end object\n"
         "instance \"floor_inst\" \"floor\" material [ \"grey\" ] end instance\n"
         "instgroup \"root\" \"cam_inst\" \"lamp_inst\" \"floor_inst\" end instgroup\n"
         "render \"root\" \"cam_inst\" \"opt\"\n";
}

}  // namespace oriel
