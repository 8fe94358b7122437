// SPDX-License-Identifier: Apache-2.0
// Several ranks of an MPI job render one picture: its bytes are those of one process.
#include "resume_test.h"

namespace oriel {
namespace mpi_test {

namespace fs = std::filesystem;

class Mpi : public ResumeTest {
 protected:
  void SetUp() override {
    const fs::path module = fs::path(ORIEL_PROGRAM).parent_path() / "oriel_mpi.so";
    if (!fs::exists(module) || std::system("mpirun --version > /dev/null 2>&1") != 0)
      GTEST_SKIP() << "Open MPI is not installed, or was not when Oriel was built";
  }

  /// Renders scene.mi with several ranks. `before`: of the shell, before mpirun.
  RunResult render_with(int ranks, const std::string& options,
                        const std::string& after = "") const {
    return shell(
        "export OMPI_MCA_btl_vader_single_copy_mechanism=none OMPI_MCA_mpi_yield_when_idle=1; "
        "mpirun --allow-run-as-root --oversubscribe -np " +
        std::to_string(ranks) + " \"$ORIEL\" render scene.mi --threads 1 " + options +
        " > stdout.txt 2> stderr.txt" + after);
  }

  void expect_same(const Words& words, const std::vector<int>& counts) const {
    const std::vector<char> whole = uninterrupted(words);
    std::string options = "-o a.exr -q";
    for (const std::string& word : words) options += " '" + word + "'";
    for (const int ranks : counts) {
      fs::remove(file("a.exr"));
      const RunResult r = render_with(ranks, options);
      EXPECT_EQ(r.exit_code, 0) << r.err;
      ASSERT_TRUE(there("a.exr")) << r.err;
      EXPECT_TRUE(bytes_of(file("a.exr")) == whole) << options << ", " << ranks << " ranks";
    }
  }
};

// acceptance: F4
TEST_F(Mpi, AnyNumberOfRanksGivesTheSameBytes) {
  expect_same({"--samples", "20", "--layers", "all", "--cryptomatte", "--light-group", "key=lamp*"},
              {1, 2, 3, 7});
  expect_same({"--noise", ".04"}, {3});
  expect_same({"--samples", "32", "--size", "128x128"}, {3});
}

// acceptance: F2
TEST_F(Mpi, RanksShareMaps) {
  std::string text = small_scene("globillum on caustic on finalgather accuracy 32");
  const std::string place = "origin 0 1 -3";
  text.replace(text.find(place), place.size(),
               place + " energy 5 5 5 globillum photons 1000 caustic photons 100");
  write("scene.mi", text);
  for (const char* method : {"path+cache", "fg", "fg+photons"})
    expect_same({"--gi", method, "--samples", "16"}, {3});
}

TEST_F(Mpi, RanksRenderAnimations) {
  write("scene.mi", small_scene() + "render \"root\" \"cam_inst\" \"opt\"\n");
  ASSERT_EQ(render({"--samples", "8", "-o", "w.#.exr"}).exit_code, 0);
  const RunResult r = render_with(2, "--samples 8 -o 'a.#.exr' -q");
  EXPECT_EQ(r.exit_code, 0) << r.err;
  for (const char* number : {"1", "2"})
    EXPECT_TRUE(bytes_of(file("a." + std::string(number) + ".exr")) ==
                bytes_of(file("w." + std::string(number) + ".exr")))
        << number;
}

// A rank is killed; the job ends with the last checkpoint of rank 0, from which another number of
// ranks continues.
// acceptance: F4
TEST_F(Mpi, AKilledRankLeavesACheckpoint) {
  const std::vector<char> whole = uninterrupted({"--samples", "300"});
  const RunResult killed =
      render_with(3, "--samples 300 -o a.exr --json --checkpoint 'a.chk,every .05'",
                  " & job=$!; for i in $(seq 1000); do grep -q checkpoint stdout.txt && break; "
                  "sleep .02; done; "
                  "kill -9 $(ps -o pid= --ppid $job | tail -1); wait $job");
  EXPECT_NE(killed.exit_code, 0);
  ASSERT_TRUE(there("a.chk")) << killed.err;
  fs::remove(file("a.exr"));  // the picture so far
  const RunResult r = render_with(2, "--samples 300 -o a.exr --resume a.chk");
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE(r.err.find("OR-RN-075"), std::string::npos) << r.err;
  EXPECT_TRUE(bytes_of(file("a.exr")) == whole);
}

// mpirun passes SIGINT and SIGTERM to the ranks as SIGTERM.
// acceptance: F4
TEST_F(Mpi, InterruptsLeaveACheckpoint) {
  const Words options = {"--samples", "2000"};
  const std::vector<char> whole = uninterrupted(options);
  // To mpirun, or to one rank that does not lead.
  for (const std::string target :
       {"INT $job", "TERM $job", "TERM $(ps -o pid= --ppid $job | tail -1)"}) {
    fs::remove(file("a.exr"));
    const RunResult ended =
        render_with(3, "--samples 2000 -o a.exr --json --checkpoint a.chk",
                    " & job=$!; for i in $(seq 1000); do grep -q '\"pass\":3' stdout.txt && break; "
                    "sleep .02; done; kill -" +
                        target + "; wait $job");
    EXPECT_NE(ended.exit_code, 0) << target;
    ASSERT_TRUE(there("a.chk")) << target << ended.err;
    EXPECT_NE(ended.out.find("\"stopped_by\":\"interrupted\""), std::string::npos) << ended.out;
    const RunResult r = render_with(2, "--samples 2000 -o a.exr --resume a.chk");
    EXPECT_EQ(r.exit_code, 0) << r.err;
    EXPECT_TRUE(bytes_of(file("a.exr")) == whole) << target;
  }
}

// As in a job of Slurm that nears its time limit.
TEST_F(Mpi, Usr1EndsRanksWithTheStatusOfParts) {
  const Words options = {"--samples", "1000"};
  const std::vector<char> whole = uninterrupted(options);
  const RunResult ended = render_with(
      3, "--samples 1000 -o a.exr --json --checkpoint a.chk --stop-at-usr1",
      " & job=$!; for i in $(seq 1000); do grep -q '\"pass\":3' stdout.txt && break; sleep .02; "
      "done; kill -USR1 $job; wait $job");
  EXPECT_EQ(ended.exit_code, 75) << ended.err;
  ASSERT_TRUE(there("a.chk")) << ended.err;
  const RunResult r = render({"--samples", "1000", "-o", "a.exr", "--resume", "a.chk"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_TRUE(bytes_of(file("a.exr")) == whole);
}

// The same version, and another build: bytes after the end of a program are ignored.
TEST_F(Mpi, RanksOfAnotherProgramAreRefusedByName) {
  fs::create_directory(file("other"));
  for (const char* name : {"oriel", "oriel_mpi.so"})
    fs::copy_file(fs::path(ORIEL_PROGRAM).parent_path() / name, file("other/" + std::string(name)));
  std::ofstream(file("other/oriel"), std::ios::app | std::ios::binary) << "x";
  const RunResult r = shell(
      "mpirun --allow-run-as-root --oversubscribe -np 1 \"$ORIEL\" render scene.mi -o a.exr : "
      "-np 1 other/oriel render scene.mi -o a.exr > stdout.txt 2> stderr.txt");
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_NE(r.err.find("rank 1 on "), std::string::npos) << r.err;
  EXPECT_NE(r.err.find(", and rank 0 on "), std::string::npos) << r.err;
  EXPECT_FALSE(there("a.exr"));
}

TEST_F(Mpi, RanksOnOlderProcessorsAreRefusedByName) {
  if (!runs_older_processor()) GTEST_SKIP() << "qemu-x86_64 is not installed";
  const RunResult r = shell(
      "mpirun --allow-run-as-root --oversubscribe -np 1 \"$ORIEL\" render scene.mi -o a.exr : "
      "-np 1 " +
      std::string(kOlderProcessor) +
      " \"$ORIEL\" render scene.mi -o a.exr > stdout.txt 2> stderr.txt");
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_NE(r.err.find("oriel: rank 1 on "), std::string::npos) << r.err;
  EXPECT_NE(r.err.find(": the processor lacks AVX2"), std::string::npos) << r.err;
  EXPECT_FALSE(there("a.exr"));
}

TEST_F(Mpi, RanksOfAnotherSceneAreRefusedByName) {
  write("other.mi", small_scene("", "lens \"mia_exposure_simple\" (\"gain\" 2)"));
  const RunResult r = shell(
      "mpirun --allow-run-as-root --oversubscribe -np 1 \"$ORIEL\" render scene.mi -o a.exr : "
      "-np 1 \"$ORIEL\" render other.mi -o a.exr > stdout.txt 2> stderr.txt");
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_NE(r.err.find("rank 1 renders another picture"), std::string::npos) << r.err;
  EXPECT_FALSE(there("a.exr"));
}

TEST_F(Mpi, PartsAreForSingleProcesses) {
  const RunResult r = render_with(2, "-o a.exr --part 1/2");
  EXPECT_NE(r.exit_code, 0);
  EXPECT_NE(r.err.find("--part"), std::string::npos) << r.err;
}

class Srun : public FaultTest {};

TEST_F(Srun, ProcessesThatDoNotKnowOfEachOtherAreRefused) {
  const RunResult r = shell(
      "SLURM_STEP_NUM_TASKS=8 \"$ORIEL\" render scene.mi -o a.exr > stdout.txt 2> stderr.txt");
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_NE(r.err.find("srun --mpi=pmix"), std::string::npos) << r.err;
  EXPECT_EQ(r.error_lines(), 1) << r.err;
  EXPECT_FALSE(there("a.exr"));
}

}  // namespace mpi_test
}  // namespace oriel
