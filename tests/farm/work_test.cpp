// SPDX-License-Identifier: Apache-2.0
// oriel submit, work and status with programs that stand for oriel render, oriel merge and Slurm.
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "support/program.h"

namespace oriel {
namespace work_test {

namespace fs = std::filesystem;

/// Stands for `oriel render` and `oriel merge`: notes each call, fails or stops if a file asks for
/// it, and writes a part or a picture.
constexpr const char* kOriel = R"sh(#!/bin/sh
here=$(dirname "$0")
printf '%s|' "$@" >>"$here/calls"
echo >>"$here/calls"
frame=1 first=$2
while [ $# -gt 0 ]; do
  case $1 in
    --part) part=${2%/*} parts=${2#*/} ;;
    --frames) frame=$2 ;;
    -o) output=$2 ;;
    --maps-only) maps=$2 ;;
    merge) merge=1 ;;
  esac
  shift
done
if [ -n "$merge" ]; then
  if [ -e "$here/again" ]; then
    rm "$here/again"
    exit 75
  fi
  frame=$(echo "$first" | sed 's/.*frame-0*\([0-9]*\)[.]part.*/\1/')
  echo picture >"$(echo "$output" | sed "s/#/$frame/")"
  exit
fi
if [ -n "$maps" ]; then
  echo maps >"$maps/frame-000$frame.maps"
  exit
fi
if [ -z "$part" ]; then
  echo picture >"$(echo "$output" | sed "s/#/$frame/")"
  exit
fi
output=$(echo "$output" | sed "s/####/000$frame/")
if [ -e "$here/fail-$frame-$part" ]; then
  echo "oriel: frame $frame, part $part: no texture" >&2
  exit 1
fi
if [ -e "$here/stop-$part" ]; then
  rm "$here/stop-$part"
  kill -USR1 $PPID
  exit 75
fi
echo part >"${output%.exr}.part-$part-of-$parts"
)sh";

/// Stands for Slurm's commands.
constexpr const char* kSlurm = R"sh(#!/bin/sh
printf '%s|' "$(basename "$0")" "$@" >>"$(dirname "$0")/slurm"
echo >>"$(dirname "$0")/slurm"
case $(basename "$0") in
  sbatch)
    case $* in *"$(cat "$(dirname "$0")/refused" 2>/dev/null || echo none.sh)") exit 1 ;; esac
    wc -l <"$(dirname "$0")/slurm"
    ;;
  squeue) cat "$(dirname "$0")/queue" 2>/dev/null ;;
  scontrol) echo "MaxArraySize            = 4" ;;
  srun)
    while [ "${1#--}" != "$1" ]; do shift; done
    exec "$@"
    ;;
esac
exit 0
)sh";

