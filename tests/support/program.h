// SPDX-License-Identifier: Apache-2.0
// Test support: runs the built program in a temporary folder and inspects its results.
#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "support/files.h"

namespace oriel {

/// What a run left behind.
struct RunResult {
  int exit_code = -1;  ///< -1: ended by a signal
  std::string out, err;
  int error_lines() const { return static_cast<int>(std::count(err.begin(), err.end(), '\n')); }
};

/// A temporary folder in which the program runs.
class ProgramTest : public ::testing::Test {
 protected:
  std::string file(const std::string& name) const { return folder_.file(name); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name)) << text;
  }

  /// Starts `oriel arguments...` in the folder; returns its process.
  pid_t start(const std::vector<std::string>& arguments) const;
  RunResult finish(pid_t child) const;
  RunResult run(const std::vector<std::string>& arguments) const {
    return finish(start(arguments));
  }

 private:
  TestFolder folder_;
};

/// A floor with a light over it, 48 x 32 pixels. `options` and `camera` are further statements.
std::string small_scene(const std::string& options = "", const std::string& camera = "");

}  // namespace oriel
