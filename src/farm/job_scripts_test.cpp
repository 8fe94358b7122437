// SPDX-License-Identifier: Apache-2.0
#include "farm/job_scripts.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <memory>

namespace oriel::farm {
namespace job_scripts_test {

/// What /bin/sh prints.
std::string shell_output(const std::string& line) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(line.c_str(), "r"), pclose);
  std::string text;
  for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get()))
    text += static_cast<char>(c);
  return text;
}

constexpr const char* kHostile = "it's \"a\" $(touch x) `y` \\ ;&|<>*? \n tab\t!";

TEST(JobScripts, QuotedTextIsOneWord) {
  EXPECT_EQ(shell_output("printf %s " + shell_quoted(kHostile)), kHostile);
  EXPECT_EQ(shell_output("printf '[%s]' " + shell_line({"", "a b", "--x=1", "it's"})),
            "[][a b][--x=1][it's]");
  EXPECT_EQ(shell_line({"sbatch", "--array=0-3%2", "a b"}), "sbatch --array=0-3%2 'a b'");
}

Job job() {
  Job made;
  made.folder = std::string("/jobs/") + kHostile;
  made.name = "house";
  made.program = "/opt/ori el/oriel";
  made.outputs = {"/x.exr"};
  made.parts = 9;
  made.resources.nodes = 4;
  made.resources.time = "2:00:00";
  made.resources.partition = "main";
  return made;
}

/// The part of a script that the shell runs, with another program in place of `exec`.
std::string words_of_script(const std::string& script) {
  std::string command = script.substr(script.find("\nexec ") + 6);
  return shell_output("SLURM_ARRAY_TASK_ID=7; printf '[%s]' " + command);
}

TEST(JobScripts, ThePathsReachTheProgram) {
  const std::string words = std::string("[/opt/ori el/oriel][work][/jobs/") + kHostile + "]";
  EXPECT_EQ(words_of_script(render_script(job())), words + "[--task][7]");
  EXPECT_EQ(words_of_script(merge_script(job())), words + "[--merge]");
}

TEST(JobScripts, SbatchLinesComeFirstAndHaveNoPaths) {
  for (const std::string& script : {render_script(job()), merge_script(job())}) {
    const std::string head = script.substr(0, script.find("\nexec "));
    EXPECT_EQ(head.find("/jobs"), head.npos) << head;
    EXPECT_NE(head.find("\n#SBATCH --requeue\n#"), head.npos) << head;
    EXPECT_NE(head.find("\n#SBATCH --open-mode=append\n"), head.npos) << head;
    EXPECT_NE(head.find("\n#SBATCH --partition=main"), head.npos) << head;
    EXPECT_EQ(head.find("trap"), head.npos);
    for (std::size_t at = 0; (at = head.find('\n', at)) != head.npos; ++at)
      EXPECT_EQ(head[at + 1], '#') << head;
  }
  EXPECT_NE(render_script(job()).find("\n#SBATCH --signal=B:USR1@120\n"), std::string::npos);
}

TEST(JobScripts, WholeNodesUnlessCpusAreGiven) {
  Job made = job();
  EXPECT_NE(render_script(made).find("\n#SBATCH --exclusive\n"), std::string::npos);
  made.resources.cpus = 8;
  EXPECT_EQ(render_script(made).find("--exclusive"), std::string::npos);
  EXPECT_NE(render_script(made).find("\n#SBATCH --cpus-per-task=8\n"), std::string::npos);
}

TEST(JobScripts, Submissions) {
  const Job made = job();
  EXPECT_EQ(render_submission(made, {0, 1, 2, 8}),
            (std::vector<std::string>{"sbatch", "--parsable", "--chdir=" + made.folder,
                                      "--array=0-2,8%4", made.folder + "/render.sh"}));
  EXPECT_EQ(merge_submission(made, "12")[3], "--dependency=afterany:12");
}

}  // namespace job_scripts_test
}  // namespace oriel::farm
