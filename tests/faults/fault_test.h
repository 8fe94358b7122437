// SPDX-License-Identifier: Apache-2.0
// Test support: the program with a size limit of files, in a shell, and while it is running.
#pragma once

#include <sys/resource.h>
#include <sys/stat.h>

#include <cstdlib>
#include <set>

#include "support/program.h"

namespace oriel {

/// Limits the size of files that this process and its children write. Writes beyond it fail with an
/// error, as on a full disk; the signal is ignored.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(std::size_t bytes) : before_signal_(::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    ::signal(SIGXFSZ, before_signal_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*before_signal_)(int);
};

/// Before a command: an emulated processor without AVX2.
inline constexpr const char* kOlderProcessor = "qemu-x86_64 -cpu Nehalem";
inline bool runs_older_processor() {
  return std::system("qemu-x86_64 --version > /dev/null 2>&1") == 0;
}

class FaultTest : public ProgramTest {
 protected:
  FaultTest() { write("scene.mi", small_scene()); }

  bool there(const std::string& name) const { return std::filesystem::exists(file(name)); }

  RunResult render(const std::vector<std::string>& arguments) const {
    return run(render_words(arguments));
  }
  pid_t start_render(const std::vector<std::string>& arguments) const {
    return start(render_words(arguments));
  }

  /// Runs a command of the shell in the folder, in which $ORIEL is the program. It redirects its
  /// output itself; `finish` reads stdout.txt and stderr.txt.
  RunResult shell(const std::string& command) const {
    for (const char* name : {"stdout.txt", "stderr.txt"}) write(name, "");
    const pid_t child = fork();
    if (child == 0) {
      if (chdir(file(".").c_str()) != 0) _exit(126);
      setenv("ORIEL", ORIEL_PROGRAM, 1);
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(127);
    }
    return finish(child);
  }

  /// Waits until the condition holds, at most half a minute.
  template <class Condition>
  static bool wait_until(const Condition& condition) {
    for (int i = 0; i < 3000; ++i) {
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
  bool wait_for_text(const std::string& text) const {
    return wait_until([&] { return text_of(file("stdout.txt")).find(text) != std::string::npos; });
  }

  std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(file(".")))
      all.insert(entry.path().filename().string());
    return all;
  }

 private:
  static std::vector<std::string> render_words(const std::vector<std::string>& arguments) {
    std::vector<std::string> words = {"render", "scene.mi"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return words;
  }
};

}  // namespace oriel
