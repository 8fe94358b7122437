// SPDX-License-Identifier: Apache-2.0
#include "base/sandbox.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <functional>

namespace oriel {
namespace sandbox_test {

/// Exit code of a confined child process; -1 if a signal ended it.
int confined(const std::function<int()>& work, std::size_t memory_bytes = 0) {
  const pid_t child = fork();
  if (child == 0) {
    enter_sandbox({memory_bytes});
    _exit(work());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Sandbox, RefusesFilesNetworkProgramsAndProcesses) {
  EXPECT_EQ(confined([] { return open("/etc/passwd", O_RDONLY) < 0 ? errno : 0; }), EACCES);
  EXPECT_EQ(confined([] { return open("/tmp/new", O_CREAT | O_WRONLY, 0600) < 0 ? errno : 0; }),
            EACCES);
  EXPECT_EQ(confined([] {
              struct stat status {};
              return stat("/etc/passwd", &status) < 0 ? errno : 0;
            }),
            EACCES);
  EXPECT_EQ(confined([] { return socket(AF_INET, SOCK_STREAM, 0) < 0 ? errno : 0; }), EPERM);
  EXPECT_EQ(confined([] {
              char* const words[] = {nullptr};
              return execve("/bin/true", words, words) < 0 ? errno : 0;
            }),
            EPERM);
  EXPECT_EQ(confined([] { return fork() < 0 ? errno : 0; }), EPERM);
  EXPECT_EQ(confined([] { return kill(getppid(), 0) < 0 ? errno : 0; }), EPERM);
  EXPECT_EQ(confined([] {
              return mmap(nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1,
                          0) == MAP_FAILED
                         ? errno
                         : 0;
            }),
            EPERM);
}

TEST(Sandbox, GrantsOneFile) {
  const int file = open("/proc/self/exe", O_RDONLY);
  ASSERT_GE(file, 0);
  EXPECT_EQ(confined([&] {
              grant_file("/granted", file);
              struct stat status {};
              char head[4] = {};
              const int opened = open("/granted", O_RDONLY);
              if (opened < 0 || stat("/granted", &status) != 0 || status.st_size == 0) return 1;
              if (read(opened, head, 4) != 4 || head[1] != 'E') return 2;
              if (open("/granted", O_RDWR) >= 0 || open("/other", O_RDONLY) >= 0) return 3;
              grant_file(nullptr, -1);
              return open("/granted", O_RDONLY) >= 0 ? 4 : 0;
            }),
            0);
  close(file);
}

TEST(Sandbox, LimitsMemory) {
  const auto takes = [] { return std::calloc(1, std::size_t{512} << 20) ? 1 : 0; };
  EXPECT_EQ(confined(takes, std::size_t{256} << 20), 0);
  EXPECT_EQ(confined(takes, std::size_t{4} << 30), 1);
}

}  // namespace sandbox_test
}  // namespace oriel