class FarmWork : public ProgramTest {
 protected:
  void SetUp() override {
    fs::create_directories(file("bin"));
    write_program("bin/oriel", kOriel);
    for (const char* name : {"sbatch", "squeue", "scontrol", "srun", "scancel"})
      write_program(std::string("bin/") + name, kSlurm);
    path_ = std::getenv("PATH");
    setenv("PATH", (file("bin") + ":" + path_).c_str(), 1);
    for (const char* name : {"SLURM_JOB_ID", "SLURM_RESTART_COUNT", "SLURM_CPUS_PER_TASK"})
      unsetenv(name);
    write("house.mi", small_scene() + "render \"root\" \"cam_inst\" \"opt\"\n" +
                          "render \"root\" \"cam_inst\" \"opt\"\n");
  }
  void TearDown() override {
    setenv("PATH", path_.c_str(), 1);
    for (const char* name : {"SLURM_JOB_ID", "SLURM_RESTART_COUNT"}) unsetenv(name);
  }
  void write_program(const std::string& name, const char* text) const {
    write(name, text);
    fs::permissions(file(name), fs::perms::owner_all);
  }
  /// Submits and lets the program that stands for oriel render.
  RunResult submit(std::vector<std::string> more) const {
    std::vector<std::string> words = {"submit", "house.mi",          "-o", "it's a \"shot\".#.exr",
                                      "--job",  "a job's \"folder\""};
    words.insert(words.end(), more.begin(), more.end());
    RunResult result = run(words);
    if (result.exit_code != 0) return result;
    nlohmann::json job = nlohmann::json::parse(text_of(in_job("job.json")));
    job["program"] = file("bin/oriel");
    write(kJob + "/job.json", job.dump());
    return result;
  }
  RunResult work(std::vector<std::string> more) const {
    std::vector<std::string> words = {"work", kJob};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  std::string in_job(const std::string& name) const { return file(kJob + "/" + name); }
  std::string picture(int frame) const {
    return file("it's a \"shot\"." + std::to_string(frame) + ".exr");
  }
  nlohmann::json record(int frame, int part = 1) const {
    return nlohmann::json::parse(text_of(in_job("units/frame-000" + std::to_string(frame) +
                                                ".part-" + std::to_string(part) + ".json")));
  }
  std::string calls() const { return text_of(file("bin/calls")); }
  std::string slurm() const { return text_of(file("bin/slurm")); }
  const std::string kJob = "a job's \"folder\"";

 private:
  std::string path_;
};

TEST_F(FarmWork, FramesAreSubmittedAsAnArrayAndAMerge) {
  const RunResult r = submit({"--nodes", "2", "--time", "1:00:00", "--sbatch=--nice=5"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const std::string folder = fs::canonical(file(kJob)).string();
  EXPECT_NE(slurm().find("sbatch|--parsable|--chdir=" + folder + "|--array=0-2%2|--nice=5|" +
                         folder + "/render.sh|\n"),
            std::string::npos)
      << slurm();
  EXPECT_NE(slurm().find("|--dependency=afterany:2|"), std::string::npos) << slurm();
  EXPECT_TRUE(fs::exists(in_job("scene/house.mi")));
  EXPECT_NE(text_of(in_job("render.sh")).find("#SBATCH --time=1:00:00\n"), std::string::npos);
  // Submitting again would disturb the job.
  EXPECT_EQ(submit({}).exit_code, 1);
}

TEST_F(FarmWork, FramesFitIntoTheLargestArray) {
  ASSERT_EQ(submit({"--parts", "3"}).exit_code, 0);  // 9 units, at most 4 tasks
  EXPECT_NE(slurm().find("|--array=0-2|"), std::string::npos) << slurm();
  ASSERT_EQ(work({"--task", "1"}).exit_code, 0);
  EXPECT_EQ(record(2, 1)["state"], "done");
  EXPECT_EQ(record(2, 3)["state"], "done");
  EXPECT_FALSE(fs::exists(in_job("units/frame-0001.part-1.json")));
}

TEST_F(FarmWork, EachTaskRendersItsFrameAndMergesIt) {
  ASSERT_EQ(submit({"--", "--samples", "7"}).exit_code, 0);
  ASSERT_EQ(work({"--task", "1"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(picture(2)));
  EXPECT_FALSE(fs::exists(picture(1)));
  EXPECT_NE(calls().find("render|" + fs::canonical(file(kJob)).string() + "/scene/house.mi|"),
            std::string::npos)
      << calls();
  EXPECT_NE(calls().find("|--part|1/1|"), std::string::npos);
  EXPECT_NE(calls().find("|--frames|2|"), std::string::npos);
  EXPECT_NE(calls().find("|--samples|7|"), std::string::npos);
  // A second run does nothing.
  const std::string before = calls();
  EXPECT_EQ(work({"--task", "1"}).exit_code, 0);
  EXPECT_EQ(calls(), before);
}

TEST_F(FarmWork, AFailedFrameIsNamedAndOnlyItIsSubmittedAgain) {
  ASSERT_EQ(submit({"--retries", "1"}).exit_code, 0);
  write("bin/fail-2-1", "");
  for (const char* task : {"0", "1", "2"})
    EXPECT_EQ(work({"--task", task}).exit_code, task[0] == '1' ? 1 : 0);
  const RunResult status = run({"status", kJob});
  EXPECT_EQ(status.exit_code, 1);
  EXPECT_EQ(status.out.find("it_s_a__shot_: 2 of 3 frames done, 1 failed"), 0u) << status.out;
  EXPECT_NE(status.out.find("frame 2 failed (attempt 1): oriel: frame 2, part 1: no texture"),
            std::string::npos)
      << status.out;
  EXPECT_EQ(work({"--merge"}).exit_code, 0);
  EXPECT_NE(slurm().find("|--array=1|"), std::string::npos) << slurm();
  EXPECT_EQ(work({"--task", "1"}).exit_code, 1);
  // The number of repetitions is bounded.
  const std::string before = slurm();
  const RunResult merge = work({"--merge"});
  EXPECT_EQ(merge.exit_code, 1);
  EXPECT_NE(merge.err.find("no texture"), std::string::npos) << merge.err;
  EXPECT_EQ(slurm(), before);
  EXPECT_EQ(record(2)["attempts"], 2);
}

TEST_F(FarmWork, ATaskNearItsLimitIsRequeued) {
  ASSERT_EQ(submit({"--frames", "1", "--parts", "2"}).exit_code, 0);
  write("bin/stop-2", "");
  setenv("SLURM_JOB_ID", "77", 1);
  ASSERT_EQ(work({"--task", "0"}).exit_code, 0);
  EXPECT_EQ(work({"--task", "1"}).exit_code, 75);
  EXPECT_NE(slurm().find("scontrol|requeue|77|\n"), std::string::npos) << slurm();
  EXPECT_EQ(record(1, 2)["state"], "stopped");
  EXPECT_EQ(work({"--task", "1"}).exit_code, 0);
  EXPECT_EQ(work({"--merge"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(picture(1)));
}

TEST_F(FarmWork, MapsAreComputedOnceBeforeTheParts) {
  ASSERT_EQ(submit({"--frames", "1", "--parts", "2", "--maps"}).exit_code, 0);
  EXPECT_NE(slurm().find("|--array=0-0|"), std::string::npos) << slurm();
  EXPECT_NE(slurm().find("/maps.sh|\n"), std::string::npos) << slurm();
  EXPECT_NE(slurm().find("|--array=0-1|--dependency=afterany:2|"), std::string::npos) << slurm();
  ASSERT_EQ(work({"--maps", "0"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(in_job("maps/frame-0001.maps")));
  ASSERT_EQ(work({"--task", "0"}).exit_code, 0);
  EXPECT_EQ(work({"--maps", "0"}).exit_code, 0);
  const std::string all = calls();
  EXPECT_EQ(all.find("--maps-only"), all.rfind("--maps-only")) << all;
  EXPECT_NE(all.find("|--maps|" + fs::canonical(in_job("maps")).string() + "|"), all.npos) << all;
  // A task does not depend on the job of the maps.
  fs::remove(in_job("maps/frame-0001.maps"));
  ASSERT_EQ(work({"--task", "1"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(in_job("maps/frame-0001.maps")));
}

TEST_F(FarmWork, ANoiseTargetMayAskForAnotherRound) {
  ASSERT_EQ(submit({"--frames", "1", "--parts", "2", "--retries", "0"}).exit_code, 0);
  for (const char* task : {"0", "1"}) ASSERT_EQ(work({"--task", task}).exit_code, 0);
  write("bin/again", "");
  EXPECT_EQ(work({"--merge"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(picture(1)));
  // Both parts are submitted again, which is no retry of a failure.
  EXPECT_NE(slurm().rfind("|--array=0-1|"), slurm().find("|--array=0-1|")) << slurm();
  for (const char* task : {"0", "1"}) ASSERT_EQ(work({"--task", task}).exit_code, 0);
  EXPECT_EQ(record(1, 2)["attempts"], 2);
  EXPECT_EQ(work({"--merge"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(picture(1)));
  // One part decides itself.
  write("bin/again", "");
  fs::remove_all(file(kJob));
  ASSERT_EQ(submit({"--frames", "2", "--parts", "1"}).exit_code, 0);
  EXPECT_EQ(work({"--task", "0"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(picture(2)));
}

TEST_F(FarmWork, OneMachineCanRenderAllOfIt) {
  ASSERT_EQ(submit({"--parts", "2"}).exit_code, 0);
  EXPECT_EQ(work({"--all"}).exit_code, 0);
  for (const int frame : {1, 2, 3}) EXPECT_TRUE(fs::exists(picture(frame))) << frame;
  const nlohmann::json status = nlohmann::json::parse(run({"status", kJob, "--json"}).out);
  EXPECT_EQ(status["frames_done"], 3);
  EXPECT_EQ(status["failed"], 0);
}

TEST_F(FarmWork, NodesRenderAPictureTogether) {
  ASSERT_EQ(submit({"--mpi", "3", "--time", "30"}).exit_code, 0);
  EXPECT_NE(slurm().find("|--array=0-2|"), std::string::npos) << slurm();
  const std::string script = text_of(in_job("render.sh"));
  for (const char* line : {"#SBATCH --nodes=3\n", "#SBATCH --ntasks=3\n",
                           "#SBATCH --ntasks-per-node=1\n", "#SBATCH --requeue\n"})
    EXPECT_NE(script.find(line), std::string::npos) << line << script;
  EXPECT_EQ(text_of(in_job("merge.sh")).find("--ntasks=3"), std::string::npos);
  setenv("SLURM_JOB_ID", "77", 1);
  ASSERT_EQ(work({"--task", "1"}).exit_code, 0);
  const std::string checkpoint =
      fs::canonical(file(kJob)).string() + "/parts/frame-0002.checkpoint";
  EXPECT_NE(slurm().find("srun|--mpi=pmix|--kill-on-bad-exit=1|--nodes=3|--ntasks=3|"),
            std::string::npos)
      << slurm();
  EXPECT_NE(calls().find("|--checkpoint|" + checkpoint + "|--resume|" + checkpoint +
                         "|--stop-at-usr1|\n"),
            std::string::npos)
      << calls();
  EXPECT_TRUE(fs::exists(picture(2)));
  EXPECT_EQ(record(2)["state"], "done");
  // Without Slurm by one process.
  unsetenv("SLURM_JOB_ID");
  const std::string before = slurm();
  ASSERT_EQ(work({"--task", "0"}).exit_code, 0);
  EXPECT_EQ(slurm(), before);
  EXPECT_TRUE(fs::exists(picture(1)));
  EXPECT_EQ(run({"submit", "house.mi", "-o", "b.exr", "--mpi", "2", "--parts", "2"}).exit_code, 2);
}

TEST_F(FarmWork, TasksReadTheCopyOfTheirNode) {
  ASSERT_EQ(submit({"--stage", "a node's \"disk\""}).exit_code, 0);
  for (const char* task : {"0", "1"}) ASSERT_EQ(work({"--task", task}).exit_code, 0);
  const fs::path stage = fs::canonical(file("a node's \"disk\""));
  ASSERT_EQ(std::distance(fs::directory_iterator(stage), fs::directory_iterator()), 1);
  const std::string copy = fs::directory_iterator(stage)->path().string();
  const std::string all = calls();
  EXPECT_EQ(all.find("render|" + copy + "/house.mi|"), 0u) << all;
  EXPECT_EQ(all.find("/scene/house.mi|-o"), all.npos) << all;
}

// The second task would wait ten minutes.
TEST_F(FarmWork, TasksStartOneAfterTheOther) {
  ASSERT_EQ(submit({"--stagger", "600"}).exit_code, 0);
  ASSERT_EQ(work({"--task", "0"}).exit_code, 0);
  const std::string before = calls();
  const pid_t second = start({"work", kJob, "--task", "1"});
  const auto waits = [&] {
    return text_of(file("stderr.txt")).find("starts in") != std::string::npos;
  };
  for (int i = 0; i < 3000 && !waits(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(second, SIGUSR1);
  const RunResult r = finish(second);
  EXPECT_EQ(r.exit_code, 75) << r.err;
  EXPECT_NE(r.err.find("task 1 starts in 600 s"), std::string::npos) << r.err;
  EXPECT_EQ(calls(), before);
  // Requeued tasks start at different times by themselves.
  setenv("SLURM_RESTART_COUNT", "1", 1);
  ASSERT_EQ(work({"--task", "1"}).exit_code, 0);
  EXPECT_NE(calls(), before);
}

/// Jobs whose parts the program itself renders.
class FarmParts : public FarmWork {
 protected:
  void SetUp() override {
    FarmWork::SetUp();
    write("still.mi", small_scene());
    ASSERT_EQ(run({"submit", "still.mi", "-o", "a.exr", "--job", kJob, "--parts", "2", "--retries",
                   "1", "--", "--samples", "8"})
                  .exit_code,
              0);
    for (const char* task : {"0", "1"}) ASSERT_EQ(work({"--task", task}).exit_code, 0);
  }
  std::string part(int k) const {
    return in_job("parts/frame-0001.part-" + std::to_string(k) + "-of-2");
  }
  void expect_picture_of_one_machine() const {
    ASSERT_EQ(run({"render", "still.mi", "-o", "whole.exr", "-q", "--samples", "8"}).exit_code, 0);
    EXPECT_EQ(text_of(file("a.exr")), text_of(file("whole.exr")));
  }
};

TEST_F(FarmParts, DamagedAndMissingOnesAreRenderedAgain) {
  fs::resize_file(part(2), fs::file_size(part(2)) / 2);
  const RunResult merge = work({"--merge"});
  EXPECT_EQ(merge.exit_code, 0) << merge.err;
  EXPECT_NE(merge.err.find("frame-0001.part-2-of-2' is rendered again"), std::string::npos)
      << merge.err;
  EXPECT_NE(slurm().find("|--array=1|"), std::string::npos) << slurm();
  EXPECT_FALSE(fs::exists(file("a.exr")));
  ASSERT_EQ(work({"--task", "1"}).exit_code, 0);
  EXPECT_EQ(work({"--merge"}).exit_code, 0);
  expect_picture_of_one_machine();
}

TEST_F(FarmParts, OneMachineRepairsThem) {
  fs::resize_file(part(1), 100);
  fs::remove(part(2));
  const RunResult all = work({"--all"});
  EXPECT_EQ(all.exit_code, 0) << all.err;
  expect_picture_of_one_machine();
}

TEST_F(FarmWork, WrongOptionsAreFoundBeforeTheSubmission) {
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--", "--sample", "7"},
                                                {"--", "--resume", "x"},
                                                {"--", "-o", "x.exr"},
                                                {"--time", "1:00\n#SBATCH --wrap=x"},
                                                {"--partition", "a b"}}) {
    const RunResult r = submit(wrong);
    EXPECT_EQ(r.exit_code, 2) << wrong.back() << r.out << r.err;
  }
  const RunResult beyond = submit({"--frames", "2..9"});
  EXPECT_EQ(beyond.exit_code, 1);
  EXPECT_NE(beyond.err.find("3 render statements"), std::string::npos) << beyond.err;
  EXPECT_EQ(slurm().find("sbatch"), std::string::npos);
}

// The same command is tried again after a correction.
TEST_F(FarmWork, ARefusedSubmissionLeavesNothing) {
  for (const char* script : {"render.sh", "merge.sh"}) {
    write("bin/refused", script);
    const RunResult r = submit({});
    EXPECT_EQ(r.exit_code, 1);
    EXPECT_NE(r.err.find("sbatch failed"), std::string::npos) << r.err;
    EXPECT_FALSE(fs::exists(file(kJob))) << script;
  }
  // The array was accepted before its merge was not: the calls are numbered.
  EXPECT_NE(slurm().find("scancel|4|\n"), std::string::npos) << slurm();
  fs::remove(file("bin/refused"));
  EXPECT_EQ(submit({"--frames", "9"}).exit_code, 1);
  EXPECT_FALSE(fs::exists(file(kJob)));
  EXPECT_EQ(submit({}).exit_code, 0);
}

TEST_F(FarmWork, ADryRunWritesNothing) {
  const RunResult r = run({"submit", "house.mi", "-o", "shot.#.exr", "--dry-run", "--cpus", "8"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE(r.out.find("#SBATCH --signal=B:USR1@120\n"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("#SBATCH --cpus-per-task=8\n"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("--array=0-2"), std::string::npos) << r.out;
  EXPECT_FALSE(fs::exists(file("shot.job")));
}

TEST_F(FarmWork, WithoutSlurmTheMessageSaysWhatToDo) {
  setenv("PATH", "/nonexistent", 1);
  const RunResult r = run({"submit", "house.mi", "-o", "a.exr"});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_NE(r.err.find("sbatch is not in PATH"), std::string::npos) << r.err;
  EXPECT_FALSE(fs::exists(file("a.job")));
}

}  // namespace work_test
}  // namespace oriel
